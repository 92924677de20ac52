"""Parts that lose energy and are as stiff as the deck says: stretches of bars, other elements, springs of models of matrices."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, product, steps
from mouse_cli.diagnosis.effects.hinges import lines
from mouse_cli.diagnosis.effects.losses import of_elements, of_springs
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.frf.extend import with_lossy_elements, with_lossy_entries
from mouse_cli.diagnosis.likelihoods.frf.lossy import LOSSES, STRUCTURAL, VISCOUS
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.lines import Line
from mouse_cli.diagnosis.sites.stretches import covered, elements_of, of_lines, stretch
from mouse_cli.model.problem import Problem

_SIZES = 4
Chosen = Callable[[Edit, np.ndarray], list[tuple[int, int]]]


def lossy_parts(model: Reduced, middle: float) -> list[Recipe]:
    """D + eta K_e, or C + eta K_e / omega_0 with omega_0 = `middle`, rad/s, of each part."""
    found = []
    for recipe, line in zip(of_lines(model, LOSSY_PART), lines(model), strict=True):
        stiffness = lambda values, line=line: _stiffness(model, line, values)
        chosen = lambda edit, values, line=line: elements_of(edit, line, *stretch(line, values))
        found += _both(
            recipe, stiffness, lambda p, v, n, c=chosen: with_lossy_elements(p, n, v[0], lambda e: c(e, v)), middle
        )
    for recipe in of_elements(model, LOSSY_PART, 1):
        K, number = recipe.change(np.ones(1)).K, recipe.site(np.ones(1)).ids[0]
        chosen = lambda edit, number=number: [edit.element(number)]
        found += _both(recipe, lambda v, K=K: K, lambda p, v, n, c=chosen: with_lossy_elements(p, n, v[0], c), middle)
    for recipe in of_springs(model, LOSSY_PART, 1):
        K = recipe.change(np.ones(1)).K
        stronger = lambda problem, recipe=recipe: recipe.extend(problem, np.ones(1))
        found += _both(
            recipe, lambda v, K=K: K, lambda p, v, n, c=stronger: with_lossy_entries(p, n, v[0], c(p)), middle
        )
    return found


def _stiffness(model: Reduced, line: Line, values: np.ndarray) -> np.ndarray:
    """K (r, r) of a stretch, of bars that are covered in part their share."""
    touched, a, b = covered(line, *stretch(line, values))
    return model.bars.strained(touched, (b - a)[:, None, None] * model.bars.rigid(touched))


def _both(recipe: Recipe, stiffness: Callable, extend: Callable[..., Problem], middle: float) -> list[Recipe]:
    """The part of `recipe`, whose first unknown is a size, with structural and with viscous losses of its `stiffness`."""
    found = []
    for law, name, unit in ((STRUCTURAL, "loss_factor", 1.0), (VISCOUS, "stiffness_damping", middle)):
        eta = LOSSES[law]

        def change(values: np.ndarray, law=law, unit=unit) -> Change:
            matrix = values[0] / unit * stiffness(values)
            return Change(D=matrix) if law == STRUCTURAL else Change(C=matrix)

        extended = lambda problem, values, name=name, unit=unit: extend(
            problem, np.append(values[0] / unit, values[1:]), name
        )
        rest = np.unique(recipe.grid[:, 1:], axis=0)
        at = product(steps(eta, _SIZES), np.arange(len(rest)))
        grid = np.hstack([at[:, :1], rest[at[:, 1].astype(int)]])
        share = recipe.log_prior - float(np.log(2))
        unknowns = (eta, *recipe.unknowns[1:])
        found.append(
            replace(recipe, unknowns=unknowns, change=change, grid=grid, log_prior=share, extend=extended, law=law)
        )
    return found


LOSSY_PART = Candidate(
    "lossy-part",
    "a part that loses energy",
    "local-damping",
    "a stretch of a bar, another element or a spring that dissipates more than the rest, with the stiffness of the deck (rubbing "
    "joint, damping layer, damper between two parts): D + eta K_e, or C + eta K_e / omega_0; sought in FRFs only",
    lambda model, candidate: [],
)

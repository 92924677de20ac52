"""A support on a block of its own: it is flexible against the ground, and what moves has a mass.

A flexible support without mass moves as its spring is loaded. A foundation, a pedestal or the table of a test stand has inertia
too, so that structure and block are two bodies: K + k e e', M + m e e' in the motion e of the support, which carries the structure
along as statics says (Wolf, Dynamic Soil-Structure Interaction, 1985, ch. 3). Sought are k and the frequency of the block alone,
sqrt(k / m) / (2 pi): far above the band it is a flexible support, far below it a mass in free space.
"""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, product, steps
from mouse_cli.diagnosis.effects.released import SOFTEST, STIFFEST
from mouse_cli.diagnosis.effects.support_sets import support_site
from mouse_cli.diagnosis.effects.supports import Released, released
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import highest, lowest
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.problem import Problem

_MOST = 8  # supports that are looked at: those that bear most
_STARTS = 5, 6  # stiffnesses and frequencies to begin from
_BAND = 0.3, 3.0  # of the lowest and the highest measured frequency: own frequencies of blocks


def blocks(model: Reduced, candidate: Candidate, turning: bool) -> list[Recipe]:
    """A recipe for each support that the measured modes load, in translation or in rotation."""
    if model.problem.held is not None:
        return []
    found = released(model, range(3, 6) if turning else range(3), most=_MOST, light=True)
    return [] if found is None else [_recipe(model, candidate, found, n) for n in range(len(found.held))]


def _recipe(model: Reduced, candidate: Candidate, found: Released, n: int) -> Recipe:
    """On support number n."""
    held, moved, against = found.held[n], found.moved.part([n], model.r), float(found.resistance[n])
    hz = np.sqrt([lowest(model), highest(model)]) / (2 * np.pi)
    unit = "N m/rad" if held[1] > 2 else "N/m"
    k = Unknown("stiffness of the ground", unit, SOFTEST * against, STIFFEST * against)
    f = Unknown("frequency of the block alone", "Hz", _BAND[0] * hz[0], _BAND[1] * hz[1])
    support = support_site(model.problem, [held])
    site = replace(support, text=f"{support.text}, on a block")

    def change(values: np.ndarray) -> Change:
        M = moved.M.copy()
        M[-1, -1] += _inertia(*values)
        return replace(moved.on_springs(values[:1]), M=M)

    extend = lambda problem, values: _on_block(problem, model.problem, held, *values)
    grid = product(steps(k, _STARTS[0]), steps(f, _STARTS[1]))
    prior = -float(np.log(len(found.held)))
    return Recipe(
        candidate, (k, f), change, grid, lambda values: site, 1, log_prior=prior, extend=extend, carried=moved.carried
    )


def _inertia(k: float, hz: float) -> float:
    """Mass (kg) or moment of inertia (kg m2) of a block."""
    return k / (2 * np.pi * hz) ** 2


def _on_block(problem: Problem, known: Problem, held: tuple[int, int], k: float, hz: float) -> Problem:
    """The deck with a spring in place of the support, and the inertia of the block, in its direction alone, behind it."""
    edit, (there, d) = Edit(problem), held
    node, text = edit.index(int(known.mesh.node_ids[there])), support_site(known, [held]).text
    edit.supports = [each for each in edit.supports if each != (node, d)]
    unit, name, of = ("N m/rad", f"J{'xyz'[d - 3]}", "kg m2") if d > 2 else ("N/m", "mass", "kg")
    spring = edit.add("spring", [[node]], {DIRECTIONS[d]: k})
    edit.bind(f"stiffness of the ground under {text}", spring, (DIRECTIONS[d],), unit=unit)
    block = edit.add("mass", [[node]], {"mass": 0.0} | {name: _inertia(k, hz)})
    edit.bind(f"inertia of the block under {text}", block, (name,), unit=of)
    return edit.done()

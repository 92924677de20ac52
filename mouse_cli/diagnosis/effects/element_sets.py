"""Named element sets of imported matrices that lose, or gain, stiffness or mass as a whole."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.extend.matrices import Entries, with_entries
from mouse_cli.diagnosis.extend.points import found as new_parameter
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.sets import within
from mouse_cli.model.arrays import Matrix, upper_triangle
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.held import ElementGroup
from mouse_cli.model.problem import Problem

_MISSING, _HEAVIER = Unknown("share lost", "1", 0.02, 0.999), Unknown("share gained", "1", 0.02, 20.0)
_FELT = 1e-6  # share of the energy of a mode below which a set has no part in it


def listed(model: Reduced) -> list[tuple[str, Entries, np.ndarray]]:
    """Sets with stiffness: name, entries of -K in the matrices of the model, and K (r, r)."""
    parts = [(group, within(model.problem, group.K)) for group in model.problem.groups]
    return [(text(group), _entries(K, -1), model.project(K)) for group, K in parts if K is not None]


def missing(model: Reduced, candidate) -> list[Recipe]:
    """K - d K_s and M - d M_s of each set that has both: a part that is missing, in part or as a whole, or thinner."""
    found = []
    for group in model.problem.groups:
        K, M = (within(model.problem, each) for each in (group.K, group.M))
        if K is not None and M is not None:
            found.append((group, -model.project(K), -model.project(M), _entries(K, -1), _entries(M, -1)))
    return [_recipe(candidate, _MISSING, one, len(found), "and its mass, lost") for one in _that_bear(model, found)]


def heavier(model: Reduced, candidate) -> list[Recipe]:
    """M + d M_s of each set: a lining, a filling, something that is fastened all over it."""
    parts = [(group, within(model.problem, group.M)) for group in model.problem.groups]
    none = np.zeros((model.r, model.r))
    found = [(group, none, model.project(M), None, _entries(M, 1)) for group, M in parts if M is not None]
    return [_recipe(candidate, _HEAVIER, one, len(found), "in mass, gained") for one in found]


def text(group: ElementGroup) -> str:
    """A set in words."""
    return f"element set {group.name}"


def _recipe(candidate, share: Unknown, one: tuple, count: int, what: str) -> Recipe:
    group, K, M, stiff, heavy = one
    site = Site("dof", (), None, text(group))

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        given = {name: each for name, each in (("K", stiff), ("M", heavy)) if each is not None}
        return with_entries(problem, new_parameter(f"share of {text(group)} {what}", values[0], "1"), **given)

    return Recipe(
        candidate,
        (share,),
        lambda values: Change(K=values[0] * K, M=values[0] * M),
        steps(share, 4)[:, None],
        lambda values: site,
        log_prior=-float(np.log(count)),
        extend=extend,
    )


def _that_bear(model: Reduced, found: list[tuple]) -> list[tuple]:
    """Those that hold a share of the energy of a measured mode."""
    count = min(model.r, int(model.data.test.number.max()) + 1)
    scale = np.maximum(model.eigenvalues[:count], 1e-9 * model.eigenvalues[-1])
    return [one for one in found if (-np.diag(one[1])[:count] / scale).max() > _FELT]


def _entries(matrix: Matrix, sign: int) -> Entries:
    row, col, values = upper_triangle(matrix)
    return row, col, sign * values

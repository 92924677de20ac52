"""A parameter of the deck that is another one after a change: all that is of one material warmer, a tank that is less full."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.mesh import Binding, Mesh
from mouse_cli.model.problem import Problem

_WIDE, _SELDOM = 5.0, 0.25  # factor either way of what is not merely warmer or softer, and its share of the prior
_SD, _RANGE = 3.0, (0.005, 0.3)  # prior sd, as a share of the value, by which others change; ln of the factor at least, and at most
_STEP, _LINEAR = 0.25, 1e-6  # of the value, by which it is moved; of what that makes, up to which twice as much makes twice of it
_MOST = 200  # parameters that are looked at
_MOSTLY = 0.5  # of all elements of a kind, that a parameter is of


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """K + (f - 1) t dK/dt and M likewise, for each parameter t of most elements of a kind, in which both are linear.

    What has changed in few of them is a member, a storey or a mass, which have mechanisms of their own.
    """
    bound: dict[int, list[Binding]] = {}
    for binding in () if model.problem.mesh is None else model.problem.bindings:
        bound.setdefault(binding.parameter, []).append(binding)
    common = [j for j, bindings in bound.items() if _common(model.problem.mesh, bindings)]
    none = _matrices(model, model.theta) if common else np.zeros(0)
    found = [(j, *slope) for j in common[:_MOST] if (slope := _slope(model, j, none)) is not None]
    return [
        _recipe(model, candidate, bound[j], j, slopes, by, float(np.log(share / len(found))))
        for j, *slopes in found
        for by, share in ((_narrow(model, j), 1 - _SELDOM), (float(np.log(_WIDE)), _SELDOM))
    ]


def _common(mesh: Mesh, bindings: list[Binding]) -> bool:
    """Whether a parameter is of several elements, and of most of their kind."""
    own = {(b.set, int(i)) for b in bindings for i in b.members}
    kinds = {mesh.elements[s].type for s, _ in own}
    return len(own) > 1 and len(own) > _MOSTLY * sum(len(each) for each in mesh.elements if each.type in kinds)


def _narrow(model: Reduced, j: int) -> float:
    """ln of the factor by which a parameter changes as a rule: as far as it is uncertain."""
    return float(np.clip(_SD * model.problem.parameters[j].sd / abs(model.theta[j]), *_RANGE))


def _matrices(model: Reduced, theta: np.ndarray) -> np.ndarray:
    """K and M (2, r, r) at theta (p,), in the coordinates of the model."""
    return np.array([model.project(matrix) for matrix in model.assembly.matrices(theta)])


def _slope(model: Reduced, j: int, none: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """What as much again of a parameter adds to K and M (`none`, 2, r, r); None where they are not linear in it, or know nothing
    of it.
    """
    if not model.theta[j]:
        return None
    unit = model.theta * (np.arange(len(model.theta)) == j)
    added, twice = (_matrices(model, model.theta + share * unit) - none for share in (_STEP, 2 * _STEP))
    least = _LINEAR * np.abs(none).max(axis=(1, 2))
    known = np.abs(added).max(axis=(1, 2)) > least
    curved = np.abs(twice - 2 * added).max(axis=(1, 2)) > least
    return tuple(added / _STEP) if known.any() and not curved.any() else None


def _recipe(
    model: Reduced, candidate: Candidate, bindings: list[Binding], j: int, slopes: list[np.ndarray], by: float, share: float
) -> Recipe:
    name, mesh = model.problem.parameters[j].name, model.problem.mesh
    ids = tuple(sorted({int(mesh.elements[b.set].ids[i]) for b in bindings for i in b.members}))
    far = by > _narrow(model, j)
    site = Site("element", ids, None, f"parameter '{name}'{', further than it is uncertain' * far}")

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        own = [edit.element(number) for number in ids]
        edit.bind(f"change of {name}", own, tuple(dict.fromkeys(b.property for b in bindings)), factor=values[0])
        return edit.done()

    (K, M), factor = slopes, Unknown("factor", "1", float(np.exp(-by)), float(np.exp(by)))
    change = lambda values: Change(K=(values[0] - 1) * K, M=(values[0] - 1) * M)
    return Recipe(candidate, (factor,), change, steps(factor, 6)[:, None], lambda values: site, log_prior=share, extend=extend)


CANDIDATE = Candidate(
    "parameter",
    "a parameter of the deck that has changed",
    "parameter",
    "with `--changed` alone: a parameter of the deck has another value in what changed, by a factor: all of a material warmer or "
    "softer, a tank less full, where each deck has the same parameters",
    recipes,
    between=True,
)

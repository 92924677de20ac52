"""A body of the deck on a mount that turns: a store on its pylon, a tank on a bracket, an instrument on its foot."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.effects.losses import matrices_of
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import highest, lowest
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.mesh import RigidLink
from mouse_cli.model.problem import Problem

_MOST = 8  # bodies that are looked at: those that turn with the largest share of the energy
_LEAST = 1e-3  # share of the energy of a measured mode that is a body's turning, below which nobody would see it
_BEGUN = 8  # stiffnesses to begin from
_RANGE = 0.2, 10.0  # frequencies of the body on its mount over the lowest and the highest of the band
_AXES = (3, 4, 5)

Body = tuple[int, int, np.ndarray, tuple[int, ...]]  # number of the element, node (index), M (6, 6), axes about which it turns


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """M of a body moves with its node but for turns p of its own about some axes, K + k (t - p)'(t - p), t those of the node.

    Half of the prior is of one axis, half of all of them, each with its own stiffness.
    """
    found = _bodies(model)
    one = [(number, node, M, (d,)) for number, node, M, axes in found for d in axes]
    kinds = [kind for kind in (one, [each for each in found if len(each[3]) > 1]) if kind]
    return [_recipe(model, candidate, *each, len(kind) * len(kinds)) for kind in kinds for each in kind]


def _bodies(model: Reduced) -> list[Body]:
    mesh, count, found = model.problem.mesh, model.low_modes(), []
    for s, members in enumerate(() if mesh is None else mesh.elements):
        for i, M in enumerate(matrices_of(model, s)["M"] if members.type == "mass" else ()):
            node = int(members.nodes[i, 0])
            turns = M.diagonal()[3:, None] * model.node(node)[3:, :count] ** 2
            axes = tuple(d for d in _AXES if d in mesh.directions and turns[d - 3].max() > _LEAST)
            if axes:
                found.append((-turns.max(), (int(members.ids[i]), node, M, axes)))
    return [body for _, body in sorted(found, key=lambda each: each[0])[:_MOST]]


def _recipe(
    model: Reduced, candidate: Candidate, number: int, node: int, M: np.ndarray, axes: tuple[int, ...], count: int
) -> Recipe:
    R, r, a = model.node(node), model.r, len(axes)
    own = np.hstack([R, np.zeros((6, a))])  # of the body
    own[list(axes)] = np.eye(r + a)[r:]
    moved = own.T @ M @ own
    moved[:r, :r] -= R.T @ M @ R
    apart = np.hstack([R[list(axes)], -np.eye(a)])
    low, high = _RANGE[0] ** 2 * lowest(model), _RANGE[1] ** 2 * highest(model)
    k = [_stiffness(d, M[d, d] * low, M[d, d] * high, a) for d in axes]
    site = Site("element", (number,), tuple(model.problem.mesh.coordinates[node].tolist()), _text(number, axes))
    return Recipe(
        candidate,
        tuple(k),
        lambda values: Change((apart.T * values) @ apart, moved),
        np.column_stack([steps(each, _BEGUN) for each in k]),
        lambda values: site,
        own=a,
        log_prior=-float(np.log(count)),
        extend=lambda problem, values: _hinged(problem, number, axes, values),
    )


def _stiffness(axis: int, low: float, high: float, count: int) -> Unknown:
    return Unknown("stiffness" if count < 2 else f"stiffness, {DIRECTIONS[axis]}", "N m/rad", low, high)


def _text(number: int, axes: tuple[int, ...]) -> str:
    return f"mass {number}, about {', '.join('XYZ'[d - 3] for d in axes)}"


def _hinged(problem: Problem, number: int, axes: tuple[int, ...], values: np.ndarray) -> Problem:
    """The deck with mass `number` on a node of its own, which turns about some axes on springs."""
    edit = Edit(problem)
    element = edit.element(number)
    host = int(edit.sets[element[0]].nodes[element[1], 0])
    free = edit.node(edit.coordinates[host])
    across = tuple(each for each in problem.mesh.directions if each not in axes)
    edit.links += [RigidLink(host, free, across)] if across else []
    edit.move_to(element, free)
    spring = edit.add("spring", [[host, free]], {DIRECTIONS[d]: k for d, k in zip(axes, values, strict=True)})
    for d in axes:
        edit.bind(f"mount of {_text(number, (d,))}", spring, (DIRECTIONS[d],), unit="N m/rad")
    return edit.done()


CANDIDATE = Candidate(
    "mount-rotation",
    "a body on a mount that turns",
    "local-stiffness",
    "a body of the deck (a point mass with rotary inertia, or beside its node) whose mount is not as stiff in turning as modelled, "
    "about one axis or about all: a store on its pylon, a tank on a bracket; each axis has one mode more",
    recipes,
)

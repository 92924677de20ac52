"""A part of a point mass of the deck that is on a spring instead of fixed: liquid that sloshes, a machine on a soft mount."""

from itertools import combinations

import numpy as np

from mouse_cli.diagnosis.effects.arms import at_end, offset, with_arm
from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, product, steps
from mouse_cli.diagnosis.effects.losses import matrices_of
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import BODY, highest, lowest, total_mass
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.mesh import RigidLink
from mouse_cli.model.problem import Problem

Item = tuple[int, int, np.ndarray, float]  # number of the element, node (index), vector (3,) from there to the mass, and kg

_MOST = 12  # point masses that are looked at, the heaviest
_STILL = 0.02  # share of the largest motion in a measured mode below which a direction does not take part
_SHARES = np.array([0.1, 0.3, 0.8])  # to begin from


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """K + k [B, -1]'[B, -1], M + m [0, 1]'[0, 1] - m B'B, k = m (2 pi f)^2, m a share of the mass of one element, B its motion.

    Half of the prior is of one axis, half of several that are alike.
    """
    found, count = _heaviest(model), model.low_modes()
    moved = [np.abs(at_end(model, model.node(node), off)[:, :count]).max(axis=1) for _, node, off, _ in found]
    least = _STILL * max((each.max() for each in moved), default=0.0)
    taking = [[d for d in range(3) if own[d] > least] for own in moved]
    some = lambda n: [(*each, axes) for each, own in zip(found, taking, strict=True) for axes in combinations(own, n)]
    kinds = [kind for kind in (some(1), some(2) + some(3)) if kind]
    return [_recipe(model, candidate, *each, len(kind) * len(kinds)) for kind in kinds for each in kind]


def _heaviest(model: Reduced) -> list[Item]:
    """Those that a body as light as bodies may be can be a part of."""
    mesh, found = model.problem.mesh, []
    for s, members in enumerate(() if mesh is None else mesh.elements):
        if members.type == "mass":
            masses = [float(M[0, 0]) for M in matrices_of(model, s)["M"]]
            offsets = [offset(members)] * len(masses)
            found += zip(members.ids.tolist(), members.nodes[:, 0].tolist(), offsets, masses, strict=True)
    found = [each for each in found if each[3] > BODY[0] * total_mass(model)]
    return sorted(sorted(found, key=lambda each: -each[3])[:_MOST], key=lambda each: each[0])


def _recipe(
    model: Reduced,
    candidate: Candidate,
    number: int,
    node: int,
    off: np.ndarray,
    mass: float,
    axes: tuple[int, ...],
    count: int,
) -> Recipe:
    hz = np.sqrt([lowest(model), highest(model)]) / (2 * np.pi)
    share = Unknown("share of the mass", "1", max(0.02, BODY[0] * total_mass(model) / mass), 1.0)
    f = Unknown("frequency", "Hz", 0.3 * hz[0], 1.5 * hz[1])
    measured = model.data.test.frequency_hz[model.data.has_frequency]
    B = at_end(model, model.node(node), off)[list(axes)]
    a, along = len(axes), np.hstack([B, -np.eye(len(axes))])
    moved = np.pad(-B.T @ B, (0, a)) + np.diag(np.append(np.zeros(B.shape[1]), np.ones(a)))
    site = Site("element", (number,), tuple(model.problem.mesh.coordinates[node].tolist()), _text(number, axes))

    def change(values: np.ndarray) -> Change:
        m = values[0] * mass
        return Change(m * (2 * np.pi * values[1]) ** 2 * along.T @ along, m * moved)

    def limit(values: np.ndarray) -> str:
        """So stiff that it follows the structure it acts as a mass; so soft that it stands still, as a mass that is gone."""
        if values[1] > hz[1]:
            return "mass"
        return "mass-loss" if values[1] < hz[0] else ""

    starts = product(np.unique(np.maximum(_SHARES, share.lower)), np.concatenate([steps(f, 10), measured]))
    extend = lambda problem, values: _hung(problem, number, axes, values[0], mass, (2 * np.pi * values[1]) ** 2)
    prior = -float(np.log(count))
    return Recipe(
        candidate, (share, f), change, starts, lambda values: site, own=a, log_prior=prior, extend=extend, limit=limit
    )


def _text(number: int, axes: tuple[int, ...]) -> str:
    return f"mass {number}, {' and '.join(DIRECTIONS[d] for d in axes)}{' alike' if len(axes) > 1 else ''}"


def _hung(problem: Problem, number: int, axes: tuple[int, ...], share: float, mass: float, rate: float) -> Problem:
    """The deck with `share` of mass `number` on a node of its own, on a spring along some axes and fixed across them."""
    edit = Edit(problem)
    element = edit.element(number)
    members = edit.sets[element[0]]
    host, off = int(members.nodes[element[1], 0]), offset(members)
    host = with_arm(edit, host, off) if off.any() else host
    free = edit.node(edit.coordinates[host])
    across = tuple(each for each in range(3) if each not in axes and each in problem.mesh.directions)
    edit.links += [RigidLink(host, free, across)] if across else []
    text, along = _text(number, axes), tuple(DIRECTIONS[d] for d in axes)
    edit.bind(f"fixed part of {text}", [element], ("mass",), factor=1 - share)
    edit.bind(f"part of {text} on a spring", edit.add("mass", [[free]], {"mass": share * mass}), ("mass",), unit="kg")
    spring = edit.add("spring", [[host, free]], dict.fromkeys(along, share * mass * rate))
    edit.bind(f"spring of a part of {text}", spring, along, unit="N/m")
    return edit.done()


CANDIDATE = Candidate(
    "sprung-mass",
    "a part of a point mass on a spring of its own",
    "oscillator",
    "a point mass of the deck, or a share of it, that moves against the structure along one axis, or along several alike: liquid "
    "that sloshes in a tank, a machine on soft mounts; its mass is taken out of what is fixed, and each axis has one mode more",
    recipes,
)

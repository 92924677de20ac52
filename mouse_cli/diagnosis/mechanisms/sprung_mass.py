"""A part of a point mass of the deck that is on a spring instead of fixed: liquid that sloshes, a machine on a soft mount."""

import numpy as np

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

_MOST = 12  # point masses that are looked at, the heaviest
_STILL = 0.02  # share of the largest motion in a measured mode below which a direction does not take part
_SHARES = np.array([0.1, 0.3, 0.8])  # to begin from


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """K + k [B, -1]'[B, -1], M + m [0, 1]'[0, 1] - m B'B, k = m (2 pi f)^2, m a share of the mass of one element along one axis."""
    found, count = _heaviest(model), model.low_modes()
    moved = [np.abs(model.node(node)[:3, :count]).max(axis=1) for *_, node, _ in found]
    least = _STILL * max((each.max() for each in moved), default=0.0)
    sites = [(*each, d) for each, own in zip(found, moved, strict=True) for d in range(3) if own[d] > least]
    return [_recipe(model, candidate, *each, len(sites)) for each in sites]


def _heaviest(model: Reduced) -> list[tuple[int, int, float]]:
    """Number of the element, node (index) and mass (kg) of those that a body as light as bodies may be can be a part of."""
    mesh, found = model.problem.mesh, []
    for s, members in enumerate(() if mesh is None else mesh.elements):
        if members.type == "mass":
            masses = [float(M[0, 0]) for M in matrices_of(model, s)["M"]]
            found += zip(members.ids.tolist(), members.nodes[:, 0].tolist(), masses, strict=True)
    found = [each for each in found if each[2] > BODY[0] * total_mass(model)]
    return sorted(sorted(found, key=lambda each: -each[2])[:_MOST])


def _recipe(model: Reduced, candidate: Candidate, number: int, node: int, mass: float, d: int, count: int) -> Recipe:
    hz = np.sqrt([lowest(model), highest(model)]) / (2 * np.pi)
    share = Unknown("share of the mass", "1", max(0.02, BODY[0] * total_mass(model) / mass), 1.0)
    f = Unknown("frequency", "Hz", 0.3 * hz[0], 1.5 * hz[1])
    measured = model.data.test.frequency_hz[model.data.has_frequency]
    B = model.node(node)[d]
    along, own = np.append(B, -1.0), np.diag(np.append(np.zeros(len(B)), 1.0))
    fixed = np.outer(np.append(B, 0.0), np.append(B, 0.0))
    site = Site(
        "element", (number,), tuple(model.problem.mesh.coordinates[node].tolist()), f"mass {number}, {DIRECTIONS[d]}"
    )

    def change(values: np.ndarray) -> Change:
        m = values[0] * mass
        return Change(m * (2 * np.pi * values[1]) ** 2 * np.outer(along, along), m * (own - fixed))

    def limit(values: np.ndarray) -> str:
        """So stiff that it follows the structure it acts as a mass; so soft that it stands still, as a mass that is gone."""
        if values[1] > hz[1]:
            return "mass"
        return "mass-loss" if values[1] < hz[0] else ""

    starts = product(np.unique(np.maximum(_SHARES, share.lower)), np.concatenate([steps(f, 10), measured]))
    extend = lambda problem, values: _hung(problem, number, d, values[0], mass, (2 * np.pi * values[1]) ** 2)
    prior = -float(np.log(count))
    return Recipe(
        candidate, (share, f), change, starts, lambda values: site, own=1, log_prior=prior, extend=extend, limit=limit
    )


def _hung(problem: Problem, number: int, d: int, share: float, mass: float, rate: float) -> Problem:
    """The deck with `share` of mass `number` on a node of its own, on a spring along d and fixed across it."""
    edit = Edit(problem)
    element = edit.element(number)
    host = int(edit.sets[element[0]].nodes[element[1], 0])
    free = edit.node(edit.coordinates[host])
    across = tuple(each for each in range(3) if each != d and each in problem.mesh.directions)
    edit.links += [RigidLink(host, free, across)] if across else []
    text = f"mass {number}, {DIRECTIONS[d]}"
    edit.bind(f"fixed part of {text}", [element], ("mass",), factor=1 - share)
    edit.bind(f"part of {text} on a spring", edit.add("mass", [[free]], {"mass": share * mass}), ("mass",), unit="kg")
    spring = edit.add("spring", [[host, free]], {DIRECTIONS[d]: share * mass * rate})
    edit.bind(f"spring of a part of {text}", spring, (DIRECTIONS[d],), unit="N/m")
    return edit.done()


CANDIDATE = Candidate(
    "sprung-mass",
    "a part of a point mass on a spring of its own",
    "oscillator",
    "a point mass of the deck, or a share of it, that moves against the structure along one axis: liquid that sloshes in a tank, "
    "a machine on a soft mount; its mass is taken out of what is fixed, and one mode more than the model has is its own",
    recipes,
)

"""A body at a node: a hub, a flywheel, a heavy joint; or the rotary inertia alone of what the deck has as a point."""

import numpy as np

from mouse_cli.diagnosis.effects.arms import turning
from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, product, steps
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import BODY, span, total_mass
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.attached import Attached
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.problem import Problem

_STILL = 1e-3  # share of the largest turn below which a node does not turn about an axis
_INERTIA = ("Jx", "Jy", "Jz")


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """M + J R'R and M + m T'T + J R'R for the translations T and rotations R of a node: J alike about all axes, and about each."""
    nodes, count = turning(model)
    found = []
    for node, at in nodes:
        turned = np.abs(model.node(node)[3:]).max(axis=1)
        axes = [d for d in range(3) if turned[d] > _STILL * turned.max()]
        about = [axes, *([d] for d in axes if len(axes) > 1)]
        shares = -float(np.log(2 * count)), -float(np.log(2 * count * len(about)))
        found.append(_recipe(model, candidate, node, at, axes, True, shares[0]))
        found += [_recipe(model, candidate, node, at, own, False, shares[1]) for own in about]
    return found


def _recipe(
    model: Reduced, candidate: Candidate, node: int, at: Attached, axes: list[int], heavy: bool, share: float
) -> Recipe:
    """axes: those about which it has inertia; heavy: it has mass too."""
    number, total = int(model.problem.mesh.node_ids[node]), total_mass(model)
    least, most = total * span(model) ** 2 * np.array([1e-6, 5e-2])
    J, m = Unknown("rotary inertia", "kg m2", least, most), Unknown("mass", "kg", *(BODY * total))
    turns = at.rows[[3 + d for d in axes]]
    straight, turned = at.rows[:3].T @ at.rows[:3], turns.T @ turns
    one = "" if heavy else f", rotary inertia alone, {' and '.join(DIRECTIONS[3 + d] for d in axes)}"
    site = Site("node", (number,), tuple(model.problem.mesh.coordinates[node].tolist()), f"node {number}{one}")

    def change(values: np.ndarray) -> Change:
        M = values[0] * turned + (values[1] * straight if heavy else 0.0)
        return Change(K=at.K, M=at.with_mass(M), sensing=at.sensing)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        inertia = {_INERTIA[d]: values[0] for d in axes}
        own = edit.add("mass", [[edit.index(number)]], {"mass": values[1] if heavy else 0.0, **inertia})
        edit.bind(f"rotary inertia at {site.text}", own, tuple(inertia), unit="kg m2")
        if heavy:
            edit.bind(f"mass at {site.text}", own, ("mass",), unit="kg")
        return edit.done()

    unknowns, grid = ((J, m), product(steps(J, 4), steps(m, 3))) if heavy else ((J,), steps(J, 5)[:, None])
    return Recipe(candidate, unknowns, change, grid, lambda values: site, at.own, log_prior=share, extend=extend)


CANDIDATE = Candidate(
    "extended-mass",
    "a lumped mass with rotary inertia",
    "mass",
    "a body at a node that the model lacks, or has as a point: a hub, a flywheel, a heavy joint: M + m T'T + J R'R for the "
    "translations T and rotations R of the node; or its rotary inertia alone, M + J R'R, about one axis or all alike",
    recipes,
    plain="mass",
)

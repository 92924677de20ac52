"""A body at a node: a hub, a flywheel, a heavy joint; or the rotary inertia alone of what the deck has as a point."""

import numpy as np

from mouse_cli.diagnosis.effects.arms import turning
from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import BODY, span, total_mass
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.attached import Attached
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.problem import Problem

_STILL = 1e-3  # share of the largest turn in the measured modes, below which a node does not turn about an axis
_INERTIA = ("Jx", "Jy", "Jz")


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """M + m T'T + R'J R for the translations T and rotations R of a node: J alike about all axes, each its own, and about one."""
    nodes, count = turning(model)
    found, used = [], model.low_modes(2)  # which are the same in whatever coordinates a first look is taken
    for node, at in nodes:
        turned = np.abs(model.node(node)[3:, :used]).max(axis=1)
        axes = [d for d in range(3) if turned[d] > _STILL * turned.max()]
        each = tuple((d,) for d in axes)
        bodies = [(tuple(axes),), each] if len(axes) > 1 else [each]
        about = [*bodies, *((own,) for own in each)] if len(axes) > 1 else bodies
        shares = -float(np.log(2 * count * len(bodies))), -float(np.log(2 * count * len(about)))
        found += [_recipe(model, candidate, node, at, own, True, shares[0]) for own in bodies]
        found += [_recipe(model, candidate, node, at, own, False, shares[1]) for own in about]
    return found


def _recipe(
    model: Reduced,
    candidate: Candidate,
    node: int,
    at: Attached,
    axes: tuple[tuple[int, ...], ...],
    heavy: bool,
    share: float,
) -> Recipe:
    """axes: those about which it has inertia, in sets of which each has one of its own; heavy: it has mass too."""
    number, total = int(model.problem.mesh.node_ids[node]), total_mass(model)
    least, most = total * span(model) ** 2 * np.array([1e-6, 5e-2])
    names = [f"rotary inertia, R{'XYZ'[own[0]]}" if len(axes) > 1 else "rotary inertia" for own in axes]
    J = [Unknown(name, "kg m2", least, most) for name in names]
    m = Unknown("mass", "kg", *(BODY * total))
    about = " and ".join(DIRECTIONS[3 + d] for own in axes for d in own) + (", each its own" if len(axes) > 1 else "")
    one = (", each axis its own" if len(axes) > 1 else "") if heavy else f", rotary inertia alone, {about}"
    site = Site("node", (number,), tuple(model.problem.mesh.coordinates[node].tolist()), f"node {number}{one}")

    def change(values: np.ndarray) -> Change:
        inertia = np.repeat([values[-1] if heavy else 0.0, 0.0], 3)
        for value, own in zip(values, axes, strict=False):
            inertia[[3 + d for d in own]] = value
        return Change(K=at.K, M=at.with_mass((at.rows.T * inertia) @ at.rows), sensing=at.sensing)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        inertia = {_INERTIA[d]: value for own, value in zip(axes, values, strict=False) for d in own}
        mass = edit.add("mass", [[edit.index(number)]], {"mass": values[-1] if heavy else 0.0, **inertia})
        for own, name in zip(axes, names, strict=True):
            edit.bind(f"{name} at {site.text}", mass, tuple(_INERTIA[d] for d in own), unit="kg m2")
        if heavy:
            edit.bind(f"mass at {site.text}", mass, ("mass",), unit="kg")
        return edit.done()

    alike = np.tile(steps(J[0], 4 if heavy else 5)[:, None], len(J))
    grid = np.hstack([np.repeat(alike, 3, 0), np.tile(steps(m, 3), 4)[:, None]]) if heavy else alike
    unknowns = (*J, m) if heavy else tuple(J)
    return Recipe(candidate, unknowns, change, grid, lambda values: site, at.own, log_prior=share, extend=extend)


CANDIDATE = Candidate(
    "extended-mass",
    "a lumped mass with rotary inertia",
    "mass",
    "a body at a node that the model lacks, or has as a point: a hub, a flywheel, a heavy joint: M + m T'T + R'J R for the "
    "translations T and rotations R of the node; or its rotary inertia alone, M + R'J R; about one axis, about all alike, or "
    "about each its own",
    recipes,
    plain="mass",
)

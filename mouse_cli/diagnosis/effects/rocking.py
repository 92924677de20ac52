"""A foundation that moves as one rigid body: all supports of a mesh together, or a building of storeys that turns about its base.

With psi the motion of the whole for a unit motion of the base, u = V q + psi c: held together, psi is what statics makes of the
rigid motion of all supports. Storeys resist the drift alone, which a rigid rotation is not, although a model without rotations
takes it for one: there psi = h, the height above the base, K psi = 0, and psi' M psi gets the rotary inertia of floors and base.
"""

from dataclasses import replace
from itertools import combinations

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, product, steps
from mouse_cli.diagnosis.effects.released import Followed, followed, free_model, static
from mouse_cli.diagnosis.extend.base import joined, on_joints
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.bases import Axis, Base, axes, base, loaded
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.geometry import DIRECTIONS

_SOFT, _SOFTER, _STIFF = 0.8, 0.03, 200.0  # times what gives the rigid structure on it the lowest measured frequency
_STARTS = 10, 12  # sizes to begin from: no descent passes a mode, and between which two its own lies depends on both
_SMALL, _LARGE = 1e-2, 0.5  # rotary inertia of floors and base, of that of all masses about the base


def rocking(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """What the base of a model can do: turn below storeys, or move in each direction where all of its supports are one body."""
    if model.motion is None:
        return []
    found = [_turned(model, candidate, axis) for axis in axes(model.problem)]
    found = found or _blocks(model, candidate, base(model.problem))
    return [replace(one, log_prior=-float(np.log(len(found)))) for one in found]


def _range(model: Reduced, inertia: float) -> tuple[float, float]:
    """Ends of the stiffness below a structure of that inertia.

    By Rayleigh's principle no structure on a base has a higher first frequency than if it were rigid, but for errors of its mass.
    """
    scale, first = lowest(model) * inertia, int(model.data.test.number.min()) == 1
    return (_SOFT if first else _SOFTER) * scale, _STIFF * scale


def _turned(model: Reduced, candidate: Candidate, axis: Axis) -> Recipe:
    """A building of storeys that turns about its base."""
    free = free_model(model)
    motion = np.zeros((free.n, 1))
    for label, factor in axis.heights.items():
        if label in free.place:
            motion[free.place[label], 0] = factor
    moved = followed(model, free, motion)
    r, K, M, carried = model.r, moved.K, moved.M, moved.carried
    K[:, r:], K[r:, :] = 0.0, 0.0
    slopes = carried.slopes
    slopes[0][:, :, r:], slopes[0][:, r:, :] = 0.0, 0.0
    carried = replace(carried, K=0 * motion, every=slopes, across=_still(carried.across), strain=0 * carried.strain)
    inertia = float(M[r, r]) + axis.inertia
    M[r, r] = inertia
    direction = DIRECTIONS[axis.rotation]
    k = Unknown("stiffness of the foundation", "N m/rad", *_range(model, inertia))
    J = Unknown("rotary inertia of floors and foundation", "kg m2", _SMALL * inertia, _LARGE * inertia)
    number = int(model.problem.mesh.node_ids[axis.node])
    position = tuple(model.problem.mesh.coordinates[axis.node].tolist())
    site = Site("node", (number,), position, f"the base at node {number}, {direction}")
    one = np.zeros(K.shape)
    one[r, r] = 1.0
    extend = lambda problem, values: on_joints(problem, axis, number, values)
    return Recipe(
        candidate,
        (k, J),
        lambda values: Change(K + values[0] * one, M + values[1] * one, moved.sensing),
        product(steps(k, _STARTS[0]), steps(J, _STARTS[1])),
        lambda values: site,
        own=1,
        extend=extend,
        carried=carried,
    )


def _still(across):
    """Nothing of K, as the motion is rigid; M as it is."""
    return lambda other: (0 * (found := across(other))[0], found[1])


def _blocks(model: Reduced, candidate: Candidate, found: Base | None) -> list[Recipe]:
    """All supports as one body, in each direction that the modes load, and about two axes of those."""
    if found is None:
        return []
    free = free_model(model)
    held = [i for i, label in enumerate(found.labels) if label in free.place]
    if len(held) < len(found.labels):
        return []
    s = np.array([free.place[label] for label in found.labels])
    modes = slice(0, model.low_modes())
    load = np.abs(found.pattern.T @ free.reactions(model, s, modes)).max(axis=1)
    chosen = loaded(load)
    if not chosen:
        return []
    moved = followed(model, free, static(model, free, s, found.pattern[:, chosen]))
    turns = [i for i, d in enumerate(chosen) if d > 2]
    sets = [[i] for i in range(len(chosen))] + [list(pair) for pair in combinations(turns, 2)]
    return [_block(model, candidate, found, [chosen[i] for i in own], moved.part(own, model.r)) for own in sets]


def _block(model: Reduced, candidate: Candidate, found: Base, directions: list[int], moved: Followed) -> Recipe:
    """In `directions`, each with a stiffness of its own; moved: by these alone."""
    names = [DIRECTIONS[d] for d in directions]
    k = [
        Unknown(
            f"stiffness of the foundation, {name}",
            "N m/rad" if d > 2 else "N/m",
            *_range(model, float(moved.M[model.r + i, model.r + i])),
        )
        for i, (d, name) in enumerate(zip(directions, names, strict=True))
    ]
    site = Site(
        "node", found.numbers, found.centre, f"the foundation of all supports as one body, {' and '.join(names)}"
    )
    change = lambda values: moved.on_springs(values)
    extend = lambda problem, values: joined(problem, found, directions, values)
    grid = product(*(steps(each, 6 if len(k) == 1 else 4) for each in k))
    return Recipe(candidate, tuple(k), change, grid, lambda values: site, len(k), extend=extend, carried=moved.carried)

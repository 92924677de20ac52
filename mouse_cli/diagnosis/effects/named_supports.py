"""Flexible supports of imported matrices, by name: each moves as a rigid body on springs, in one direction or in all, or in part.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.effects.released import (
    SOFTEST,
    STIFFEST,
    Followed,
    Free,
    followed,
    free_model,
    resistance,
    static,
)
from mouse_cli.diagnosis.extend.supports import with_motions
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.geometry import DIRECTIONS, rigid_motions
from mouse_cli.model.held import Support

_MOST = 24  # supports
_FLEXIBLE = 48  # degrees of freedom up to which a support follows the structure as it deforms
_NODES, _ADJACENT = 24, 4  # of a support, parts of which may be loose; nodes that are loose together, less than half of them
_POINT = 1e-9  # of the size of the structure: extent of a support that cannot turn about itself


@dataclass(frozen=True)
class Motions:
    """Of one support: pattern (k, a) of its degrees of freedom, labels (a,), and bed (a, a): stiffness of springs of 1 in all.

    words: what moves, where it is more than one motion.
    """

    support: Support
    pattern: np.ndarray
    labels: tuple[str, ...]
    bed: np.ndarray
    words: str = "all directions"


def named(model: Reduced, candidate, turning: bool) -> list[Recipe]:
    """A recipe for each support and direction, for each in all directions on a bed of springs, and for nodes of it side by side."""
    free = free_model(model)
    sets = _kinds(free, model.problem.held.supports[:_MOST], turning)
    if not sets:
        return []
    motions = [each for kind in sets for each in kind]
    s, pattern = _together(motions)
    motion = static(model, free, s, pattern)
    moved = followed(model, free, motion)
    start, placed = 0, []
    for kind in sets:
        placed.append([])
        for each in kind:
            placed[-1].append((each, list(range(start, start + len(each.labels)))))
            start += len(each.labels)
    parts = [(part, [at[i] for i in own]) for each, at in placed[-1] * (not turning) for part, own in _parts(free, each)]
    placed += [parts] if parts else []
    return [
        _recipe(model, candidate, each, which, moved, len(kind) * len(placed), turning)
        for kind in placed
        for each, which in kind
    ]


def _parts(free: Free, whole: Motions) -> Iterator[tuple[Motions, np.ndarray]]:
    """Nodes side by side of a support that follows the structure as it deforms (bolts that are loose), and which of its columns."""
    at = free.problem.structure.geometry
    alone = np.count_nonzero(whole.pattern, axis=0) == 1
    if at is None or not alone.all():
        return
    nodes = at.node[whole.support.dofs[whole.pattern.argmax(axis=0)]]
    shifted = np.diag(whole.bed) > 0
    own = np.unique(nodes[shifted & (nodes >= 0)])
    if not 2 < len(own) <= _NODES:
        return
    x, seen = at.coordinates[own], set()
    for centre in x:
        order = own[np.argsort(np.linalg.norm(x - centre, axis=1), kind="stable")]
        for count in range(1, min(_ADJACENT, (len(own) - 1) // 2) + 1):
            some = tuple(sorted(order[:count].tolist()))
            if some in seen:
                continue
            seen.add(some)
            columns = np.flatnonzero(np.isin(nodes, some) & shifted)
            names = f"node{'s' * (count > 1)} {', '.join(str(at.node_ids[i]) for i in some)} of it, all directions"
            labels, bed = tuple(whole.labels[i] for i in columns), np.eye(len(columns)) / count
            yield replace(whole, pattern=whole.pattern[:, columns], labels=labels, bed=bed, words=names), columns


def _kinds(free: Free, supports: tuple[Support, ...], turning: bool) -> list[list[Motions]]:
    """Motions of one direction, and, in translation, of all at once."""
    rigid = [_rigid(free, support) for support in supports]
    if turning:
        return [kind for kind in [[m for each in rigid for m in _single(*each, range(3, 6))]] if kind]
    single = [m for each in rigid for m in _single(*each, range(3))]
    whole = [m for each in rigid for m in _whole(*each)]
    return [kind for kind in (single, whole) if kind]


def _rigid(free: Free, support: Support) -> tuple[Support, np.ndarray]:
    """Patterns (k, 6) of a rigid body about the centre of the support."""
    at = free.problem.structure.geometry
    pattern = np.zeros((len(support.dofs), 6))
    if at is None or not (own := at.node[support.dofs] >= 0).any():
        return support, pattern
    x = at.coordinates[at.node[support.dofs[own]]]
    centre = at.coordinates[np.unique(at.node[support.dofs[own]])].mean(axis=0)
    size = float(np.ptp(at.coordinates, axis=0).max())
    pattern[own] = rigid_motions(x - centre, at.direction[support.dofs[own]], _POINT * size)
    return support, pattern


def _single(support: Support, pattern: np.ndarray, directions: range) -> list[Motions]:
    held = [d for d in directions if pattern[:, d].any()]
    return [Motions(support, pattern[:, [d]], (DIRECTIONS[d],), np.ones((1, 1))) for d in held]


def _whole(support: Support, pattern: np.ndarray) -> list[Motions]:
    """All directions, on springs of equal stiffness at every node; one stiffness, that of all of them together, in translation.

    Every degree of freedom for itself where they are few, else as a rigid body. Where such springs hold every rotation of the
    support, rotations of its nodes are free. A support that holds several nodes in one direction is left by each in that one.
    """
    kept = [d for d in range(6) if pattern[:, d].any()]
    translations = [d for d in kept if d < 3]
    count = np.count_nonzero(pattern[:, translations[0]]) if translations else 0
    if len(translations) < 2 and count < 2:
        return []
    shifted = pattern[:, :3].any(axis=1)
    words = "all directions" if len(translations) > 1 else f"{DIRECTIONS[translations[0]]} at each node"
    if len(support.dofs) <= _FLEXIBLE:
        spread = np.linalg.matrix_rank(pattern[shifted, 3:]) == 3  # its springs hold its rotations too
        own = np.flatnonzero(pattern.any(axis=1) if spread else shifted)
        each, bed = np.eye(len(support.dofs))[:, own], np.diag(shifted[own] / count)
        return [Motions(support, each, tuple(f"motion {i + 1}" for i in range(len(own))), bed, words)]
    bed = pattern[shifted][:, kept].T @ pattern[shifted][:, kept]
    return [Motions(support, pattern[:, kept], tuple(DIRECTIONS[d] for d in kept), bed / count, words)]


def _together(motions: list[Motions]) -> tuple[np.ndarray, np.ndarray]:
    """Degrees of freedom of all supports, and patterns (s, a) of all motions."""
    s = np.unique(np.concatenate([each.support.dofs for each in motions]))
    columns = []
    for each in motions:
        block = np.zeros((len(s), each.pattern.shape[1]))
        block[np.searchsorted(s, each.support.dofs)] = each.pattern
        columns.append(block)
    return s, np.hstack(columns)


def _recipe(
    model: Reduced, candidate, own: Motions, which: list[int], moved: Followed, count: int, turning: bool
) -> Recipe:
    K, M = moved.K, moved.M
    r, one = model.r, len(own.labels) == 1
    at = np.concatenate([np.arange(r), r + np.array(which)])
    own_rows, sensing = np.ix_(at, at), moved.sensing[:, at]
    against = resistance(model, K[own_rows], M[own_rows], own.bed)
    unit = "N m/rad" if turning else "N/m"
    k = Unknown("stiffness of the support", unit, SOFTEST * float(against.min()), STIFFEST * float(against.max()))
    words = own.labels[0] if one else own.words
    site = Site("node", (), None, f"the support {own.support.name}, {words}")

    def change(values: np.ndarray) -> Change:
        with_springs = K[own_rows]  # of all supports: many recipes share it
        with_springs[r:, r:] += values[0] * own.bed
        return Change(with_springs, M[own_rows], sensing)

    extend = lambda problem, values: with_motions(
        problem, own.support.name, own.pattern, own.labels, own.bed, values[0], unit
    )
    return Recipe(
        candidate,
        (k,),
        change,
        steps(k, 8)[:, None],
        lambda values: site,
        own=len(which),
        log_prior=-float(np.log(count)),
        extend=extend,
        carried=moved.carried.part(which, r),
    )

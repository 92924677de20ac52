"""Motions of named supports of imported matrices: of one direction or of all, of each or of several alike, of all of it or a part.

What is soft in shear, as rubber is, has a stiffness across the plane of the supports and one in it, or is held in one of both.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from mouse_cli.diagnosis.effects.released import Free
from mouse_cli.diagnosis.effects.support_sets import TOGETHER, in_rows
from mouse_cli.model.geometry import DIRECTIONS, rigid_motions
from mouse_cli.model.groups import enumerated
from mouse_cli.model.held import Support

_ALL, _ALONG, _ACROSS = "all directions", "along ", "across "
_FLEXIBLE, _TOGETHER = 48, 128  # degrees of freedom up to which a support, and several, follow the structure as they deform
_NODES, _ADJACENT = 24, 4  # of a support, parts of which may be loose; nodes that are loose together, less than half of them
_POINT = 1e-9  # of the size of the structure: extent of a support that cannot turn about itself
_PLANE = 1e-6  # of the same, by which the nodes of supports of one plane are out of it at most
_FEW = 4  # supports of a kind, any of which may be loose together


@dataclass(frozen=True)
class Motions:
    """Of supports: pattern (k, a) of their degrees of freedom, labels (a,), and springs (k, a), one a stiffness: a bed S'S.

    called: the support, or supports; words: what moves, where it is more than one motion; across: direction of the first stiffness.
    """

    supports: tuple[Support, ...]
    pattern: np.ndarray
    labels: tuple[str, ...]
    springs: tuple[np.ndarray, ...]
    called: str
    words: str = _ALL
    across: str = ""

    @property
    def dofs(self) -> np.ndarray:
        """Degrees of freedom (k,)."""
        return np.concatenate([each.dofs for each in self.supports])

    @property
    def beds(self) -> list[np.ndarray]:
        """Stiffness (a, a) of springs of 1, one a stiffness."""
        return [each.T @ each for each in self.springs]


def parts(free: Free, whole: Motions) -> Iterator[tuple[Motions, np.ndarray]]:
    """Nodes side by side of a support that follows the structure as it deforms (bolts that are loose), and which of its columns."""
    at = free.problem.structure.geometry
    alone = np.count_nonzero(whole.pattern, axis=0) == 1
    if at is None or not alone.all():
        return
    nodes = at.node[whole.dofs[whole.pattern.argmax(axis=0)]]
    shifted = whole.springs[0].any(axis=0)
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
            labels, pattern = tuple(whole.labels[i] for i in columns), whole.pattern[:, columns]
            yield replace(whole, pattern=pattern, labels=labels, springs=(pattern / np.sqrt(count),), words=names), columns


def kinds(free: Free, supports: tuple[Support, ...], turning: bool) -> list[list[Motions]]:
    """Motions of one direction, and, in translation, of all at once; those with two stiffnesses, and of supports alike."""
    rigid = [_rigid(free, support) for support in supports]
    if turning:
        return [kind for kind in [[m for each in rigid for m in _single(*each, range(3, 6))]] if kind]
    single = [m for each in rigid for m in _single(*each, range(3))]
    whole = [m for each in rigid for m in _whole(*each)]
    if not whole:
        return [single] if single else []
    across = _across(free, supports)
    apart = [part for each in whole for part in _apart(free, each, across) if part.across or not part.words.startswith(_ALONG)]
    return [kind for kind in (single, whole, apart, _alike(free, rigid, across)) if kind]


def _across(free: Free, supports: tuple[Support, ...]) -> int | None:
    """The direction (0 to 2) across the plane that the nodes of all supports are in; None where there is no such plane."""
    at = free.problem.structure.geometry
    if at is None:
        return None
    nodes = np.concatenate([_nodes(free, each) for each in supports])
    if not len(nodes):
        return None
    thick = np.ptp(at.coordinates[nodes], axis=0)
    flat = np.flatnonzero(thick <= _PLANE * np.ptp(at.coordinates, axis=0).max())
    return int(flat[0]) if len(flat) == 1 else None


def _apart(free: Free, whole: Motions, across: int | None) -> list[Motions]:
    """The same with one stiffness across the plane of the supports and another one in it, or held in one of both."""
    if across is None or not whole.words.startswith(_ALL):
        return []
    along, rest = DIRECTIONS[across], whole.words.removeprefix(_ALL)
    own = (free.problem.structure.geometry.direction[whole.dofs] == across)[:, None]
    both = own, ~own
    springs = tuple(np.where(which, whole.springs[0], 0.0) for which in both)
    if not all(each.any() for each in springs):
        return []
    found = [replace(whole, springs=springs, words=f"{_ALONG}{along} and across it{rest}", across=along)]
    for which, words in zip(both, (_ALONG + along, _ACROSS + along), strict=True):
        free_to = np.flatnonzero(~np.where(which, 0.0, whole.pattern).any(axis=0))
        labels, parts = tuple(whole.labels[i] for i in free_to), [each[:, free_to] for each in (whole.pattern, *whole.springs)]
        found += [replace(whole, pattern=parts[0], labels=labels, springs=(parts[1],), words=words + rest)] if len(free_to) else []
    return found


def _alike(free: Free, rigid: list[tuple[Support, np.ndarray]], across: int | None) -> list[Motions]:
    """Supports that hold the same directions, each on springs of the same stiffnesses: all, those of a row, and any of few."""
    at, by, found = free.problem.structure.geometry, {}, []
    for support, pattern in (each for each in rigid if each[1].any()):
        by.setdefault(tuple(pattern[:, :3].any(axis=0)), []).append((support, pattern))
    near = 0.0 if at is None else _PLANE * float(np.ptp(at.coordinates, axis=0).max())
    for own in by.values():
        if not 1 < len(own) <= TOGETHER:
            continue
        centres = np.array([at.coordinates[_nodes(free, each)].mean(axis=0) for each, _ in own])
        rows = [tuple(range(len(own))), *map(tuple, in_rows(centres, near))]
        some = [each for n in range(2, len(own)) for each in combinations(range(len(own)), n)] if len(own) <= _FEW else []
        for which in dict.fromkeys([*rows, *some]):
            flexible = sum(len(own[i][0].dofs) for i in which) <= _TOGETHER
            each = [m for i in which for m in _whole(*own[i], flexible)]
            if len(each) == len(which):
                found.append(one := _joined(each, len(which) == len(rigid)))
                found += _apart(free, one, across) if which in rows else []
    return found


def _joined(each: list[Motions], every: bool) -> Motions:
    """Motions of several supports as those of one, whose stiffness each of them has."""
    from scipy.linalg import block_diag

    called = "all supports" if every else f"the supports {enumerated([one.supports[0].name for one in each])}"
    labels = tuple(f"{one.supports[0].name} {label}" for one in each for label in one.labels)
    pattern, springs = (block_diag(*parts) for parts in ([one.pattern for one in each], [one.springs[0] for one in each]))
    supports = tuple(one.supports[0] for one in each)
    return Motions(supports, pattern, labels, (springs,), called, f"{each[0].words}, alike")


def _rigid(free: Free, support: Support) -> tuple[Support, np.ndarray]:
    """Patterns (k, 6) of a rigid body about the centre of the support."""
    at = free.problem.structure.geometry
    pattern = np.zeros((len(support.dofs), 6))
    if at is None or not (own := at.node[support.dofs] >= 0).any():
        return support, pattern
    x = at.coordinates[at.node[support.dofs[own]]]
    centre = at.coordinates[_nodes(free, support)].mean(axis=0)
    size = float(np.ptp(at.coordinates, axis=0).max())
    pattern[own] = rigid_motions(x - centre, at.direction[support.dofs[own]], _POINT * size)
    return support, pattern


def _nodes(free: Free, support: Support) -> np.ndarray:
    """Nodes of a support, none twice."""
    own = free.problem.structure.geometry.node[support.dofs]
    return np.unique(own[own >= 0])


def _single(support: Support, pattern: np.ndarray, directions: range) -> list[Motions]:
    held = [pattern[:, [d]] for d in directions if pattern[:, d].any()]
    names = [DIRECTIONS[d] for d in directions if pattern[:, d].any()]
    one = lambda P, name: Motions((support,), P, (name,), (P / np.linalg.norm(P),), f"the support {support.name}")
    return [one(P, name) for P, name in zip(held, names, strict=True)]


def _whole(support: Support, pattern: np.ndarray, flexible: bool = True) -> list[Motions]:
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
    words = _ALL if len(translations) > 1 else f"{DIRECTIONS[translations[0]]} at each node"
    P, labels = pattern[:, kept], tuple(DIRECTIONS[d] for d in kept)
    if flexible and len(support.dofs) <= _FLEXIBLE:
        spread = np.linalg.matrix_rank(pattern[shifted, 3:]) == 3  # its springs hold its rotations too
        own = np.flatnonzero(pattern.any(axis=1) if spread else shifted)
        P, labels = np.eye(len(support.dofs))[:, own], tuple(f"motion {i + 1}" for i in range(len(own)))
    springs = np.where(shifted[:, None], P, 0.0) / np.sqrt(count)
    return [Motions((support,), P, labels, (springs,), f"the support {support.name}", words)]

"""Sets of mechanisms whose effects add up best: every pair of places and sizes of all candidates, and larger ones from these.

Of two, to first order, |A_a + A_b|^2 is left, A = W (r - r(none) / 2) and W'W = I - T (T'T + P)^-1 T', as the parameters of the
deck follow both; a further one beside them adds W (r - r(none)). See `superposed`. Products of matrices say it of all: in single
precision, for what is chosen here only says where to begin.
"""

from collections.abc import Iterator

import numpy as np

from mouse_cli.diagnosis.search.superposed import Alone

At = tuple[str, int]  # site of a recipe, and number of the size
Members = tuple[tuple[str, At], ...]  # candidates with their places and sizes
Sum = tuple[float, Members, np.ndarray]  # misfit, members, and the sum of what they do (q,)

_KEPT = 64  # sets of one size that are kept, from which larger ones are made
_ALIKE, _TRIED = 3, 256  # sets of the same candidates that are kept, and sums among which these are sought
_LARGE = 1e12  # effects, by the sd of the data, from which on how large they are is no matter
_ROWS = 512  # places and sizes of one candidate that meet all of another at once


class Effects:
    """What places and sizes of candidates do by themselves, in coordinates where effects add up, and the sets that do best."""

    def __init__(self, alone: dict[str, Alone], T: np.ndarray, adapted: np.ndarray):
        """T (q, k), adapted (k, q + k): how far the parameters of the deck follow to first order; see `Study`."""
        q = len(T)
        values, vectors = np.linalg.eigh(np.eye(q) - T @ adapted[:, :q])
        W = vectors * np.sqrt(np.maximum(values, 0.0))
        self.at = {name: one.at for name, one in alone.items()}
        self.added = {name: _single((one.residuals - one.none) @ W) for name, one in alone.items()}
        self.half = {name: _single(one.none @ W / 2) for name, one in alone.items()}
        self._found: dict[tuple[str, int], list[Sum]] = {}

    def sets(self, count: int, kind: str = "") -> list[Sum]:
        """The best sets of `count`, the best first; kind: a candidate of which all are, if any."""
        if (kind, count) not in self._found:
            names = [name for name in self.at if kind in ("", name)]
            found = self._pairs(names) if count == 2 else self._further(self.sets(count - 1, kind), names)
            self._found[kind, count] = found
        return self._found[kind, count]

    def _pairs(self, names: list[str]) -> list[Sum]:
        found: list[Sum] = []
        for i, name in enumerate(names):
            first = self.added[name] + self.half[name]
            begun = lambda j, name=name, first=first: (((name, self.at[name][j]),), first[j])
            for other in names[i:]:
                found = _best([*found, *self._with(first, begun, other, self.half[other], _bound(found))])
        return found

    def _further(self, sets: list[Sum], names: list[str]) -> list[Sum]:
        """Sets of one more than `sets` have, each beside one of these."""
        found: list[Sum] = []
        if not sets:
            return found
        sums, begun = np.array([own for *_, own in sets]), lambda j: sets[j][1:]
        for other in names:
            found = _best([*found, *self._with(sums, begun, other, 0.0, _bound(found))])
        return found

    def _with(self, sums: np.ndarray, begun, name: str, half, bound: float) -> Iterator[Sum]:
        """The best of `sums` (n, q) with a place and size of candidate `name` beside them, below a misfit of `bound`."""
        B, at = self.added[name] + half, self.at[name]
        taken: set[frozenset] = set()
        for left, i, j in _least(sums, B, bound):
            members, whole = begun(i)
            places = frozenset((other, place) for other, (place, _) in members)
            if (name, at[j][0]) in places or (places := places | {(name, at[j][0])}) in taken:
                continue
            taken.add(places)
            yield left, (*members, (name, at[j])), whole + B[j]
            if len(taken) == _ALIKE:
                return


def _least(A: np.ndarray, B: np.ndarray, bound: float) -> list[tuple[float, int, int]]:
    """|A_i + B_j|^2 below `bound` with i and j, the least first; _TRIED of so many rows at most."""
    found, own = [], np.einsum("ij,ij->i", B, B)
    for start in range(0, len(A), _ROWS):
        some = A[start : start + _ROWS]
        left = 2 * some @ B.T
        left += own
        left += np.einsum("ij,ij->i", some, some)[:, None]
        flat = left.ravel()
        below = np.flatnonzero(flat < bound)
        if len(below) > _TRIED:
            below = below[np.argpartition(flat[below], _TRIED)[:_TRIED]]
        found += [(float(flat[i]), start + i // len(B), i % len(B)) for i in below.tolist()]
    return sorted(found)


def _single(values: np.ndarray) -> np.ndarray:
    """In single precision, so that squares do not overflow."""
    return np.clip(values, -_LARGE, _LARGE).astype(np.float32)


def _bound(found: list[Sum]) -> float:
    """The misfit above which no further set is kept."""
    return found[-1][0] if len(found) == _KEPT else np.inf


def _best(found: list[Sum]) -> list[Sum]:
    """The best, each set of places once."""
    kept: dict[frozenset, Sum] = {}
    for one in sorted(found, key=lambda each: each[0]):
        kept.setdefault(frozenset((name, place) for name, (place, _) in one[1]), one)
    return list(kept.values())[:_KEPT]

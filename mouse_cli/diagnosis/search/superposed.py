"""Places and sizes of a cause that deserve a look beside causes that are there, and pairs of them: those whose effects add up best.

To first order effects add: r(a and b) = r(a) + r(b) - r(none), r the residuals (q,). What each place and size does by itself was
looked at once, at the parameters where the search began, so that beside whatever else only a sum is needed to choose by. Of two
that is |A_a + A_b|^2, A = W (r - r(none) / 2) and W'W = I - T (T'T + P)^-1 T', as the parameters of the deck follow both: a product
of two matrices says it of all places and sizes of both.
"""

from collections.abc import Container, Iterator
from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe

KEPT = 64  # places and sizes of one candidate that are looked at beside others; of no more each is
_EACH = 4  # of one recipe at least, if it has so many among the best
# Pairs of places of two candidates that are kept, and pairs of sizes among which they are sought
_OF_TWO, _TRIED = 3, 512


def text(recipe: Recipe) -> str:
    """Site of a recipe at its first size, by which it is known at any parameters."""
    return recipe.site(recipe.grid[0]).text


@dataclass(frozen=True)
class Alone:
    """What places and sizes do by themselves: site and number of the size (n,), residuals (n, q), and that of none (q,).

    glimpsed: they are those of `Model.glimpsed`, not of its points.
    """

    at: list[tuple[str, int]]
    residuals: np.ndarray
    none: np.ndarray
    glimpsed: bool = False

    def of(self, places: Container[str]) -> "Alone":
        """The same of these sites alone."""
        own = [i for i, (place, _) in enumerate(self.at) if place in places]
        return Alone([self.at[i] for i in own], self.residuals[own], self.none, self.glimpsed)


def by_itself(looks: list[tuple[str, int, np.ndarray]], none: np.ndarray, glimpsed: bool = False) -> Alone:
    """Of looks (site, number of the size, residual) at the prior mean, and the residual (q,) there without a cause."""
    return Alone([each[:2] for each in looks], np.array([residual for *_, residual in looks]), none, glimpsed)


def chosen(
    alone: Alone, residual: np.ndarray, z: np.ndarray, T: np.ndarray, adapted: np.ndarray
) -> set[tuple[str, int]]:
    """The most promising of `alone` beside causes that leave `residual` (q,) at the deck's parameters z (k,).

    T (q, k + t), adapted (k + t, q + k): how far these, and t coordinates of the causes, follow to first order; see `Study`.
    """
    q = len(residual)
    R = alone.residuals + (residual - alone.none)
    steps = R @ adapted[:, :q].T + adapted[:, q:] @ z
    left = ((R - steps @ T.T) ** 2).sum(axis=1) + ((z + steps[:, : len(z)]) ** 2).sum(axis=1)
    most = max(_EACH, KEPT // len({text for text, _ in alone.at}))
    taken: dict[str, int] = {}
    found: set[tuple[str, int]] = set()
    for i in np.argsort(left, kind="stable").tolist():
        text = alone.at[i][0]
        if taken.get(text, 0) < most:
            taken[text] = taken.get(text, 0) + 1
            found.add(alone.at[i])
        if len(found) == KEPT:
            break
    return found


At = tuple[str, int]  # site of a recipe, and number of the size


def best_pairs(
    alone: dict[str, Alone], leading: list[str], T: np.ndarray, adapted: np.ndarray, most: int
) -> list[tuple[tuple[str, At], tuple[str, At]]]:
    """The `most` most promising pairs, each a candidate of `leading` and any of `alone` with their places and sizes.

    T (q, k), adapted (k, q + k): how far the parameters of the deck follow to first order; see `Study`.
    """
    q = len(T)
    values, vectors = np.linalg.eigh(np.eye(q) - T @ adapted[:, :q])
    W = vectors * np.sqrt(np.maximum(values, 0.0))
    added = {name: (one.residuals - one.none / 2) @ W for name, one in alone.items()}
    found = []
    for i, name in enumerate(leading):
        for other in (each for each in alone if each not in leading[:i]):
            each = _of_two(alone[name], alone[other], added[name], added[other], name == other)
            found += [(cost, (name, a), (other, b)) for cost, a, b in each]
    return [each[1:] for each in sorted(found, key=lambda item: item[0])[:most]]


def _of_two(one: Alone, other: Alone, A: np.ndarray, B: np.ndarray, same: bool) -> Iterator[tuple[float, At, At]]:
    """Misfit, place and size of the best of both at different places."""
    left = (A**2).sum(axis=1)[:, None] + (B**2).sum(axis=1) + 2 * A @ B.T
    least = np.argpartition(left, min(_TRIED, left.size - 1), axis=None)[:_TRIED]
    taken: set[tuple[str, ...]] = set()
    for at in least[np.argsort(left.ravel()[least], kind="stable")]:
        i, j = divmod(int(at), len(B))
        places = one.at[i][0], other.at[j][0]
        places = tuple(sorted(places)) if same else places
        if places in taken or (same and places[0] == places[1]):
            continue
        taken.add(places)
        yield float(left[i, j]), one.at[i], other.at[j]
        if len(taken) == _OF_TWO:
            return

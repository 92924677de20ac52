"""Places and sizes of a cause that deserve a look beside causes that are there: those whose effects add up best.

To first order effects add: r(a and b) = r(a) + r(b) - r(none), r the residuals (q,). What each place and size does by itself was
looked at once, at the parameters where the search began, so that beside whatever else only a sum is needed to choose by.
"""

from collections.abc import Container
from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe

KEPT = 64  # places and sizes of one candidate that are looked at beside others; of no more each is
_EACH = 4  # of one recipe at least, if it has so many among the best


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


def promised(alone: Alone, residual: np.ndarray, z: np.ndarray, T: np.ndarray, adapted: np.ndarray) -> np.ndarray:
    """Misfit (n,) of each of `alone` beside causes that leave `residual` (q,) at the deck's parameters z (k,).

    T (q, k + t), adapted (k + t, q + k): how far these, and t coordinates of the causes, follow to first order; see `Study`.
    """
    q = len(residual)
    R = alone.residuals + (residual - alone.none)
    steps = R @ adapted[:, :q].T + adapted[:, q:] @ z
    return ((R - steps @ T.T) ** 2).sum(axis=1) + ((z + steps[:, : len(z)]) ** 2).sum(axis=1)


def chosen(
    alone: Alone, residual: np.ndarray, z: np.ndarray, T: np.ndarray, adapted: np.ndarray, kept: int
) -> set[tuple[str, int]]:
    """The `kept` most promising of `alone`, see `promised`."""
    left = promised(alone, residual, z, T, adapted)
    most = max(_EACH, kept // len({text for text, _ in alone.at}))
    taken: dict[str, int] = {}
    found: set[tuple[str, int]] = set()
    for i in np.argsort(left, kind="stable").tolist():
        text = alone.at[i][0]
        if taken.get(text, 0) < most:
            taken[text] = taken.get(text, 0) + 1
            found.add(alone.at[i])
        if len(found) == kept:
            break
    return found

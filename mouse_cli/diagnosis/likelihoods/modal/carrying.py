"""Causes whose own degrees of freedom carry the model along, which other causes see, and the deck's parameters."""

from functools import cached_property
from itertools import permutations

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.given import Given
from mouse_cli.diagnosis.likelihoods.modal.softened import Softened


class Carrying(Softened, Given):
    """What causes of a model that carry it do to one another: base, recipes, their coordinates `places` among `size`."""

    made_of = "base", "recipes"

    @cached_property
    def _carriers(self) -> list[int]:
        """Causes that carry the model along."""
        return [j for j, recipe in enumerate(self.recipes) if recipe.carried is not None]

    @cached_property
    def within(self) -> list[np.ndarray | None]:
        """Coordinates of each cause from those of all (., size), where other causes carry the model along."""
        r, found = self.base.r, []
        for i, at in enumerate(self.places):
            others = [] if self.recipes[i].carried is not None else self._carriers
            G = np.zeros((len(at), self.size)) if others else None
            if others:
                G[range(len(at)), at] = 1.0
            for j in others:
                G[:r, self.places[j][r:]] = self.recipes[j].carried.model
            found.append(G)
        return found

    def crossed(self, K: np.ndarray, M: np.ndarray) -> None:
        """Adds what is between the own degrees of freedom of two causes that both carry the model along."""
        for i, j in permutations(self._carriers, 2):
            one, other = self.recipes[i].carried, self.recipes[j].carried
            at = np.ix_(self.places[i][self.base.r :], self.places[j][self.base.r :])
            K[at] += one.whole.T @ other.K
            M[at] += one.whole.T @ other.M

    @cached_property
    def following(self) -> tuple[np.ndarray, np.ndarray] | None:
        """What the deck's parameters, along each of d directions, add to K and M (d, size, size) of the causes; None: nothing."""
        own = [(i, recipe.carried) for i, recipe in enumerate(self.recipes) if recipe.carried]
        if not own:
            return None
        K, M = np.zeros((2, self.base.directions.shape[1], self.size, self.size))
        for i, carried in own:
            at = self.places[i]
            for into, slopes in zip((K, M), carried.slopes, strict=True):
                into[:, at[:, None], at] += slopes
            for j, other in own:
                if i != j:
                    between = (slice(None), *np.ix_(self.places[j][self.base.r :], at[self.base.r :]))
                    for into, slopes in zip((K, M), carried.across(other.whole), strict=True):
                        into[between] += slopes
        return K, M

    def followed(self, z: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
        """Its derivatives by z (k, size, size)."""
        if self.following is None:
            return None
        rates = self.base.rates(z)
        return tuple(np.tensordot(rates, slopes, 1) for slopes in self.following)

    def moved(self, X: np.ndarray) -> np.ndarray:
        """Shapes (r, m) of the structure, causes that carry it included, in coordinates of the base, from X (size or more, m)."""
        own = [(each.carried.model, at) for each, at in zip(self.recipes, self.places, strict=True) if each.carried]
        return X[: self.base.r] + sum(along @ X[at[self.base.r :]] for along, at in own)

    def own_of(self, i: int, X: np.ndarray) -> np.ndarray:
        """Shapes (., m) in the coordinates of cause i."""
        G = self.within[i]
        return X[self.places[i]] if G is None else G @ X

    def lift(self, i: int, push: np.ndarray, forces: np.ndarray) -> None:
        """Into forces (..., size, m) those in the coordinates of cause i."""
        G = self.within[i]
        if G is None:
            forces[..., self.places[i], :] += push
        else:
            forces += G.T @ push

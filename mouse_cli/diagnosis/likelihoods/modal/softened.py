"""Bars that causes make softer, in series within each, in all coordinates of a model with these."""

from functools import cached_property

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, effective_loss, residual
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced

_FARTHEST = 50.0  # ln of how much stiffer than at the parameters of the base a bar is taken to be at most


class Softened:
    """What softens bars of a model: base, recipes of the causes, their coordinates `places` among `size`."""

    base: Reduced
    recipes: tuple[Recipe, ...]
    places: list[np.ndarray]
    size: int

    def softer(self, changes: list[Change]) -> tuple[np.ndarray, np.ndarray]:
        """Bars (c,), and the changes of their stiffness (c, 3, 3) by all that makes them softer, in series within each."""
        parts = [change.softening for change in changes if change.softening is not None]
        if not parts:
            return np.zeros(0, int), np.zeros((0, 3, 3))
        if len(parts) == 1:
            (part,) = parts
            lost = self.base.bars.lost(part.bars, part.added) if part.lost is None else part.lost
            return part.bars, lost if part.residual is None else effective_loss(lost, part.residual)
        touched = np.zeros(len(self.base.bars), bool)
        for part in parts:
            touched[part.bars] = True
        bars, place = np.flatnonzero(touched), np.cumsum(touched) - 1
        total = np.zeros((len(bars), 3, 3))
        for part in parts:  # in which none is there twice
            total[place[part.bars]] += part.added
        lost, left = self.base.bars.lost(bars, total), residual(parts, bars)
        return bars, lost if left is None else effective_loss(lost, left)

    @cached_property
    def strain(self) -> np.ndarray:
        """Natural strains of all bars (b, 3, size): in the coordinates, and where causes carry the model along."""
        found = np.zeros((len(self.base.bars), 3, self.size))
        found[..., : self.base.r] = self.base.bars.strain
        for recipe, at in zip(self.recipes, self.places, strict=True):
            if recipe.carried is not None:
                found[..., at[self.base.r :]] = recipe.carried.strain
        return found

    def strained(self, bars: np.ndarray, core: np.ndarray) -> np.ndarray:
        """Matrix (size, size) of stiffnesses `core` (c, 3, 3) on the natural strains of `bars` (c,)."""
        rows = self.strain[bars]
        return rows.reshape(-1, self.size).T @ (core @ rows).reshape(-1, self.size)

    def follow(self, bars: np.ndarray, z: np.ndarray) -> np.ndarray:
        """EI of `bars` at z over what it is at the parameters of the base (c, 1, 1)."""
        stiffer = self.base.stiffening[bars] @ (z - self.base.z)
        return np.exp(np.clip(stiffer, -_FARTHEST, _FARTHEST))[:, None, None]  # a trial step may be beyond any prior

"""A field and, besides, another rival without a name: what varies along a structure that something unknown also holds."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.nameless._cells import Cells
from mouse_cli.diagnosis.nameless._field import Fielded, Smooth, fielded


@dataclass(frozen=True, kw_only=True)
class Both(Fielded):
    """A reduced model with a field and `other`: z = [z of the deck (k,), w of the field, those of the other]."""

    other: Fielded

    @property
    def L(self) -> np.ndarray:
        """Root (p, k + w + v) of the prior of the deck's parameters."""
        own = super().L
        return np.hstack([own, np.zeros((len(own), self._behind))])

    @property
    def _behind(self) -> int:
        """Unknowns of the other."""
        return len(self.other.of_field)

    def _of_other(self, z: np.ndarray) -> np.ndarray:
        """Unknowns (k + v,) of the model with the other alone."""
        return np.concatenate([z[: self.deck], z[self.deck + len(self.of_field) :]])

    def matrices(self, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """K and M (r, r) at z."""
        found = dict(zip("KM", self.other.matrices(self._of_other(z)), strict=True))
        for into, added in self._added.items():
            found[into] = found[into] + np.tensordot(z[self.deck :][: len(added)], added, 1)
        return found["K"], found["M"]

    def slopes(self, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """dK/dz and dM/dz (k + w + v, r, r)."""
        return self.moved(z, np.eye(self.r))

    def moved(self, z: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """dK/dz u and dM/dz u (k + w + v, r, m) for motion u (r, m)."""
        found = dict(zip("KM", self.other.moved(self._of_other(z), u), strict=True))
        none = np.zeros((len(self.of_field), *u.shape))
        for into, each in found.items():
            own = self._added[into] @ u if into in self._added else none
            found[into] = np.concatenate([each[: self.deck], own, each[self.deck :]])
        return found["K"], found["M"]

    def second_slopes(self, z: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
        """That of the other, by unknowns of both."""
        found = self.other.second_slopes(self._of_other(z), u)
        behind = len(self.of_field)
        return found and (found[0] + behind, found[1] + behind, found[2])


def both(other: Fielded, field: Smooth, cells: Cells | None) -> Both:
    """`other` with a field in it besides, likewise as in `fielded`."""
    own = vars(fielded(other, field, cells))
    return Both(**{name: own[name] for name in Fielded.__dataclass_fields__}, other=other)

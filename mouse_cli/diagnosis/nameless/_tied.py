"""A change of stiffness of rank one: a spring that moves with the structure as a whole, along a motion that nobody knows.

K + sign b b', b = w'R: R (w, r) the smooth fields of motion. Soil on which a building rocks, an outrigger, or a strut between
distant parts change K by one such term, which no field of stiffness along the structure can.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.nameless._cells import Cells
from mouse_cli.diagnosis.nameless._field import Fielded, Smooth


@dataclass(frozen=True, kw_only=True)
class Tied(Fielded):
    """A reduced model with such a spring: z = [z of the deck (k,), w]; of_field: R (w, r)."""

    def matrices(self, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """K and M (r, r) at z."""
        K, M = Reduced.matrices(self, z)
        b = z[self.deck :] @ self.of_field
        return K + self.nameless.sign * np.outer(b, b), M

    def slopes(self, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """dK/dz and dM/dz (k + w, r, r)."""
        dK, dM = Reduced.slopes(self, z)
        half = np.einsum("wi,j->wij", self.of_field, z[self.deck :] @ self.of_field)
        dK[self.deck :] = self.nameless.sign * (half + np.swapaxes(half, 1, 2))
        return dK, dM

    def moved(self, z: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """dK/dz u and dM/dz u (k + w, r, m) for motion u (r, m)."""
        dK, dM = Reduced.moved(self, z, u)
        b, R = z[self.deck :] @ self.of_field, self.of_field
        dK[self.deck :] = self.nameless.sign * (R[:, :, None] * (b @ u) + b[:, None] * (R @ u)[:, None])
        return dK, dM


def tied(base: Reduced, field: Smooth, cells: Cells | None) -> Tied:
    """`base` with such a spring along the rows of motion of `cells`; None: it does not have it."""
    own = {name: getattr(base, name) for name in Reduced.__dataclass_fields__}
    rows = np.zeros((field.P.shape[1], base.r))
    if cells is not None:
        rows = field.P.T @ np.concatenate([np.sqrt(size[0, 0]) * row for row, size in cells.blocks])
    return Tied(**own, nameless=field, of_field=rows)

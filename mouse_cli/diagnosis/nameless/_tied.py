"""A change of stiffness of rank one along a motion of the whole structure that nobody knows.

A spring that moves with the structure adds K + b b', b = w'R: R (w, r) the smooth fields of motion. Soil on which a building rocks
adds flexibility instead, K^-1 + h h' with the smooth motion h = w'R that it lets the structure make. By Sherman and Morrison,
K - g g' / (1 + h'g) with g = K h, which is not smooth where K is not, and stays positive definite whatever h.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.nameless._cells import Cells
from mouse_cli.diagnosis.nameless._field import Fielded, Smooth


@dataclass(frozen=True, kw_only=True)
class Tied(Fielded):
    """A reduced model with such a change: z = [z of the deck (k,), w]; of_field: R (w, r)."""

    @property
    def R(self) -> np.ndarray:
        """Motion of each w in the coordinates of the model (w, r)."""
        return self.of_field

    def matrices(self, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """K and M (r, r) at z."""
        K, M = Reduced.matrices(self, z)
        b = z[self.deck :] @ self.R
        if self.nameless.sign < 0:
            g = K @ b
            return K - np.outer(g, g) / (1 + b @ g), M
        return K + np.outer(b, b), M

    def slopes(self, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """dK/dz and dM/dz (k + w, r, r)."""
        return self.moved(z, np.eye(self.r))

    def moved(self, z: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """dK/dz u and dM/dz u (k + w, r, m) for motion u (r, m)."""
        dK, dM = Reduced.moved(self, z, u)
        own = slice(self.deck, None)
        b = z[own] @ self.R
        if self.nameless.sign > 0:
            dK[own] = self.R[:, :, None] * (b @ u) + b[:, None] * (self.R @ u)[:, None]
            return dK, dM
        K = Reduced.matrices(self, z)[0]
        g, dg = K @ b, Reduced.moved(self, z, b[:, None])[0][..., 0]  # dg (k + w, r)
        size = 1 + b @ g
        d_size = dg @ b
        dg[own] = self.R @ K
        d_size[own] = 2 * self.R @ g
        gu = g @ u
        dK -= (dg[:, :, None] * gu + g[:, None] * (dg @ u)[:, None]) / size
        dK += np.outer(g, gu) * (d_size / size**2)[:, None, None]
        return dK, dM

    def second_slopes(self, z: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Unknowns i and j (c,) of z, and d2K/dz_i dz_j u (c, r, m) for motion u (r, m); of added flexibility to leading order."""
        i, j = np.triu_indices(len(self.R))
        rows = self.R
        if self.nameless.sign < 0:
            rows, h = rows @ Reduced.matrices(self, z)[0], z[self.deck :] @ self.R
            rows = rows / np.sqrt(1 + h @ (z[self.deck :] @ rows))
        pulled = self.nameless.sign * (rows @ u)[:, None]
        return self.deck + i, self.deck + j, rows[i, :, None] * pulled[j] + rows[j, :, None] * pulled[i]


def tied(base: Reduced, field: Smooth, cells: Cells | None) -> Tied:
    """`base` with such a spring along the rows of motion of `cells`; None: it does not have it."""
    own = {name: getattr(base, name) for name in Reduced.__dataclass_fields__}
    rows = np.zeros((field.P.shape[1], base.r))
    if cells is not None:
        rows = field.P.T @ np.concatenate([np.sqrt(size[0, 0]) * row for row, size in cells.blocks])
    return Tied(**own, nameless=field, of_field=rows)

"""The legacy term: listed elements of K and M that follow physical properties through the matrix A."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.model.arrays import Matrix, is_sparse, sparse_symmetric
from mouse_cli.model.structure import ListedElements, Structure


@dataclass(frozen=True)
class MatrixEntries:
    """d(k, m) = A d(properties), Eq. (3-2): `elements` (e) and A (e, p) on top of the baseline `structure`."""

    structure: Structure
    elements: ListedElements
    A: Matrix

    def matrices(self, change: np.ndarray) -> tuple[Matrix, Matrix]:
        """K and M (n, n) after the properties have changed by `change` (p,); Eqs. O-9 and O-10."""
        moved = self.A @ change
        mass = self.elements.is_mass
        return (
            self._moved(self.structure.K, moved, ~mass),
            self._moved(self.structure.M, moved, mass),
        )

    def _moved(self, base: Matrix, moved: np.ndarray, which: np.ndarray) -> Matrix:
        """`base` with the listed elements `which`, and their mirror images, changed."""
        if not which.any():
            return base
        row, col, value = self.elements.row[which], self.elements.col[which], moved[which]
        if is_sparse(base):
            return base + sparse_symmetric(row, col, value, base.shape[0])
        changed = base.copy()
        changed[row, col] += value
        off = row != col
        changed[col[off], row[off]] += value[off]
        return changed

    def total_mass(self, dofs: np.ndarray) -> np.ndarray:
        """d(total mass)/d(properties) (p,): the mass that moves along when `dofs` translate together by 1."""
        listed = self.elements
        counted = listed.is_mass & np.isin(listed.row, dofs) & np.isin(listed.col, dofs)
        weight = np.where(counted, np.where(listed.row == listed.col, 1.0, 2.0), 0.0)
        return self.A.T @ weight

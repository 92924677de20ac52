"""dZ x: the forces that a unit change of each property exerts on a mode, from the nonzeros of A alone."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.model.arrays import Matrix, is_sparse
from mouse_cli.model.structure import ListedElements

_LARGEST_DENSE = 4_000_000  # forces on all touched degrees of freedom by all properties; more are kept sparse


@dataclass(frozen=True)
class Forces:
    """The pattern of d(K, M)/d(properties), element by element and with mirror images, z entries in all.

    Entry k says that a unit change of property `column` puts `value` times x[`other`] on the degree of freedom
    touched[`row`]; `mass`: through M and not K. touched (t,), properties: p.
    """

    touched: np.ndarray
    row: np.ndarray
    other: np.ndarray
    column: np.ndarray
    value: np.ndarray
    mass: np.ndarray
    properties: int

    def on(self, x: np.ndarray, eigenvalue: float) -> Matrix:
        """(dK - eigenvalue dM) x for all properties, (t, p), at the touched degrees of freedom."""
        return self._summed(np.where(self.mass, -eigenvalue, 1.0) * self.value * x[self.other])

    def inertial(self, x: np.ndarray) -> Matrix:
        """dM x for all properties (t, p)."""
        return self._summed(np.where(self.mass, self.value, 0.0) * x[self.other])

    def _summed(self, force: np.ndarray) -> Matrix:
        t, p = len(self.touched), self.properties
        if t * p > _LARGEST_DENSE:
            from scipy.sparse import coo_array

            return coo_array((force, (self.row, self.column)), shape=(t, p)).tocsr()
        return np.bincount(self.row * p + self.column, force, minlength=t * p).reshape(t, p)


def forces(n: int, elements: ListedElements, A: Matrix | None = None) -> Forces:
    """The pattern for `elements` of a model of n degrees of freedom and A (e, p); without A each element is a property."""
    if A is None:
        element, column, value = np.arange(len(elements)), np.arange(len(elements)), np.ones(len(elements))
    elif is_sparse(A):
        entries = A.tocoo()
        element, column, value = entries.row, entries.col, entries.data
    else:
        element, column = np.nonzero(A)
        value = A[element, column]
    a, b = elements.row[element], elements.col[element]
    off = np.flatnonzero(a != b)
    is_touched = np.zeros(n, bool)
    is_touched[a] = is_touched[b] = True
    place = np.cumsum(is_touched) - 1
    return Forces(
        touched=np.flatnonzero(is_touched),
        row=place[np.concatenate([a, b[off]])],
        other=np.concatenate([b, a[off]]),
        column=np.concatenate([column, column[off]]),
        value=np.concatenate([value, value[off]]),
        mass=elements.is_mass[np.concatenate([element, element[off]])],
        properties=len(elements) if A is None else A.shape[1],
    )

"""The term of 1972: listed elements of K and M that follow physical properties through the matrix A."""

from functools import cached_property

import numpy as np

from mouse_cli.model.arrays import Matrix, is_sparse
from mouse_cli.model.structure import ListedElements
from mouse_cli.model.term import Places, Slopes


class MatrixEntries:
    """d(k, m) = A d(properties), Eq. (3-2): `elements` (e) and A (e, p); the change is counted from `nominal` (p,)."""

    linear = True

    def __init__(self, elements: ListedElements, A: Matrix, nominal: np.ndarray):
        self.elements, self.A, self.nominal = elements, A, nominal
        self.places, self._listed = {}, {}
        for name, which in (("K", ~elements.is_mass), ("M", elements.is_mass)):
            listed = np.flatnonzero(which)
            if len(listed):
                row, col = elements.row[listed], elements.col[listed]
                off = row != col
                self._listed[name] = np.concatenate([listed, listed[off]])
                self.places[name] = Places(np.concatenate([row, col[off]]), np.concatenate([col, row[off]]))

    def values(self, theta: np.ndarray) -> dict[str, np.ndarray]:
        """Changes of the listed elements, Eqs. O-9 and O-10, and of their mirror images."""
        moved = self.A @ (theta - self.nominal)
        return {name: moved[listed] for name, listed in self._listed.items()}

    def slopes(self, theta: np.ndarray) -> dict[str, Slopes]:
        """A itself, element by element."""
        return self._slopes

    def by_element(self) -> dict[str, Slopes]:
        """Derivatives by the listed elements themselves, as if each were a property: for B of Eq. O-4."""
        one = np.arange(len(self.elements))
        return {name: self._at(one, one, np.ones(len(one)), name) for name in self.places}

    @cached_property
    def _slopes(self) -> dict[str, Slopes]:
        if is_sparse(self.A):
            entries = self.A.tocoo()
            element, column, value = entries.row, entries.col, entries.data
        else:
            element, column = np.nonzero(self.A)
            value = self.A[element, column]
        return {name: self._at(element, column, value, name) for name in self.places}

    def _at(self, element: np.ndarray, column: np.ndarray, value: np.ndarray, name: str) -> Slopes:
        """Entries (element, column, value) of A that belong to the matrix `name`, with mirror images."""
        own = self.elements.is_mass[element] == (name == "M")
        element, column, value = element[own], column[own], value[own]
        row, col = self.elements.row[element], self.elements.col[element]
        off = row != col
        return Slopes(
            np.concatenate([column, column[off]]),
            np.concatenate([row, col[off]]),
            np.concatenate([col, row[off]]),
            np.concatenate([value, value[off]]),
        )

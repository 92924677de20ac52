"""dZ x: the forces that a unit change of each property exerts on a mode, from the nonzeros of dK and dM alone."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mouse_cli.dynamics.contraction import Stack
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.term import CONSTANT, Slopes

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
    n: int
    slopes: dict[str, Slopes]

    @cached_property
    def stack(self) -> Stack:
        """The same as two sparse matrices: for large models."""
        return Stack(self.n, self.properties, self.slopes)

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


def forces(n: int, properties: int, slopes: dict[str, Slopes]) -> Forces:
    """The pattern for a model of n degrees of freedom, from the derivatives of its K and M by `properties` parameters."""
    parts = [slopes.get("K", CONSTANT), slopes.get("M", CONSTANT)]
    is_touched = np.zeros(n, bool)
    for part in parts:
        is_touched[part.row] = True
        is_touched[part.col] = True
    place = np.cumsum(is_touched) - 1
    return Forces(
        touched=np.flatnonzero(is_touched),
        row=place[np.concatenate([part.row for part in parts])],
        other=np.concatenate([part.col for part in parts]),
        column=np.concatenate([part.parameter for part in parts]),
        value=np.concatenate([part.value for part in parts]),
        mass=np.repeat([False, True], [len(part) for part in parts]),
        properties=properties,
        n=n,
        slopes=slopes,
    )

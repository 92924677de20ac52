"""Frequency response functions of a model: alpha(s) = L Z(s)^-1 F with Z(s) = K + iD + sC + s^2 M, and s = i omega.

K, M, C, D symmetric; D the imaginary part of a complex stiffness (structural damping). With s = i omega + sigma the response is
that of records weighed by e^(-sigma t): sigma widens every resonance alike, in a model and in a measurement.

Small models are solved line by line as they are. Larger ones are solved in a basis (`frf_basis`): the modes of the band, and
what loads and damping do besides, whose error is checked against full solutions at some lines.
"""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from mouse_cli.dynamics.frf_uncoupled import Uncoupled, uncoupled
from mouse_cli.dynamics.sensing import unit_loads
from mouse_cli.model.arrays import Matrix, dense

_ROOM = 4_000_000  # complex numbers of the dynamic stiffness of as many lines as are solved at once


@dataclass(frozen=True)
class Dynamics:
    """The matrices (n, n) of a model; C viscous, D structural damping, None where there is none."""

    K: Matrix
    M: Matrix
    C: Matrix | None = None
    D: Matrix | None = None

    @property
    def n(self) -> int:
        """Degrees of freedom."""
        return self.K.shape[0]

    def dense(self) -> "Dynamics":
        """The same as dense matrices."""
        return Dynamics(*(None if m is None else dense(m) for m in (self.K, self.M, self.C, self.D)))

    def at(self, s: complex) -> Matrix:
        """Z(s) (n, n)."""
        Z = self.K + s**2 * self.M
        Z = Z if self.C is None else Z + s * self.C
        return Z if self.D is None else Z + 1j * self.D


def product(matrix: Matrix, x: np.ndarray) -> np.ndarray:
    """A real matrix times complex columns, in real arithmetic."""
    if not np.iscomplexobj(x):
        return matrix @ x
    out = matrix @ np.concatenate([x.real, x.imag], axis=1)
    return out[:, : x.shape[1]] + 1j * out[:, x.shape[1] :]


class Loads:
    """Unit loads of several sets of sensors or forces side by side: at (r,) degrees of freedom, values (r, l); their columns."""

    def __init__(self, sensings: tuple[Matrix, ...]):
        parts = [unit_loads(sensing) for sensing in sensings]
        self.at = np.unique(np.concatenate([at for at, _ in parts]).astype(int))
        counts = [values.shape[1] for _, values in parts]
        ends = np.cumsum([0, *counts])
        self.columns = [slice(a, b) for a, b in pairwise(ends.tolist())]
        self.values = np.zeros((len(self.at), int(ends[-1])))
        for (at, values), columns in zip(parts, self.columns, strict=True):
            np.add.at(self.values[:, columns], np.searchsorted(self.at, at), values)

    @property
    def count(self) -> int:
        """Number of loads l."""
        return self.values.shape[1]

    def full(self, n: int) -> np.ndarray:
        """The loads (n, l)."""
        out = np.zeros((n, self.count))
        out[self.at] = self.values
        return out


class FrfModel:
    """A model ready to be solved at many lines: matrices (d, d) and loads (d, l) in the basis V (d, n), or as they are (V None).

    error: of the FRFs, relative, at the lines that were checked; motion_error: of the motions, and so of derivatives; 0 without a
    basis. levels: of Krylov vectors in the basis.
    """

    def __init__(
        self,
        matrices: Dynamics,
        loads: np.ndarray,
        columns: list[slice],
        V: np.ndarray | None = None,
        levels: int = 0,
        error: float = 0.0,
        motion_error: float = 0.0,
    ):
        self.matrices, self.loads, self.columns, self.V = matrices, loads, columns, V
        self.levels, self.error, self.motion_error = levels, error, motion_error

    @property
    def d(self) -> int:
        """Size of the basis."""
        return self.matrices.n

    def at(self, s: np.ndarray) -> "Fields":
        """The motions under every load at s (f,), rad/s: i omega, or i omega + sigma."""
        s = np.atleast_1d(np.asarray(s, complex))
        return Fields(self, s, self._solved(s))

    @cached_property
    def _uncoupled(self) -> Uncoupled | None:
        return None if self.V is None else uncoupled(self.matrices)

    def _solved(self, s: np.ndarray) -> np.ndarray:
        """Z(s)^-1 loads (f, d, l)."""
        if self._uncoupled is not None:
            return self._uncoupled.solve(s, self.loads)
        Y = np.empty((len(s), *self.loads.shape), complex)
        each = max(1, _ROOM // self.d**2)
        for first in range(0, len(s), each):
            part = s[first : first + each, None, None]
            Y[first : first + each] = np.linalg.solve(self.matrices.at(part), self.loads)
        return Y


class Fields:
    """Motions Y (f, d, l) under every load at s (f,), in the basis of `model`; and what sensors read of them."""

    def __init__(self, model: FrfModel, s: np.ndarray, Y: np.ndarray):
        self.model, self.s, self.Y = model, s, Y

    def of(self, which: int) -> np.ndarray:
        """Those (f, d, o) of set number `which` of loads."""
        return self.Y[:, :, self.model.columns[which]]

    def receptance(self, left: int = 0, right: int = 1) -> np.ndarray:
        """alpha (f, o, i): what set `left` reads when set `right` drives; m/N for the usual units."""
        L = self.model.loads[:, self.model.columns[left]]
        return np.matmul(L.T, self.of(right))


def kind_factor(power: int, s: np.ndarray) -> np.ndarray:
    """s^power (f, 1, 1): receptance (power 0) times that is mobility (1) or accelerance (2)."""
    return (s**power)[:, None, None]

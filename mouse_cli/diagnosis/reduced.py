"""The baseline in few coordinates: its modes, what its parameters do to them, and what forces where sensors are would do.

u = V q with V'M V = I and V'K V diagonal at the parameters that the update found. A small model keeps all of its modes, and is
exact; of a large one V holds the lowest, the static responses to unit loads at sensors and at places that matter, and the
derivatives of the measured modes by the parameters.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mouse_cli.diagnosis.bars import Bars, bars, motion_of
from mouse_cli.diagnosis.data import Data
from mouse_cli.model.arrays import dense
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.problem import Problem
from mouse_cli.terms.assembly import Assembly, assembly
from mouse_cli.terms.constraints import Motion
from mouse_cli.updating.coordinates import Coordinates, coordinates

WHOLE = 130  # degrees of freedom up to which a model is not reduced
_MOST = 40  # directions of the parameters that are kept when there are more


@dataclass(frozen=True)
class Reduced:
    """theta (p,): where V is taken. eigenvalues (r,) there. dK, dM (p, r, r): derivatives by the parameters, in their units.

    sensing (s, r); V (n, r); data: the test.
    """

    problem: Problem
    theta: np.ndarray
    coordinates: Coordinates
    V: np.ndarray
    eigenvalues: np.ndarray
    dK: np.ndarray
    dM: np.ndarray
    sensing: np.ndarray
    data: Data
    assembly: Assembly

    @property
    def r(self) -> int:
        """Number of coordinates."""
        return len(self.eigenvalues)

    @cached_property
    def L(self) -> np.ndarray:
        """Root (p, k) of the prior, in the coordinates u in which parameters are estimated."""
        L = self.coordinates.L
        return np.diag(L) if L.ndim == 1 else L

    def parameters(self, z: np.ndarray) -> np.ndarray:
        """Values (p,) of the deck's parameters at z (k,), prior standard deviations from the prior mean."""
        return self.coordinates.value(self.coordinates.mean + self.L @ z)

    def matrices(self, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """K and M (r, r) at z (k,)."""
        step = self.parameters(z) - self.theta
        K, M = np.diag(self.eigenvalues), np.eye(self.r)
        return K + np.tensordot(step, self.dK, 1), M + np.tensordot(step, self.dM, 1)

    def slopes(self, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """dK/dz and dM/dz (k, r, r)."""
        by = self.coordinates.slope(self.coordinates.mean + self.L @ z)[:, None] * self.L
        return np.tensordot(by.T, self.dK, 1), np.tensordot(by.T, self.dM, 1)

    @cached_property
    def z(self) -> np.ndarray:
        """z (k,) of theta."""
        u = np.where(self.coordinates.logarithmic, np.log(np.maximum(self.theta, 1e-300)), self.theta)
        return (
            np.linalg.lstsq(self.L, u - self.coordinates.mean, rcond=None)[0]
            if self.L.size
            else np.zeros(self.L.shape[1])
        )

    @cached_property
    def motion(self) -> Motion | None:
        """How nodes follow degrees of freedom; None without a mesh."""
        return None if self.problem.mesh is None else motion_of(self.problem)

    @cached_property
    def bars(self) -> Bars | None:
        """Bars that bend; None where there are none."""
        return None if self.motion is None else bars(self.problem, self.motion, self.theta, self.V)

    def project(self, matrix) -> np.ndarray:
        """V' matrix V (r, r)."""
        return self.V.T @ (matrix @ self.V)

    def node(self, index: int) -> np.ndarray:
        """Motion (6, r) of a node in each coordinate."""
        rows = np.zeros((6, self.r))
        for d in range(6):
            dofs, factor = self.motion.of(index, d)
            rows[d] = factor @ self.V[dofs] if len(dofs) else 0.0
        return rows

    def without(self, keep_modes: np.ndarray) -> "Reduced":
        """The same model with fewer measured modes: mask `keep_modes` (m,)."""
        return self.with_test(restricted(self.data.test, keep_modes))

    def with_test(self, test: ModalTest, sensing: np.ndarray | None = None) -> "Reduced":
        """The same model for another test, of the same sensors or of `sensing` (s, r)."""
        return replace(self, data=Data(test), sensing=self.sensing if sensing is None else sensing)


def restricted(test: ModalTest, modes: np.ndarray) -> ModalTest:
    """The test with the modes of the mask `modes` (m,) alone."""
    return replace(
        test,
        number=test.number[modes],
        frequency_hz=test.frequency_hz[modes],
        frequency_sd_hz=test.frequency_sd_hz[modes],
        shapes=test.shapes[:, modes],
        shape_sd=test.shape_sd[:, modes],
    )


def reduced(problem: Problem, theta: np.ndarray) -> Reduced:
    """The model of `problem` at theta (p,), reduced where it is large."""
    total = assembly(problem)
    K, M = total.matrices(theta)
    if K.shape[0] > WHOLE:
        from mouse_cli.diagnosis.subspace import subspace

        V, eigenvalues = subspace(problem, total, K, M, theta)
    else:
        V, eigenvalues = _modes(dense(K), dense(M))
    dK, dM = _derivatives(total, theta, V)
    at = problem.test.measured_at
    seen = V[at] if at.ndim == 1 else np.asarray(at @ V)
    return Reduced(problem, theta, coordinates(problem, total), V, eigenvalues, dK, dM, seen, Data(problem.test), total)


def _modes(K: np.ndarray, M: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    from mouse_cli.dynamics.eigen import dense_solution

    solution = dense_solution(K, M)
    return solution.shapes, solution.eigenvalues


def _derivatives(total: Assembly, theta: np.ndarray, V: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """V' dK_j V and V' dM_j V (p, r, r)."""
    from scipy.sparse import coo_array

    r, found = V.shape[1], []
    slopes = total.slopes(theta)
    for name in ("K", "M"):
        out = np.zeros((total.p, r, r))
        part = slopes.get(name)
        order = np.argsort(part.parameter, kind="stable")
        cut = np.searchsorted(part.parameter[order], np.arange(total.p + 1))
        for j in range(total.p):
            own = order[cut[j] : cut[j + 1]]
            if len(own):
                rows, at = np.unique(part.row[own], return_inverse=True)
                cols, to = np.unique(part.col[own], return_inverse=True)
                block = coo_array((part.value[own], (at, to)), shape=(len(rows), len(cols))).tocsr()
                out[j] = V[rows].T @ (block @ V[cols])
        found.append(out)
    return found[0], found[1]

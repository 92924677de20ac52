"""What methods start from: the model, its rigid-body modes, and the measured modes on all degrees of freedom of the model."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mouse_cli.dynamics.condensation import LooseError
from mouse_cli.dynamics.eigen import EigenSolution
from mouse_cli.dynamics.expansion import Measured, expansion
from mouse_cli.dynamics.frequency import eigenvalue
from mouse_cli.dynamics.solver import Notice
from mouse_cli.methods import refusals
from mouse_cli.methods.acceleration import Accelerated
from mouse_cli.model.arrays import Matrix, is_sparse
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.problem import Problem
from mouse_cli.terms.assembly import Assembly

MOST_ITERATIONS = 300
_MOST_REMEMBERED = 1_000_000  # elements of K of which the last few iterations are kept
SETTLED = 1e-5  # relative change of K or of the parameters with which an iteration ends


@dataclass(frozen=True)
class Given:
    """problem, its assembly, and K, M (n, n) at the prior mean; solution: their modes, of which the first `r` are rigid.

    how: key of the expansion.
    """

    problem: Problem
    assembly: Assembly
    K: Matrix
    M: Matrix
    solution: EigenSolution
    r: int
    how: str
    notice: Notice = lambda text: None

    @property
    def test(self) -> ModalTest:
        """The modes that may be used."""
        return self.problem.test

    @property
    def rigid(self) -> np.ndarray:
        """Rigid-body modes (n, r), mass-normalised."""
        return self.solution.shapes[:, : self.r]

    @cached_property
    def eigenvalues(self) -> np.ndarray:
        """Measured, (m,), (rad/s)^2."""
        return eigenvalue(self.test.frequency_hz)

    def expanded(self, K: Matrix) -> np.ndarray:
        """Measured shapes (n, m) on all degrees of freedom of a model with stiffness K, at unit modal mass.

        K and the eigenvalues are shifted together, by the lowest of these: forces (K - lambda M) x stay, and the energy that they
        put into the structure, by which some expansions measure them, is finite though it may move as a rigid body.
        Raises NumericalError where they are not determined.
        """
        test, elastic = self.test, slice(self.r, self.r + max(self.test.s - self.r, self.test.m))
        basis = self.solution.eigenvalues[elastic], self.solution.shapes[:, elastic]
        shift = self.eigenvalues.min()
        shifted = K + shift * self.M, self.M
        measured = Measured(*shifted, test.measured_at, test.shapes, test.shape_sd, self.eigenvalues + shift, *basis)
        try:
            X = expansion(self.how).expand(measured)
        except (LooseError, np.linalg.LinAlgError) as reason:
            raise refusals.not_expanded(self.problem, self.how, str(reason)) from None
        size = np.einsum("ij,ij->j", X, self.M @ X)
        if not (size > 0).all():
            mode = test.number[np.argmin(size)]
            raise refusals.not_expanded(self.problem, self.how, f"measured mode {mode} then moves no mass")
        return X / np.sqrt(size)

    def energies(self) -> Callable[[np.ndarray], np.ndarray]:
        """(K0 + s M)^-1 times columns, s the lowest measured eigenvalue: r'(K0 + s M)^-1 r is the energy of forces r."""
        A = self.K + self.eigenvalues.min() * self.M
        if not is_sparse(A):
            return lambda columns: np.linalg.solve(A, columns)
        from scipy.sparse import csc_array
        from scipy.sparse.linalg import splu

        return splu(csc_array(A), permc_spec="MMD_AT_PLUS_A").solve

    def orthonormal(self, X: np.ndarray) -> np.ndarray:
        """Shapes (n, m) nearest to X with X'MX = 1 and no rigid motion: X (X'MX)^-1/2 (Baruch and Bar-Itzhack 1978).

        Nearest in the norm of M; rigid-body modes take part in it with the weight of certainty.
        """
        X = X - self.rigid @ (self.rigid.T @ (self.M @ X))
        values, vectors = np.linalg.eigh(X.T @ (self.M @ X))
        if values[0] < 1e-8 * values[-1]:
            raise refusals.alike(self.problem)
        return X @ (vectors / np.sqrt(values)) @ vectors.T

    def iterate(self, step: Callable[[np.ndarray], Matrix]) -> tuple[Matrix, int, float, bool]:
        """The lecture's two sub-steps until K settles: the current K expands the shapes, `step` turns shapes (n, m) into K.

        Returns K, how many iterations, the last relative change, and whether that is small.
        """
        K, ahead, scale, change, iteration = self.K, Accelerated(), np.abs(self.K).max(), np.inf, 0
        while iteration < MOST_ITERATIONS:
            iteration += 1
            new = step(self.orthonormal(self.expanded(K)))
            before, change = change, float(np.abs(new - K).max() / scale)
            if change < SETTLED or not np.isfinite(change):
                break
            if change > before:
                ahead.forget()
            K = ahead.propose(K.ravel(), new.ravel()).reshape(K.shape) if K.size < _MOST_REMEMBERED else new
        return new, iteration, change, change < SETTLED

"""What an updated model says of modes that were fitted, of modes held out, and of the structure after a known change."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.dynamics.correlation import mac, pair
from mouse_cli.dynamics.eigen import RIGID, EigenSolution, dense_solution
from mouse_cli.dynamics.frequency import frequency_hz
from mouse_cli.model.arrays import Matrix, dense, is_sparse
from mouse_cli.model.hold_out import Altered
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.problem import Problem
from mouse_cli.model.updated import Predicted
from mouse_cli.updating.state import reference_eigenvalue, solve

_LARGE = 300  # degrees of freedom
_MORE = 6  # modes beyond the highest that is asked for


@dataclass(frozen=True)
class Modes:
    """Modes of a model: eigenvalues (k,) ascending, shapes (n, k); zero: eigenvalues this small are those of rigid motion."""

    eigenvalues: np.ndarray
    shapes: np.ndarray
    zero: float

    @property
    def rigid(self) -> int:
        """How many are of rigid motion."""
        return int(np.count_nonzero(np.abs(self.eigenvalues) <= self.zero))

    @property
    def negative(self) -> int:
        """How many have an imaginary frequency."""
        return int(np.count_nonzero(self.eigenvalues < -self.zero))

    @property
    def elastic(self) -> np.ndarray:
        """Indices of those that vibrate."""
        return np.flatnonzero(self.eigenvalues > self.zero)


def modes(problem: Problem, K: Matrix, M: Matrix, highest: int) -> Modes:
    """The modes of K, M, whether or not K is semidefinite; of large sparse models those up to number `highest` and some more.

    Raises IndefiniteError for a sparse K that is not.
    """
    if is_sparse(K):
        found: EigenSolution = solve(problem, K, M, min(highest + _MORE, K.shape[0]))
    else:
        found = _whole((K + K.T) / 2, dense(M))
    return Modes(found.eigenvalues, found.shapes, RIGID * reference_eigenvalue(problem, found.eigenvalues))


def _whole(K: np.ndarray, M: np.ndarray) -> EigenSolution:
    """All modes of dense matrices; of larger ones without the extended precision that low modes of slender structures want."""
    if len(K) > _LARGE:
        from scipy.linalg import LinAlgError, eigh

        try:
            return EigenSolution(*eigh(K, M))
        except LinAlgError:  # masses that are zero
            pass
    return dense_solution(K, M)


def predicted(problem: Problem, title: str, fitted: bool, test: ModalTest, prior: Modes, revised: Modes) -> Predicted:
    """The modes of `test` by both models, paired by number or by shape as the run options say."""
    hz, shapes, alike = [], [], np.full(test.m, np.nan)
    for model in (prior, revised):
        chosen = _paired(problem, test, prior.rigid, model)
        at = np.where(chosen < 0, 0, chosen)
        hz.append(np.where(chosen < 0, np.nan, frequency_hz(np.maximum(model.eigenvalues[at], 0.0))))
        shapes.append(test.read(model.shapes[:, at]) if test.s else np.zeros((0, test.m)))
    have = np.isfinite(test.shapes).sum(axis=0) >= 2
    if have.any():
        alike = np.where(have & np.isfinite(hz[1]), mac(test.shapes, shapes[1]).diagonal(), np.nan)
    return Predicted(title, fitted, test.number, test.frequency_hz, test.frequency_sd_hz, *hz, alike)


def _paired(problem: Problem, test: ModalTest, rigid: int, model: Modes) -> np.ndarray:
    """Index (m,) of each mode of `test` among those of the model, -1 where it has not so many; numbers count the elastic ones."""
    elastic = model.elastic
    have = np.isfinite(test.shapes)
    if problem.run.pairing == "mac" and len(have) and have.sum(axis=0).min() >= 2 and len(elastic) >= test.m:
        near = elastic[: 2 * int(test.number.max()) + _MORE]
        hz = frequency_hz(model.eigenvalues[near])
        return near[pair(test.shapes, test.frequency_hz, test.read(model.shapes[:, near]), hz)]
    wanted = test.number - 1 - rigid
    there = (wanted >= 0) & (wanted < len(elastic))
    return np.where(there, elastic[np.where(there, wanted, 0)] if len(elastic) else -1, -1)


def changed(K: Matrix, M: Matrix, altered: Altered) -> tuple[Matrix, Matrix]:
    """K and M with the springs and masses of another configuration."""
    return _added(K, altered.springs), _added(M, altered.masses)


def _added(matrix: Matrix, values: dict[int, float]) -> Matrix:
    if not values:
        return matrix
    at = np.array(list(values))
    if not is_sparse(matrix):
        matrix = matrix.copy()
        matrix[at, at] += list(values.values())
        return matrix
    from scipy.sparse import csr_array

    return matrix + csr_array((list(values.values()), (at, at)), shape=matrix.shape)


def as_test(problem: Problem, altered: Altered) -> ModalTest:
    """The measured frequencies of another configuration as a test without shapes."""
    k = len(altered.number)
    nothing = np.zeros((0, k))
    return ModalTest(altered.number, altered.frequency_hz, altered.frequency_sd_hz, np.zeros(0, int), nothing, nothing)

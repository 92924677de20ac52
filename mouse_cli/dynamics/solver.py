"""The eigensolver that a run keeps: one symbolic analysis, the shapes found last to begin with, memory used again."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mouse_cli.dynamics import memory
from mouse_cli.dynamics.eigen import EigenSolution, IndefiniteError, dense_solution
from mouse_cli.dynamics.factors import Analysis, Backend, Factor
from mouse_cli.dynamics.known import improved, known
from mouse_cli.dynamics.krylov import BLOCK, Krylov, Operator
from mouse_cli.dynamics.lanczos import INFINITE, NotConverged, initial_vectors, krylov_space, refined, start_block
from mouse_cli.dynamics.pencil import Pencil, without_zeros
from mouse_cli.dynamics.shared_space import COLUMNS
from mouse_cli.dynamics.workspace import Workspace
from mouse_cli.model.arrays import Matrix, dense, is_sparse

Notice = Callable[[str], None]
TOLERANCE = 1e-8  # residual |A^-1 M x - theta x| / theta of a mode: its eigenvalue is then good to 1e-13 or so
EXACT = 1e-12  # the same for partial derivatives that are to be exact to rounding
_PARTED = 1e-4  # eigenvalues that lie so far apart, relative, can be counted from between them
_TRIES = 4
# Degrees of freedom from which on refining costs too much for less, and then less than what
_COSTLY, _NOISY_LARGE = 30_000, 1e-2
_NOISY, _NOISY_EXACT = 1e-5, 1e-10  # rounding above which solutions are refined, by a bound 30 to 3000 times too large
_CLEAN = 1e-9  # the same above which modes are freed of what rounding mixed into them
_STEPS = 3  # of Newton's method for exact shapes
# The shift, and the lowest elastic eigenvalue that makes a new one worth its while, by the other
_BELOW, _FAR = 0.3, 0.02
_SEARCHES, _TRIAL = 8, 4  # most factorisations to find a shift, and steps of Lanczos in each


class EigenSolver:
    """Solves one model after the other whose K and M keep their patterns; the space of a solution lives until the next one.

    notice: called with a sentence as each phase of a large model begins. backend: of the factorisations; None: the best.
    sensors: how many will be asked for derivatives, whose memory is then counted.
    """

    def __init__(self, notice: Notice = lambda text: None, backend: Backend | None = None, sensors: int = 0):
        self._notice, self._backend, self._sensors = notice, backend, sensors
        self._pencil: Pencil | None = None
        self._last: EigenSolution | None = None
        self._asked: tuple | None = None
        self._workspace = Workspace()

    def solve(
        self,
        K: Matrix,
        M: Matrix,
        count: int,
        shift: float | None = None,
        tolerance: float = TOLERANCE,
        verify: bool = False,
    ) -> EigenSolution:
        """Lowest `count` modes, as `eigensolution`; dense matrices, and small ones, by LAPACK. Asked again, it has them still.

        verify: count the eigenvalues below the highest mode by the inertia of K - s M (Sylvester), and search on when one was
        missed. Raises IndefiniteError, numpy.linalg.LinAlgError.
        """
        n = K.shape[0]
        if not (is_sparse(K) or is_sparse(M)) or n < 3 * count + 10:
            return dense_solution(dense(K), dense(M))
        if M.diagonal().min() < 0:
            raise IndefiniteError("the mass matrix is not positive semidefinite")
        if not self._same(K, M, count, shift, tolerance):
            self._last = self._solved(K, M, count, shift, tolerance)
            self._asked = K, M, count, shift, tolerance
        if verify and not self._last.verified:
            self._last = self._verified(self._last, K, M, self._last.shift, count, tolerance)
        return self._last

    def _same(self, K: Matrix, M: Matrix, count: int, shift: float | None, tolerance: float) -> bool:
        """Whether the last solution, whose space lives still, is what is asked for."""
        if self._asked is None or self._last.space is None or not self._last.space.current:
            return False
        stiff, mass, *how = self._asked
        if count > how[0] or [shift, tolerance] != how[1:] or not self._pencil.fits(K, M):
            return False
        return all(np.array_equal(a.data, b.data) for a, b in ((stiff, K), (mass, M)))

    def _solved(self, K: Matrix, M: Matrix, count: int, shift: float | None, tolerance: float) -> EigenSolution:
        self._release()
        if self._pencil is None or not self._pencil.fits(K, M):
            self._pencil, self._analysis = Pencil(K, M, self._pencil), None
        sigma, operator = self._operated(K, M, shift, count, tolerance)
        space = krylov_space(operator, count, tolerance, self._known(), self._workspace, self._notice)
        return _solution(space, sigma, count, tolerance)

    def _release(self) -> None:
        """Give up the space of the last solution, its factorisation first: the next one needs its memory."""
        if self._last is not None and self._last.space is not None:
            self._last.space.end()

    def _known(self) -> np.ndarray | None:
        return None if self._last is None else self._last.shapes

    def _operated(
        self, K: Matrix, M: Matrix, shift: float | None, count: int, tolerance: float
    ) -> tuple[float, Operator]:
        """The shift, and K - shift M factorised; an unknown one is brought near the lowest elastic eigenvalue."""
        sigma = self._shift(K, M) if shift is None else shift
        operator = self._operator(K, M, sigma, count, tolerance)
        for _ in range(_SEARCHES if shift is None else 0):
            lowest = _elastic(operator, sigma)
            if not 0 < lowest < -_FAR * sigma:
                break
            sigma = -_BELOW * lowest
            operator = self._operator(K, M, sigma, count, tolerance)
        return sigma, operator

    def _shift(self, K: Matrix, M: Matrix) -> float:
        """A shift below all eigenvalues: some of the first elastic one, when that is known."""
        if self._last is not None:
            elastic = self._last.eigenvalues[self._last.eigenvalues > self._last.zero]
            if len(elastic):
                return -_BELOW * float(elastic[0])
        masses = M.diagonal()
        heavy = masses > 0
        return -1e-4 * float(np.min(K.diagonal()[heavy] / masses[heavy]))

    def _operator(self, K: Matrix, M: Matrix, sigma: float, count: int, tolerance: float) -> Operator:
        """A = K - sigma M, factorised. Raises IndefiniteError when it is not positive definite."""
        A = self._pencil.shifted(K, M, sigma)
        if self._analysis is None:
            self._notice(f"ordering {A.shape[0]:,} degrees of freedom")
            self._analysis = Analysis(A, self._backend)
            self._report_memory(A, count)
        factor = self._factor(A)
        if factor.negative() != 0:  # Lanczos near the shift would not see what lies far below it
            raise IndefiniteError(f"the stiffness matrix has eigenvalues below {sigma:.6g} (rad/s)^2")
        noise = _noise(A, M, sigma)
        tolerated = _NOISY_EXACT if tolerance <= EXACT else _NOISY if A.shape[0] < _COSTLY else _NOISY_LARGE
        refined = noise > tolerated
        extended = self._pencil.shifted(K, M, sigma, np.longdouble) if refined else None
        return Operator(factor, without_zeros(M), noise, extended)

    def _report_memory(self, A: Matrix, count: int) -> None:
        """Say how much memory it will take. Raises NumericalError when that is not there."""
        n, symbolic = A.shape[0], self._analysis.symbolic
        vectors = 2 * initial_vectors(n, count) + 3 * (self._sensors + BLOCK) + 4 * COLUMNS
        self._memory = memory.needed(n, A.nnz, symbolic.memory_bytes, vectors)
        memory.check(self._memory, n)

    def _factor(self, A: Matrix) -> Factor:
        self._notice(f"factorising {A.shape[0]:,} degrees of freedom: about {memory.shown(self._memory)}")
        return self._analysis.factor(A)

    def _verified(
        self, solution: EigenSolution, K: Matrix, M: Matrix, sigma: float, count: int, tolerance: float
    ) -> EigenSolution:
        """The solution with as many of its modes as can be told confirmed to be the lowest. Raises NotConverged."""
        for attempt in range(1, _TRIES):
            found, s = _between(solution.eigenvalues, solution.zero)
            if not found:
                return solution
            self._notice(f"counting the modes below mode {found + 1}")
            below = self._factor(self._pencil.shifted(K, M, s)).negative()
            if below is None:
                return solution
            if below == found:
                return replace(solution, verified=found)
            space = solution.space
            space.start(start_block(space.n, None, attempt))
            solution = _solution(refined(space, count, tolerance, self._notice), sigma, count, tolerance)
        raise NotConverged(f"{below} modes lie below {s:.6g} (rad/s)^2, of which only {found} were found")


def eigensolution(K: Matrix, M: Matrix, count: int | None = None, shift: float | None = None) -> EigenSolution:
    """Lowest `count` modes of symmetric K and positive semidefinite M (all of them for dense matrices).

    Dense matrices go to LAPACK; sparse ones to block Lanczos around a factorisation of K - shift M, shift < 0, which is
    positive definite although the structure may move as a rigid body. Degrees of freedom without mass follow the others: their
    own modes, of infinite frequency, are left out.

    Raises IndefiniteError when M has negative eigenvalues, and for sparse matrices when K has eigenvalues below the shift.

    >>> import numpy as np
    >>> eigensolution(np.array([[2.0, -1.0], [-1.0, 2.0]]), np.eye(2)).eigenvalues.round(12).tolist()
    [1.0, 3.0]
    """
    if is_sparse(K) or is_sparse(M):
        return EigenSolver().solve(K, M, count or min(20, K.shape[0] - 2), shift)
    return dense_solution(K, M)


def _elastic(operator: Operator, sigma: float) -> float:
    """The lowest eigenvalue that is not zero, or what rounding makes of zero, roughly: from a small space.

    Below zero when K is indefinite, inf: none found.
    """
    space = Krylov(operator, (_TRIAL + 1) * BLOCK)
    space.start(start_block(space.n, None, 0))
    for _ in range(_TRIAL):
        if not space.expand():
            break
    theta = space.ritz()[0]
    eigenvalues = sigma + 1 / theta[theta > INFINITE * theta[0]]
    return float(min(eigenvalues[np.abs(eigenvalues) > max(1e-7, operator.noise) * -sigma], default=np.inf))


def _noise(A: Matrix, M: Matrix, sigma: float) -> float:
    """What rounding may make of the lowest mode by a solution with A = K - sigma M, relative: eps |A| / |sigma M|, roughly."""
    masses = M.diagonal()
    heavy = masses > 0
    highest = np.max(A.diagonal()[heavy] / masses[heavy], initial=0.0)
    return float(np.finfo(float).eps * highest / abs(sigma))


def _solution(space: Krylov, sigma: float, count: int, tolerance: float) -> EigenSolution:
    """The lowest `count` modes in `space`, or all that have mass. Raises IndefiniteError when theta < 0: a negative mass."""
    theta, S, _ = space.ritz()
    if theta[-1] < -INFINITE * theta[0]:
        raise IndefiniteError("the mass matrix is not positive semidefinite")
    kept = np.flatnonzero(theta[:count] > INFINITE * theta[0])
    theta, S = theta[kept], S[:, kept]
    space.known = known(space, theta, S) if space.operator.noise > _CLEAN else None
    if space.known is None:
        shapes = (S.T @ space.V[: space.reached]).T / np.sqrt(theta)
        return EigenSolution(sigma + 1 / theta, shapes, 1e-8 * abs(sigma), space, sigma)
    if space.operator.refined and tolerance <= EXACT:
        for _ in range(_STEPS):
            space.known = improved(space.known, space.operator)
    own = space.operator.quotients(space.known.X, space.known.MX) if space.operator.refined else 1 / theta
    return EigenSolution(sigma + own, space.known.X.T, 1e-8 * abs(sigma), space, sigma)


def _between(eigenvalues: np.ndarray, zero: float) -> tuple[int, float]:
    """How many eigenvalues lie below s, and s: halfway in the highest gap that is wide enough to count from; 0 where none is.

    zero: below it an eigenvalue is that of a motion as a rigid body, and what parts it from others is rounding.
    """
    gap = (np.diff(eigenvalues) > _PARTED * np.abs(eigenvalues[1:])) & (eigenvalues[1:] > zero)
    if not gap.any():
        return 0, 0.0
    highest = int(np.flatnonzero(gap)[-1])
    return highest + 1, float(eigenvalues[highest] + eigenvalues[highest + 1]) / 2

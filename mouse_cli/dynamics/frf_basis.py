"""The model in which frequency response functions are computed: the whole of a small one, a basis of a large one.

The basis holds the modes found, vectors that the search for them left behind, A^-1 L, A^-1 M A^-1 L, ... of the loads L at sensors
and forces (A = K - sigma M; static and dynamic attachment modes), and A^-1 C X, A^-1 D X where damping couples the modes X of the
band. Galerkin's method in it errs by the product of two residuals in alpha and by one of them in motions and derivatives. At some
lines both errors are found against full solutions, which the basis and A precondition; levels are added until they are small.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mouse_cli.dynamics.eigen import EigenSolution
from mouse_cli.dynamics.frf import Dynamics, FrfModel, Loads, product
from mouse_cli.dynamics.frf_basis_error import errors
from mouse_cli.dynamics.krylov import BLOCK, Krylov
from mouse_cli.model.arrays import Matrix, dense, is_sparse

WHOLE = 60  # degrees of freedom up to which a model is solved as it is
BEYOND = 1.5  # modes are taken up to so many times the highest frequency
FINAL, ITERATING = 1e-6, 1e-4  # relative errors of FRFs that are reported, and of those on the way
_FIRST, _MOST = 2, 8  # levels of Krylov vectors at first, and at the end
_ROUNDING = 1e-11  # what damping may differ from a combination of K and M, relative, to be taken for one


def frf_model(
    dynamics: Dynamics,
    sensings: tuple[Matrix, ...],
    checked: np.ndarray,
    solution: EigenSolution | None = None,
    tolerance: float = FINAL,
) -> FrfModel:
    """The model for loads at `sensings`: sets of degrees of freedom, or of weights (o, n), of sensors and of forces.

    checked: some s (c,), rad/s, of the lines wanted, the highest among them, at which the error of a basis is found and brought
    below `tolerance`. solution: of K and M, with the modes up to BEYOND times the highest line and, for a sparse model, its space
    alive; a dense one needs none. Raises numpy.linalg.LinAlgError.
    """
    loads = Loads(sensings)
    if dynamics.n <= WHOLE or (not is_sparse(dynamics.K) and solution is None) or _without_space(solution):
        return FrfModel(dynamics.dense(), loads.full(dynamics.n), loads.columns)
    basis, levels = _Basis(dynamics, loads, solution, float(np.abs(checked).max())), _FIRST
    while True:
        while basis.levels < levels:
            basis.extend()
        model, levels = basis.model(), basis.levels + 1
        error, motion_error = errors(basis, model, np.asarray(checked, complex))
        if error <= tolerance or basis.complete or levels > _MOST:
            return FrfModel(model.matrices, model.loads, model.columns, model.V, basis.levels, error, motion_error)


def galerkin(
    dynamics: Dynamics, solution: EigenSolution
) -> tuple[np.ndarray | None, Dynamics, Callable[[np.ndarray, np.ndarray], np.ndarray]]:
    """V (d, n) and matrices in it for modes alone, no loads; V None for the model as it is. And residual(s (k,), shapes (n, k)).

    That is the relative error (k,) of poles s, of second order in what the basis lacks: r'A^-1 r / 2|s|^2 with r = Z psi.
    """
    if dynamics.n <= WHOLE or _without_space(solution) or (solution.space is None and not solution.complete):
        return None, dynamics.dense(), lambda s, shapes: np.zeros(len(s))
    top = float(np.sqrt(np.abs(solution.eigenvalues[-1])))
    basis = _Basis(dynamics, Loads((np.zeros(0, int),)), solution, top)
    for _ in range(_FIRST):
        basis.extend()

    def residual(s: np.ndarray, shapes: np.ndarray) -> np.ndarray:
        error = np.zeros(len(s))
        for k, at in enumerate(s):
            r = basis.times(at, shapes[:, [k]])
            solved = basis.operator.columns(np.asfortranarray(np.concatenate([r.real, r.imag], axis=1)))
            error[k] = np.abs(r[:, 0].real @ solved[:, 0] + r[:, 0].imag @ solved[:, 1]) / (2 * np.abs(at) ** 2)
        return error

    return basis.krylov.V, basis.model().matrices, residual


def _without_space(solution: EigenSolution | None) -> bool:
    """Whether a sparse model came without the space that its basis grows from."""
    return solution is not None and not solution.complete and (solution.space is None or not solution.space.current)


@dataclass(frozen=True)
class _Whole:
    """A = K - sigma M of a dense model, as an operator like those of Krylov spaces."""

    A: np.ndarray
    M: np.ndarray
    refined: bool = False

    def solve(self, right: np.ndarray) -> np.ndarray:
        return np.linalg.solve(self.A, right.T).T

    def columns(self, right: np.ndarray) -> np.ndarray:
        return np.linalg.solve(self.A, right)

    def mass(self, vectors: np.ndarray) -> np.ndarray:
        return vectors @ self.M


class _Basis:
    """Rows V (d, n), orthonormal in A, that grow by a level at a time."""

    def __init__(self, dynamics: Dynamics, loads: Loads, solution: EigenSolution, top: float):
        self.dynamics, self.loads, self.levels = dynamics, loads, 0
        self.followed = {name: _follows(getattr(dynamics, name), dynamics) for name in ("C", "D")}
        self.full = loads.full(dynamics.n)
        space = solution.space
        if space is None:
            elastic = solution.eigenvalues[solution.eigenvalues > 0]
            self.sigma = -0.3 * float(elastic[0]) if len(elastic) else -1.0
            M = dense(dynamics.M)
            self.operator = _Whole(dense(dynamics.K) - self.sigma * M, M)
        else:
            self.sigma, self.operator = solution.shift, space.operator
        band = solution.eigenvalues <= (BEYOND * top) ** 2
        X = solution.shapes.T[band]
        self.krylov = self._found(X, solution.eigenvalues[band]) if space is None else space.grown(self._room)
        first = self.krylov.d if space is None else space.reached  # its last block is still to be expanded
        self._VMV = np.zeros((0, 0)) if space is None else space.T
        self._MV = np.zeros((0, dynamics.n))
        self._damped(X)
        self._append(np.ascontiguousarray(self.full.T))
        self._newest = slice(first, self.krylov.d)  # where damping acts, it drives like a force

    @property
    def _room(self) -> int:
        """Vectors that loads and levels usually add."""
        return (self.loads.count + BLOCK) * (1 + _FIRST)

    def _found(self, X: np.ndarray, eigenvalues: np.ndarray) -> Krylov:
        """The modes X (m, n) of a dense model. For a sparse one there is what the search for them left, higher modes and all."""
        krylov = Krylov(self.operator, max(1, min(self.dynamics.n, len(X) + self._room)))
        if len(X):
            mu = eigenvalues[:, None] - self.sigma
            krylov.append(np.array(X), mu * self.operator.mass(np.ascontiguousarray(X)))
        return krylov

    def _damped(self, X: np.ndarray) -> None:
        """What coupling of the modes X (m, n) by damping does to them: A^-1 C X, A^-1 D X outside of their span.

        Damping of a few degrees of freedom does no more than forces at these do.
        """
        for name, followed in self.followed.items():
            if followed is None and len(X):
                damping = getattr(self.dynamics, name)
                at = _moved(damping)
                if len(at) < len(X):
                    right = np.zeros((len(at), self.dynamics.n))
                    right[np.arange(len(at)), at] = 1.0
                else:
                    right = np.ascontiguousarray((damping @ np.ascontiguousarray(X.T)).T)
                self._append(right)

    def _append(self, right: np.ndarray) -> None:
        """Add A^-1 times the rows `right`; they are the newest."""
        first = self.krylov.d
        right = right[np.abs(right).max(axis=1) > 0]
        if len(right):
            self.krylov.append(self.operator.solve(right), right)
        self._newest = slice(first, self.krylov.d)

    @property
    def complete(self) -> bool:
        """Whether nothing is left that could be added."""
        return self._newest.start == self._newest.stop or self.krylov.d >= self.dynamics.n

    def extend(self) -> None:
        """One level more: A^-1 M of the newest vectors."""
        self.levels += 1
        if not self.complete:
            self._project_mass()
            newest, self._MV = self._MV[self._newest.start - self.krylov.d :], self._MV[:0]
            self._append(newest)

    def _project_mass(self) -> None:
        """V M V' of the vectors that are new, each multiplied by M once; the products with the newest are kept for a level more."""
        V, known = self.krylov.V, len(self._VMV)
        if known < len(V):
            self._MV = self.operator.mass(V[known:])
            new = V @ self._MV.T
            self._VMV = np.block([[self._VMV, new[:known]], [new[:known].T, (new[known:] + new[known:].T) / 2]])

    def model(self) -> FrfModel:
        """Galerkin's matrices."""
        self._project_mass()
        V, M = self.krylov.V, self._VMV
        K = np.eye(len(V)) + self.sigma * M
        C, D = (self._projected(name, K, M) for name in ("C", "D"))
        loads = V[:, self.loads.at] @ self.loads.values
        return FrfModel(Dynamics(K, M, C, D), loads, self.loads.columns, V, self.levels)

    def _projected(self, name: str, K: np.ndarray, M: np.ndarray) -> np.ndarray | None:
        damping, followed = getattr(self.dynamics, name), self.followed[name]
        if damping is None:
            return None
        if followed is not None:
            return followed[0] * K + followed[1] * M
        V = self.krylov.V
        at = _moved(damping)
        part = damping if len(at) == len(V[0]) else (damping.tocsr() if is_sparse(damping) else damping)[at][:, at]
        few = np.ascontiguousarray(V.T if len(at) == len(V[0]) else V[:, at].T)
        out = few.T @ (part @ few)
        return (out + out.T) / 2

    def times(self, s: np.ndarray | complex, x: np.ndarray) -> np.ndarray:
        """Z(s) x for x (n, c), s one or (c,); damping that follows K and M costs no product of its own."""
        of_K, of_M, out = 1.0 + 0j, s**2, 0.0  # of each column
        for name, weight in (("C", s), ("D", 1j)):
            if self.followed[name] is not None:
                of_K, of_M = (total + weight * a for total, a in zip((of_K, of_M), self.followed[name], strict=True))
            else:
                out = out + weight * product(getattr(self.dynamics, name), x)
        return out + of_K * product(self.dynamics.K, x) + of_M * product(self.operator.M, x)


def _moved(damping: Matrix) -> np.ndarray:
    """Degrees of freedom that a symmetric matrix concerns."""
    return np.flatnonzero(np.diff(damping.tocsr().indptr) if is_sparse(damping) else damping.any(axis=1))


def _follows(damping: Matrix | None, dynamics: Dynamics) -> tuple[float, float] | None:
    """a, b with sparse `damping` = a K + b M, as far as their patterns tell at once; None where it is not, or not easily seen."""
    K, M = dynamics.K, dynamics.M
    if damping is None:
        return 0.0, 0.0
    if not (is_sparse(damping) and is_sparse(K) and is_sparse(M)):
        return None
    if not (len(damping.data) == len(K.data) and np.array_equal(damping.indices, K.indices)):
        return None
    same = len(M.data) == len(K.data) and np.array_equal(M.indices, K.indices)
    scale = float(K.data @ K.data)
    a, b = float(damping.data @ K.data) / scale, 0.0
    if same and np.abs(damping.data - a * K.data).max() > _ROUNDING * np.abs(damping.data).max():
        parts = np.stack([K.data, M.data], axis=1)
        size = np.linalg.norm(parts, axis=0)
        a, b = (np.linalg.lstsq(parts / size, damping.data, rcond=None)[0] / size).tolist()
    rest = damping.data - a * K.data - (b * M.data if same else 0.0)
    return (a, b) if np.abs(rest).max() <= _ROUNDING * np.abs(damping.data).max() else None

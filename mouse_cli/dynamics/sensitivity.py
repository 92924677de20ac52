"""Exact first derivatives of eigenvalues and mode-shape components with respect to elements of K and M, or to properties.

With dZ = dK - lambda_i dM and x_i'Mx_i = 1 (Fox and Kapoor 1968; the report's O-4):

    d lambda_i = x_i' dZ x_i
    d x_i      = -G_i dZ x_i - 1/2 (x_i' dM x_i) x_i,     G_i = sum_{j != i} x_j x_j' / (lambda_j - lambda_i)

over *all* modes j. Only products of G_i with the measured rows or with the forces dZ x_i are formed, whichever are fewer;
a sparse model needs no further mode for them, but one solve.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.dynamics.adjoint import Adjoint
from mouse_cli.dynamics.eigen import EigenSolution, clusters
from mouse_cli.dynamics.forces import Forces
from mouse_cli.dynamics.sensing import read, unit_loads
from mouse_cli.model.arrays import Matrix, is_sparse

_FEW = 0.25  # share of the degrees of freedom that sensors may read for one space to serve all modes
FINAL, EXACT = 1e-6, 1e-9  # relative errors of partial derivatives that are reported, and of those that are to be exact


@dataclass(frozen=True)
class ModalPartials:
    """Partial derivatives by the e listed elements, or by p properties, in the order of the data of a test.

    values (m + m s, e): all eigenvalues, then mode 1 at its s points, mode 2, ...; d_lambda (m, e) and d_shape (m, s, e)
    are views of it. error: estimated relative error of d_shape; 0 where it is rounding alone, None where it was not estimated.
    """

    values: np.ndarray
    modes: int
    error: float | None = 0.0

    @property
    def d_lambda(self) -> np.ndarray:
        """Derivatives (m, e) of the eigenvalues."""
        return self.values[: self.modes]

    @property
    def d_shape(self) -> np.ndarray:
        """Derivatives (m, s, e) of the shape components."""
        points = len(self.values) // max(self.modes, 1) - 1
        return self.values[self.modes :].reshape(self.modes, points, self.values.shape[1])


def modal_partials(
    solution: EigenSolution,
    K: Matrix,
    M: Matrix,
    modes: np.ndarray,
    sensing: Matrix,
    pattern: Forces,
    accuracy: float | None = FINAL,
) -> ModalPartials:
    """T = d(lambda, x)/d(properties) for the measured `modes` (m,), from 0, at the sensors; Eqs. (3-1) and O-5 of the report.

    sensing: degrees of freedom (s,), from 0, or what each sensor reads (s, n). pattern: derivatives of K and M by the
    properties, or by listed elements for B. Modes closer than 1e-6, relative, are treated as a subspace: derivatives within it
    are those of parallel transport.
    accuracy: relative error to be reached by a sparse model; None: about 1e-3, enough to iterate with, and not estimated.
    """
    space = solution.space
    if space is not None and space.current and 0 < sensing.shape[0] <= _FEW * len(solution.shapes):
        partials = ModalPartials(np.empty((len(modes) * (1 + sensing.shape[0]), pattern.properties)), len(modes))
        adjoint = Adjoint(solution, modes, sensing, pattern.stack)
        return replace(partials, error=adjoint.partials(partials.d_lambda, partials.d_shape, accuracy))
    s = sensing.shape[0]
    touched, any_mass = pattern.touched, bool(pattern.mass.any())
    partials = ModalPartials(np.empty((len(modes) * (1 + s), pattern.properties)), len(modes))
    d_lambda, d_shape = partials.d_lambda, partials.d_shape
    family = clusters(solution.eigenvalues, solution.zero)
    for i, mode in enumerate(modes):
        x, same = solution.shapes[:, mode], np.flatnonzero(family == family[mode])
        F = pattern.on(x, solution.eigenvalues[mode])
        d_lambda[i] = F.T @ x[touched]
        if s:
            d_shape[i] = _response(solution, K, M, mode, same, sensing, touched, F)
        if any_mass:  # the length of x_i follows the mass: -1/2 sum_k x_k (x_k' dM x_i) over its cluster
            X = solution.shapes[:, same]
            d_shape[i] -= 0.5 * read(sensing, X) @ (pattern.inertial(x).T @ X[touched]).T
    return partials


def _response(
    solution: EigenSolution,
    K: Matrix,
    M: Matrix,
    mode: int,
    same: np.ndarray,
    sensing: Matrix,
    touched: np.ndarray,
    F: Matrix,
) -> np.ndarray:
    """-G_i F at the sensors (s, p), for forces F (t, p) at the touched degrees of freedom."""
    (n, k), s, (t, p) = solution.shapes.shape, sensing.shape[0], F.shape
    by_forces = p < s and not is_sparse(F)
    if k < n:
        inverse = _fixed(solution, K, M, mode, same)
        if by_forces:
            return -read(sensing, inverse(touched, F))
        return -(F.T @ inverse(*unit_loads(sensing))[touched]).T
    distance = solution.eigenvalues - solution.eigenvalues[mode]
    distance[same] = np.inf
    rows = read(sensing, solution.shapes) / distance
    if by_forces and n * p * (t + s) < s * t * (n + p):
        return -rows @ (solution.shapes[touched].T @ F)
    return -(F.T @ (rows @ solution.shapes[touched].T).T).T


def _fixed(
    solution: EigenSolution, K: Matrix, M: Matrix, mode: int, same: np.ndarray
) -> Callable[[np.ndarray, np.ndarray], np.ndarray]:
    """G_i without the other modes: K - lambda_i M is regular once as many components are fixed as the cluster has modes.

    (Nelson 1976, for a cluster: where its shapes differ most.) Unlike a border it leaves the matrix as sparse as it is. The answer
    gives G_i times `values` (r, c) placed at the degrees of freedom `at` (r,), as (n, c).
    """
    from scipy.linalg import qr
    from scipy.sparse import csc_array, diags_array
    from scipy.sparse.linalg import splu

    n, X = K.shape[0], solution.shapes[:, same]
    border, held = M @ X, np.zeros(n)
    held[qr(X.T, mode="r", pivoting=True)[1][: len(same)]] = 1.0
    free, scale = diags_array(1 - held), float(np.abs(K.diagonal()).max())
    shifted = csc_array(K) - solution.eigenvalues[mode] * csc_array(M)
    try:
        factor = splu(
            csc_array(free @ shifted @ free + diags_array(scale * held)),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=1e-3,
            options={"SymmetricMode": True},
        )
    except RuntimeError as reason:  # SuperLU's word for an exactly singular matrix
        raise np.linalg.LinAlgError(f"mode {mode + 1}: {reason}") from None

    def inverse(at: np.ndarray, values: np.ndarray) -> np.ndarray:
        right = np.zeros((n, values.shape[1]))
        right[at] = values
        right -= border @ (X[at].T @ values)
        right[held > 0] = 0.0
        motion = factor.solve(right)
        return motion - X @ (border.T @ motion)

    return inverse

"""A model seen through its sensors: motion of all degrees of freedom by readings, and matrices of the size of the test."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mouse_cli.dynamics.sensing import read
from mouse_cli.model.arrays import Matrix, is_sparse

_FREE = 1e8  # amplification beyond which readings do not hold the structure


class LooseError(ArithmeticError):
    """The sensors leave a motion of the structure undetermined."""


def weights(sensing: Matrix, n: int) -> Matrix:
    """What the sensors read (s, n), sparse, of a sensing given as degrees of freedom (s,) or as weights (s, n)."""
    from scipy.sparse import csr_array

    if sensing.ndim == 2:
        return csr_array(sensing)
    s = len(sensing)
    return csr_array((np.ones(s), sensing, np.arange(s + 1)), shape=(s, n))


def held(Z: Matrix, sensing: Matrix, readings: np.ndarray) -> np.ndarray:
    """Motion u (n, k) with given `readings` (s, k) and no force but at the sensors: Z u = S'f, S u = readings.

    For sensors that are degrees of freedom that is u_o = -Z_oo^-1 Z_oa u_a; Z = K gives the static shapes of Guyan (1965),
    Z = K - lambda M those of Kidder (1973). One factorisation of Z bordered by S. Raises LooseError when the readings
    do not determine u.
    """
    solve = bordered(Z, weights(sensing, Z.shape[0]))
    motion = solve(np.zeros((Z.shape[0], readings.shape[1])), readings)[0]
    checked(motion, sensing, readings)
    return motion


Solve = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]


def bordered(Z: Matrix, S: Matrix) -> Solve:
    """Solver of Z u = load + S'f with S u = readings, for loads (n, k) and readings (s, k): u (n, k) and f (s, k).

    Regular although Z is singular, as long as the sensors see what moves without force. Raises LooseError, also when used.
    """
    n, scale = Z.shape[0], float(np.abs(Z.diagonal()).max()) or 1.0
    solve = _factor(Z, S * scale)

    def solved(load: np.ndarray, readings: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        found = solve(np.vstack([load, readings * scale]))
        return found[:n], -scale * found[n:]

    return solved


def _factor(Z: Matrix, S: Matrix) -> Callable[[np.ndarray], np.ndarray]:
    """Solver of [[Z, S'], [S, 0]] x = right."""
    from scipy.sparse import block_array, csc_array

    if not is_sparse(Z):
        S = S.toarray()
        matrix = np.block([[Z, S.T], [S, np.zeros((len(S), len(S)))]])
        return lambda right: _regular(lambda: np.linalg.solve(matrix, right))
    from scipy.sparse.linalg import splu

    matrix = block_array([[csc_array(Z), csc_array(S.T)], [csc_array(S), None]], format="csc")
    factor = _regular(lambda: splu(matrix, permc_spec="MMD_AT_PLUS_A"))

    def refined(right: np.ndarray) -> np.ndarray:  # fine meshes are ill-conditioned, and a second solve is cheap
        first = factor.solve(right)
        return first + factor.solve(right - matrix @ first)

    return refined


def _regular(compute: Callable):
    try:
        return compute()
    except (np.linalg.LinAlgError, RuntimeError):  # SuperLU's word for an exactly singular matrix is RuntimeError
        raise LooseError("the sensors leave a motion of the structure undetermined") from None


def checked(motion: np.ndarray, sensing: Matrix, readings: np.ndarray) -> None:
    """Raise LooseError for a solution that only rounding made possible."""
    size = np.abs(readings).max(initial=0.0)
    wrong = np.abs(read(sensing, motion) - readings).max(initial=0.0)
    if not np.isfinite(motion).all() or np.abs(motion).max(initial=0.0) > _FREE * size or wrong > 1e-5 * size:
        raise LooseError("the sensors leave a motion of the structure undetermined")


@dataclass(frozen=True)
class TestModel:
    """K and M of the size of the test (s, s); they stand for the model as far as motion follows from the readings."""

    __test__ = False  # not a pytest class

    K: np.ndarray
    M: np.ndarray


def static(K: Matrix, M: Matrix, sensing: Matrix) -> TestModel:
    """Guyan's test-analysis model: K and M on the static shapes R of unit readings, R'KR and R'MR. Raises LooseError."""
    R = held(K, sensing, np.eye(sensing.shape[0]))
    return TestModel(R.T @ (K @ R), R.T @ (M @ R))


def modal(eigenvalues: np.ndarray, shapes: np.ndarray) -> TestModel:
    """The test-analysis model of k mass-normalised modes, `shapes` (s, k) at the sensors: X+'X+ and X+' Lambda X+.

    It reproduces those modes exactly (SEREP, O'Callahan, Avitabile and Riemer 1989); its rank is k.
    """
    inverse = np.linalg.pinv(shapes)
    return TestModel(inverse.T @ (eigenvalues[:, None] * inverse), inverse.T @ inverse)


def orthogonality(one: np.ndarray, other: np.ndarray, mass: np.ndarray) -> np.ndarray:
    """x'M y / sqrt(x'M x y'M y) (a, b) between columns of `one` (s, a) and `other` (s, b); NaN where one is missing."""
    product = one.T @ (mass @ other)
    a, b = (np.sqrt(np.maximum(np.einsum("ij,ij->j", x, mass @ x), 0.0)) for x in (one, other))
    size = np.outer(a, b)
    return np.divide(product, size, out=np.full(size.shape, np.nan), where=size > 0)


def sd_orthogonality(shapes: np.ndarray, sd: np.ndarray, mass: np.ndarray) -> np.ndarray:
    """What independent errors `sd` (s, a) of the components of `shapes` make of their orthogonality (a, a): standard deviations.

    To first order in the errors, off the diagonal: sd_ij^2 = sum_k (M x_j)_k^2 sd_ki^2 + (M x_i)_k^2 sd_kj^2, over the product
    of the modal masses.
    """
    forces = mass @ shapes
    size = np.maximum(np.einsum("ij,ij->j", shapes, forces), 0.0)
    spread = (sd**2).T @ forces**2
    variance = np.divide(
        spread + spread.T, np.outer(size, size), out=np.full(spread.shape, np.nan), where=np.outer(size, size) > 0
    )
    return np.sqrt(variance)

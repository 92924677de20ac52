"""How alike two sets of mode shapes are, and which model mode a measured mode is."""

import numpy as np


def mac(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Modal assurance criterion (a, b) between columns of `one` (s, a) and `other` (s, b); NaN components are left out.

    MAC = |x'y|^2 / (x'x y'y), over the points that both measured (Allemang and Brown 1982).

    >>> import numpy as np
    >>> mac(np.array([[1.0], [2.0]]), np.array([[2.0, 2.0], [4.0, -1.0]])).round(12).tolist()
    [[1.0, 0.0]]
    """
    have_one, have_other = np.isfinite(one).astype(float), np.isfinite(other).astype(float)
    x, y = np.nan_to_num(one), np.nan_to_num(other)
    size = ((x * x).T @ have_other) * (have_one.T @ (y * y))
    return np.divide((x.T @ y) ** 2, size, out=np.zeros_like(size), where=size > 0)


def pair(test_shapes: np.ndarray, test_hz: np.ndarray, shapes: np.ndarray, hz: np.ndarray) -> np.ndarray:
    """Index (m,) of the model mode that each measured mode is: the assignment of least total distance.

    Distance 1 - MAC + 2 |ln(f / f_test)|: shapes decide where they can, frequencies where shapes are alike.
    test_shapes (s, m), test_hz (m,) may hold NaN; shapes (s, k), hz (k,). A model mode of zero frequency is never paired.
    """
    from scipy.optimize import linear_sum_assignment

    distance = 1.0 - mac(test_shapes, shapes)
    with np.errstate(divide="ignore"):
        detuning = np.abs(np.log(np.maximum(hz, 0.0)[None, :] / test_hz[:, None]))
    distance += np.where(np.isnan(detuning), 0.0, np.minimum(2 * detuning, 1e3))
    distance[:, hz <= 0] = 1e6
    return linear_sum_assignment(distance)[1]


def least_squares_scale(theory: np.ndarray, test: np.ndarray, mass: np.ndarray) -> float:
    """Factor c of `test` (s,) that brings it nearest to `theory` (s,) in the metric of `mass` (s, s).

    c = theory' M test / test' M test; it carries the sign. 0 when the two are unrelated.
    """
    return float(theory @ mass @ test) / float(test @ mass @ test)


def align(basis: np.ndarray, test: np.ndarray) -> np.ndarray:
    """Rotation (c, c) of a cluster's shapes `basis` (s, c) whose first columns lie nearest to `test` (s, t), t <= c.

    Orthogonal Procrustes problem (Schoenemann 1966): modes of equal frequency are defined only up to a rotation.
    """
    left, _, right = np.linalg.svd(basis.T @ test)
    t = test.shape[1]
    first = left[:, :t] @ right
    return np.hstack([first, left[:, t:]])

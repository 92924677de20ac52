"""Baruch and Bar-Itzhack (1978): the symmetric K nearest to K0 that has the measured modes. Closed form."""

import numpy as np

from mouse_cli.methods import SHAPES, Method
from mouse_cli.methods.found import Found
from mouse_cli.methods.given import Given
from mouse_cli.model.updated import KEPT, LOST


def nearest(K: np.ndarray, M: np.ndarray, X: np.ndarray, eigenvalues: np.ndarray) -> np.ndarray:
    """K0 + D + D', D = (1 - M X X'/2)(M X L - K0 X) X'M, for shapes X (n, m) with X'MX = 1 (lecture 21-1).

    The same as P'K0 P + M X L X'M with P = 1 - X X'M, which shows that K stays positive semidefinite.

    >>> import numpy as np
    >>> nearest(np.diag([1.0, 4.0]), np.eye(2), np.array([[1.0], [0.0]]), np.array([2.0])).tolist()
    [[2.0, 0.0], [0.0, 4.0]]
    """
    MX = M @ X
    D = (MX * eigenvalues - K @ X) @ MX.T
    D -= MX @ (X.T @ D) / 2
    return K + D + D.T


def update(given: Given) -> Found:
    """The matrix nearest to K0 in |M^-1/2 (K - K0) M^-1/2|, shapes expanded by the current K until both agree."""
    K, count, change, settled = given.iterate(lambda X: nearest(given.K, given.M, X, given.eigenvalues))
    return Found(K, given.M, count, change, settled)


METHOD = Method(
    "baruch",
    "Baruch and Bar-Itzhack",
    "min |M^-1/2 (K - K0) M^-1/2| with K X = M X L: K = K0 + D + D', D = (1 - M X X'/2)(M X L - K0 X) X'M",
    "lecture 21-1; Baruch and Bar-Itzhack, AIAA J. 16 (1978) 346",
    (
        (KEPT, "X L X' replaces in K the modes of K0 that are nearest to X"),
        (KEPT, "K = P'K0 P + M X L X'M with P = 1 - X X'M, a sum of semidefinite matrices"),
        (KEPT, "X is made orthogonal to the rigid-body modes of K0, so that D has no force on them"),
        (LOST, "M X X'M is full: degrees of freedom are joined that nothing joins in the structure"),
        (LOST, "modes that were not measured stay those of the model, which was wrong; no element has that stiffness"),
    ),
    (SHAPES,),
    update,
    dense=True,
)

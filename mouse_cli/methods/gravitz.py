"""Gravitz's estimate (section 2 of the report; with Rodden): flexibility from modes, made symmetric by averaging, inverted."""

import numpy as np

from mouse_cli.methods import SHAPES, Method
from mouse_cli.methods.found import Found
from mouse_cli.methods.given import Given
from mouse_cli.model.updated import LOST, PARTLY

_ZERO = 1e-12  # of the largest eigenvalue of the flexibility


def update(given: Given) -> Found:
    """K is the inverse of F = (G + G')/2 within its range; shapes X are expanded once, and not made orthogonal.

    G = X L^-1 (X'MX)^-1 X' is symmetric where X'MX is diagonal. In m coordinates: F = Q f Q', Q an orthonormal basis of the shapes
    in the metric of M, and K = M Q f^-1 Q'M.
    """
    X, M = given.expanded(given.K), given.M
    L = np.linalg.cholesky(X.T @ (M @ X))
    Q = np.linalg.solve(L, X.T).T
    G = (L.T / given.eigenvalues) @ np.linalg.inv(L.T)
    values, V = np.linalg.eigh((G + G.T) / 2)
    kept = np.abs(values) > _ZERO * np.abs(values).max()
    MQ = M @ (Q @ V[:, kept])
    return Found((MQ / values[kept]) @ MQ.T, M)


METHOD = Method(
    "gravitz",
    "Gravitz and Rodden, averaged flexibility",
    "K^-1 = (G + G')/2, G = X L^-1 (X'MX)^-1 X'",
    "section 2 of the 1972 report, references 4 and 5",
    (
        (PARTLY, "exactly where the shapes are orthogonal as measured; the average moves them else"),
        (LOST, "the average of G and its transpose may have negative eigenvalues when many modes are given (Ross)"),
        (PARTLY, "as good as the measured shapes are orthogonal to them"),
        (LOST, "M Q is full"),
        (LOST, "there is no stiffness against any motion that was not measured: K has the rank of the test"),
    ),
    (SHAPES,),
    update,
    dense=True,
)

"""Converged modes of a slender structure, freed of what rounding mixed into them, and taken out of other vectors by their mass.

A solution with A = K - sigma M carries an error of about eps |A| / mu_1 along the lowest mode, mu_1 = lambda_1 - sigma, whatever
was solved for; products with A, which tell how much of the mode is there, have lost as many digits. Products with M have not.
"""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.dynamics.krylov import Krylov, Operator

_EQUAL = 1e-6  # modes so close, relative, are left as they are towards one another
ROWS = 2048  # worked on at once: they stay in the cache


@dataclass(frozen=True)
class Known:
    """k modes: shapes X (k, n), mass-normalised, M X (k, n), and their coefficients (d, k) in terms of a Krylov space's V.

    theta (k,): their eigenvalues of A^-1 M as that space has them.
    """

    X: np.ndarray
    MX: np.ndarray
    coefficients: np.ndarray
    theta: np.ndarray

    def take_out(self, U: np.ndarray) -> None:
        """Make U (n, c) orthogonal to the modes, in place: U - X'(M X U)."""
        part = self.MX @ U
        for first in range(0, len(U), ROWS):
            rows = slice(first, first + ROWS)
            U[rows] -= self.X[:, rows].T @ part


def known(space: Krylov, theta: np.ndarray, S: np.ndarray) -> Known:
    """The modes S (r, k) of `space`, lowest first, each made orthogonal to those below it: there the error is."""
    combined = S / np.sqrt(theta)
    X = combined.T @ space.V[: len(S)]
    MX = space.operator.mass(X)
    lower = np.linalg.cholesky(X @ MX.T)  # Gram and Schmidt's process, by its matrix
    X, MX = np.linalg.solve(lower, X), np.linalg.solve(lower, MX)
    return Known(X, MX, np.linalg.solve(lower, combined.T).T, theta)


def improved(modes: Known, operator: Operator) -> Known:
    """The modes after a step of Newton's method with residuals in extended precision: r_i = A x_i - mu_i M x_i.

    x_i - sum_k x_k (x_k'r_i) / (mu_k - mu_i) - P A^-1 r_i, over all other modes k, P the projector that removes them.
    """
    X, MX = modes.X, modes.MX
    mu = operator.quotients(X, MX)
    rest = operator.residual(X, MX, mu)
    distance = mu[:, None] - mu
    near = np.abs(distance) < _EQUAL * mu
    within = np.where(near, 0.0, X @ rest.T / np.where(near, 1.0, distance))
    outside = operator.solve(rest)
    X = X - within.T @ X - (outside - (outside @ MX.T) @ X)
    MX = operator.mass(X)
    lower = np.linalg.cholesky(X @ MX.T)
    C = np.linalg.solve(lower, (modes.coefficients - modes.coefficients @ within).T).T
    return replace(modes, X=np.linalg.solve(lower, X), MX=np.linalg.solve(lower, MX), coefficients=C)

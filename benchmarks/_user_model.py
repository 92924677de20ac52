"""Model updating as a user writes it with numpy and scipy: eigensolution, pairing by MAC, weighted residuals. No mouse in it.

It also runs in the environment of the peers, which have other versions of both.
"""

import numpy as np


class UserModel:
    """K = sum_j theta_j K_j (p, n, n dense, or a list of sparse matrices) and M; f (m,), shapes (s, m) measured at dofs (s,).

    Residuals are divided by their standard deviations f_sd (m,) and shape_sd (s, m), those of the parameters by prior_sd (p,).
    """

    def __init__(self, K, M, dofs, f, f_sd, shapes, shape_sd, prior_sd):
        self.K, self.M, self.dofs, self.shapes = K, M, dofs, shapes
        self.y = np.concatenate([f, shapes.T.ravel()])
        self.sd = np.concatenate([f_sd, shape_sd.T.ravel()])
        self.prior_sd, self.modes, self.solutions = prior_sd, len(f), 0

    def predicted(self, theta: np.ndarray) -> np.ndarray:
        """Natural frequencies in Hz and shape components (q,) of the model modes most like the measured ones."""
        eigenvalues, shapes = self.eigensolution(theta)
        x = shapes[self.dofs]
        mac = (self.shapes.T @ x) ** 2 / np.outer((self.shapes**2).sum(axis=0), (x**2).sum(axis=0))
        mode = mac.argmax(axis=1)
        x = x[:, mode] * np.sign(np.einsum("ij,ij->j", x[:, mode], self.shapes))
        return np.concatenate([np.sqrt(np.abs(eigenvalues[mode])) / (2 * np.pi), x.T.ravel()])

    def matrices(self, theta: np.ndarray):
        """K and M at theta (p,)."""
        if isinstance(self.K, np.ndarray):
            return np.tensordot(theta, self.K, 1), self.M
        return sum(t * K for t, K in zip(theta, self.K, strict=True)), self.M

    def eigensolution(self, theta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The lowest modes and three more, to pair with."""
        self.solutions += 1
        K, M = self.matrices(theta)
        count = min(self.modes + 3, M.shape[0])
        if isinstance(K, np.ndarray):
            from scipy.linalg import eigh

            return eigh(K, M, subset_by_index=[0, count - 1])
        from scipy.sparse.linalg import eigsh

        return eigsh(K, count, M, sigma=0.0)

    def residual(self, theta: np.ndarray) -> np.ndarray:
        """Weighted residuals (q + p,): those of the data, then those of the prior around 1."""
        return np.concatenate([(self.predicted(theta) - self.y) / self.sd, (theta - 1.0) / self.prior_sd])

    def least_squares(self, **options) -> np.ndarray:
        """The answer of scipy.optimize.least_squares with its finite differences, from nominal values."""
        from scipy.optimize import least_squares

        return least_squares(self.residual, np.ones(len(self.prior_sd)), x_scale=self.prior_sd, **options).x

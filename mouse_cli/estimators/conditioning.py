"""Bounds of errors in parameter estimation (lecture 21): what errors of A and of b can do to the answer of A z = b.

For square A the lecture has |dz|/|z| <= kappa |dA|/|A| and |dz|/|z| <= kappa |db|/|b|. With more data than parameters part of b
lies outside of the range of A, at an angle theta, and to first order (Golub and Van Loan 1996, theorem 5.3.1)

    |dz|/|z| <= kappa / cos(theta) |db|/|b|,    |dz|/|z| <= (kappa + kappa^2 tan(theta)) |dA|/|A|,

which are the lecture's where theta = 0. The Bayes estimate is the least-squares answer of [B; I] z = [d; 0].
"""

import numpy as np

from mouse_cli.estimators.linear import LinearProblem
from mouse_cli.model.conditioning import Conditioning

MOST = 1000  # parameters, or data, up to which singular values are computed


def conditioning(
    problem: LinearProblem, z: np.ndarray, weighted: bool, with_prior: bool, error: float | None = None
) -> Conditioning | None:
    """The bounds at the answer z (k,) of `problem`; None for problems so large that they would cost more than the answer.

    error: estimated |dA|/|A|.
    """
    B, d = problem.whitened() if weighted else (problem.in_prior_units(), problem.d)
    q, k = B.shape
    if min(q, k) > MOST or not k or not q:
        return None
    largest, smallest, direction = _singular(B)
    rest, met = d - B @ z, B @ z
    if with_prior:
        largest, smallest = np.hypot(1.0, largest), np.hypot(1.0, smallest)
        rest, met = np.concatenate([rest, z]), np.concatenate([met, z])
    size = float(np.linalg.norm(met))
    spread = np.abs(problem.L) if problem.L.ndim == 1 else np.linalg.norm(problem.L, axis=1)
    weakest = problem.expand(direction) / np.where(spread > 0, spread, 1.0)
    kappa = float(largest / smallest) if smallest > np.finfo(float).eps * max(q, k) * largest else np.inf
    if not np.isfinite(kappa) or not size > 0:
        return Conditioning(kappa, np.inf, np.inf, weakest, with_prior, error)
    tangent = float(np.linalg.norm(rest)) / size
    return Conditioning(
        kappa, kappa * float(np.hypot(1.0, tangent)), kappa + kappa**2 * tangent, weakest, with_prior, error
    )


def _singular(B: np.ndarray) -> tuple[float, float, np.ndarray]:
    """Largest and smallest singular value of B (q, k), zero where q < k, and the direction (k,) of the smallest."""
    q, k = B.shape
    if q > 2 * k:
        B = np.linalg.qr(B, mode="r")
    if (
        q < k
    ):  # something is not seen at all: the direction of it that B changes least, by projection of the least seen axis
        _, s, Vt = np.linalg.svd(B, full_matrices=False)
        unseen = int(np.argmin(np.einsum("ij,ij->j", Vt, Vt)))
        direction = np.eye(k)[unseen] - Vt.T @ Vt[:, unseen]
        return float(s[0]), 0.0, direction / max(float(np.linalg.norm(direction)), 1e-300)
    _, s, Vt = np.linalg.svd(B, full_matrices=False)
    return float(s[0]), float(s[-1]), Vt[-1]

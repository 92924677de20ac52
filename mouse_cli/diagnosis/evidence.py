"""The evidence for causes, by Laplace's method: likelihood times prior, integrated as a Gaussian about the most probable values.

With x = [z, c], k parameters z ~ N(0, 1) and d coordinates c of causes, uniform in ranges of widths w, C = |residual|^2 + |z|^2 at
its least and H = J'J + I_z there (Tierney and Kadane 1986; MacKay, Information Theory, Inference and Learning Algorithms, 27),

    ln Z = -C/2 - sum ln w + (d/2) ln 2 pi - 1/2 ln |H + diag(0, 2 pi / w^2)|

but for what the data have by themselves, sum ln(sqrt(2 pi) sd). The prior of z is normalised by the same (2 pi)^(k/2) as its
integral. What is added to H keeps an unknown that the data do not feel from being found wider than its range: it leaves Z as it is.
"""

import numpy as np


def capped(hessian: np.ndarray, width: np.ndarray) -> np.ndarray:
    """H (k + d, k + d), the last d unknowns at most as wide as their ranges of `width` (d,)."""
    found = hessian.copy()
    at = np.arange(len(hessian) - len(width), len(hessian))
    found[at, at] += 2 * np.pi / width**2
    return found


def root(hessian: np.ndarray, width: np.ndarray) -> np.ndarray:
    """Root B (k + d, k + d) of the covariance B B' of all unknowns, the last d at most as wide as their ranges of `width` (d,).

    In units where the diagonal of the Hessian is 1 no eigenvalue counts for less than rounding: of two unknowns that the data
    cannot tell apart at all, the sum alone is known, and the covariance is positive definite all the same.
    """
    H = capped(hessian, width)
    unit = 1 / np.sqrt(H.diagonal())
    values, vectors = np.linalg.eigh(unit[:, None] * H * unit)
    return unit[:, None] * vectors / np.sqrt(np.maximum(values, len(H) * np.finfo(float).eps))


def laplace(misfit: float, hessian: np.ndarray, width: np.ndarray) -> float:
    """ln Z for C = `misfit`, H = `hessian` (k + d, k + d) and widths (d,) of the ranges of the last d unknowns."""
    size = log_determinant(hessian, width)
    return float(-0.5 * misfit - np.log(width).sum() + 0.5 * len(width) * np.log(2 * np.pi) - 0.5 * size)


def at_ends(left: np.ndarray, hessian: np.ndarray, width: np.ndarray, share: np.ndarray) -> float:
    """What ln Z gains where prior is at the upper ends of ranges too, a `share` (d,) of each of the last d unknowns, `left` (d,)
    below the end at its most probable value.

    Evidence at a point of a range is evidence over the range times posterior over prior density there (Dickey, Annals of
    Mathematical Statistics 42, 1971); unknowns are taken one by one.
    """
    at = np.flatnonzero(share)
    if not len(at) or not np.isfinite(hessian).all():
        return 0.0
    sd = np.linalg.norm(root(hessian, width)[len(hessian) - len(width) + at], axis=1)
    ln_ratio = np.log(width[at] / (np.sqrt(2 * np.pi) * sd)) - 0.5 * (left[at] / sd) ** 2
    return float(np.logaddexp(np.log1p(-share[at]), np.log(share[at]) + ln_ratio).sum())


def marginal(residual: np.ndarray, root: np.ndarray) -> tuple[float, float]:
    """Chi-square of `residual` (n,) ~ N(0, I + B B') and ln |I + B B'|, with B = `root` (n, d).

    By the singular values of B, so that an unknown that is open by many powers of ten takes its direction out of the chi-square;
    the covariance itself would be singular to rounding.
    """
    U, s, _ = np.linalg.svd(root, full_matrices=False)
    known = U.T @ residual
    return float(residual @ residual - known**2 @ (s**2 / (1 + s**2))), float(np.log1p(s**2).sum())


def log_determinant(hessian: np.ndarray, width: np.ndarray) -> float:
    """ln |H| of a positive definite H (k + d, k + d), the last d unknowns at most as wide as their ranges of `width` (d,); infinite
    where it has no numbers.

    Of unknowns that the data hardly tell apart rounding leaves H singular, or indefinite: no evidence may come of that, so that
    in units where the diagonal is 1 no eigenvalue counts for less than rounding.
    """
    H = capped(hessian, width)
    scale = np.sqrt(H.diagonal())
    scaled = H / np.outer(scale, scale)
    if not np.isfinite(scaled).all():
        return np.inf
    least = len(H) * np.finfo(float).eps
    return float(2 * np.log(scale).sum() + np.log(np.maximum(np.linalg.eigvalsh(scaled), least)).sum())

"""How much a chain of an ensemble tells: autocorrelation time, agreement of its walkers."""

import numpy as np

AGREED = 1.05  # split R-hat of walkers; each is short, which alone makes 1 + tau / steps
ENOUGH = 50  # autocorrelation times


def times(chain: np.ndarray) -> np.ndarray:
    """Integrated autocorrelation times (q,) in steps of a chain (s, w, q) (Goodman and Weare 2010; the package emcee)."""
    from emcee.autocorr import integrated_time

    with np.errstate(invalid="ignore", divide="ignore"):
        found = integrated_time(chain, tol=0, quiet=True)
    return np.where(np.isfinite(found), np.maximum(found, 1.0), len(chain))


def r_hat(chain: np.ndarray) -> np.ndarray:
    """Rank-normalised split R-hat (q,) of a chain (s, w, q), both halves of each walker being chains.

    sqrt((n-1)/n + B/W) of z = Phi^-1((rank - 3/8)/(S + 1/4)) (Vehtari, Gelman, Simpson, Carpenter and Buerkner, Bayesian Anal. 16
    (2021), section 4.1); B is the variance of the means of chains, W the mean of their variances.
    """
    from scipy.special import ndtri
    from scipy.stats import rankdata

    half = len(chain) // 2
    split = np.concatenate([chain[:half], chain[-half:]], axis=1)
    ranks = rankdata(split.reshape(-1, split.shape[2]), axis=0)
    z = ndtri((ranks - 0.375) / (len(ranks) + 0.25)).reshape(split.shape)
    inside = z.var(axis=0, ddof=1).mean(axis=0)
    between = z.mean(axis=0).var(axis=0, ddof=1)
    ratio = np.divide(between, inside, out=np.zeros_like(inside), where=inside > 0)
    return np.sqrt((half - 1) / half + ratio)


def long_enough(chain: np.ndarray) -> tuple[bool, float]:
    """Whether every quantity of the chain (s, w, q) has ENOUGH autocorrelation times and its walkers agree; the longest time."""
    tau = float(times(chain).max())
    return bool(len(chain) >= ENOUGH * tau and r_hat(chain).max() < AGREED), tau

"""Pareto k-hat: whether draws of one density can stand for another, by the tail of their importance weights."""

import numpy as np

DOUBTFUL = 0.7  # beyond it no practicable number of draws makes their weights reliable (Vehtari et al. 2024)
_ALIKE = 1e-9  # share by which weights differ for rounding alone


def k_hat(log_weights: np.ndarray) -> float:
    """Shape of the generalised Pareto distribution of the largest weights, for log weights (s,) up to a constant.

    The tail are the min(s / 5, 3 sqrt(s)) largest weights, above the next one (Vehtari, Simpson, Gelman, Yao and Gabry, J. Mach.
    Learn. Res. 25 (2024), sections 2.4 and 3.2.2). 0 where these are all alike, infinite where fewer draws have any weight.
    """
    log_weights = np.sort(log_weights)
    count = int(min(len(log_weights) / 5, 3 * np.sqrt(len(log_weights))))
    if count < 5 or not np.isfinite(log_weights[-count - 1]):
        return np.inf
    weights = np.exp(log_weights[-count - 1 :] - log_weights[-1])
    return _shape(weights[1:] - weights[0]) if weights[0] < 1 - _ALIKE else 0.0


def _shape(x: np.ndarray) -> float:
    """k of the generalised Pareto distribution of exceedances x (n,), ascending: Zhang and Stephens, Technometrics 51 (2009), 316.

    Drawn towards 0.5 as by ten more exceedances (Vehtari et al. 2024, appendix G).
    """
    n = len(x)
    grid = 30 + int(np.sqrt(n))
    quartile = max(x[int(n / 4 + 0.5) - 1], x[-1] * 1e-12)
    theta = 1 / x[-1] + (1 - np.sqrt(grid / (np.arange(grid) + 0.5))) / (3 * quartile)
    k = -np.log1p(-theta[:, None] * x).mean(axis=1)
    likelihood = n * (np.log(theta / k) + k - 1)
    with np.errstate(over="ignore"):  # shares of nothing
        share = 1 / np.exp(likelihood - likelihood[:, None]).sum(axis=1)
    best = float(theta @ share)
    return float((n * np.log1p(-best * x).mean() + 10 * 0.5) / (n + 10))

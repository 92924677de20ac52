"""How many lines say the same: what a fit of functions leaves is smooth over lines where theory or calibration is at fault.

With residuals e_j of neighbouring lines correlated by rho_k at a distance of k lines, a sum over n lines varies as if there were
n / tau of them, tau = 1 + 2 sum_k rho_k, the sum up to the first k where rho is no more than noise (Sokal's window, at tau of its
own: k <= 5 tau).
"""

from collections.abc import Iterator

import numpy as np

from mouse_cli.diagnosis.noise import LOUD
from mouse_cli.diagnosis.search.fit import Fit

_WINDOW = 5.0
_SMOOTH = 0.25  # share of what is left beyond the noise stated that neighbouring lines may have in common
_FEW = 8  # lines of a function below which nothing is said


def correlated(one: Fit) -> float:
    """tau >= 1 of the fit `one` of FRFs, the mean over its functions, each weighed by its lines."""
    every = list(_sequences(one))
    count = sum(map(len, every))
    return sum(len(e) * _time(e) for e in every) / count if count else 1.0


def scatter(one: Fit) -> float:
    """Variance of what a fit of FRFs leaves over what the deck states, where that is scatter from line to line; else 1.

    What physics leaves is alike at neighbouring lines, and scatter is not: of what is too much no more than _SMOOTH may be.
    """
    found, every = one.misfit / max(one.dof, 1), list(_sequences(one))
    size = sum(float(np.vdot(e, e).real) for e in every)
    if not 1 < found <= LOUD or not size:
        return 1.0
    alike = sum(float(np.vdot(e[1:], e[:-1]).real) for e in every) / size
    return found if alike * found < _SMOOTH * (found - 1) else 1.0


def _sequences(one: Fit) -> Iterator[np.ndarray]:
    """Complex residuals of each function, line by line."""
    start = 0
    for block in one.model.base.data.blocks:
        q = int(block.has.sum())
        parts = one.point.residual[2 * start : 2 * (start + q)].reshape(2, q)
        whole = np.zeros(block.has.shape, complex)
        whole[block.has] = parts[0] + 1j * parts[1]
        for o, i in np.ndindex(block.has.shape[1:]):
            e = whole[block.has[:, o, i], o, i]
            if len(e) >= _FEW:
                yield e
        start += q


def _time(e: np.ndarray) -> float:
    """tau of one sequence of complex residuals."""
    n = len(e)
    spectrum = np.abs(np.fft.fft(e, 2 * n)) ** 2
    rho = np.fft.ifft(spectrum).real[:n] / max(spectrum.mean(), 1e-300)
    tau = 1 + 2 * np.cumsum(rho[1:])
    inside = np.flatnonzero(np.arange(1, n) >= _WINDOW * tau)
    return float(max(1.0, tau[inside[0]] if len(inside) else tau[-1]))

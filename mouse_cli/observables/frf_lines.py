"""Which lines of a measurement are fitted: half of them evenly over its band, half where its resonances are.

The second half lie at equal shares of the area beneath the mean magnitude of mobility, each function scaled by its own area.
Mobility peaks at every resonance as 1/(2 zeta omega m) over a width of 2 zeta omega, so that each gets about as many lines,
however narrow; what a line tells of frequencies and damping is most there.
"""

import numpy as np

from mouse_cli.model.frf_test import KINDS, FrfTest


def chosen(test: FrfTest, have: np.ndarray, most: int) -> np.ndarray:
    """Indices, ascending, of at most `most` lines at which anything of `have` (f, o, i) stands; all where these are no more."""
    lines = np.flatnonzero(have.any(axis=(1, 2)))
    if len(lines) <= most:
        return lines
    size = np.where(have, np.abs(np.where(have, test.H, 0.0)), 0.0)[lines]
    mobility = size * (test.omega[lines] ** (1.0 - KINDS[test.kind]))[:, None, None]
    area = mobility.sum(axis=0)
    peaks = np.divide(mobility, area, out=np.zeros_like(mobility), where=area > 0).sum(axis=(1, 2))
    density = 0.5 / len(lines) + 0.5 * peaks / peaks.sum()
    return lines[_spread(density, most)]


def _spread(density: np.ndarray, most: int) -> np.ndarray:
    """`most` different places, spaced in proportion to 1 / density; none is more than one."""
    density = density * most / density.sum()
    while True:  # a line counts once, however dense: what is cut off goes to the others
        full = density >= 1.0
        rest = most - full.sum()
        scaled = np.where(full, 1.0, density * rest / max(density[~full].sum(), 1e-300))
        if np.allclose(scaled, density):
            break
        density = scaled
    edges = np.floor(np.cumsum(density) + 0.5 - 1e-9)
    return np.flatnonzero(np.diff(np.concatenate([[0.0], edges])) > 0)

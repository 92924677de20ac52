"""A measurement as it would be with much more damping: where a search for parameters begins.

H is analytic for Re s > 0, so that its values on a line sigma + i omega follow from those on the axis (Poisson's integral):

    H(sigma + i omega) = 1/pi int sigma / ((omega - nu)^2 + sigma^2) H(i nu) d nu

They are the FRF of the records weighed by e^(-sigma t). With sigma = width omega every resonance is as broad as that of a damping
ratio larger by `width`, in the model, which is solved at the same s, and in the measurement: resonances that lie apart by much more
than their own width then overlap, and nothing need be known of which is which. No curve is fitted and no peak is picked.
Below zero H(-i nu) is the conjugate of H(i nu).
"""

import numpy as np

from mouse_cli.model.frf_test import FrfTest
from mouse_cli.observables.frf import FrfObservable, accuracy, usable

LINES = 80  # at which it is compared
SEEN = 0.8  # share of the kernel that the measured band must hold
SD = 0.1  # accuracy given to logarithms of what was smoothed
GAP = 4.0  # times the distance to its other neighbour, beyond which a line says nothing of what lies between


def smoothed(test: FrfTest, width: float) -> FrfObservable:
    """`test` at s = (i + width) omega as ln|H| and phase, at LINES lines or fewer, evenly by logarithm of frequency."""
    have = usable(test, accuracy(test)[0], "complex")
    known = np.flatnonzero(have.any(axis=(1, 2)))
    omega = test.omega
    wanted = np.geomspace(omega[known[0]], omega[known[-1]], LINES)
    lines = np.unique(np.abs(omega[:, None] - wanted).argmin(axis=0))
    H, share = _on_line(test, have, lines, width * omega[lines])
    kept = np.isfinite(H) & (share > SEEN)
    return FrfObservable(test, "log-phase", lines, np.where(kept, H, np.nan), SD * np.abs(H), kept, width)


def _on_line(test: FrfTest, have: np.ndarray, lines: np.ndarray, sigma: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Poisson's integral (l, o, i) over what was measured, scaled to the share (l, o, i) of its kernel that lies there."""
    omega, weight = test.omega, _widths(test.omega) / np.pi
    at, sigma = omega[lines, None], sigma[:, None]
    above, below = (sigma / ((at - sign * omega) ** 2 + sigma**2) * weight for sign in (1, -1))
    H = np.where(have, test.H, 0.0)
    share = np.tensordot(above + below, have.astype(float), axes=1)
    total = np.tensordot(above, H, axes=1) + np.tensordot(below, H.conj(), axes=1)
    return np.divide(total, share, out=np.full(share.shape, np.nan, complex), where=share > 0), share


def _widths(omega: np.ndarray) -> np.ndarray:
    """What of the axis (f,) each line stands for: half-way to its neighbours, but not across gaps, where nothing was measured."""
    apart = np.diff(omega)
    below, above = np.append(apart[:1], apart), np.append(apart, apart[-1:])
    return (np.minimum(below, GAP * above) + np.minimum(above, GAP * below)) / 2

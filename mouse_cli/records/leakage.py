"""What a window makes of H1 of random records: h(tau), the impulse response, becomes h(tau) r(tau), r the lag window.

Blocks w(t) x(t), w(t) y(t) of a force that is white around a resonance have the mean product Syx / Sxx = F{h(tau) r(tau)} with
r(tau) = sum w(t) w(t - tau) / sum w(t)^2 (J. S. Bendat, A. G. Piersol, Random Data, 4th ed. 2010, section 9.1 on bias by
resolution). Of a force that acts in the first part of a block alone, both sums are over t - tau within that part; the response to
a blow at the beginning is cut off after the block. A mode decays faster by it: its resonance is too broad and too low.
"""

import numpy as np

from mouse_cli.model.block_window import BlockWindow
from mouse_cli.records.blocks import window as shape
from mouse_cli.records.modal_model import Lines, ModalModel

_SAMPLES = 2048  # of a lag window: the lines of a block are fewer, or act in fewer lags


def lag_window(w: np.ndarray, burst: float = 1.0) -> np.ndarray:
    """r (b,) of a window w (b,): at lags of 0, 1, ... samples, 1 at first; burst: share of the block in which the force acts."""
    n = 2 * len(w)
    force = np.where(np.arange(len(w)) < max(1, round(burst * len(w))), w, 0.0)
    if not force.any():
        force = np.eye(1, len(w))[0]
    found = np.fft.irfft(np.fft.rfft(w, n) * np.fft.rfft(force, n).conj(), n)[: len(w)]
    return found / found[0]


def lags(window: BlockWindow) -> np.ndarray:
    """r at lags of 0, T / b, ..., b of them."""
    return lag_window(shape(window.name, _SAMPLES, 1.0), window.burst)


def leakage(lines: Lines, model: ModalModel, r: np.ndarray, seconds: float | None = None) -> np.ndarray:
    """H with the lag window r (b,) less H without (f, o, i), at lines of blocks of b samples, s = 2 pi i n / T.

    s^k / (s - lambda) is lambda^k / (s - lambda) and powers of s, which act at no lag and do not change. seconds: T; None: by the
    spacing of the lines. The real part of s, of an exponential window, is in the exponents.
    """
    b, spacing = len(r), 2 * np.pi / seconds if seconds else float(np.median(np.diff(lines.s.imag)))
    T, n = 2 * np.pi / spacing, np.rint(lines.s.imag / spacing).astype(int)
    out, added = np.zeros(lines.H.shape, complex), lines.s[0].real
    for poles, shapes, vectors in (
        (model.poles, model.shapes, model.participation),
        (model.poles.conj(), model.shapes.conj(), model.participation.conj()),
    ):
        decays = np.exp((poles[:, None] - added) * np.arange(b) * T / b)
        within = np.fft.fft((r - 1) * decays, axis=1)[:, n % b] * T / b
        z = (poles[:, None] - lines.s) * T / b
        beyond = np.exp(b * z) / (1 - np.exp(z)) * T / b  # lags of a block and more, which no block holds
        out += np.einsum("rf,or,ir->foi", (within - beyond) * poles[:, None] ** lines.kind, shapes, vectors)
    return out

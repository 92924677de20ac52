"""What a window makes of functions of random records: h(tau), the impulse response, becomes h(tau) r(tau), r the lag window.

Blocks w(t) x(t), w(t) y(t) of a force that is white around a resonance have the mean product Syx / Sxx = F{h(tau) r(tau)} with
r(tau) = sum w(t) w(t - tau) / sum w(t)^2 (J. S. Bendat, A. G. Piersol, Random Data, 4th ed. 2010, section 9.1 on bias by
resolution). A mode decays faster by it: its resonance is too broad and too low. Of a modal model that is known in closed form.
"""

import numpy as np

from mouse_cli.records.modal_model import Lines, ModalModel


def lag_window(w: np.ndarray) -> np.ndarray:
    """r (b,) of a window w (b,): at lags of 0, 1, ... samples, 1 at first."""
    spectrum = np.fft.rfft(w, 2 * len(w))
    return np.fft.irfft(np.abs(spectrum) ** 2)[: len(w)] / (w @ w)


def leakage(lines: Lines, model: ModalModel, r: np.ndarray) -> np.ndarray:
    """H with the lag window r (b,) less H without (f, o, i), at lines of blocks of b samples, s = 2 pi i n / T.

    s^k / (s - lambda) is lambda^k / (s - lambda) and powers of s, which act at no lag and do not change.
    """
    b, spacing = len(r), float(np.median(np.diff(lines.s.imag)))
    T, n = 2 * np.pi / spacing, np.rint(lines.s.imag / spacing).astype(int)
    out = np.zeros(lines.H.shape, complex)
    for poles, shapes, vectors in (
        (model.poles, model.shapes, model.participation),
        (model.poles.conj(), model.shapes.conj(), model.participation.conj()),
    ):
        within = np.fft.fft((r - 1) * np.exp(poles[:, None] * np.arange(b) * T / b), axis=1)[:, n % b] * T / b
        z = (poles[:, None] - lines.s) * T / b
        beyond = np.exp(b * z) / (1 - np.exp(z)) * T / b  # lags of a block and more, which no block holds
        out += np.einsum("rf,or,ir->foi", (within - beyond) * poles[:, None] ** lines.kind, shapes, vectors)
    return out

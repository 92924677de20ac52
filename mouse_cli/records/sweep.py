"""Records of one frequency that passes through the band, as of a machine that runs down: where it begins and ends."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mouse_cli._errors import WARNING, Diagnostic

_BESIDE = 2  # lines that a Hann window gives a frequency to either side
_TONAL = 0.9  # share of the power of a frame in one frequency
_VISITED = 0.5  # of the lines in between
_CONTINUOUS = 0.9  # of the steps from frame to frame
_FEWEST = 8  # lines through which it passes
_MEDIAN = 5  # frames
_REACH = 3  # lines about a beginning


@dataclass(frozen=True)
class Sweep:
    """A frequency that passes from one end to the other, Hz, and those (e,) at which it begins or ends while it is loud.

    resolution_hz: how near to a beginning the structure vibrates as if it had a resonance there.
    """

    from_hz: float
    to_hz: float
    abrupt_hz: tuple[float, ...]
    resolution_hz: float

    def begins_at(self, hz: float) -> bool:
        """Whether the sweep begins or ends near a frequency."""
        return any(abs(hz - edge) < self.resolution_hz for edge in self.abrupt_hz)


def sweep(samples: np.ndarray, rate_hz: float) -> Sweep | None:
    """The sweep that samples (t, o) of outputs are; None: they are none.

    A spectrogram with as many frames as lines. One frequency holds nearly all power of some frames, moves by little from one to
    the next, and visits the lines in between; broadband forces leave power at all resonances, and a steady tone does not move.
    """
    from scipy.signal import medfilt, stft

    size = samples.std(axis=0)
    frame = 2 ** int(np.ceil(np.log2(np.sqrt(max(len(samples), 16)))))
    hz, _, parts = stft(samples / np.where(size > 0, size, 1), rate_hz, nperseg=frame, axis=0, boundary=None, padded=False)
    power = (np.abs(parts[1:]) ** 2).sum(axis=1)  # (f, t), without the mean
    line = power.argmax(axis=0)
    near = np.abs(np.arange(len(power))[:, None] - line) <= _BESIDE
    tonal = (power * near).sum(axis=0) > _TONAL * power.sum(axis=0)
    if tonal.sum() < _FEWEST:
        return None
    path = medfilt(line[tonal].astype(float), _MEDIAN)[_MEDIAN // 2 : -(_MEDIAN // 2)].astype(int)
    low, high = path.min(), path.max()
    small = np.abs(np.diff(path)) <= max(_BESIDE, (high - low) / _FEWEST)
    visited = len(np.unique(path)) / (high - low + 1)
    if high - low < _FEWEST or small.mean() < _CONTINUOUS or visited < _VISITED:
        return None
    abrupt = [float(hz[1 + line[at]]) for at in (0, -1) if tonal[at]]
    return Sweep(float(hz[1 + path[0]]), float(hz[1 + path[-1]]), tuple(abrupt), _REACH * float(hz[1]))


def swept(found: Sequence[Sweep | None], left_out: Sequence[float]) -> tuple[Diagnostic, ...]:
    """What to say of records that are sweeps; left_out: frequencies, Hz, that are no modes for it."""
    sweeps = [one for one in found if one is not None]
    if not sweeps:
        return ()
    ranges = ", ".join(f"{one.from_hz:.4g} to {one.to_hz:.4g} Hz" for one in sweeps)
    message = f"{len(sweeps)} of {len(found)} records are one frequency that passes through the band ({ranges})"
    if left_out:
        message += f"; where it begins or ends, at {', '.join(f'{hz:.4g}' for hz in left_out)} Hz, no mode can be told"
    help = "begin and end the sweep away from resonances, and name what drives it as a force where it was measured"
    return (Diagnostic("MD684", WARNING, message, help=help),)

"""A channel that does not read in proportion: a sensor, amplifier or converter that saturates, or whose range ends softly.

What it should have read is a curve of what it reads, x = y + a y^2 + b y^3 + ...; no law of a structure acts on one channel alone.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.updating.recordings.calibration import as_read, only
from mouse_cli.updating.recordings.regression import Regression
from mouse_cli.updating.recordings.study import Study

_POWERS = 2, 3, 5, 7  # of the reading, in its curve
_NEAR = 0.8  # of its largest reading, where the curve is stated: at the top it may have no end
_LEAST, _GAIN = 0.9, 0.5  # share of what is left that a curve takes; what it leaves, by what a gain alone leaves, at most


@dataclass(frozen=True)
class Saturated:
    """channel: its name; times: what it should have read near the top of its readings, by that; share of what is left."""

    channel: str
    times: float
    share: float

    def said(self) -> str:
        """What to do, in a sentence."""
        return (
            f"Channel {self.channel} does not read in proportion: at {100 * _NEAR:.2g} % of its largest reading {self.times:.3g} "
            f"times as much would fit, and a curve of its readings takes {100 * self.share:.3g} % of what the model leaves. A "
            "sensor, an amplifier or a converter that saturates does so, and no law of the structure does in one channel alone. "
            "Lower its gain and record again, or leave it out of the outputs."
        )


def saturated(own: Study) -> Saturated | None:
    """The output whose curve takes most of what is left of the loudest record; None: none takes enough, or a gain does as well.

    On a table outputs have its motion taken off, and are no curve of what was read.
    """
    if own.base.ground or own.look.slow:
        return None
    at = own.at(own.places[0])
    y = as_read(at.spectrum)
    found = [_curve(at, only(y, c)) for c in range(y.shape[1])]
    c = max(range(len(found)), key=lambda c: found[c][0])
    share, gain, times = found[c]
    return Saturated(own.records.outputs[c].name, times, share) if share > _LEAST and 1 - share < _GAIN * (1 - gain) else None


def _curve(at: Regression, y: np.ndarray) -> tuple[float, float, float]:
    """Shares of what is left that a curve of readings y (t, s) of one channel takes, and a gain; what it says near their top."""
    z = y / max(float(np.abs(y).max()), 1e-300)
    (gain, _), (share, sizes) = (at.taken([at.stacked(z**power) for power in powers]) for powers in ((1,), _POWERS))
    return share, gain, 1 - float(sizes @ _NEAR ** (np.array(_POWERS) - 1.0)) / float(np.abs(y).max() or 1.0)

"""A recording that is at odds with the others: a channel that was exchanged, stood still or came loose in one run alone.

Every fit is of all recordings together, and looks at one of them for laws and noise. What one recording alone leaves is neither a
law, which acts in all, nor noise, which is about as large in all.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.model.recording import Channel
from mouse_cli.updating.recordings.fit import Fit
from mouse_cli.updating.recordings.noise import LOUD
from mouse_cli.updating.recordings.segments import Segments

_TIMES = 25.0  # the variance of what is left of a channel in the other recordings


@dataclass(frozen=True)
class Odd:
    """recording: title; channel: number of the output; sample: first of the first stretch that is so; share: rms of what is left
    by that of the channel.
    """

    recording: str
    channel: int
    sample: int
    share: float

    def said(self, outputs: tuple[Channel, ...]) -> str:
        """What to look at, in a sentence."""
        return (
            f"Recording '{self.recording}' alone is at odds with the model: {100 * min(self.share, 1.0):.3g} % of channel "
            f"{outputs[self.channel].name} remains, from sample {self.sample} on. Look at that channel there, or leave the "
            "recording out."
        )


def odd(fit: Fit, data: list[Segments]) -> Odd | None:
    """The recording, and its channel, that `fit` leaves far more of than of any other recording; None where all are alike."""
    if len(data) < 2:
        return None
    ends = np.cumsum([len(part.starts) for part in data])[:-1]
    parts = np.split(fit.residual**2, ends, axis=2)
    left = np.array([part.mean(axis=(1, 2)) for part in parts])
    size = np.array([(part.measured**2).mean(axis=(1, 2)) for part in data])
    share = np.sqrt(left / np.maximum(size, 1e-300))
    worst, channel = np.unravel_index(np.argmax(np.where(share > LOUD, left, 0.0)), left.shape)
    usual = _TIMES * max(1.0, float(np.delete(left[:, channel], worst).max()))
    if share[worst, channel] <= LOUD or left[worst, channel] <= usual:
        return None
    series, first = data[worst].series, int(np.argmax(parts[worst][channel].mean(axis=0) > usual))
    sample = series.first + int(data[worst].starts[first])
    return Odd(series.title, int(channel), sample, float(share[worst, channel]))

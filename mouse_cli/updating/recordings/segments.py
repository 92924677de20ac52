"""Stretches of a record that are simulated side by side."""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.updating.recordings.channels import earlier
from mouse_cli.updating.recordings.series import REACH, Series

_LEAST = 64  # samples of a horizon


@dataclass(frozen=True)
class Segments:
    """G stretches of a record, `length` samples each, from samples `starts` (G,)."""

    series: Series
    starts: np.ndarray
    length: int

    def begun(self) -> "Segments":
        """Their first quarters."""
        return replace(self, length=max(self.length // 4, min(self.length, _LEAST)))

    @property
    def coarser(self) -> "Segments":
        """The same in the steps that slopes take."""
        return replace(self, series=self.series.coarser)

    @property
    def halved(self) -> "Segments":
        """The same in steps of half the length."""
        return replace(self, series=replace(self.series, factor=2 * self.series.factor))

    def earlier(self, seconds: np.ndarray) -> "Segments":
        """The same of channels so many seconds (s,) earlier."""
        measured = earlier(self.series.measured, self.series.dt, seconds)
        return replace(self, series=replace(self.series, measured=measured))

    @property
    def force(self) -> np.ndarray:
        """At every step, with REACH samples on either side of what is compared; the last input is 1 at all times."""
        factor = self.series.factor
        steps = (self.length + 2 * REACH - 1) * factor + 1
        own = np.stack([self.series.fine[(s - REACH) * factor :][:steps] for s in self.starts], axis=2)
        return np.concatenate([own, np.ones((len(own), 1, own.shape[2]))], axis=1)

    @property
    def acts(self) -> np.ndarray | None:
        """By how much the noise of each excitation acts (t, i, G), that before what is compared at its first sample; None: all the
        time.
        """
        own = self.series.acts
        if own is None:
            return None
        found = np.stack([own[s : s + self.length].astype(float) for s in self.starts], axis=2)
        found[0] = np.sqrt(np.stack([own[s - REACH : s + 1].sum(axis=0) for s in self.starts], axis=1))
        return found

    @property
    def measured(self) -> np.ndarray:
        """Filtered channels over their sd."""
        whole = self.series.filtered / self.series.sd
        return np.stack([whole[s : s + self.length].T for s in self.starts], axis=2)


def segments(series: Series, length: int, most: int) -> Segments:
    """Up to `most` stretches of `length` samples that follow one another, over the whole of the record."""
    first, last = REACH, len(series) - REACH
    starts = np.arange(first, last - length + 1, length)
    if len(starts) > most:
        starts = starts[np.unique(np.linspace(0, len(starts) - 1, most).round().astype(int))]
    return Segments(series, starts, length)

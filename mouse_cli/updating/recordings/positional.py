"""A force that repeats with the position of what travels: cogging of a motor, teeth that mesh, an eccentric gear, weight off axis.

No law of the library acts so: within a stretch the position of what nothing holds is free. Over a record it is the integral of the
measured speed, and F = a sin(k x + b) shows at the wave number k of the position.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mouse_cli.updating.recordings.acting import Place
from mouse_cli.updating.recordings.free_force import Spectrum
from mouse_cli.updating.recordings.hypothesis import Hypothesis
from mouse_cli.updating.recordings.regression import Regression

_LEAST = 0.5  # share of what is left that it takes
_PERIODS, _SAMPLES = 3.0, 4.0  # that the record has, at least: of what repeats; in one of them at the highest speed
_STEPS, _MOST = 8.0, 4000  # wave numbers in one that the travel resolves; of them
_PEAKS = 3  # that are looked at


@dataclass(frozen=True)
class Positional:
    """place; period of the position, in m or rad; amplitude, N or N m; share of what the model leaves."""

    place: Place
    period: float
    amplitude: float
    share: float

    def said(self) -> str:
        """What it is, in a sentence."""
        turn = 2 * np.pi / self.period
        return (
            f"A force {self.place.site.text} that repeats with the position, every {self.period:.4g} of it ({turn:.4g} to a "
            f"turn of an angle in rad), takes {100 * self.share:.2g} % of what the model leaves: amplitude about "
            f"{self.amplitude:.2g}. No law of the library acts so: cogging of a motor, teeth that mesh, an eccentric gear, a "
            "weight off its axis. Its amplitude and period are of a first look, without a standard deviation."
        )


def positional(spectrum: Spectrum, base: Hypothesis, places: Sequence[Place]) -> Positional | None:
    """The force on one body that takes most of what is left, where nothing holds the structure; None: none takes enough."""
    if not spectrum.series.slow:
        return None
    found = [_at(Regression(spectrum, base.placed(place))) for place in places if place.ground and place.across is None]
    best = max((one for one in found if one is not None), key=lambda one: one.share, default=None)
    return best if best is not None and best.share > _LEAST else None


def _at(at: Regression) -> Positional | None:
    """The best wave number at one place."""
    x, series = at.local.x, at.spectrum.series
    travel, fastest = float(np.ptp(x)), float(np.abs(at.local.v).max() * series.dt)
    if not travel > 0 or not fastest > 0:
        return None
    low, high = 2 * np.pi * _PERIODS / travel, 2 * np.pi / (_SAMPLES * fastest)
    count = int((high - low) * travel * _STEPS / (2 * np.pi))
    if count < 1:
        return None
    k = np.linspace(low, high, min(count, _MOST))
    force = at.free(at.begin(np.zeros_like(at.y), np.zeros(0))[0])
    seen = np.abs(np.array([np.exp(-1j * each * x[at.kept]) @ force[at.kept] for each in k]))
    share, best = max((at.share([np.sin(k[i] * x), np.cos(k[i] * x)]), float(k[i])) for i in np.argsort(-seen)[:_PEAKS])
    A = np.column_stack([np.sin(best * x), np.cos(best * x)])[at.kept]
    a, b = np.linalg.lstsq(A, force[at.kept], rcond=None)[0]
    return Positional(at.local.place, 2 * np.pi / best, float(np.hypot(a, b)), share)

"""Errors of the channels of a record, as rivals of physics: a wrong gain, a channel turned round, a delay.

A channel that reads g times what it measures, tau s late, is y(t) = g x(t - tau). Records know such an error from physics, because
no force that acts on a structure makes one channel alone late, or wrong at all frequencies alike.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.model.diagnosis import Site
from mouse_cli.model.recording import Channel
from mouse_cli.terms.laws import SIGNS, Law, Scale, Unknown
from mouse_cli.updating.recordings.series import Series

GAINS = 1e-4, 1e4  # the least and the most that a channel may read of what it measures: g for m/s2, mm for m are within
DELAYS = 1e-3, 64.0  # samples that a channel may be late, or early


@dataclass(frozen=True)
class Misreading(Law):
    """What a channel reads of what it should. reads(p, **variant): factor and delay in s."""

    reads: Callable[..., tuple[np.ndarray, np.ndarray]] = lambda p: (np.ones_like(p[0]), np.zeros_like(p[0]))


def misreadings(dt: float = 1.0) -> dict[str, Misreading]:
    """Errors of a channel whose samples are dt s apart, by key."""
    nothing = lambda p, **variant: (np.zeros((1, 1)),) * 3
    gain = Misreading(
        "sensor-gain", "sensor", "a wrong gain of a sensor",
        "one channel reads the same multiple at all times: calibration, unit, amplifier; or is turned round",
        lambda scale: (Unknown("gain", "1", *GAINS),), matrices=nothing, variants=SIGNS, words=("", "turned round"),
        homogeneous=(), reads=lambda p, sign: (sign * p[0], np.zeros_like(p[0])),
    )  # fmt: skip
    delay = Misreading(
        "sensor-delay", "sensor", "a delay of a channel",
        "one channel is late, or early, by the same time at all frequencies: a filter, a multiplexer, another clock",
        lambda scale: (Unknown("delay", "s", *(dt * end for end in DELAYS)),), matrices=nothing, variants=SIGNS,
        words=("late", "early"), homogeneous=(), reads=lambda p, sign: (np.ones_like(p[0]), sign * p[0]),
    )  # fmt: skip
    return {one.key: one for one in (delay, gain)}


@dataclass(frozen=True)
class Read:
    """What channels read at P sets of parameters. gain (P, s), delay (P, s): of outputs; force (P, i): gain of forces.

    A force that is late is the same as outputs that are early.
    """

    gain: np.ndarray
    delay: np.ndarray
    force: np.ndarray

    @property
    def plain(self) -> bool:
        """Whether all read what they measure."""
        return bool((self.gain == 1).all() and (self.delay == 0).all() and (self.force == 1).all())


def read(sizes: list, outputs: int, forces: int, count: int) -> Read:
    """What laws with their parameters (q, P) make of channels; `sizes` as of a hypothesis."""
    found = Read(np.ones((count, outputs)), np.zeros((count, outputs)), np.ones((count, forces)))
    for part, p in sizes:
        if not isinstance(part.law, Misreading):
            continue
        gain, delay = part.law.reads(p, **part.words)
        if part.place.channel < outputs:
            found.gain[:, part.place.channel] *= gain
            found.delay[:, part.place.channel] += delay
        else:
            found.force[:, part.place.channel - outputs] *= gain
            found.delay[:] -= delay[:, None]
    return found


def corrected(series: Series, at: Read) -> Series:
    """The series as its channels should have read, errors `at` one set of parameters."""
    if at.plain:
        return series
    return replace(
        series, force=series.force / at.force[0], measured=earlier(series.measured, series.dt, at.delay[0]) / at.gain[0]
    )


def earlier(x: np.ndarray, dt: float, seconds: np.ndarray) -> np.ndarray:
    """Channels x (t, s) so many seconds (s,) earlier, x(t + seconds), by their spectra; mirrored at the ends of the record."""
    found = x.copy()
    for j in np.flatnonzero(seconds):
        whole = np.concatenate([x[:, j], x[::-1, j]])
        w = 2 * np.pi * np.fft.rfftfreq(len(whole), dt)
        found[:, j] = np.fft.irfft(np.fft.rfft(whole) * np.exp(1j * w * seconds[j]), len(whole))[: len(x)]
    return found


def channel_sites(outputs: tuple[Channel, ...], inputs: tuple[Channel, ...]) -> Iterator[tuple[int, Site]]:
    """Channels that may be wrong, by number, outputs first, then forces; none of a structure that the ground carries along,
    whose channels have its motion taken off.
    """
    if any(one.ground for one in inputs):
        return
    for i, one in enumerate((*outputs, *inputs)):
        yield (
            i,
            Site(
                "sensor",
                (one.name,),
                text=f"channel {one.name} ({one.quantity}{f' at {one.sensor}' if one.sensor else ''})",
            ),
        )


SCALE = Scale(1.0, 1.0, 1.0, 1.0, (1.0, 1.0))  # of no motion

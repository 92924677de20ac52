"""Gains and delays of channels that a deck leaves uncertain: nuisances with a normal prior, estimated beside all others.

A channel reads y(t) = exp(g) x(t - tau), g of sd `gain_sd` and tau of sd `delay_sd`; a force likewise, without a delay.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.model.recording import Channel
from mouse_cli.updating.recordings.channels import Read, earlier
from mouse_cli.updating.recordings.free_force import Spectrum


@dataclass(frozen=True)
class Calibration:
    """Number of a channel, outputs before forces, and sd: of ln gain, and of the delay in s. names of both, in this order."""

    gain: tuple[tuple[int, float], ...] = ()
    delay: tuple[tuple[int, float], ...] = ()
    names: tuple[str, ...] = ()

    @property
    def sd(self) -> np.ndarray:
        """Of each nuisance (q,)."""
        return np.array([sd for _, sd in (*self.gain, *self.delay)])

    def read(self, z: np.ndarray, found: Read) -> Read:
        """`found` with its gains and delays at nuisances z (P, q), in sd."""
        outputs, sizes = found.gain.shape[1], (z * self.sd).T
        for (channel, _), size in zip(self.gain, sizes, strict=False):
            into, j = (found.gain, channel) if channel < outputs else (found.force, channel - outputs)
            into[:, j] *= np.exp(size)
        for (channel, _), size in zip(self.delay, sizes[len(self.gain) :], strict=True):
            found.delay[:, channel] += size
        return found

    def columns(self, s: Spectrum) -> Iterator[np.ndarray]:
        """What an sd of each adds to the outputs (t, s), to first order."""
        y, outputs, step = as_read(s), s.series.measured.shape[1], 0.5 * s.series.dt
        for channel, sd in self.gain:
            yield sd * (only(y, channel) if channel < outputs else -answer(s, channel - outputs))
        for channel, sd in self.delay:
            shift = np.full(outputs, step)
            slope = (earlier(y, s.series.dt, shift) - earlier(y, s.series.dt, -shift)) / (2 * step)
            yield -sd * only(slope, channel)

    def said(self, z: np.ndarray, sd: np.ndarray) -> tuple[str, ...]:
        """What was found of it: z (q,) and their sd, in prior sd."""
        found = []
        for i, (name, own) in enumerate(zip(self.names, self.sd, strict=True)):
            if i < len(self.gain):
                found.append(f"{name}: {100 * np.expm1(own * z[i]):+.2g} % (sd {100 * own * sd[i]:.2g} %)")
            else:
                found.append(f"{name}: {1e3 * own * z[i]:+.2g} ms (sd {1e3 * own * sd[i]:.2g} ms)")
        return tuple(found)


KNOWN = Calibration()


def calibration(outputs: tuple[Channel, ...], inputs: tuple[Channel, ...]) -> Calibration:
    """That of the channels of a record."""
    every = list(enumerate((*outputs, *inputs)))
    gain = [(i, one) for i, one in every if one.gain_sd]
    delay = [(i, one) for i, one in every[: len(outputs)] if one.delay_sd]
    names = [f"gain of channel {one.name}" for _, one in gain] + [f"delay of channel {one.name}" for _, one in delay]
    return Calibration(
        tuple((i, one.gain_sd) for i, one in gain), tuple((i, one.delay_sd) for i, one in delay), tuple(names)
    )


def as_read(s: Spectrum) -> np.ndarray:
    """Outputs (t, s) as they were read."""
    return s.read * s.window[:, None]


def only(x: np.ndarray, channel: int) -> np.ndarray:
    """x (t, s) of one channel, 0 of the others."""
    return np.where(np.arange(x.shape[1]) == channel, x, 0.0)


def answer(s: Spectrum, force: int) -> np.ndarray:
    """Answer (t, s) of the model to one of the measured forces."""
    alone = np.where(np.arange(s.series.force.shape[1]) == force, s.series.force, 0.0)
    lines = replace(s, series=replace(s.series, force=alone)).motion
    return s.history(np.einsum("lsn,ln->ls", s.S, lines)) * s.window[:, None]

"""Measured excitations and their noise: as they most probably were."""

from dataclasses import replace

import numpy as np

from mouse_cli.model.recording import Recording
from mouse_cli.records.strokes import loud, struck
from mouse_cli.updating.recordings.floors import LINES, levels, lowest

_SEEN = 0.05  # floor of the spectrum of an excitation, by its rms, up to which it is noise and no excitation
_FLAT = 1.2  # level by the floor, that three tenths of its spectrum stay below where the floor is white noise
_ENDS, _QUIET = 4, 0.02  # samples at an end of an excitation, and share of its peak up to which it does not act there


def excitation_noise(force: np.ndarray, stated: np.ndarray) -> np.ndarray:
    """sd (i,) of the noise of excitations (t, i): a stated share of their rms, or the floor of their spectra where that is flat,
    and low beside them. Excitations as wide as the samples allow, or that fall off slowly, show no noise: the floor is their own.
    That of strokes is what is read between them: simulations have them without it, but for as long as they act.
    """
    if not force.shape[1]:
        return np.zeros(0)
    groups = levels(force, _whole(force))
    floor, more = lowest(groups), np.sqrt(np.quantile(groups, 0.3, axis=0))
    seen = (floor < _SEEN * np.array([loud(x) for x in force.T])) & (more < _FLAT * floor)
    between = np.array([0.0 if (acts := struck(x)) is None else x[~acts].std() for x in force.T])
    found = np.where(between > 0, between, np.where(seen, floor, 0.0))
    return np.where(stated > 0, stated * force.std(axis=0), found)


def acting(force: np.ndarray) -> np.ndarray | None:
    """When the noise of excitations (t, i) acts in simulations: of strokes as long as they do; None: there are none."""
    each = [struck(x) if x.any() else np.zeros(len(x), dtype=bool) for x in force.T]
    if all(own is None for own in each):
        return None
    return np.column_stack([np.ones(len(force), dtype=bool) if own is None else own for own in each])


def quietened(record: Recording, inputs: list[int], sd: np.ndarray) -> Recording:
    """The record with its excitations as they most probably were, beside noise of so much sd (i,): strokes alone, their lines times
    the share of their power that is not noise (N. Wiener 1949) otherwise.

    Where there is nothing but noise, a simulation would repeat it at the resonances there, and damping would be found too large.
    """
    samples = record.samples.copy()
    for j, noise in zip(inputs, sd, strict=True):
        channel, x = record.channels[j], samples[:, j] - samples[:, j].mean()
        if channel.ground and channel.quantity != "acceleration":
            continue
        if (acts := struck(x)) is not None:
            samples[~acts, j] = np.median(samples[~acts, j])
        elif noise and x.any():
            share = np.maximum(1 - noise**2 / levels(x[:, None], _whole(x[:, None]))[:, 0], 0.0)
            share = np.max(
                [share, np.append(share[1:], 0.0), np.append(0.0, share[:-1])], axis=0
            )  # edges of bands are whole
            lines = np.arange(len(x) // 2 + 1)
            share = share[np.clip((lines - 1) // LINES, 0, len(share) - 1)]
            samples[:, j] += np.fft.irfft(share * np.fft.rfft(x), len(x)) - x
    return replace(record, samples=samples)


def _whole(force: np.ndarray) -> np.ndarray:
    """A window (t, i) for excitations that falls to 0 only towards ends at which they still act: a stroke at the beginning of a
    record is all of it.
    """
    t = len(force)
    away = np.abs(force - np.median(force, axis=0))
    acts = [away[own].max(axis=0) > _QUIET * away.max(axis=0) for own in (slice(None, _ENDS), slice(-_ENDS, None))]
    rise = 0.5 - 0.5 * np.cos(np.pi * (np.arange(t) + 1) / (t + 1))
    one, both = np.ones(t), np.hanning(t + 2)[1:-1]
    shapes = {(False, False): one, (True, False): rise, (False, True): rise[::-1], (True, True): both}
    return np.column_stack([shapes[bool(first), bool(last)] for first, last in zip(*acts, strict=True)])

"""Modes from outputs alone: decimation to the band, SSI, tracks that persist, and the order at which each mode is best known."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from mouse_cli.model.recording import Recording
from mouse_cli.records.lscf import OrderPoles
from mouse_cli.records.mode_selection import ALIKE, HEAVIEST, Dropped
from mouse_cli.records.ssi import Subspace, UncertainMode, poles, subspace, uncertain
from mouse_cli.records.stabilisation import Track, persistent, tracks

BLOCKS = 40  # of the records, for their scatter
_TIMES = 4  # samples of a block over its lags
_FEWEST_LAGS, _FEWEST_BLOCKS = 8, 10  # ten blocks know a standard deviation to a quarter of it
_LAGS, _SIZE, _ORDERS, _STEP = 30, 400, 40, 2
_MARGIN = 2.56  # samples a second per Hz of the band
_UNKNOWN = 0.5  # sd of the decay rate over it
_BESIDE = 2.0  # half-power bandwidths within which one resonance may show twice
_TRIED = 4  # orders at which the covariance of a mode is computed
_OVERSHOT = 1.0  # sd of a frequency over the half of its half-power bandwidth: beyond, it is no resonance


@dataclass(frozen=True)
class FoundOutputs:
    """modes: with their scatter; tracks: of each mode; dropped: what was rejected; rate_hz: after decimation."""

    modes: list[UncertainMode]
    tracks: list[Track]
    passing: list[Track]
    dropped: list[Dropped]
    poles: list[OrderPoles]
    orders: range
    rate_hz: float
    lags: int
    samples: int


@dataclass(frozen=True)
class Division:
    """How correlations are taken of records: lags, block columns of the Hankel matrix; blocks of the whole; usual: of both."""

    lags: int
    blocks: int
    usual: tuple[int, int]

    @property
    def short(self) -> bool:
        """Whether the records allow less than usual."""
        return (self.lags, self.blocks) != self.usual


def division(lengths: Sequence[int], outputs: int) -> Division | None:
    """Lags and blocks for records of so many samples: both fewer where they are short; None where even the fewest do not fit.

    A block has four times as many samples as there are lags, and each record holds one at least.
    """
    lags = lags_of(outputs)
    share = min(np.sqrt(sum(lengths) / (_TIMES * lags * BLOCKS)), min(lengths) / (_TIMES * lags), 1.0)
    fewer = max(int(share * lags), _FEWEST_LAGS)
    blocks = min(BLOCKS, sum(length // (_TIMES * fewer) for length in lengths))
    if min(lengths) < _TIMES * fewer or blocks < _FEWEST_BLOCKS:
        return None
    return Division(min(fewer, lags), blocks, (lags, BLOCKS))


def least_samples() -> int:
    """Samples, after decimation, that the fewest blocks and their lags take."""
    return _FEWEST_BLOCKS * _TIMES * _FEWEST_LAGS


def lags_of(outputs: int) -> int:
    """Block columns of the Hankel matrix."""
    return int(np.clip(_SIZE // max(outputs, 1), 8, _LAGS if outputs > 2 else 2 * _LAGS))


def decimated(recording: Recording, top_hz: float) -> tuple[np.ndarray, float]:
    """Outputs (t, o) without their means, each over its sd, at a sample rate that `top_hz` needs, and that rate."""
    from scipy.signal import decimate

    samples = recording.samples[:, recording.outputs]
    factor = max(1, int(recording.sample_rate_hz / (_MARGIN * top_hz)))
    samples = samples - samples.mean(axis=0)
    for part in _factors(factor):
        samples = decimate(samples, part, ftype="fir", axis=0, zero_phase=True)
    return samples, recording.sample_rate_hz / factor


def _factors(number: int) -> list[int]:
    """Prime factors; a prime above 13 is left as it is."""
    found = []
    for prime in (2, 3, 5, 7, 11, 13):
        while number % prime == 0:
            found.append(prime)
            number //= prime
    return [*found, number] if number > 1 else found


def identify_outputs(
    records: Sequence[np.ndarray], rate_hz: float, band_hz: tuple[float, float], division: Division, most: int | None,
    say: Callable[[str], None],
) -> FoundOutputs:  # fmt: skip
    """Modes within `band_hz` of records (t, o) of the same outputs; one of a higher level counts no more than another."""
    scaled, size = _levelled(records)
    say("correlations")
    seen = subspace(scaled, division.lags, division.blocks)
    highest = min(most or _ORDERS, len(seen.singular) // 2)
    orders = range(2, highest + 1, _STEP)
    say("poles")
    found = poles(seen, orders, rate_hz, band_hz)
    every = tracks(found)
    kept, modes, dropped = [], [], []
    say("covariance")
    for track in every:
        if not persistent(track, orders):
            continue
        mode = _best(seen, track, rate_hz)
        reason = _fault(mode)
        if reason:
            dropped.append(Dropped(mode.pole, reason))
        else:
            kept.append(track)
            modes.append(UncertainMode(mode.pole, mode.shape * size, mode.scatter * np.r_[1, 1, np.repeat(size, 2)]))
    passing = [track for track in every if not persistent(track, orders)]
    modes, kept, twice = _once(modes, kept)
    dropped += twice
    return FoundOutputs(modes, kept, passing, dropped, found, orders, rate_hz, division.lags, sum(map(len, records)))


def _levelled(records: Sequence[np.ndarray]) -> tuple[list[np.ndarray], np.ndarray]:
    """Each record over its level and each output over its size (o,), whatever units and levels they were recorded in.

    The level of a record is the geometric mean of the sd of its outputs, the size of an output its root mean square sd over levels.
    """
    sd = np.array([each.std(axis=0) for each in records])
    alive = (sd > 0).all(axis=0)
    level = np.exp(np.log(sd[:, alive]).mean(axis=1, keepdims=True)) if alive.any() else np.ones((len(sd), 1))
    size = np.sqrt(((sd / level) ** 2).mean(axis=0))
    size = np.where(size > 0, size, 1.0)
    return [each / (one * size) for each, one in zip(records, level, strict=True)], size


def _once(modes: list[UncertainMode], kept: list[Track]) -> tuple[list[UncertainMode], list[Track], list[Dropped]]:
    """The modes without those that have the shape of one that was stable in more orders, within its bandwidth."""
    dropped, stay = [], []
    for k in sorted(range(len(modes)), key=lambda k: -kept[k].stable_orders):
        other = next((j for j in stay if _alike(modes[j], modes[k])), None)
        if other is None:
            stay.append(k)
        else:
            hz = abs(modes[other].pole) / 2 / np.pi
            reason = f"has the shape of the mode at {hz:.6g} Hz within its bandwidth: one resonance, found twice"
            dropped.append(Dropped(modes[k].pole, reason))
    return [modes[k] for k in stay], [kept[k] for k in stay], dropped


def _alike(one: UncertainMode, other: UncertainMode) -> bool:
    """Whether half-power bandwidths overlap and shapes are one; single sensors see one shape only."""
    if abs(one.pole.imag - other.pole.imag) > -_BESIDE * (one.pole.real + other.pole.real):
        return False
    product = abs(one.shape.conj() @ other.shape) ** 2
    return bool(product > ALIKE * (np.abs(one.shape) ** 2).sum() * (np.abs(other.shape) ** 2).sum())


def _best(seen: Subspace, track: Track, rate_hz: float) -> UncertainMode:
    """The mode at the order, of a few stable ones, where its pole is known best."""
    members = [(order, pole) for order, pole, rests in zip(track.order, track.pole, track.stable, strict=True) if rests]
    picked = np.unique(np.linspace(0, len(members) - 1, _TRIED).astype(int))
    tried = [uncertain(seen, members[k][0], [members[k][1]], rate_hz)[0] for k in picked]
    return min(tried, key=lambda mode: float((mode.scatter[:, :2] ** 2).sum()))


def _fault(mode: UncertainMode) -> str:
    """Why a persistent pole is no mode; empty where it may be one."""
    if mode.pole.real >= 0:
        return "has no positive damping"
    if -mode.pole.real > HEAVIEST * abs(mode.pole):
        return f"is damped by more than {100 * HEAVIEST:.0f} %: a slope of the spectra, no resonance"
    decay_sd, sd = np.sqrt((mode.scatter[:, :2] ** 2).sum(axis=0))
    if sd > _OVERSHOT * -mode.pole.real:
        return "has a frequency that the record leaves more uncertain than half its half-power bandwidth"
    if decay_sd > _UNKNOWN * -mode.pole.real:
        return "has a damping that is not known to half of it"
    return ""

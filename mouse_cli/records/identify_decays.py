"""Modes from free decays: poles of Hankel matrices of the records, a fit by maximum likelihood, and the poles that it needs.

A free decay is what an impulse would leave, so that its samples make the Hankel matrix themselves (J.-N. Juang, R. S. Pappa,
Journal of Guidance 8 (1985) 620); repeats stand side by side in it.
"""

from collections.abc import Callable, Sequence

import numpy as np

from mouse_cli._errors import WARNING, Diagnostic
from mouse_cli.model.recording import Recording
from mouse_cli.records.decays import Decays, fitted, level, uncertain
from mouse_cli.records.identify_output_only import FoundOutputs
from mouse_cli.records.lscf import OrderPoles
from mouse_cli.records.mode_selection import FALSE_MODES, HEAVIEST, UNKNOWN, UNKNOWN_DAMPING, Dropped
from mouse_cli.records.ssi import Subspace, poles
from mouse_cli.records.stabilisation import Track, persistent, tracks

LEAST = 64  # samples of a decay
_ROWS, _COLUMNS, _BLOCKS = 400, 1200, 60  # of the Hankel matrix, at most; block rows
_ORDERS, _STEP, _ROUNDS = 40, 2, 3  # highest order; times that poles are sought in what a fit leaves
_MARGIN = 2.56  # samples a second per Hz of the band
_PARTS = 8  # of a decay
_FALLS = 1.5  # times the noise of the others that the first one leaves, from which on it is remarked upon


def begun(recording: Recording) -> Recording:
    """The recording from where its outputs, each over its rms, are largest: what moved it has ended there, or soon after."""
    from dataclasses import replace

    y = recording.samples[:, recording.outputs]
    y = y - y[-max(len(y) // 10, 1) :].mean(axis=0)
    size = np.sqrt((y**2).mean(axis=0))
    first = int(((y / np.where(size > 0, size, 1.0)) ** 2).sum(axis=1).argmax())
    first = min(first, max(len(y) - LEAST, 0))
    return replace(recording, samples=recording.samples[first:], start=recording.start + first)


def thinned(recording: Recording, top_hz: float) -> tuple[np.ndarray, float]:
    """Outputs (t, o) at a rate that `top_hz` needs, and that rate. A filter that is full of samples leaves poles as they are."""
    from scipy.signal import firwin, oaconvolve

    y = recording.samples[:, recording.outputs]
    factor = max(1, int(recording.sample_rate_hz / (_MARGIN * top_hz)))
    if factor == 1 or len(y) < 2 * LEAST * factor:
        return y, recording.sample_rate_hz
    low = firwin(8 * factor + 1, 1 / factor)[:, None]
    return oaconvolve(y, low, mode="valid", axes=0)[::factor], recording.sample_rate_hz / factor


def identify_decays(
    records: Sequence[np.ndarray], rate_hz: float, band_hz: tuple[float, float], most: int | None, say: Callable[[str], None]
) -> tuple[FoundOutputs, Decays]:  # fmt: skip
    """Modes within `band_hz` of free decays (t, o) of the same outputs, each begun by what it likes."""
    size = np.sqrt(np.mean([(each - each.mean(axis=0)).var(axis=0) for each in records], axis=0))
    scaled = [each / np.where(size > 0, size, 1.0) for each in records]
    kept: list[Track] = []
    passing, dropped, diagram = [], [], []
    fit = fitted(scaled, rate_hz, np.zeros(0, complex))
    orders = range(2, 2 + _STEP)
    for _ in range(_ROUNDS):
        say("poles")
        found, orders = _poles(fit.left if kept else scaled, rate_hz, band_hz, most)
        every = tracks(found)
        new = [track for track in every if persistent(track, orders) and _light(track)]
        diagram, passing = (diagram or found), (passing or [track for track in every if track not in new])
        if not new:
            break
        before = len(fit.poles)
        say("fit")
        begin = np.concatenate([fit.poles, [track.centre()[0] for track in new]])
        fit, kept, gone = _selected(fitted(scaled, rate_hz, begin), [*kept, *new])
        dropped += gone
        if len(fit.poles) <= before:
            break
    modes = uncertain(fit) if kept else []
    for mode in modes:
        mode.shape[:] *= size
        mode.scatter[:, 2:] *= np.repeat(size, 2)
    return FoundOutputs(modes, kept, passing, dropped, diagram, orders, rate_hz, 0, sum(map(len, records))), fit


def _light(track: Track) -> bool:
    pole = track.centre()[0]
    return -pole.real < HEAVIEST * abs(pole)


def _poles(
    records: Sequence[np.ndarray], rate_hz: float, band_hz: tuple[float, float], most: int | None
) -> tuple[list[OrderPoles], range]:
    """Poles of all orders by the Hankel matrix of the records."""
    o, shortest = records[0].shape[1], min(map(len, records))
    rows = int(np.clip(_ROWS // o, 8, min(_BLOCKS, shortest // 3)))
    matrix = np.hstack([_hankel(each, rows, max(_COLUMNS // len(records), rows * o)) for each in records])
    left, singular, right = np.linalg.svd(matrix, full_matrices=False)
    orders = range(2, min(most or _ORDERS, len(singular) // 2) + 1, _STEP)
    none = np.zeros((0, *matrix.shape))
    return poles(Subspace(left, singular, right.T, none, o), orders, rate_hz, band_hz), orders


def _hankel(record: np.ndarray, rows: int, most: int) -> np.ndarray:
    """Samples (t, o) in so many block rows and up to `most` columns, each from another moment on."""
    record = record - record.mean(axis=0)
    starts = np.unique(np.linspace(0, len(record) - rows, min(most, len(record) - rows + 1)).astype(int))
    return record[starts[None, :] + np.arange(rows)[:, None]].transpose(0, 2, 1).reshape(-1, len(starts))


def _selected(fit: Decays, kept: list[Track]) -> tuple[Decays, list[Track], list[Dropped]]:
    """The fit with the poles that it needs: each must lower chi2 by more than noise of its frequency could."""
    from scipy.stats import chi2

    dropped = []
    free = 2 + 2 * sum(each.shape[1] for each in fit.records)
    least = float(chi2.isf(FALSE_MODES / max(map(len, fit.records)), free))
    settled: set[Track] = set()
    while len(fit.poles) > 0:
        doubtful = [r for r in np.argsort(_sizes(fit)) if kept[r] not in settled]
        if not doubtful:
            break
        r = int(doubtful[0])
        simpler = fitted(fit.records, fit.rate_hz, np.delete(fit.poles, r), fit)
        rise, loud = simpler.chi2 - fit.chi2, _noise_factor(fit, r)
        if rise > least * loud and not (fault := _fault(fit, r)):
            settled.add(kept[r])
            continue
        reason = (
            fault if rise > least * loud else f"improves the fit no more than noise would: chi2 by {max(rise, 0):.0f}"
        )
        dropped.append(Dropped(complex(fit.poles[r]), reason))
        kept = [track for k, track in enumerate(kept) if k != r]
        fit = fitted(fit.records, fit.rate_hz, simpler.poles)
    return fit, kept, dropped


def _sizes(fit: Decays) -> np.ndarray:
    """Energy (m,) of each vibration over the noise, roughly."""
    found = np.zeros(len(fit.poles))
    for coefficients, sd in zip(fit.coefficients, fit.sd, strict=True):
        found += ((coefficients[:-1] / sd) ** 2).sum(axis=1).reshape(-1, 2).sum(axis=1)
    return found / -fit.poles.real


def _noise_factor(fit: Decays, r: int) -> float:
    """Spectrum of what the fit leaves at the frequency of a pole, over that of white noise, at least 1."""
    worst = 1.0
    for left, spectrum in zip(fit.left, level(fit), strict=True):
        line = round(fit.poles[r].imag / (2 * np.pi) * len(left) / fit.rate_hz)
        worst = max(worst, float(spectrum[min(max(line, 0), len(spectrum) - 1)].max()))
    return worst


def _fault(fit: Decays, r: int) -> str:
    """Why a fitted pole is none of a mode; empty where it may be one."""
    pole = fit.poles[r]
    if not 0 < pole.imag < np.pi * fit.rate_hz:
        return "leaves the band once fitted"
    if -pole.real > HEAVIEST * abs(pole):
        return f"is damped by more than {100 * HEAVIEST:.0f} %: a slope of the record, no resonance"
    if np.sqrt((uncertain(fit)[r].scatter[:, 0] ** 2).sum()) > UNKNOWN * -pole.real:
        return UNKNOWN_DAMPING
    return ""


def falling(fit: Decays) -> tuple[Diagnostic, ...]:
    """A remark where what the fit leaves falls along the record, as the motion does: then it is not noise."""
    from scipy.stats import f

    if not len(fit.poles):
        return ()
    parts = [[(part**2).mean() for part in np.array_split(left, _PARTS)] for left in fit.left]
    power = np.mean(parts, axis=0)
    first, rest = float(power[0]), float(np.median(power[1:]))
    lines = np.concatenate(level(fit))
    count = sum(left.size for left in fit.left) / _PARTS * float(lines.mean() ** 2 / (lines**2).mean())
    ratio = first / max(rest, 1e-300)
    if ratio < _FALLS**2 or f.sf(ratio, count, (_PARTS - 1) * count) > FALSE_MODES:
        return ()
    message = f"what the fit leaves is {np.sqrt(ratio):.3g} times as large at the beginning of the decay as later: it is not noise"
    return (
        Diagnostic("MD683", WARNING, message, help="begin later: --segment FIRST LAST; compare small and large motion"),
    )

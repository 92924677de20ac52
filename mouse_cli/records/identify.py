"""Modal identification: functions or outputs in, modes with covariance out, and what speaks against them."""

from collections.abc import Callable, Sequence

import numpy as np

from mouse_cli._errors import ERROR, WARNING, Diagnostic, RecordError
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.identification import Diagram, FrfFit, Identification, Modes, Rejected
from mouse_cli.model.recording import Recording
from mouse_cli.records import identify_decays as decays
from mouse_cli.records import identify_output_only as outputs_only
from mouse_cli.records.identify_combine import combined
from mouse_cli.records.identify_frf import LEAST_LINES, Found, banded, identify_leaking, lines_of
from mouse_cli.records.identify_output_only import Division, FoundOutputs
from mouse_cli.records.identify_review import drive_points, reviewed, reviewed_outputs
from mouse_cli.records.lscf import OrderPoles
from mouse_cli.records.modal_model import synthesised
from mouse_cli.records.mode_selection import Dropped
from mouse_cli.records.stabilisation import Track
from mouse_cli.records.sweep import sweep

Band = tuple[float, float] | None
_BRIEF = 3  # orders in which a pole was stable: fewer are not worth a line of the report
_TOP = 0.4  # of the sample rate: the band of outputs that nobody limits
_QUIET = lambda phase: None


def identify_frf(
    tests: Sequence[FrfTest], band: Band = None, most: int | None = None, say: Callable[[str], None] = _QUIET
) -> Identification:
    """Modes of sets of functions: repeats, or forces in turn. band: Hz; most: highest order. Raises RecordError (MD655)."""
    test, noise = combined(tests)
    use = banded(test, band)
    title, sources = test.title, tuple(dict.fromkeys(each.path or each.title for each in tests))
    method = "p-LSCF, LSFD, maximum likelihood"
    hz = test.frequency_hz[use]
    edges = (float(hz[0]), float(hz[-1])) if len(hz) else band or (0.0, 0.0)
    if len(hz) < LEAST_LINES:
        few = f"there are {len(hz)} spectral lines between {edges[0]:.6g} and {edges[1]:.6g} Hz; at least {LEAST_LINES} are needed"
        doubt = Diagnostic("MD651", ERROR, few, help="take finer lines, or a wider band")
        return _nothing(title, sources, method, test.output_names, edges, noise, doubt)
    lines, stated = lines_of(test, use)
    windows = {each.window for each in tests}
    found = identify_leaking(lines, stated, most, say, windows.pop() if len(windows) == 1 else None)
    drives = drive_points(test)
    judged = reviewed(found, drives)
    modes = judged.modes
    fit = FrfFit(
        hz, np.where(np.isfinite(lines.sd), lines.H, np.nan), synthesised(lines, found.fit.model),
        found.lines.sd, test.kind, test.output_names, test.input_names,
    )  # fmt: skip
    return Identification(
        title, sources, method, test.output_names, edges, modes, _diagram_frf(found, hz, lines.H), noise, found.misfit,
        (*judged.rejected, *_rejected(found.dropped, found.search.passing)), judged.doubts, judged.remarks, fit,
        details={
            "lines": len(hz), "orders": found.search.orders, "forces": test.H.shape[2], "lines raised": found.raised,
            "correlated lines": len(found.errors.rho) - 1, "leakage over sd": found.leaked,
            "sd raised": float(np.sqrt(found.covariance.excess.max(initial=1.0))),
        },
    )  # fmt: skip


def identify_recordings(
    recordings: Sequence[Recording], band: Band = None, most: int | None = None, say: Callable[[str], None] = _QUIET
) -> Identification:
    """Modes of the outputs alone of a recording, or of repeats, whose correlations are averaged.

    band: Hz; most: highest order. Raises RecordError (MD655) where they are no repeats.
    """
    first = alike(recordings)
    top = min(band[1] if band else np.inf, _TOP * first.sample_rate_hz)
    longest = max(len(each.samples) for each in recordings)
    edges = (float(band[0]) if band else 2 / (first.time_step_s * max(longest, 1)), float(top))
    parts, rates = zip(*(outputs_only.decimated(each, top) for each in recordings), strict=True)
    title, sources, names = _called(recordings)
    division = outputs_only.division([len(each) for each in parts], len(names)) if names else None
    method, of = "covariance-driven SSI", f"{len(parts)} records" if len(parts) > 1 else "the record"
    noise = f"scatter of {division.blocks if division else outputs_only.BLOCKS} blocks of {of}"
    if division is None:
        doubt = short_of(parts, rates[0], outputs_only.least_samples())
        return _nothing(title, sources, method, names, edges, noise, doubt)
    found = outputs_only.identify_outputs(parts, rates[0], edges, division, most, say)
    sweeps = [sweep(each, rates[0]) for each in parts]
    judged, remarks = reviewed_outputs(found, edges, sweeps), lost(division, found.samples, rates[0])
    return Identification(
        title, sources, method, names, edges, judged.modes, _diagram_outputs(found, parts, rates[0]), noise,
        rejected=(*judged.rejected, *_rejected(found.dropped, found.passing)), doubts=judged.doubts,
        remarks=(*judged.remarks, *remarks),
        details={"samples": found.samples, "sample rate": found.rate_hz, "lags": 2 * found.lags, "orders": found.orders[-1]},
    )  # fmt: skip


def _called(recordings: Sequence[Recording]) -> tuple[str, tuple[str, ...], tuple[str, ...]]:
    """Titles, files and sensors of repeats."""
    outputs = [recordings[0].channels[j] for j in recordings[0].outputs]
    names = tuple(channel.sensor or channel.name for channel in outputs)
    return ", ".join(each.title for each in recordings), tuple(each.path or each.title for each in recordings), names


def identify_decaying(
    recordings: Sequence[Recording], band: Band = None, most: int | None = None, say: Callable[[str], None] = _QUIET
) -> Identification:
    """Modes of free decays, repeats of one test that need not begin alike. Raises RecordError (MD655) where they are no repeats."""
    first = alike(recordings)
    top = min(band[1] if band else np.inf, _TOP * first.sample_rate_hz)
    parts, rates = zip(*(decays.thinned(each, top) for each in recordings), strict=True)
    edges = (float(band[0]) if band else rates[0] / max(map(len, parts)), float(top))
    title, sources, names = _called(recordings)
    method, noise = "free decays: ERA, maximum likelihood", "what the fit leaves, by its spectrum"
    if not names or min(map(len, parts)) < decays.LEAST:
        doubt = short_of(parts, rates[0], decays.LEAST)
        return _nothing(title, sources, method, names, edges, noise, doubt)
    found, fit = decays.identify_decays(parts, rates[0], edges, most, say)
    judged = reviewed_outputs(found, edges)
    return Identification(
        title, sources, method, names, edges, judged.modes, _diagram_outputs(found, parts, rates[0]), noise,
        rejected=(*judged.rejected, *_rejected(found.dropped, found.passing)), doubts=judged.doubts,
        remarks=(*judged.remarks, *decays.falling(fit)),
        details={
            "samples": found.samples, "sample rate": found.rate_hz, "orders": found.orders[-1],
            "first sample": ", ".join(str(each.start) for each in recordings),
        },
    )  # fmt: skip


def _nothing(
    title: str, sources: tuple[str, ...], method: str, sensors: tuple[str, ...], edges: tuple[float, float], noise: str,
    doubt: Diagnostic,
) -> Identification:  # fmt: skip
    """An answer without modes."""
    none, s = np.zeros(0), len(sensors)
    table = np.zeros((s, 0))
    modes = Modes(none, none, none, none, np.zeros((0, 0)), table + 0j, table, table, none, (), none, none, none)
    diagram = Diagram(none, none, none, none.astype(bool), none, none)
    return Identification(title, sources, method, sensors, edges, modes, diagram, noise, doubts=(doubt,))


def _rejected(dropped: list[Dropped], passing: list[Track]) -> tuple[Rejected, ...]:
    """What was dropped and what did not stay, by frequency."""
    found = [Rejected(abs(d.pole) / 2 / np.pi, -d.pole.real / abs(d.pole), d.reason) for d in dropped]
    for track in passing:
        if track.stable_orders >= _BRIEF:
            pole, _ = track.centre()
            reason = f"stable in {track.stable_orders} orders only"
            found.append(Rejected(abs(pole) / 2 / np.pi, -pole.real / abs(pole), reason))
    return tuple(sorted(found, key=lambda each: each.frequency_hz))


def _diagram_frf(found: Found, hz: np.ndarray, H: np.ndarray) -> Diagram:
    """The diagram over the root mean square of all functions."""
    level = np.sqrt((np.abs(H) ** 2).mean(axis=(1, 2)))
    return _diagram(found.search.poles, [*found.search.candidates, *found.search.passing], hz, level)


def _diagram(poles: list[OrderPoles], every: list[Track], hz: np.ndarray, level: np.ndarray) -> Diagram:
    points = [
        (o, abs(p) / 2 / np.pi, -p.real / abs(p), s)
        for t in every
        for o, p, s in zip(t.order, t.pole, t.stable, strict=True)
    ]
    order, frequency, damping, stable = np.array(points).T if points else np.zeros((4, 0))
    return Diagram(order.astype(int), frequency, damping, stable.astype(bool), hz, level)


def _diagram_outputs(found: FoundOutputs, parts: Sequence[np.ndarray], rate_hz: float) -> Diagram:
    """The diagram over the root mean square amplitude spectrum of all outputs, each over its sd, over all records."""
    from scipy.signal import welch

    size = np.concatenate(parts).std(axis=0)
    block = min([2048, *(len(each) for each in parts)])
    every = [welch(each / np.where(size > 0, size, 1), rate_hz, nperseg=block, axis=0) for each in parts]
    power = np.mean([each[1] for each in every], axis=0)
    level_hz, level = every[0][0][1:], np.sqrt(power[1:].mean(axis=1))
    return _diagram(found.poles, [*found.tracks, *found.passing], level_hz, level)


_SAME = 1e-6  # relative difference of two sample rates


def alike(recordings: Sequence[Recording]) -> Recording:
    """The first of the recordings. Raises RecordError (MD655) where outputs or rates of others differ from its."""
    first = recordings[0]
    outputs = lambda one: [
        (one.channels[j].sensor or one.channels[j].name, one.channels[j].quantity) for j in one.outputs
    ]
    for other in recordings[1:]:
        message = ""
        if outputs(other) != outputs(first):
            message = f"'{first.title}' and '{other.title}' have different responses"
        elif abs(other.sample_rate_hz / first.sample_rate_hz - 1) > _SAME:
            rates = f"{first.sample_rate_hz:.7g} samples a second, '{other.title}' {other.sample_rate_hz:.7g}"
            message = f"'{first.title}' has {rates}"
        if message:
            raise RecordError.of("MD655", message, help="identify those that are alike by themselves")
    return first


def short_of(parts: Sequence[np.ndarray], rate_hz: float, least: int) -> Diagnostic:
    """That there are too few samples, after decimation, for any answer."""
    has = "the record has" if len(parts) == 1 else f"{len(parts)} records have, the shortest {min(map(len, parts))},"
    few = f"{has} {sum(map(len, parts))} samples at {rate_hz:.6g} Hz, which the band takes; at least {least} are needed"
    return Diagnostic("MD651", ERROR, few, help="record for longer, or give repeats")


def lost(division: Division, samples: int, rate_hz: float) -> tuple[Diagnostic, ...]:
    """What records that are shorter than usual leave unknown.

    Correlations over a time T tell modes apart that are 1 / T from one another; n blocks know a standard deviation to
    1 / sqrt(2 (n - 1)) of it.
    """
    if not division.short:
        return ()
    lags, blocks = division.usual
    apart, unsure = rate_hz / (2 * division.lags), 100 / np.sqrt(2 * (division.blocks - 1))
    message = (
        f"{samples} samples at {rate_hz:.6g} Hz are few: {division.blocks} blocks of {2 * division.lags} lags instead of "
        f"{blocks} of {2 * lags}; modes less than {apart:.3g} Hz apart may run into one, and standard deviations are known to "
        f"{unsure:.0f} %"
    )
    return (Diagnostic("MD682", WARNING, message, help="record for longer, or give repeats: they are averaged"),)

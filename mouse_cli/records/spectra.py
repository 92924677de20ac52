"""Recordings of one set of channels become frequency response functions of a kind, receptance to accelerance, with variance."""

from collections.abc import Sequence

import numpy as np

from mouse_cli._errors import WARNING, Diagnostic, RecordError
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.block_window import BlockWindow
from mouse_cli.model.frf_test import KINDS, FrfTest
from mouse_cli.model.recording import FORCES, MOTIONS, Channel, Recording
from mouse_cli.model.spectra import FOUND, STROKES, MeasuredFrf, Quality, SpectraOptions
from mouse_cli.records.blocks import decay_rate, products, starts
from mouse_cli.records.frf_estimators import estimator, multiple_coherence, variance
from mouse_cli.records.periodic import periodic
from mouse_cli.records.strokes import contact, strokes, windowed

_FEWEST_BLOCKS = 16
_OF = {"displacement": "receptance", "velocity": "mobility", "acceleration": "accelerance"}
_TURNS = {"rotation": "displacement", "angular velocity": "velocity", "angular acceleration": "acceleration"}
_SAME_RATE = 1e-6
_CUT = 1e-3  # of the power of strokes, cut off by a window that is said to be a loss
Piece = tuple[np.ndarray, np.ndarray, np.ndarray]  # x (t, i), y (t, o), first samples of blocks


def functions(
    recordings: Sequence[Recording], options: SpectraOptions, n: int = 0
) -> tuple[MeasuredFrf, list[Diagnostic]]:
    """The functions of all pairs of response and force, averaged over `recordings`, and remarks.

    n: degrees of freedom of the model, 0 without one. Raises RecordError (MD618 to MD622).
    """
    first = recordings[0]
    _check(recordings, options)
    fs = first.sample_rate_hz
    samples = [(r.samples[options.skip :, r.inputs], r.samples[options.skip :, r.outputs]) for r in recordings]
    remarks: list[Diagnostic] = []
    length = 0
    if options.period:
        block = options.period
        H, spread, blocks = periodic(samples, block)
        coherence, averages = None, float(blocks)
    else:
        block = _block(samples, options)
        pieces = _pieces(recordings, samples, block, options, remarks)
        pieces, length = _force_windowed(pieces, block, options, remarks)
        found = products(pieces, block, options)
        chosen = estimator(options.estimator)
        H, coherence = chosen.estimate(found), multiple_coherence(found)
        spread, blocks, averages = variance(chosen, H, found, coherence), found.blocks, found.averages
        _averaged(first, averages, remarks)
    hz = fs / block * np.arange(1, H.shape[0] + 1)
    added = decay_rate(options.final, block / fs) if options.taken == "exponential" and not options.period else 0.0
    kind, by = _kinds(first, options, added + 2j * np.pi * hz)
    inputs, outputs = ([first.channels[j] for j in columns] for columns in (first.inputs, first.outputs))
    _dependent(H, inputs, first, options)
    frf = FrfTest(
        hz, H * by[:, :, None], kind, weights(outputs, n), weights(inputs, n), spread * np.abs(by[:, :, None]) ** 2,
        tuple(c.sensor or c.name for c in outputs), tuple(c.sensor or c.name for c in inputs), coherence,
        first.title if len(recordings) == 1 else f"{first.title} and {len(recordings) - 1} more", first.path, decay_rate=added,
        window=_window(options, block / fs, by),
    )  # fmt: skip
    return MeasuredFrf(
        frf, averages, blocks, block, fs, tuple(r.title for r in recordings), qualities(frf), length
    ), remarks


def _window(options: SpectraOptions, seconds: float, by: np.ndarray) -> BlockWindow | None:
    """The window that broadened resonances in a way that is known: H1 of the kind that was recorded, of a random force or strokes.

    After a stroke an exponential window is a decay rate, and what is left of it where the block ends is cut off.
    """
    if options.period or options.estimator != "h1" or not (by == 1).all():
        return None
    if options.impact:
        return BlockWindow("uniform", seconds, 0.0)
    return BlockWindow(options.taken, seconds) if options.taken != "exponential" else None


def _refuse(code: str, message: str, help: str) -> None:
    raise RecordError.of(code, message, help=help)


def _check(recordings: Sequence[Recording], options: SpectraOptions) -> None:
    """Forces and responses are there, the same in all recordings, and enough for the estimator."""
    first = recordings[0]
    i, o = len(first.inputs), len(first.outputs)
    if not i or not o:
        what = "an input" if not i else "an output"
        _refuse(
            "MD618",
            f"the recording '{first.title}' has no channel that is {what}",
            "name forces as inputs and responses as outputs",
        )
    bad = [c for c in first.channels if c.quantity not in (*MOTIONS, *_TURNS) and c.role == "output"]
    bad += [c for c in first.channels if c.quantity not in FORCES and c.role == "input"]
    if bad:
        message = f"channel '{bad[0].name}' is {bad[0].quantity}; functions are of motion per force"
        help = "leave it out, or correct its quantity and unit"
        if bad[0].ground:
            help = "`mouse diagnose` and `mouse run` take the motion of the ground; for modes use `mouse identify --output-only`"
        _refuse("MD618", message, help)
    if options.impact and options.taken not in STROKES:
        _refuse(
            "MD628",
            f"the window '{options.taken}' weakens a stroke, which is at the beginning of its block",
            "leave --window out (uniform), or take --window exponential where the response outlasts the block",
        )
    for each in recordings[1:]:
        if abs(each.time_step_s / first.time_step_s - 1) > _SAME_RATE:
            message = f"'{first.title}' has {first.sample_rate_hz:.7g} samples a second, '{each.title}' {each.sample_rate_hz:.7g}"
            _refuse("MD603", message, "recordings that are averaged have one sample rate")
    if i > 1 and not options.period and estimator(options.estimator).single:
        _refuse(
            "MD619",
            f"{options.estimator.upper()} is defined for one force; the recordings have {i}",
            "use --estimator h1 or hv",
        )
    if options.period and len(recordings) < i:
        message = f"{i} forces need as many periodic experiments; there are {len(recordings)}"
        _refuse("MD619", message, "excite them one at a time or with different signs, and give all recordings")


def _block(samples: Sequence[tuple[np.ndarray, np.ndarray]], options: SpectraOptions) -> int:
    """Samples of a block."""
    shortest = min(len(x) for x, _ in samples)
    if options.lines is None:
        wanted = shortest if options.impact else max(1, sum(len(x) for x, _ in samples) // (_FEWEST_BLOCKS // 2))
        return max(4, 2 ** int(np.log2(max(4, min(shortest, wanted)))))
    block = 2 * options.lines
    if block > shortest:
        message = f"{options.lines} lines need blocks of {block} samples; the recording has {shortest}"
        _refuse("MD620", message, f"take at most {shortest // 2} lines")
    return block


def _pieces(
    recordings: Sequence[Recording], samples: Sequence[tuple[np.ndarray, np.ndarray]], block: int, options: SpectraOptions,
    remarks: list[Diagnostic],
) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:  # fmt: skip
    """Each recording with the first samples of its blocks."""
    if not options.impact:
        return [(x, y, starts(len(x), block, options.shared)) for x, y in samples]
    found = []
    for recording, (x, y) in zip(recordings, samples, strict=True):
        begin, double = strokes(np.abs(x).sum(axis=1) if x.shape[1] > 1 else x[:, 0], block, options.pretrigger)
        for at in begin[double][:5]:
            message = f"the stroke at sample {recording.start + options.skip + at} of '{recording.title}' is double, and left out"
            remarks.append(Diagnostic("MD621", WARNING, message, help="hit more briefly"))
        found.append((x, y, begin[~double]))
    if not sum(len(begin) for _, _, begin in found):
        _refuse(
            "MD620",
            f"no stroke is followed by {block} recorded samples",
            "take fewer --lines, or check the channel of the force",
        )
    return found


def _force_windowed(
    pieces: list[Piece], block: int, options: SpectraOptions, remarks: list[Diagnostic]
) -> tuple[list[Piece], int]:
    """The pieces with forces that are 0 after each stroke, and the samples of the window; 0 where none is asked for."""
    if options.force_window is None or not options.impact:
        return pieces, 0
    length = options.force_window
    if length == FOUND:
        length = max(
            (contact(np.abs(x).sum(axis=1), begin, block) for x, _, begin in pieces if len(begin)), default=block
        )
    done = [(*windowed(x, begin, block, length), y, begin) for x, y, begin in pieces]
    cut = max(share for _, share, _, _ in done)
    if cut > _CUT:
        message = f"the force window of {length} samples cuts off {100 * cut:.2g} % of the power of the strokes"
        remarks.append(
            Diagnostic("MD625", WARNING, message, help="make it longer, or give no length, so that it is found")
        )
    return [(x, y, begin) for x, _, y, begin in done], length


def _averaged(first: Recording, averages: float, remarks: list[Diagnostic]) -> None:
    """A coherence of a few averages says nothing."""
    if averages <= len(first.inputs) + 1:
        message = (
            f"{averages:.3g} averages of {len(first.inputs)} forces leave no data to estimate the noise: no variances"
        )
        remarks.append(Diagnostic("MD622", WARNING, message, help="take fewer --lines, or more recordings"))


def _dependent(H: np.ndarray, inputs: list[Channel], first: Recording, options: SpectraOptions) -> None:
    """Forces that move together cannot be told apart, nor noise from a period."""
    if np.isfinite(H).any():
        return
    names = ", ".join(channel.name for channel in inputs)
    if options.period:
        message = f"the force {names} of '{first.title}' does not repeat itself after {options.period} samples"
        _refuse("MD619", message, "give its --period in samples, and --skip until it is steady")
    message = f"the forces {names} of '{first.title}' are not independent, or zero, at all lines"
    _refuse("MD619", message, "drive them with different signals")


def _kinds(first: Recording, options: SpectraOptions, s: np.ndarray) -> tuple[str, np.ndarray]:
    """Kind of the functions, and what each response (f, o) is multiplied by to be of it, at s (f,)."""
    own = [_OF[_TURNS.get(q, q)] for q in (first.channels[j].quantity for j in first.outputs)]
    kind = options.kind or own[0]
    return kind, np.stack([factor(s, KINDS[kind] - KINDS[each]) for each in own], axis=1)


def weights(channels: list[Channel], n: int) -> Matrix:
    """What the sensors read: degrees of freedom (s,) from 0, or weights (s, n); without a model numbers of channels."""
    if not n or not all(channel.weights for channel in channels):
        return np.arange(len(channels))
    if all(list(channel.weights.values()) == [1.0] for channel in channels):
        return np.array([next(iter(channel.weights)) for channel in channels], dtype=int)
    from scipy.sparse import coo_array

    entries = [(row, dof, share) for row, channel in enumerate(channels) for dof, share in channel.weights.items()]
    row, dof, share = zip(*entries, strict=True)
    return coo_array((share, (row, dof)), shape=(len(channels), n)).tocsr()


def qualities(frf: FrfTest) -> tuple[Quality, ...]:
    """Of each function, those of one force after another."""
    pairs = [(o, i) for i in range(len(frf.input_names)) for o in range(len(frf.output_names))]
    return tuple(_quality(frf, o, i) for o, i in pairs)


def _quality(frf: FrfTest, o: int, i: int) -> Quality:
    size = np.abs(frf.H[:, o, i])
    lines = np.isfinite(size) & (size > 0)
    noise = np.sqrt(frf.variance[lines, o, i] / 2) / size[lines]
    coherence = np.array([]) if frf.coherence is None else frf.coherence[lines, o]
    peak = frf.frequency_hz[lines][np.argmax(size[lines])] if lines.any() else np.nan
    return Quality(
        frf.output_names[o], frf.input_names[i], int(lines.sum()), _median(coherence), _median(noise), float(peak)
    )


def _median(values: np.ndarray) -> float:
    """Of the values that are known; NaN where none is."""
    known = values[np.isfinite(values)]
    return float(np.median(known)) if len(known) else float("nan")


def factor(s: np.ndarray, times: int) -> np.ndarray:
    """s^times (f,); NaN where it divides by 0."""
    with np.errstate(divide="ignore", invalid="ignore"):
        found = s**times if times >= 0 else 1 / s**-times
    return np.where(np.isfinite(found), found, np.nan)

"""What the report says of spectra of recordings."""

from collections.abc import Iterator

import numpy as np

from mouse_cli import __version__
from mouse_cli.model.spectra import MeasuredFrf, SpectraResult
from mouse_cli.records.frf_estimators import estimator
from mouse_cli.report.blocks import Block, Table, Text, heads
from mouse_cli.report.section import RESULT, VERDICT, Options, Section
from mouse_cli.report.sections._wording import counted


def verdict(result: SpectraResult, options: Options) -> Iterator[Block]:
    """Frequency response functions in brief: how many, how they were averaged, and how good they are."""
    for each in result.measured:
        yield Text(_averaged(each))


def _averaged(each: MeasuredFrf) -> str:
    spacing = each.sample_rate_hz / each.block_samples
    coherence = np.array([q.median_coherence for q in each.quality])
    known = np.isfinite(coherence).all()
    median = f", median coherence {coherence.min():.3f} to {coherence.max():.3f}" if known else ""
    stroke = f" The force counts as 0 after {each.force_window} samples of each block." if each.force_window else ""
    return (
        f"{', '.join(each.recordings)}: {counted(len(each.quality), 'function')}{median if len(coherence) else ''}; "
        f"{counted(each.blocks, 'block')} of {each.block_samples} samples at {each.sample_rate_hz:.6g} Hz, lines {spacing:.5g} Hz "
        f"apart, {each.averages:.4g} independent averages.{stroke}"
    )


def functions(result: SpectraResult, options: Options) -> Iterator[Block]:
    """Lines, averages, coherence, noise and the highest peak."""
    columns = heads(
        "<response | <force | lines | averages | median coherence | median noise [per cent] | highest at [Hz] | <kind"
    )
    rows = [
        (
            q.response,
            q.force,
            q.lines,
            each.averages,
            q.median_coherence,
            100 * q.median_noise,
            q.peak_hz,
            each.frf.kind,
        )
        for each in result.measured
        for q in each.quality
    ]
    yield Table(columns, rows, keys=2).without_empty_columns()
    yield Text(
        "Noise is the standard deviation of the magnitude, which is that of the phase in radians too, by the magnitude."
    )


def heading(result: SpectraResult, options: Options) -> Iterator[Block]:
    """Heading of spectra: source, and every option that changes a number. What was measured, and how it was averaged."""
    how = result.options
    rows = [
        ("program", f"mouse {__version__}"),
        ("title", result.title),
        ("source", result.source),
        ("estimator", f"{how.estimator}: {estimator(how.estimator).where}"),
        ("window", how.taken),
        ("overlap", f"{how.shared:g}"),
    ]
    if how.period:
        rows[3:] = [("averages", f"over periods of {how.period} samples; noise from their differences")]
    if how.impact:
        rows[-1] = ("blocks", f"one for each stroke, {how.pretrigger} samples before it")
    if how.skip:
        rows.append(("skipped", f"{how.skip} samples at the beginning"))
    yield Table(heads("< | <"), rows)
    for each in result.measured:
        if each.frf.decay_rate:
            yield Text(
                "The exponential window adds {} 1/s to the decay rate zeta omega of every mode. A .npz records it, and `test.frf` "
                "takes it into account; subtract it from decay rates that are identified elsewhere.",
                (each.frf.decay_rate,),
            )


SECTIONS = (
    Section("spectra-verdict", 10, "Frequency response functions", verdict, (SpectraResult,), place=VERDICT),
    Section("spectra-functions", 20, "Their accuracy", functions, (SpectraResult,), place=RESULT),
    Section("spectra-heading", 10, "Source and averaging", heading, (SpectraResult,)),
)

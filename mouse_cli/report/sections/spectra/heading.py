"""Heading of spectra: source, and every option that changes a number."""

from collections.abc import Iterator

from mouse_cli import __version__
from mouse_cli.model.spectra import SpectraResult
from mouse_cli.records.frf_estimators import estimator
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import LEFT


def heading(result: SpectraResult, options: Options) -> Iterator[Block]:
    """What was measured, and how it was averaged."""
    how = result.options
    rows = [
        ("program", f"mouse {__version__}"),
        ("title", result.title),
        ("source", result.source),
        ("estimator", f"{how.estimator}: {estimator(how.estimator).where}"),
        ("window", how.window),
        ("overlap", f"{how.shared:g}"),
    ]
    if how.period:
        rows[3:] = [("averages", f"over periods of {how.period} samples; noise from their differences")]
    if how.impact:
        rows[-1] = ("blocks", f"one for each stroke, {how.pretrigger} samples before it")
    if how.skip:
        rows.append(("skipped", f"{how.skip} samples at the beginning"))
    yield Table((Column("", align=LEFT), Column("", align=LEFT)), tuple(rows))
    for each in result.measured:
        if each.frf.decay_rate:
            yield Text(
                "The exponential window adds {} 1/s to the decay rate zeta omega of every mode. A .npz records it, and `test.frf` "
                "takes it into account; subtract it from decay rates that are identified elsewhere.",
                (each.frf.decay_rate,),
            )


SECTION = Section("spectra-heading", 10, "Source and averaging", heading, (SpectraResult,))

"""One line for each frequency response function: how much of it there is, and how good."""

from collections.abc import Iterator

from mouse_cli.model.spectra import SpectraResult
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import LEFT


def functions(result: SpectraResult, options: Options) -> Iterator[Block]:
    """Lines, averages, coherence, noise and the highest peak."""
    columns = (
        Column("response", align=LEFT), Column("force", align=LEFT), Column("lines"), Column("averages"),
        Column("median coherence"), Column("median noise", "per cent"), Column("highest at", "Hz"), Column("kind", align=LEFT),
    )  # fmt: skip
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
    yield Table(columns, tuple(rows), keys=2).without_empty_columns()
    yield Text(
        "Noise is the standard deviation of the magnitude, which is that of the phase in radians too, by the magnitude."
    )


SECTION = Section("spectra-functions", 20, "Their accuracy", functions, (SpectraResult,), place=RESULT)

"""Peaks of the functions of coupled structures."""

from collections.abc import Iterator

from mouse_cli.formats.frf_values import response_unit
from mouse_cli.model.coupled import Coupled, Peak
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import LEFT

SHARP = (
    "A standard deviation above the magnitude means that the frequency of the peak is uncertain by more than its width; "
    "the first order is not valid there."
)


def functions(found: Coupled, options: Options) -> Iterator[Block]:
    """One line a peak, with its standard deviation where the parts' accuracy is known."""
    frf = found.functions
    if frf is None:
        return
    yield Text(
        f"{frf.kind.capitalize()} at {len(frf.frequency_hz)} lines from {{}} to {{}} Hz; `--json` and `--functions` give them all.",
        (float(frf.frequency_hz[0]), float(frf.frequency_hz[-1])),
    )
    units = found.coupling.units
    yield peak_table(found.peaks, response_unit(frf.kind, units) if units.declared else "")
    if any(peak.sd > 0 for peak in found.peaks) and not options.short:
        yield Text(
            "Standard deviations are those that measured functions and the properties of models carry to the whole, to first "
            "order; parts "
            "err independently."
        )
    if any(peak.sd > peak.magnitude for peak in found.peaks):
        yield Text(SHARP)


def peak_table(peaks: tuple[Peak, ...], unit: str) -> Table:
    """Response, force, frequency, height with its sd, phase."""
    columns = (
        Column("response", align=LEFT, literal=True), Column("force", align=LEFT, literal=True), Column("peak at", "Hz"),
        Column("magnitude", unit), Column("standard deviation", unit), Column("phase", "degrees"),
    )  # fmt: skip
    rows = tuple((p.response, p.force, p.hz, p.magnitude, p.sd if p.sd > 0 else None, p.phase) for p in peaks)
    return Table(columns, rows, 2).without_empty_columns()


SECTION = Section(
    "coupling-functions", 30, "Frequency response functions of the whole", functions, (Coupled,), place=RESULT
)

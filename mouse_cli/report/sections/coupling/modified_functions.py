"""Peaks of functions before and after changes."""

from collections.abc import Iterator

from mouse_cli.formats.frf_values import response_unit
from mouse_cli.model.modified import Modified
from mouse_cli.report.blocks import Block, Heading, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections.coupling.coupling_functions import SHARP, peak_table


def functions(found: Modified, options: Options) -> Iterator[Block]:
    """One table before, one after."""
    if found.functions is None:
        return
    units = found.modification.problem.units
    unit = response_unit(found.functions.after.kind, units) if units.declared else ""
    for word, peaks in (("before", found.functions.peaks_before), ("after", found.functions.peaks)):
        yield Heading(word, 2)
        yield peak_table(peaks, unit)
    if any(p.sd > p.magnitude for p in (*found.functions.peaks_before, *found.functions.peaks)):
        yield Text(SHARP)


SECTION = Section("modified-functions", 50, "Peaks of functions", functions, (Modified,))

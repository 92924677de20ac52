"""Poles that are no modes of the answer, and why."""

from collections.abc import Iterator

from mouse_cli.model.identification import Identification
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import LEFT

_MOST = 30


def rejected(found: Identification, options: Options) -> Iterator[Block]:
    """One line a candidate."""
    if not found.rejected:
        return
    columns = Column("frequency", "Hz"), Column("damping", "per cent"), Column("why it was rejected", align=LEFT)
    judged = [each for each in found.rejected if not each.reason.startswith("stable in")]
    brief = [each for each in found.rejected if each.reason.startswith("stable in")]
    shown = sorted([*judged, *brief][:_MOST], key=lambda each: each.frequency_hz)
    yield Table(columns, tuple((each.frequency_hz, 100 * each.damping, each.reason) for each in shown))
    if len(found.rejected) > _MOST:
        yield Text(f"{len(found.rejected) - _MOST} more poles were stable in a few orders only.")


SECTION = Section("identification-rejected", 50, "Rejected", rejected, (Identification,))

"""Rivals, and the measurements that would separate them."""

from collections.abc import Iterator

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._diagnosis_wording import with_p
from mouse_cli.report.sections._wording import LEFT


def proposals(found: Diagnosis, options: Options) -> Iterator[Block]:
    """The groups that are left, then one line a measurement; nothing where there is neither."""
    if not found.proposals:
        return
    yield Text("Still possible: " + ", ".join(f"{name} ({with_p(p)})" for name, p in found.rivals) + ".")
    columns = (Column("measurement", align=LEFT), Column("between", align=LEFT), Column("separation", "nats"))
    yield Table(columns, tuple((p.text, " and ".join(p.between), float(p.separation)) for p in found.proposals))
    yield Text("A separation above 4 will settle it, one below 1 will not.")


SECTION = Section("diagnosis-next", 50, "Next measurement", proposals, (Diagnosis,))

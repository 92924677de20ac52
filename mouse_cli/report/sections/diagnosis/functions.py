"""Frequency response functions that were fitted: the model as it is beside that with the cause, and the damping they show."""

from collections.abc import Iterator

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._functions import functions
from mouse_cli.report.sections._wording import LEFT

_COLUMNS = (
    Column("damping", align=LEFT),
    Column("value"),
    Column("standard deviation"),
    Column("unit", align=LEFT),
    Column("", align=LEFT),
)


def fitted(found: Diagnosis, options: Options) -> Iterator[Block]:
    """One line a function; then loss factor and viscous damping of the structure beside the cause."""
    yield from functions(found.frf)
    if found.damping:
        rows = (
            (f"{d.name}: {d.meaning}", f"{d.value:.4g}", f"{d.sd:.2g}", d.unit if d.unit != "1" else "", _said(d.told))
            for d in found.damping
        )
        yield Table(_COLUMNS, tuple(rows))
        which = found.frf[0].models[-1].name
        yield Text(
            f"Damping of the structure is that of the {which if len(found.frf[0].models) == 1 else f'model {which}'}."
        )


def _said(told: bool) -> str:
    return "" if told else "hardly determined by the FRFs"


SECTION = Section("diagnosis-functions", 74, "Frequency response functions, before and after", fitted, (Diagnosis,))

"""Rivals, and the measurements that would separate them."""

from collections.abc import Iterator

from mouse_cli.model.diagnosis import Diagnosis, Effort
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._diagnosis_wording import separation
from mouse_cli.report.sections._wording import LEFT

EFFORTS = {
    Effort.MODES: "a wider band",
    Effort.SENSOR: "one sensor",
    Effort.SHAPES: "a few sensors",
    Effort.MASS: "an added mass",
    Effort.SUPPORT: "a changed support",
}
_COLUMNS = (
    Column("measurement", align=LEFT),
    Column("takes", align=LEFT),
    Column("between", align=LEFT),
    Column("separation", "nats"),
    Column("outlook", align=LEFT),
)


def proposals(found: Diagnosis, options: Options) -> Iterator[Block]:
    """One line a measurement; nothing where there is none."""
    if not found.proposals:
        return
    rows = (
        (p.text, EFFORTS[p.effort], " and ".join(p.between), separation(p.separation), p.outlook)
        for p in found.proposals
    )
    yield Table(_COLUMNS, tuple(rows))
    yield Text(
        "First what separates the two most probable: decisive measurements of least effort first. Separation is "
        "half the squared distance of what the two predict, over what is uncertain in both and in the measurement: above 4 it will "
        "settle it, below 1 it will not. It is predicted to first order, with accuracies like those of this test."
    )


SECTION = Section("diagnosis-next", 50, "Next measurement", proposals, (Diagnosis,), place=RESULT)

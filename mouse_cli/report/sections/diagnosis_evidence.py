"""The evidence: every candidate fitted beside the deck's own parameters."""

from collections.abc import Iterator

from mouse_cli.model.diagnosis import Diagnosis, Explanation
from mouse_cli.report.blocks import Block, Cell, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._diagnosis_wording import nats_over_none, place, probable
from mouse_cli.report.sections._wording import LEFT

_MOST = 30  # explanations listed
_COLUMNS = (
    Column("candidate", align=LEFT),
    Column("group", align=LEFT),
    Column("place", align=LEFT),
    Column("parameter", align=LEFT),
    Column("value"),
    Column("sd"),
    Column("unit", align=LEFT),
    Column("ln evidence over none"),
    Column("probability"),
    Column("misfit probability"),
)


def evidence(found: Diagnosis, options: Options) -> Iterator[Block]:
    """One line for each parameter of each explanation, the most probable first."""
    if not found.explanations:
        yield Text("No candidate has a meaning for this model.")
        return
    shown = found.explanations[:_MOST]
    yield Table(_COLUMNS, tuple(row for one in shown for row in _rows(found, one)))
    more = len(found.explanations) - len(shown)
    rest = f" {more} less probable ones are left out." if more else ""
    yield Text(
        "ln evidence is the logarithm of how many times more probable the data are with the candidate than with none, its "
        "freedom paid for. Probability shares 1 among all that were tried, none included, with equal shares for groups that "
        "data can hardly tell apart; misfit probability: that noise alone leaves as much as the candidate leaves."
        + rest
    )


def _rows(found: Diagnosis, one: Explanation) -> Iterator[tuple[Cell, ...]]:
    judged = (nats_over_none(found, one), probable(one.probability), float(one.p) if one.dof > 0 else None)
    if not one.causes:
        yield "none", "none", "", "", None, None, "", *judged
    for cause in one.causes:
        head: tuple[Cell, ...] = (cause.physics, cause.group, place(cause.site))
        for size in cause.sizes:
            yield *head, size.name, float(size.value), float(size.sd), size.unit, *judged
            head, judged = ("", "", ""), (None, None, None)
        if not cause.sizes:
            yield *head, "", None, None, "", *judged
            judged = (None, None, None)


SECTION = Section("diagnosis-evidence", 40, "Evidence", evidence, (Diagnosis,))

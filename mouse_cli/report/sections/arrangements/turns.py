"""The evidence for each mechanism in turn: what was tried with all before it in the model."""

from collections.abc import Iterator

from mouse_cli.model.arrangements import ArrangementsDiagnosis
from mouse_cli.model.diagnosis import UNKNOWN, Explanation
from mouse_cli.report.blocks import Block, Cell, Column, Heading, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._diagnosis_wording import nats, probable, where
from mouse_cli.report.sections._field import untried_text
from mouse_cli.report.sections._wording import LEFT

_SHOWN = 6  # of each turn
_COLUMNS = (
    Column("candidate", align=LEFT),
    Column("site", align=LEFT),
    Column("log evidence over none"),
    Column("probability"),
    Column("chi-square"),
)


def turns(found: ArrangementsDiagnosis, options: Options) -> Iterator[Block]:
    """One table a step, and what was tried with all mechanisms in the model and is not demanded."""
    explains = found.kind != UNKNOWN
    for number, turn in enumerate(found.turns, 1):
        yield Heading(f"Step {number}: {turn.best.title}", 2)
        yield _table(turn.before, turn.explanations, explains)
        if turn.noise_scale > 1:
            yield Text(
                f"The best of these leaves {turn.noise_scale:.3g} times the variance that the decks state: more is missing, and "
                "the evidence is computed with that much noise."
            )

    yield Heading("With all of these in the model, not demanded", 2)
    yield _table(found.rest[0], found.rest, explains)
    yield from untried_text(found.untried)


def _table(before: Explanation, tried: tuple[Explanation, ...], explains: bool) -> Table:
    """explains: whether all mechanisms together explain the data; else no probability is given."""
    order = sorted(tried, key=lambda one: -one.probability)
    rows = tuple(_row(before, one, explains) for one in order[:_SHOWN])
    return Table(_COLUMNS, rows).without_empty_columns()


def _row(before: Explanation, one: Explanation, explains: bool) -> tuple[Cell, ...]:
    over = nats(one.log_evidence - before.log_evidence)
    return one.physics, where(one), over, probable(one.probability) if explains else None, f"{one.chi2:.1f}"


SECTION = Section("arrangements-turns", 40, "Evidence", turns, (ArrangementsDiagnosis,))

"""The evidence for each cause in turn: what was tried beside all that were told before."""

from collections.abc import Iterator

from mouse_cli.model.arrangements import ArrangementsDiagnosis
from mouse_cli.model.diagnosis import Explanation
from mouse_cli.report.blocks import Block, Cell, Column, Heading, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._diagnosis_wording import nats, probable, where
from mouse_cli.report.sections._wording import LEFT

_SHOWN = 6  # of each turn
_COLUMNS = (
    Column("candidate", align=LEFT),
    Column("place", align=LEFT),
    Column("ln evidence over none"),
    Column("probability"),
    Column("chi-square"),
)


def turns(found: ArrangementsDiagnosis, options: Options) -> Iterator[Block]:
    """One table a turn, and what was tried beside all causes and is not demanded."""
    for number, turn in enumerate(found.turns, 1):
        yield Heading(f"Turn {number}: {turn.best.title}", 2)
        yield _table(turn.before, turn.explanations)
        if turn.noise_scale > 1:
            yield Text(
                f"The best of these leaves {turn.noise_scale:.3g} times the variance that the decks state: more is missing, and "
                "probabilities are reckoned with that much noise."
            )

    yield Heading("Beside all of these, not demanded", 2)
    yield _table(found.rest[0], found.rest)


def _table(before: Explanation, tried: tuple[Explanation, ...]) -> Table:
    order = sorted(tried, key=lambda one: -one.probability)
    return Table(_COLUMNS, tuple(_row(before, one) for one in order[:_SHOWN]))


def _row(before: Explanation, one: Explanation) -> tuple[Cell, ...]:
    over = nats(one.log_evidence - before.log_evidence)
    return one.physics, where(one), over, probable(one.probability), f"{one.chi2:.1f}"


SECTION = Section("arrangements-turns", 40, "Evidence", turns, (ArrangementsDiagnosis,))

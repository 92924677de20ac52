"""How far answers spread when the test is drawn anew."""

from collections.abc import Iterator

from mouse_cli.model.campaign import Bootstrap, Spread
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import LEFT, counted, deck_table

_COLUMNS = (
    Column("run"),
    Column("posterior sd"),
    Column("predicted sd"),
    Column("bootstrap sd"),
    Column("jackknife sd"),
    Column("bias"),
    Column("95 % from"),
    Column("to"),
    Column("BCa from"),
    Column("to"),
)
_DRAWN = {
    "modes": "modes",
    "sensors": "sensors",
    "both": "modes and sensors",
    "functions": "functions",
    "records": "stretches of the recordings",
}


def spread(found: Bootstrap, options: Options) -> Iterator[Block]:
    """One line a property, then one a frequency."""
    yield deck_table(found.problem)
    yield Text(
        f"{counted(len(found.replicates), 'replicate')}, in which {_DRAWN[found.over]} of the test are drawn with replacement, and "
        f"{counted(len(found.left_out), 'run')} that leave one out; seed {found.seed}. What is drawn c times has its variances "
        "divided by c; the prior stays."
    )
    first = (Column("property", align=LEFT), Column("unit", align=LEFT))
    rows = tuple((each.name, each.unit, *_row(each)) for each in found.parameters[: options.elements])
    yield Table((*first, *_COLUMNS), rows).without_empty_columns()
    rows = tuple((int(each.name), *_row(each)) for each in found.frequencies)
    if rows:
        yield Table((Column("mode", "Hz"), *_COLUMNS), rows).without_empty_columns()
    yield Text(
        "Predicted is the standard deviation of the bootstrap were the stated accuracies right and the errors independent; it "
        "differs from the posterior one, to which the prior contributes."
    )


def _row(each: Spread) -> tuple[float, ...]:
    ends = (*each.percentile, *each.bca)
    return (
        each.value,
        each.posterior_sd,
        each.predicted,
        each.sd,
        each.jackknife,
        each.bias,
        *(float(end) for end in ends),
    )


SECTION = Section("bootstrap-spread", 10, "Bootstrap", spread, (Bootstrap,), place=RESULT)

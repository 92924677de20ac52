"""What the report says of sweeps and bootstraps."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.campaign import Bootstrap, Moved, Spread, Sweep
from mouse_cli.report.blocks import Block, Column, Table, Text, heads
from mouse_cli.report.section import RESULT, VERDICT, Options, Section
from mouse_cli.report.sections._wording import LEFT, counted, deck_table, worded


def remarks(found: Sweep | Bootstrap, options: Options) -> Iterator[Block]:
    """One paragraph a remark, or one that says that there is none."""
    yield from worded(found.warnings, options)
    if not found.warnings and isinstance(found, Sweep):
        yield Text("No property moves by more than one posterior standard deviation.")
    if not found.warnings and isinstance(found, Bootstrap):
        yield Text("The scatter agrees with the stated accuracies, and no single measurement dominates.")


_COLUMNS = heads(
    "run | posterior sd | predicted sd | bootstrap sd | jackknife sd | bias | 95 % from | to | BCa from | to"
)
_DRAWN = {
    "modes": "modes",
    "sensors": "sensors",
    "both": "modes and sensors",
    "functions": "functions",
    "records": "stretches of the recordings",
}


def spread(found: Bootstrap, options: Options) -> Iterator[Block]:
    """How far answers spread when the test is drawn anew. One line a property, then one a frequency."""
    yield deck_table(found.problem)
    yield Text(
        f"{counted(len(found.replicates), 'replicate')}, in which {_DRAWN[found.over]} of the test are drawn with replacement, and "
        f"{counted(len(found.left_out), 'run')} that leave one out; seed {found.seed}. What is drawn c times has its variances "
        "divided by c; the prior stays."
    )
    first = heads("<property | <unit")
    rows = tuple((each.name, each.unit, *_spread_row(each)) for each in found.parameters[: options.elements])
    yield Table((*first, *_COLUMNS), rows).without_empty_columns()
    rows = tuple((int(each.name), *_spread_row(each)) for each in found.frequencies)
    if rows:
        yield Table((Column("mode", "Hz"), *_COLUMNS), rows).without_empty_columns()
    yield Text(
        "Predicted is the standard deviation of the bootstrap were the stated accuracies right and the errors independent; it "
        "differs from the posterior one, to which the prior contributes."
    )


def _spread_row(each: Spread) -> tuple[float, ...]:
    ends = (*each.percentile, *each.bca)
    return (each.value, each.posterior_sd, each.predicted, each.sd, each.jackknife, each.bias, *ends)


def influence(found: Bootstrap, options: Options) -> Iterator[Block]:
    """One line a mode or sensor that is left out, the strongest first."""
    shown = found.parameters[: options.properties]
    table = np.array([each.influence for each in shown]).reshape(len(shown), len(found.units))
    if not table.size:
        return
    strength = np.nan_to_num(np.abs(table)).max(axis=0)
    order = np.argsort(-strength, kind="stable")
    columns = (Column("without", align=LEFT), *(Column(each.name, "sd", literal=True, digits=4) for each in shown))
    rows = tuple((found.units[i], *(round(float(v), 3) for v in table[:, i])) for i in order[: options.elements])
    yield Table(columns, rows)
    more = len(found.units) - len(rows)
    rest = f" {counted(more, 'further one', 'further ones')}: see --csv." if more else ""
    yield Text(f"By how many posterior standard deviations each property moves when that is left out.{rest}")


def moved(found: Sweep, options: Options) -> Iterator[Block]:
    """What moves over a sweep, by how much, and by which quantity. One line a property, then one a frequency."""
    head = heads("from | to", Column("moves by", "sd", digits=4), "<most by")
    shares = tuple(Column(f"share of {name}", literal=True, digits=3) for name in found.varied)
    if found.parameters:
        first = heads("<property | <unit")
        rows = tuple(
            (each.name, each.unit, *_moved_row(each, found.varied)) for each in found.parameters[: options.elements]
        )
        yield Table((*first, *head, *shares), rows).without_empty_columns()
    if found.frequencies:
        rows = tuple((int(each.name), *_moved_row(each, found.varied)) for each in found.frequencies)
        columns = heads("mode | from [Hz] | to [Hz]", *head[2:], *shares)
        yield Table(columns, rows).without_empty_columns()
    yield Text(
        "Lengths are in posterior standard deviations, the median of those found. A share is that of the variance over the points "
        "which a quantity explains by itself; the rest is due to interactions."
    )


def _moved_row(each: Moved, varied: tuple[str, ...]) -> tuple:
    most = "" if each.most_by is None else varied[each.most_by]
    lengths = round(each.lengths, 3) if np.isfinite(each.lengths) else None
    return (each.low, each.high, lengths, most, *(round(s, 3) for s in each.shares))


def points(found: Sweep, options: Options) -> Iterator[Block]:
    """The points of a sweep and what was found at each. One line a point."""
    yield deck_table(found.problem)
    shown = found.parameters[: options.properties]
    columns = heads(
        "point",
        *(Column(name, literal=True) for name in found.varied),
        "<ended | chi-square | p",
        *(Column(each.name, each.unit, literal=True) for each in shown),
    )
    rows = [
        (i, *(_cell(value) for value in point), answer.ended, answer.chi2, answer.p, *answer.theta[: len(shown)])
        for i, (point, answer) in enumerate(zip(found.points, found.answers, strict=True), 1)
    ]
    yield Table(columns, tuple(rows[: options.elements]), 1 + len(found.varied))
    if len(rows) > options.elements:
        yield Text(f"{counted(len(rows) - options.elements, 'further point')}: see --csv.")
    more = len(found.parameters) - len(shown)
    hidden = f"; {counted(more, 'further property', 'further properties')}: see --csv" if more else ""
    yield Text(f"Chi-square and its probability p are those of the residual, after the revision{hidden}.")


def _cell(value: object) -> float | int | str:
    """Words as they are; yes and no for what is either."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    return value


SECTIONS = (
    Section("campaign-remarks", 60, "Verdict", remarks, (Sweep, Bootstrap), place=VERDICT),
    Section("bootstrap-spread", 10, "Bootstrap", spread, (Bootstrap,), place=RESULT),
    Section("bootstrap-influence", 20, "Influence of what was measured", influence, (Bootstrap,), place=RESULT),
    Section("sweep-moved", 20, "What moves", moved, (Sweep,), place=RESULT),
    Section("sweep-points", 10, "Sweep", points, (Sweep,)),
)

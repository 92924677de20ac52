"""The evidence: every candidate fitted beside the deck's own parameters."""

from collections.abc import Iterator

from mouse_cli.model.diagnosis import UNKNOWN, Diagnosis, Explanation
from mouse_cli.report.blocks import Block, Cell, Column, Heading, Table, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._diagnosis_wording import nats, nats_over_none, probable, where
from mouse_cli.report.sections._field import untried_text
from mouse_cli.report.sections._wording import LEFT

_LEAST, _MOST = 1e-3, 30  # probability of explanations that are listed, and how many; a few are, however improbable
_ALWAYS = 8
_COUNTS, _FEW = 0.01, 5  # the same of a short report
_JUDGED = (
    Column("candidate", align=LEFT),
    Column("group", align=LEFT),
    Column("site", align=LEFT),
    Column("log evidence over none"),
    Column("probability"),
    Column("p-value"),
)
_SIZED = (
    Column("candidate", align=LEFT),
    Column("parameter", align=LEFT),
    Column("value"),
    Column("sd"),
    Column("unit", align=LEFT),
    Column("range from"),
    Column("to"),
)


def evidence(found: Diagnosis, options: Options) -> Iterator[Block]:
    """One line for each explanation, the most probable first; then the parameters of their mechanisms."""
    if not found.explanations:
        yield Text("No candidate has a meaning for this model.")
        yield from untried_text(found.untried)
        return
    if options.short:
        yield _brief(found)
        return
    likely = sum(one.probability >= _LEAST for one in found.explanations)
    shown = found.explanations[: min(max(likely, _ALWAYS), _MOST)]
    yield Table(_JUDGED, tuple(_judged(found, one) for one in shown)).without_empty_columns()
    more = len(found.explanations) - len(shown)
    rest = f" {more} less probable ones are left out; --json has all." if more else ""
    yield Text(
        "The log evidence is the logarithm of how many times more probable the data are with the candidate than with none (the "
        f"Bayes factor). {_probability(found)} The p-value is that of the misfit which the candidate leaves, blank where it has as "
        "many parameters as there are data." + rest
    )
    yield from untried_text(found.untried)
    rows = tuple(row for one in shown for row in _sized(one))
    if rows:
        yield Heading("Sizes", 2)
        yield Table(_SIZED, rows, keys=2)


def _brief(found: Diagnosis) -> Table:
    """The most probable explanations; the others are folded."""
    likely = sum(one.probability >= _COUNTS for one in found.explanations)
    rows = tuple(_judged(found, one) for one in found.explanations)
    rest = "" if found.kind == UNKNOWN else f"of probability below {_COUNTS:g}"
    table = Table(_JUDGED, rows, kept=_FEW if found.kind == UNKNOWN else max(likely, 2), rest=rest)
    return table.without_empty_columns()


def _probability(found: Diagnosis) -> str:
    if found.kind == UNKNOWN:
        return "No probability is given, as no candidate explains the data."
    return (
        "The probability is that of the hypothesis among all that were tried, none included, with equal prior shares for groups "
        "that data can hardly distinguish."
    )


def _judged(found: Diagnosis, one: Explanation) -> tuple[Cell, ...]:
    misfit = probable(float(one.p)) if one.dof > 0 else None
    probability = None if found.kind == UNKNOWN else probable(one.probability)
    return one.physics, one.group, where(one), nats(nats_over_none(found, one)), probability, misfit


def _sized(one: Explanation) -> Iterator[tuple[Cell, ...]]:
    for cause in one.causes:
        for size in cause.sizes:
            name = f"{cause.physics}: {size.name}" if len(one.causes) > 1 else size.name
            value, sd, lower, upper = (f"{x:.4g}" for x in (size.value, size.sd, size.lower, size.upper))
            yield one.physics, name, value, sd, size.unit, lower, upper


SECTION = Section("diagnosis-evidence", 40, "Evidence", evidence, (Diagnosis,), place=RESULT)

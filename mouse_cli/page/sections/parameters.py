"""Parameters with prior and posterior."""

from collections.abc import Iterator

from mouse_cli.page.charts import Interval, intervals
from mouse_cli.page.html import Markup
from mouse_cli.page.numbers import apart, shown, signed_per_cent
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import cut
from mouse_cli.page.tables import Cell, table
from mouse_cli.report.reading import Part, updates

_HEADS = ("parameter", "unit", "prior", "prior sd", "posterior", "posterior sd", "change", "note")
_MOST = 40  # lines of the figure


def parameters(document: Part) -> Iterator[Markup]:
    """One figure and one table for each model that was updated."""
    for key, name, found in updates(document):
        all_of = found.parts("parameters")
        rows = [_interval(each) for each in all_of[:_MOST]]
        spoken = "; ".join(f"{row.label}: {row.words}" for row in rows)
        told = f"Shift from the prior value, and half widths of one sd, both in prior sd. {cut(all_of)}{spoken}."
        yield intervals(f"intervals-{key}", f"Parameters of {name}, prior and posterior", told, rows)
        yield table(f"parameters-{key}", f"Parameters of {name}", _HEADS, map(_row, all_of))


def _interval(parameter: Part) -> Interval:
    """In prior standard deviations."""
    prior, sd, value = (parameter.number(key) for key in ("prior", "prior_sd", "posterior"))
    name = parameter.text("name")
    if value is None or prior is None or not sd:
        return Interval(name, "no posterior" if value is None else "no prior sd", None, None)
    half = _sd(parameter)
    centre = (value - prior) / sd
    width = " at its limit" if half is None else f" ± {half / sd:.2g}"
    shift = f"{'−' if centre < 0 else '+'}{abs(centre):.2f}"
    return Interval(name, f"{shift}{width} prior sd", centre, None if half is None else half / sd)


def _sd(parameter: Part) -> float | None:
    """Standard deviation of the posterior; documents of arrangements call it `sd`."""
    return parameter.number("posterior_sd" if "posterior_sd" in parameter.values else "sd")


def _row(parameter: Part) -> tuple[object, ...]:
    prior, value = parameter.number("prior"), parameter.number("posterior")
    change = apart(value, prior)
    return (
        parameter.text("name"),
        parameter.text("unit"),
        prior,
        Cell(parameter.number("prior_sd"), shown(parameter.number("prior_sd"), 3)),
        value,
        Cell(_sd(parameter), shown(_sd(parameter), 3)),
        Cell(change, signed_per_cent(change)),
        "at its limit" if parameter.flag("at_limit") else "",
    )


SECTION = PageSection("parameters", 50, "Parameters", parameters)

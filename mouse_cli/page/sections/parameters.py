"""Parameters and laws, what they went through, and the errors that the answer allows for."""

from collections.abc import Iterator

from mouse_cli.page.charts import Interval, curve, intervals
from mouse_cli.page.html import Markup
from mouse_cli.page.numbers import shown, signed_per_cent
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import cut, listed, place
from mouse_cli.page.tables import Cell, Listing, columns_of, table
from mouse_cli.report.reading import Part, updates

_MOST = 40  # lines of the figure


def parameters(document: Part) -> Iterator[Markup]:
    """Parameters with prior and posterior. One figure and one table for each model that was updated."""
    for key, name, found in updates(document):
        all_of = found.parts("parameters")
        rows = [_interval(each) for each in all_of[:_MOST]]
        listed = "; ".join(f"{row.label}: {row.words}" for row in rows)
        description = f"Shift from the prior value, and half widths of one sd, both in prior sd. {cut(all_of)}{listed}."
        yield intervals(f"intervals-{key}", f"Parameters of {name}, prior and posterior", description, rows)
        yield Listing(f"parameters-{key}", f"Parameters of {name}", _PARAMETERS, all_of).html()


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


_PARAMETERS = columns_of(
    "parameter: name text | unit: unit text | prior: prior | prior sd: prior_sd 3 | posterior: posterior | posterior sd: () | "
    "change: posterior percent prior | note: ()",
    lambda parameter: Cell(_sd(parameter), shown(_sd(parameter), 3)),
    lambda parameter: "at its limit" if parameter.flag("at_limit") else "",
)


_LAWS_HEADS = ("law", "place", "amount", "unit", "value", "sd")


def laws(document: Part) -> Iterator[Markup]:
    """Local laws of a deck, as records revised them. One row an amount."""
    rows = []
    for law in document.parts("laws"):
        for size in law.parts("parameters"):
            sd = Cell(size.number("sd"), shown(size.number("sd"), 3))
            title = law.text("title") or law.text("physics")
            rows.append(
                (title, place(law.part("site")), size.text("name"), size.text("unit"), size.number("value"), sd)
            )
    yield table("laws-of-the-deck", "Laws, revised", _LAWS_HEADS, rows)


def shared_errors(document: Part) -> Iterator[Markup]:
    """What theory errs in all arrangements alike. Errors of ln f by mode, in per cent of the frequency."""
    rows = []
    for each in document.parts("shared_errors"):
        value, sd = each.number("value"), each.number("sd")
        words = signed_per_cent(None if value is None else 100 * value)
        mode = Cell(each.number("mode"), each.label("mode"))
        rows.append((mode, Cell(value, words), Cell(sd, "–" if sd is None else f"{shown(100 * sd, 3)} %")))
    heads = ("mode", "measured minus model", "sd")
    yield table("shared", "Model error shared by all configurations, by mode", heads, rows)


_CYCLES = columns_of(
    "cycle: cycle name | chi-square: chi2 | data outside their limits: exceedances | allowed: allowed | cost: cost | "
    "damping of the step: damping"
)


def convergence(document: Part) -> Iterator[Markup]:
    """Convergence: the misfit after each cycle. Chi-square by cycle as a curve, then every cycle."""
    cycles = document.parts("cycles")
    chi2 = [cycle.number("chi2") for cycle in cycles]
    listed = "; ".join(f"cycle {i}: {shown(value, 4)}" for i, value in enumerate(chi2))
    description = f"Sum of squared differences over their variances, logarithmic; cycle 0 is the prior model. {listed}."
    yield curve(description, chi2)
    yield Listing("cycles", "Cycles of the run", _CYCLES, cycles).html()


_NAMES = {
    "frequency": "frequency of each mode",
    "shape": "largest component of each shape",
    "mechanism": "what a mechanism does",
    "configurations": "frequency of each mode, in all configurations alike",
    "link_stiffness": "stiffness of parts without a parameter",
    "link_damping": "damping of parts without a parameter",
}


def theory(document: Part) -> Iterator[Markup]:
    """Errors of theory that the answer allows for. Standard deviations in per cent, those that this kind of test uses."""
    given = document.part("theory")
    values = {name: given.number(key) for key, name in _NAMES.items()}
    rows = [(name, Cell(value, f"{shown(100 * value, 3)} %")) for name, value in values.items() if value is not None]
    yield table("theory-allowed", "Standard deviations", ("of", "sd"), rows)


def remarks(document: Part) -> Iterator[Markup]:
    """Remarks and warnings. Each as one entry of a list."""
    yield listed([*document.texts("remarks"), *document.texts("warnings")])


SECTIONS = (
    PageSection("parameters", 50, "Parameters", parameters),
    PageSection("laws", 52, "Local laws", laws),
    PageSection("shared-errors", 55, "Shared errors", shared_errors),
    PageSection("convergence", 70, "Convergence", convergence),
    PageSection("theory", 75, "Errors of theory allowed for", theory),
    PageSection("remarks", 80, "Remarks and warnings", remarks),
)

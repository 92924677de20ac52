"""Groups of mechanisms and single candidates, with their probabilities, and candidates that were left out."""

from collections.abc import Iterator

from mouse_cli.page.html import Markup, tag
from mouse_cli.page.numbers import probable, shown
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import places, shares
from mouse_cli.page.tables import Listing, columns_of, table
from mouse_cli.report.reading import Part


def causes(document: Part) -> Iterator[Markup]:
    """Probabilities of the groups as bars, then every candidate."""
    yield from _judged("", "", document)
    for number, turn in enumerate(document.parts("turns"), 1):  # of several configurations: sequential identification
        yield from _judged(f"-{number}", f" (step {number})", turn)
    yield Listing("rest", "What else was tried, and is not demanded", _CANDIDATES, document.parts("rest")).html()
    yield _untried(document.part("verdict").parts("untried"))


def _untried(found: list[Part]) -> Markup:
    """Candidates that were left out and why, folded; empty without any."""
    rows = [(each.text("physics"), each.text("reason")) for each in found]
    left = table("untried", "Candidates that were not tried", ("candidate", "reason"), rows)
    return tag("details", tag("summary", f"Not tried: {len(rows)}"), left) if rows else left


def _judged(key: str, which: str, document: Part) -> Iterator[Markup]:
    groups = document.parts("groups")
    rows = [(g.text("group"), probable(g.number("probability")), g.number("probability")) for g in groups]
    title, description = f"Probability of each group{which}", "Given that what is missing is a candidate or nothing."
    yield shares(f"groups{key}", title, description, rows)
    caption = f"Candidates, the leading one first{which}"
    yield Listing(f"candidates{key}", caption, _CANDIDATES, document.parts("candidates")).html()


_CANDIDATES = columns_of(
    "candidate: () | group: group text | site: () | size: () | probability: probability p | "
    "log evidence over none: log_evidence_over_none | chi-square: chi2 | degrees of freedom: dof | p-value: p p",
    lambda one: one.text("title") or one.text("physics"),
    places,
    lambda one: ", ".join(map(size, one.parts("parameters"))) or "–",
)


def size(found: Part) -> str:
    """Name, value and standard deviation."""
    unit = "" if found.text("unit") in ("", "1") else f" {found.text('unit')}"
    return f"{found.text('name')} {shown(found.number('value'), 4)}{unit} (sd {shown(found.number('sd'), 2)})"


SECTION = PageSection("causes", 20, "Mechanisms", causes)

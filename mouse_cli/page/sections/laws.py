"""Local laws of a deck, as records revised them."""

from collections.abc import Iterator

from mouse_cli.page.html import Markup
from mouse_cli.page.numbers import shown
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import place
from mouse_cli.page.tables import Cell, table
from mouse_cli.report.reading import Part

_HEADS = ("law", "place", "amount", "unit", "value", "sd")


def laws(document: Part) -> Iterator[Markup]:
    """One row an amount."""
    rows = []
    for law in document.parts("laws"):
        for size in law.parts("parameters"):
            sd = Cell(size.number("sd"), shown(size.number("sd"), 3))
            title = law.text("title") or law.text("physics")
            rows.append(
                (title, place(law.part("site")), size.text("name"), size.text("unit"), size.number("value"), sd)
            )
    yield table("laws-of-the-deck", "Laws, revised", _HEADS, rows)


SECTION = PageSection("laws", 52, "Local laws", laws)

"""Errors of theory that the answer allows for."""

from collections.abc import Iterator

from mouse_cli.page.html import Markup
from mouse_cli.page.numbers import shown
from mouse_cli.page.section import PageSection
from mouse_cli.page.tables import Cell, table
from mouse_cli.report.reading import Part

_NAMES = {
    "frequency": "frequency of each mode",
    "shape": "largest component of each shape",
    "mechanism": "what a mechanism does",
    "configurations": "frequency of each mode, in all configurations alike",
    "link_stiffness": "stiffness of parts without a parameter",
    "link_damping": "damping of parts without a parameter",
}


def theory(document: Part) -> Iterator[Markup]:
    """Standard deviations in per cent, those that this kind of test uses."""
    given = document.part("theory")
    values = {name: given.number(key) for key, name in _NAMES.items()}
    rows = [(name, Cell(value, f"{shown(100 * value, 3)} %")) for name, value in values.items() if value is not None]
    yield table("theory-allowed", "Standard deviations", ("of", "sd"), rows)


SECTION = PageSection("theory", 75, "Errors of theory allowed for", theory)

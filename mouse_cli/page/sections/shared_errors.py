"""What theory errs in all arrangements alike."""

from collections.abc import Iterator

from mouse_cli.page.html import Markup
from mouse_cli.page.numbers import shown, signed_per_cent
from mouse_cli.page.section import PageSection
from mouse_cli.page.tables import Cell, table
from mouse_cli.report.reading import Part


def shared_errors(document: Part) -> Iterator[Markup]:
    """Errors of ln f by mode, in per cent of the frequency."""
    rows = []
    for each in document.parts("shared_errors"):
        value, sd = each.number("value"), each.number("sd")
        words = signed_per_cent(None if value is None else 100 * value)
        mode = Cell(each.number("mode"), each.label("mode"))
        rows.append((mode, Cell(value, words), Cell(sd, "–" if sd is None else f"{shown(100 * sd, 3)} %")))
    heads = ("mode", "measured minus model", "sd")
    yield table("shared", "Model error shared by all configurations, by mode", heads, rows)


SECTION = PageSection("shared-errors", 55, "Shared errors", shared_errors)

"""What to measure next, to separate what this test does not."""

from collections.abc import Iterator

from mouse_cli.page.html import Markup
from mouse_cli.page.section import PageSection
from mouse_cli.page.tables import table
from mouse_cli.report.reading import Part

_HEADS = ("measure", "between", "predicted separation, log evidence", "outlook")


def proposals(document: Part) -> Iterator[Markup]:
    """The proposals in their order: the least effort that settles it comes first."""
    rows = [
        (each.text("measure"), " and ".join(each.labels("between")), each.number("separation"), each.text("outlook"))
        for each in document.parts("next_measurement")
    ]
    yield table("proposals", "Measurements that would separate the rivals", _HEADS, rows)


SECTION = PageSection("next", 38, "What to measure next", proposals)

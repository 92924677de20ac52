"""What answers that judge no model hold: their figures, their first table, and the others folded."""

from collections.abc import Iterator

from mouse_cli.page.html import Markup, tag
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._unjudged import UNJUDGED
from mouse_cli.report.reading import Part

_ROWS = 12  # of a table that stands open


def results(document: Part) -> Iterator[Markup]:
    """The first figure stands open, and the first table where it is short."""
    kind = UNJUDGED.get(document.text("schema"))
    if kind is None:
        return
    first, *more = [*filter(None, kind.figures(document)), None]
    yield first or Markup("")
    found = [listing for listing in kind.tables(document) if listing]
    for number, listing in enumerate(found):
        drawn = listing.html()
        open_ = number == 0 and len(listing.parts) <= _ROWS
        yield drawn if open_ else tag("details", tag("summary", listing.caption), drawn)
    more = [each for each in more if each]
    if more:
        yield tag("details", tag("summary", f"{len(more)} more figures"), *more)


SECTION = PageSection("results", 35, "Results", results, folded=False)

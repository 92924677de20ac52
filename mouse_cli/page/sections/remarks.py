"""Remarks and warnings."""

from collections.abc import Iterator

from mouse_cli.page.html import Markup
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import listed
from mouse_cli.report.reading import Part


def remarks(document: Part) -> Iterator[Markup]:
    """Each as one entry of a list."""
    yield listed([*document.texts("remarks"), *document.texts("warnings")])


SECTION = PageSection("remarks", 80, "Remarks and warnings", remarks)

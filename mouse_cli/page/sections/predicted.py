"""Natural frequencies of a model before any test, with the uncertainty of its properties carried through."""

from collections.abc import Iterator

from mouse_cli.page.html import Markup
from mouse_cli.page.numbers import shown
from mouse_cli.page.section import PageSection
from mouse_cli.page.tables import Cell, table
from mouse_cli.report.reading import Part

_HEADS = ("mode", "frequency, Hz", "sd, Hz", "sd")
_MOST = 1000  # modes of the table


def predicted(document: Part) -> Iterator[Markup]:
    """A table of the modes of `mouse modes`."""
    if document.text("schema") != "mouse.modes/1":
        return
    modes = document.parts("modes")
    shown_of = f"The first {_MOST} of {len(modes)} natural frequencies" if len(modes) > _MOST else "Natural frequencies"
    yield table("foreseen", f"{shown_of} of the model", _HEADS, map(_row, modes[:_MOST]))


def _row(mode: Part) -> tuple[object, ...]:
    hz, sd = mode.number("hz"), mode.number("sd_hz")
    share = 100 * sd / hz if sd is not None and hz else None
    words = "–" if share is None else f"{shown(share, 2)} %"
    return (Cell(mode.number("mode"), mode.label("mode")), hz, Cell(sd, shown(sd, 3)), Cell(share, words))


SECTION = PageSection("foreseen", 41, "Natural frequencies", predicted)

"""Where: the place posterior by the shapes alone, and where stiffness and shapes disagree."""

from collections.abc import Iterator

from mouse_cli.page.html import Markup
from mouse_cli.page.numbers import probable, shown
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import paragraphs, place, shares
from mouse_cli.page.tables import Cell, table
from mouse_cli.report.reading import Part


def where(document: Part) -> Iterator[Markup]:
    """Both maps, where the document has them."""
    yield from _posterior(document.part("location"))
    yield from _energy(document.part("energy"))


def _posterior(location: Part) -> Iterator[Markup]:
    if not location:
        return
    single = (
        "A single place may be it." if location.flag("single") else "No force at a single place makes these shapes."
    )
    region, tried = shown(location.number("region")), shown(location.number("tried"))
    yield paragraphs(f"{single} The 90 % region holds {region} of {tried} places.")
    found = location.parts("places")
    rows = [(place(p.part("site")), probable(p.number("probability")), p.number("probability")) for p in found]
    likely = [row for row in rows if (row[2] or 0.0) >= 1e-3] or rows[:5]
    yield shares("place-posterior", "Probability of each place", "If one force made the measured shapes.", likely)
    heads = ("place", "motion", "probability", "nats below the best")
    yield table("places", "Places, the most probable first", heads, map(_row, found))


def _row(each: Part) -> tuple[object, ...]:
    p = each.number("probability")
    return place(each.part("site")), each.text("channel"), Cell(p, probable(p)), each.number("deficit")


def _energy(energy: Part) -> Iterator[Markup]:
    rows = []
    for each in energy.parts("places"):
        share = each.number("share")
        rows.append((place(each.part("site")), Cell(share, "–" if share is None else f"{100 * share:.3g} %")))
    drawn = [(name, cell.words, cell.value) for name, cell in rows[:12]]
    yield shares("energy-shares", "Where stiffness and shapes disagree", "Largest shares of the energy.", drawn)
    yield table("energy", "Shares of the energy by which stiffness and shapes disagree", ("place", "share"), rows)


SECTION = PageSection("where", 30, "Where", where)

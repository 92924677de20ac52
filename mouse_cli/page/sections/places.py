"""Where: localisation by the shapes alone, and where stiffness and shapes disagree."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.page.html import Markup
from mouse_cli.page.lines import Line, lines
from mouse_cli.page.numbers import probable, shown
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import paragraphs, place, shares
from mouse_cli.page.tables import Cell, table
from mouse_cli.report.reading import Part

_DEEP = 40.0  # log probability below the best place: less probable ones lie at the edge


def where(document: Part) -> Iterator[Markup]:
    """Both maps, where the document has them."""
    yield from _posterior(document.part("location"))
    yield from _energy(document.part("energy"))


def _posterior(location: Part) -> Iterator[Markup]:
    if not location:
        return
    single = "A single site may be it." if location.flag("single") else "No force at a single site makes these shapes."
    region, tried = shown(location.number("region")), shown(location.number("tried"))
    yield paragraphs(f"{single} The 90 % region holds {region} of {tried} sites.")
    found = location.parts("places")
    yield _along(found)
    rows = [(place(p.part("site")), probable(p.number("probability")), p.number("probability")) for p in found]
    likely = [row for row in rows if (row[2] or 0.0) >= 1e-3] or rows[:5]
    yield shares("place-posterior", "Probability of each site", "If one force made the measured shapes.", likely)
    heads = ("site", "motion", "probability", "log probability below the best")
    yield table("places", "Sites, the most probable first", heads, map(_row, found))


def _along(places: list[Part]) -> Markup:
    """ln of the probability over position, where the places lie on one line; nothing where they do not."""
    at = [_position(each.part("site")) for each in places]
    known = [(p, -(each.number("deficit") or 0.0)) for p, each in zip(at, places, strict=True) if p]
    if len({len(p) for p, _ in known}) != 1:
        return Markup("")
    points = np.array([p for p, _ in known], float)
    if len(known) < max(3, 0.5 * len(places)):
        return Markup("")
    extent = np.ptp(points, axis=0)
    axis = int(extent.argmax())
    if (np.delete(extent, axis) > 1e-6 * extent[axis]).any() or extent[axis] == 0:
        return Markup("")
    best: dict[float, float] = {}
    for p, score in known:
        best[p[axis]] = max(score, best.get(p[axis], -np.inf))
    line = [[x, best[x]] for x in sorted(best)]
    top = max(line, key=lambda point: point[1])
    name = f"{'xyz'[axis]}" if len(points[0]) == 3 else "degree of freedom"
    title = "Log probability of each site, below the best"
    description = f"Over {name}; the best is at {shown(top[0], 4)}."
    drawn = [Line("", "revised", line), Line("", "revised", line, dots=True)]
    return lines("place-along", title, description, name, "nats", drawn, _DEEP)


def _position(site: Part) -> tuple[float, ...] | None:
    """Coordinates of a place; of a model without positions the number of its degree of freedom."""
    position = tuple(x for x in site.numbers("position") if x is not None)
    ids = site.labels("ids")
    if len(position) == 3:
        return position
    return (float(ids[0]),) if len(ids) == 1 and ids[0].isascii() and ids[0].isdecimal() else None


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
    yield table("energy", "Shares of the energy by which stiffness and shapes disagree", ("site", "share"), rows)


SECTION = PageSection("where", 30, "Where", where)

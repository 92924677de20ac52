"""Physics without a name: the field along the structure with its uncertainty, and its values."""

from collections.abc import Callable, Iterator

import numpy as np

from mouse_cli.page.html import Markup
from mouse_cli.page.lines import Line, lines
from mouse_cli.page.numbers import shown
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import paragraphs, place
from mouse_cli.page.tables import Cell, table
from mouse_cli.report.reading import Part

_SHOWN = 2.0  # sd from which on a value is listed by itself
_THIN = 0.05  # of the length: how far sites may lie off the line
_UNITS = {
    "stiffness": "%",
    "mass": "%",
    "bed": "EI/L^4",
    "axial": "EI/L^2",
    "force": "of that motion",
    "law": "of the static stiffness",
}


def field(document: Part) -> Iterator[Markup]:
    """The drawing with the band of two standard deviations, then the values that differ from none."""
    found = document.part("verdict").part("field")
    if not found:
        return
    rows, others = significant(found)
    yield _drawn(found)
    words = words_of(found)
    cells = [(name, Cell(each.number("value"), value), sd) for each in rows for name, value, sd in [words(each)]]
    yield table("field-values", title(found), ("site", "value", "sd"), cells)
    if others:
        yield paragraphs(f"{len(others)} sites with negligible values (below two sd) left out.")


def title(found: Part) -> str:
    """What the field is of."""
    kind = found.text("property")
    known = {
        "bed": "Bed stiffness",
        "axial": "Axial force",
        "force": "Force of unknown law",
        "law": "Stiffness at one site, mode by mode,",
    }
    return known.get(kind, f"Change of {kind}") + " without a name"


def significant(found: Part) -> tuple[list[Part], list[Part]]:
    """Values that differ from 0 by more than two standard deviations, or the largest, in their order; and the others."""
    every = found.parts("sites")
    size = lambda each: abs(each.number("value") or 0.0)
    chosen = [each for each in every if size(each) > _SHOWN * (each.number("sd") or 0.0)]
    chosen = chosen or sorted(every, key=lambda each: -size(each))[:1]
    return chosen, [each for each in every if each not in chosen]


def words_of(found: Part) -> Callable[[Part], tuple[str, str, str]]:
    """Site, value and sd of a value in words, with the unit of the field."""
    unit, by = _UNITS.get(found.text("property"), ""), _factor(found)
    amount = lambda x, digits: "–" if x is None else f"{shown(by * x, digits)} {unit}".strip()
    return lambda each: (place(each), amount(each.number("value"), 3), amount(each.number("sd"), 2))


def _factor(found: Part) -> float:
    return 100.0 if _UNITS.get(found.text("property")) == "%" else 1.0


def _drawn(found: Part) -> Markup:
    """Value and band over the coordinate, or over the number of the site where sites are not in one line."""
    every = [s for s in found.parts("sites") if s.number("value") is not None and s.number("sd") is not None]
    if len(every) < 2:
        return Markup("")
    at, name = _along(every)
    by = _factor(found)
    value, sd = (by * np.array([s.number(key) for s in every]) for key in ("value", "sd"))
    order = np.argsort(at, kind="stable")
    at, value, sd = at[order], value[order], sd[order]
    points = lambda y: np.column_stack([at, y]).tolist()
    outline = points(value + 2 * sd) + points(value - 2 * sd)[::-1]
    drawn = [Line("two sd", "band", outline, filled=True), Line("value", "revised", points(value))]
    top = int(np.argmax(np.abs(value)))
    unit = _UNITS.get(found.text("property"), "")
    largest = f"{shown(value[top], 3)} {unit}, sd {shown(sd[top], 2)}, at {shown(at[top], 4)}"
    description = f"Over {name}; the largest value is {largest}."
    return lines("field-along", title(found), description, name, unit, drawn)


def _along(every: list[Part]) -> tuple[np.ndarray, str]:
    points = [[x for x in s.numbers("position") if x is not None] for s in every]
    if all(len(p) == 3 for p in points):
        extent = np.ptp(np.array(points), axis=0)
        axis = int(extent.argmax())
        if extent[axis] > 0 and np.delete(extent, axis).max() <= _THIN * extent[axis]:
            return np.array(points)[:, axis], "xyz"[axis]
    return np.arange(1.0, len(every) + 1), "number of the site"


def _beside(document: Part) -> bool:
    """Whether it is one of several, which are evidence, and not the answer."""
    return document.part("verdict").text("kind") == "one-of"


SECTION = PageSection("field", 15, "Physics without a name", field, _beside)

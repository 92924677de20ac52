"""Mode shapes: MAC matrices of test and model, from the measured components."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.dynamics.correlation import mac
from mouse_cli.page.html import Markup
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import paragraphs
from mouse_cli.page.tables import Cell, table
from mouse_cli.report.reading import Part

_MOST = 60  # modes of a matrix that is still read
_SHADES = (0.2, 0.4, 0.6, 0.8, 0.9)


def shapes(document: Part) -> Iterator[Markup]:
    """MAC of every measured mode with every paired mode of the model, revised and prior."""
    components = document.parts("shapes")
    modes = list(dict.fromkeys(c.label("mode") for c in components))
    if not 0 < len(modes) <= _MOST:
        return
    test = _columns(components, modes, "test")
    heads = ("test \\ model", *(f"mode {m}" for m in modes))
    yield paragraphs(
        "Rows are measured modes, columns the modes of the model that they are paired with. 1: the same shape."
    )
    for key in ("revised", "prior"):
        rows = zip(modes, mac(test, _columns(components, modes, key)).tolist(), strict=True)
        cells = [(f"mode {m}", *map(_shaded, values)) for m, values in rows]
        yield table(f"mac-{key}", f"MAC of the measured shapes with those of the {key} model", heads, cells)


def _columns(components: list[Part], modes: list[str], key: str) -> np.ndarray:
    """Components (s, m), NaN where one was not measured."""
    dofs = {name: i for i, name in enumerate(dict.fromkeys(c.label("dof") for c in components))}
    found = np.full((len(dofs), len(modes)), np.nan)
    column = {name: i for i, name in enumerate(modes)}
    for each in components:
        value = each.number(key)
        found[dofs[each.label("dof")], column[each.label("mode")]] = np.nan if value is None else value
    return found


def _shaded(value: float) -> Cell:
    return Cell(value, f"{value:.3f}", f"shade{sum(value >= edge for edge in _SHADES)}")


SECTION = PageSection("shapes", 60, "Likeness of mode shapes", shapes)

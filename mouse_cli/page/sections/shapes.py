"""Mode shapes: MAC matrices of test and model, from the measured components."""

from collections.abc import Iterator

from mouse_cli.dynamics.correlation import mac
from mouse_cli.page.html import Markup, tag
from mouse_cli.page.matrix import matrix, shade
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import paragraphs
from mouse_cli.page.tables import Cell, table
from mouse_cli.report.reading import Part, columns, updates

_MOST = 60  # modes of a matrix that is still read
_Matrix = tuple[str, str, Part, str]  # key for ids, name of the model, update with its components, and which of them


def shapes(document: Part) -> Iterator[Markup]:
    """MAC of every measured mode with every paired mode of the models before and after, drawn and as tables."""
    drawn, tables = [], []
    for key, name, found, which in _models(document):
        components = found.parts("shapes")
        modes = list(dict.fromkeys(c.label("mode") for c in components))
        if not 0 < len(modes) <= _MOST:
            continue
        values = mac(columns(components, modes, "test"), columns(components, modes, which)).tolist()
        title = f"MAC of the measured shapes with those of {name}"
        told = f"Diagonal: {', '.join(f'mode {m} {row[i]:.3f}' for i, (m, row) in enumerate(zip(modes, values, strict=True)))}."
        drawn.append(matrix(f"matrix-{key}", title, told, modes, values))
        cells = [(f"mode {m}", *map(_shaded, row)) for m, row in zip(modes, values, strict=True)]
        tables.append(table(f"mac-{key}", title, ("test \\ model", *(f"mode {m}" for m in modes)), cells))
    if drawn:
        yield paragraphs(
            "Rows are measured modes, columns the modes of the model that they are paired with. 1: the same shape."
        )
        yield tag("div", *drawn, class_="gallery matrices")
        yield from tables


def _models(document: Part) -> list[_Matrix]:
    """The models whose shapes are compared, the first as it was before."""
    if document.text("schema") == "mouse.result/1":
        return [(key, f"the {key} model", document, key) for key in ("prior", "revised")]
    return [(key, name, found, "revised") for key, name, found in updates(document)]


def _shaded(value: float) -> Cell:
    return Cell(value, f"{value:.3f}", shade(value)) if value == value else Cell(None, "–")


SECTION = PageSection("shapes", 60, "Mode shape correlation (MAC)", shapes)

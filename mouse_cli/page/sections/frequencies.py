"""Modes of test and model: frequencies, shapes and predictions."""

from collections.abc import Iterator

from mouse_cli.dynamics.correlation import mac
from mouse_cli.page.html import Markup, tag
from mouse_cli.page.matrix import matrix, shade
from mouse_cli.page.numbers import shown
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import differences, listed, paragraphs, shares
from mouse_cli.page.tables import Cell, Listing, columns_of, table
from mouse_cli.report.reading import Part, columns, updates


def methods(document: Part) -> Iterator[Markup]:
    """Bars of what is missed of each configuration, a table of guarantees, and all frequencies."""
    found = document.parts("methods")
    if not found:
        return
    titles = list(dict.fromkeys(c.text("title") for one in found for c in one.parts("configurations")))
    for number, title in enumerate(titles, 1):
        rows = [
            (one.text("method"), _words(part), part.number("rms_percent"))
            for one in found
            for part in _titled(one, title)
        ]
        yield shares(f"missed-{number}", f"Missed of the frequencies, rms: {title}", "In per cent.", rows)
    yield table(
        "methods", "Methods", ("method", "model of a structure", *_GUARANTEES.values()), map(_methods_row, found)
    )
    for number, title in enumerate(titles, 1):
        of = [(one.text("method"), part.parts("modes")) for one in found for part in _titled(one, title)]
        rows = [(method, *row) for method, modes in of for row in Listing("", "", _METHODS_MODES, modes).rows()]
        heads = ("method", *(column.head for column in _METHODS_MODES))
        yield table(f"methods-modes-{number}", f"Frequencies: {title}", heads, rows)
    refused = document.part("refused")
    yield listed([f"{key} was not used: {'; '.join(refused.texts(key))}" for key in refused.values])


_GUARANTEES = {
    "measured_modes": "reproduces the measured modes",
    "definiteness": "stays definite",
    "rigid_body_modes": "keeps rigid-body modes",
    "sparsity": "keeps zeros",
    "physical_meaning": "keeps its meaning",
}
_METHODS_MODES = columns_of(
    "mode: mode name | test, Hz: test_hz | before, Hz: prior_hz | off: prior_hz percent test_hz | "
    "after, Hz: revised_hz | off: revised_hz percent test_hz | MAC: mac 4"
)


def _titled(one: Part, title: str) -> list[Part]:
    return [part for part in one.parts("configurations") if part.text("title") == title]


def _words(part: Part) -> str:
    value = part.number("rms_percent")
    return (
        f"{shown(value, 3)} %{', fitted' if part.flag('fitted') else ''}" if value is not None else "has no such mode"
    )


def _methods_row(one: Part) -> tuple[object, ...]:
    given = one.part("guarantees")
    return (
        one.text("method"),
        "yes" if one.flag("physical") else "no",
        *(given.text(key) or "–" for key in _GUARANTEES),
    )


def _within(mode: Part) -> str:
    return "–" if mode.number("test_hz") is None else "no" if mode.flag("exceeds") else "yes"


_FREQUENCIES = columns_of(
    "mode: mode name | test, Hz: test_hz | sd of test: test_sd_hz 3 | prior, Hz: prior_hz | prior off: prior_hz percent test_hz | "
    "revised, Hz: revised_hz | sd of revised: sd_hz 3 | revised off: revised_hz percent test_hz | within its limits: () | "
    "prior MAC: prior_mac 4 | revised MAC: mac 4",
    _within,
)


def frequencies(document: Part) -> Iterator[Markup]:
    """Natural frequencies before and after, against the test. One figure and one table for each model that was updated."""
    for key, name, found in updates(document):
        modes = found.parts("modes")
        rows = [
            (f"mode {m.label('mode')}", m.number("test_hz"), m.number("prior_hz"), m.number("revised_hz"))
            for m in modes
        ]
        yield differences(f"off-{key}", f"Frequency error of {name}", rows)
        yield Listing(f"modes-{key}", f"Natural frequencies of test and {name}", _FREQUENCIES, modes).html()


_SHAPES_MOST = 60  # modes of a matrix that is still read
_Matrix = tuple[str, str, Part, str]  # key for ids, name of the model, update with its components, and which of them


def shapes(document: Part) -> Iterator[Markup]:
    """MAC of every measured mode with every paired mode of the models before and after, drawn and as tables."""
    drawn, tables = [], []
    for key, name, found, which in _models(document):
        components = found.parts("shapes")
        modes = list(dict.fromkeys(c.label("mode") for c in components))
        if not 0 < len(modes) <= _SHAPES_MOST:
            continue
        values = mac(columns(components, modes, "test"), columns(components, modes, which)).tolist()
        title = f"MAC of the measured shapes with those of {name}"
        diagonal = (f"mode {m} {row[i]:.3f}" for i, (m, row) in enumerate(zip(modes, values, strict=True)))
        drawn.append(matrix(f"matrix-{key}", title, f"Diagonal: {', '.join(diagonal)}.", modes, values))
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


SECTIONS = (
    PageSection("methods", 25, "Methods", methods),
    PageSection("frequencies", 40, "Frequencies", frequencies),
    PageSection("shapes", 60, "Mode shape correlation (MAC)", shapes),
)

"""Modes of test and model: frequencies, shapes and predictions."""

from collections.abc import Iterator

from mouse_cli.dynamics.correlation import mac
from mouse_cli.page.html import Markup, tag
from mouse_cli.page.matrix import matrix, shade
from mouse_cli.page.numbers import apart, shown, signed_per_cent
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import differences, listed, paragraphs, shares
from mouse_cli.page.tables import Cell, table
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
        rows = [row for one in found for part in _titled(one, title) for row in _modes(one.text("method"), part)]
        yield table(f"methods-modes-{number}", f"Frequencies: {title}", _METHODS_HEADS, rows)
    refused = document.part("refused")
    yield listed([f"{key} was not used: {'; '.join(refused.texts(key))}" for key in refused.values])


_GUARANTEES = {
    "measured_modes": "reproduces the measured modes",
    "definiteness": "stays definite",
    "rigid_body_modes": "keeps rigid-body modes",
    "sparsity": "keeps zeros",
    "physical_meaning": "keeps its meaning",
}
_METHODS_HEADS = ("method", "mode", "test, Hz", "before, Hz", "off", "after, Hz", "off", "MAC")


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


def _modes(method: str, part: Part) -> Iterator[tuple[object, ...]]:
    for mode in part.parts("modes"):
        test, prior, revised = (mode.number(key) for key in ("test_hz", "prior_hz", "revised_hz"))
        before, after = apart(prior, test), apart(revised, test)
        yield (
            method,
            Cell(mode.number("mode"), mode.label("mode")),
            test,
            prior,
            Cell(before, signed_per_cent(before)),
            revised,
            Cell(after, signed_per_cent(after)),
            Cell(mode.number("mac"), shown(mode.number("mac"), 4)),
        )


_FREQUENCIES_HEADS = (
    "mode",
    "test, Hz",
    "sd of test",
    "prior, Hz",
    "prior off",
    "revised, Hz",
    "sd of revised",
    "revised off",
    "within its limits",
    "prior MAC",
    "revised MAC",
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
        yield table(
            f"modes-{key}", f"Natural frequencies of test and {name}", _FREQUENCIES_HEADS, map(_frequencies_row, modes)
        )


def _frequencies_row(mode: Part) -> tuple[object, ...]:
    test, prior, revised = (mode.number(key) for key in ("test_hz", "prior_hz", "revised_hz"))
    before, after = apart(prior, test), apart(revised, test)
    within = "–" if test is None else "no" if mode.flag("exceeds") else "yes"
    return (
        Cell(mode.number("mode"), mode.label("mode")),
        test,
        Cell(mode.number("test_sd_hz"), shown(mode.number("test_sd_hz"), 3)),
        prior,
        Cell(before, signed_per_cent(before)),
        revised,
        Cell(mode.number("sd_hz"), shown(mode.number("sd_hz"), 3)),
        Cell(after, signed_per_cent(after)),
        within,
        Cell(mode.number("prior_mac"), shown(mode.number("prior_mac"), 4)),
        Cell(mode.number("mac"), shown(mode.number("mac"), 4)),
    )


_PREDICTED_HEADS = ("mode", "frequency, Hz", "sd, Hz", "sd")
_PREDICTED_MOST = 1000  # modes of the table


def predicted(document: Part) -> Iterator[Markup]:
    """Natural frequencies of a model before any test, with the uncertainty of its properties carried through."""
    if document.text("schema") != "mouse.modes/1":
        return
    modes = document.parts("modes")
    shown_of = (
        f"The first {_PREDICTED_MOST} of {len(modes)} natural frequencies"
        if len(modes) > _PREDICTED_MOST
        else "Natural frequencies"
    )
    yield table("predicted", f"{shown_of} of the model", _PREDICTED_HEADS, map(_predicted_row, modes[:_PREDICTED_MOST]))


def _predicted_row(mode: Part) -> tuple[object, ...]:
    hz, sd = mode.number("hz"), mode.number("sd_hz")
    share = 100 * sd / hz if sd is not None and hz else None
    words = "–" if share is None else f"{shown(share, 2)} %"
    return (Cell(mode.number("mode"), mode.label("mode")), hz, Cell(sd, shown(sd, 3)), Cell(share, words))


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
    PageSection("predicted", 41, "Natural frequencies", predicted),
    PageSection("shapes", 60, "Mode shape correlation (MAC)", shapes),
)

"""Methods of updating side by side: what each misses of what it was given, and of what it was not."""

from collections.abc import Iterator

from mouse_cli.page.html import Markup
from mouse_cli.page.numbers import apart, shown, signed_per_cent
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import listed, shares
from mouse_cli.page.tables import Cell, table
from mouse_cli.report.reading import Part


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
    yield table("methods", "Methods", ("method", "model of a structure", *_GUARANTEES.values()), map(_row, found))
    for number, title in enumerate(titles, 1):
        rows = [row for one in found for part in _titled(one, title) for row in _modes(one.text("method"), part)]
        yield table(f"methods-modes-{number}", f"Frequencies: {title}", _HEADS, rows)
    refused = document.part("refused")
    yield listed([f"{key} was not used: {'; '.join(refused.texts(key))}" for key in refused.values])


_GUARANTEES = {
    "measured_modes": "reproduces the measured modes",
    "definiteness": "stays definite",
    "rigid_body_modes": "keeps rigid-body modes",
    "sparsity": "keeps zeros",
    "physical_meaning": "keeps its meaning",
}
_HEADS = ("method", "mode", "test, Hz", "before, Hz", "off", "after, Hz", "off", "MAC")


def _titled(one: Part, title: str) -> list[Part]:
    return [part for part in one.parts("configurations") if part.text("title") == title]


def _words(part: Part) -> str:
    value = part.number("rms_percent")
    return (
        f"{shown(value, 3)} %{', fitted' if part.flag('fitted') else ''}" if value is not None else "has no such mode"
    )


def _row(one: Part) -> tuple[object, ...]:
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


SECTION = PageSection("methods", 25, "Methods", methods)

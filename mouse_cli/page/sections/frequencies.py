"""Natural frequencies before and after, against the test."""

from collections.abc import Iterator

from mouse_cli.page.html import Markup
from mouse_cli.page.numbers import apart, shown, signed_per_cent
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import differences
from mouse_cli.page.tables import Cell, table
from mouse_cli.report.reading import Part, updates

_HEADS = (
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
    """One figure and one table for each model that was updated."""
    for key, name, found in updates(document):
        modes = found.parts("modes")
        rows = [
            (f"mode {m.label('mode')}", m.number("test_hz"), m.number("prior_hz"), m.number("revised_hz"))
            for m in modes
        ]
        yield differences(f"off-{key}", f"Frequency error of {name}", rows)
        yield table(f"modes-{key}", f"Natural frequencies of test and {name}", _HEADS, map(_row, modes))


def _row(mode: Part) -> tuple[object, ...]:
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


SECTION = PageSection("frequencies", 40, "Frequencies", frequencies)

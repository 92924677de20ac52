"""Frequency response functions, fitted and held out, before and after."""

from collections.abc import Iterator

from mouse_cli.page.html import Markup
from mouse_cli.page.lines import Line, lines
from mouse_cli.page.numbers import shown
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import shares
from mouse_cli.page.tables import Cell, table
from mouse_cli.report.reading import Part

_HEADS = ("function", "lines", "before, dB", "after, dB", "FRAC before", "FRAC after")

_DEEP = 120.0  # dB below the highest value: more would flatten all else


def functions(document: Part) -> Iterator[Markup]:
    """Curves of the functions that are missed most, then a table for each measurement."""
    for key, kind in (("frf", "fitted"), ("held_out_frf", "held out")):
        for number, each in enumerate(document.parts(key), 1):
            rows = [_row(function) for function in each.parts("functions")]
            title = f"{each.text('title') or each.text('kind')}, {kind}, measurement {number}"
            drawn = [(name, f"{cell.words} dB", cell.value) for name, _, _, cell, *_ in rows]
            slug = f"{key}-{number}".replace("_", "-")
            for order, pair in enumerate(each.parts("curves"), 1):
                yield _curves(f"{slug}-curve-{order}", pair, each.text("kind"), kind)
            yield shares(f"{slug}-error", f"Median error of magnitudes after: {title}", "In dB.", drawn)
            yield table(slug, f"Median error of magnitudes: {title}", _HEADS, rows)


def _curves(slug: str, pair: Part, kind: str, which: str) -> Markup:
    """Measured, before and after, over frequency."""
    drawn = [
        Line(name, looks, pair.vectors(key, 2))
        for key, name, looks in (
            ("measured", "measured", "measured"),
            ("prior", "before", "prior"),
            ("baseline", "as it is", "prior"),
            ("revised", "after", "revised"),
        )
    ]
    title = f"{kind.capitalize()} {pair.label('output')} by {pair.label('input')}, {which}"
    told = f"Magnitudes of {' and '.join(line.name for line in drawn if line.points)} over frequency."
    return lines(slug, title, told, "frequency, Hz", "dB", drawn, _DEEP)


def _row(function: Part) -> tuple[object, ...]:
    before = "baseline" if "baseline_median_db" in function.values else "prior"
    keys = (f"{before}_median_db", "revised_median_db", f"{before}_frac", "revised_frac")
    cells = [Cell(function.number(key), shown(function.number(key), 3)) for key in keys]
    return (f"{function.label('output')} by {function.label('input')}", function.number("lines"), *cells)


SECTION = PageSection("functions", 65, "Frequency response functions", functions)

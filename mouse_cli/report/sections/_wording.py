"""Words that several sections share."""

from collections.abc import Iterable, Iterator
from math import isfinite

from mouse_cli import __version__
from mouse_cli._errors import Diagnostic
from mouse_cli._texts import capital
from mouse_cli.model.problem import Problem
from mouse_cli.model.result import ChiSquareTest
from mouse_cli.report.blocks import Table, Text, heads
from mouse_cli.report.section import Options

LEFT = "left"  # side at which a column of words starts
_BRIEF = 3  # remarks of a short report


def names(problem: Problem) -> tuple[str, ...]:
    """Names (p,) of the properties."""
    return tuple(p.name for p in problem.parameters)


def counted(count: int, one: str, many: str = "") -> str:
    """`count` with its noun.

    >>> counted(1, "datum", "data"), counted(20, "datum", "data"), counted(2, "mode")
    ('1 datum', '20 data', '2 modes')
    """
    return f"{count} {one if count == 1 else many or one + 's'}"


def finite(value: float) -> float | None:
    """A number for a cell, which stays empty where there is none."""
    return float(value) if isfinite(value) else None


def deck_table(problem: Problem) -> Table:
    """Which program, title and deck."""
    rows = ("program", f"mouse {__version__}"), ("title", problem.title.strip()), ("source", problem.source.path)
    return Table(heads("< | <"), rows)


def test_table(tests: tuple[ChiSquareTest, ...]) -> Table:
    """Chi-square tests, one a row."""
    columns = heads("<test | chi-square | degrees of freedom | probability of a larger value")
    return Table(columns, tuple((t.name, t.chi2, t.dof, t.p if t.dof else None) for t in tests))


def worded(found: Iterable[Diagnostic], options: Options) -> Iterator[Text]:
    """One paragraph a remark, with its place and advice; in a short report the first ones in brief, and how many more."""
    found = tuple(found)
    for remark in found[:_BRIEF] if options.short else found:
        place = f" ({remark.span})" if remark.span else ""
        parts = () if options.short else (remark.note, remark.help)
        more = "".join(f" {capital(part)}." for part in parts if part)
        yield Text(f"{remark.code}{place}: {remark.message}.{more}")
    if options.short and len(found) > _BRIEF:
        yield Text(f"and {len(found) - _BRIEF} more; `--full`")

"""Figures as inline SVG: bars, intervals and curves, each with a title and a description in words.

Widths are in units of which a column of the page is 400. What colour tells, form or words tell too.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import log10

from mouse_cli.page.html import Markup, join, tag
from mouse_cli.page.numbers import shown
from mouse_cli.page.svg import figure, tenth

_WIDTH, _LEFT, _RIGHT = 400.0, 8.0, 392.0
_LONGEST = 46  # characters of a label that fit beside what is said of it


@dataclass(frozen=True)
class Bar:
    """One line of a bar chart: its label, what is said at its end, and one length a series, None where unknown."""

    label: str
    words: str
    lengths: tuple[float | None, ...]


@dataclass(frozen=True)
class Interval:
    """One line of a chart of intervals: before as 0 +- 1, after as `centre` +- `half`, both in prior sd."""

    label: str
    words: str
    centre: float | None
    half: float | None


def bars(key: str, title: str, description: str, rows: Sequence[Bar], series: Sequence[str]) -> Markup:
    """Horizontal bars from a common zero; several series lie below each other, the last one filled."""
    lengths = [x for row in rows for x in row.lengths if x is not None]
    if not lengths:
        return Markup("")
    scale = _scale(min(0.0, *lengths), max(0.0, *lengths))
    top = 22.0 if len(series) > 1 else 4.0
    pitch = 20.0 + 9.0 * len(series)
    drawn = [_bar(row, top + i * pitch, scale) for i, row in enumerate(rows)]
    height = top + pitch * len(rows) + 4
    return _figure(key, title, description, height, [_legend(series) if len(series) > 1 else None, *drawn])


def intervals(
    key: str, title: str, description: str, rows: Sequence[Interval], series: Sequence[str] = ("prior", "posterior")
) -> Markup:
    """Both `series` of each parameter on the axis of the standard deviation of the first."""
    ends = [row.centre + sign * (row.half or 0.0) for row in rows if row.centre is not None for sign in (-1, 1)]
    if not ends:
        return Markup("")
    scale = _scale(min(-1.2, *ends), max(1.2, *ends))
    drawn = [_interval(row, 22.0 + 40.0 * i, scale) for i, row in enumerate(rows)]
    height = 22.0 + 40.0 * len(rows) + 4
    return _figure(key, title, description, height, [_legend(series), *drawn])


def curve(description: str, values: Sequence[float | None]) -> Markup:
    """Positive values one after another on a logarithmic axis, a mark at each."""
    known = [(i, log10(v)) for i, v in enumerate(values) if v is not None and v > 0]
    if len(known) < 2:
        return Markup("")
    low, high = min(y for _, y in known), max(y for _, y in known)
    step = (_RIGHT - _LEFT - 20) / known[-1][0]
    span = max(high - low, 1e-9)
    points = [(_LEFT + 10 + i * step, 130 - 95 * (y - low) / span) for i, y in known]
    line = tag("polyline", points=" ".join(f"{tenth(x)},{tenth(y)}" for x, y in points), class_="curve")
    marks = [tag("circle", cx=tenth(x), cy=tenth(y), r=3, class_="after") for x, y in points]
    words = [_words(_LEFT, 14, f"largest {shown(10**high, 3)}"), _words(_LEFT, 148, f"least {shown(10**low, 3)}")]
    last = _words(_RIGHT, 148, f"cycle {known[-1][0]}", "end")
    return _figure("chi-square", "Chi-square after each cycle", description, 154, [line, *marks, *words, last])


def _scale(low: float, high: float):
    """The function that turns a value into its place across the figure."""
    span = (high - low) or 1.0
    return lambda value: _LEFT + (_RIGHT - _LEFT) * ((value - low) / span)


def _bar(row: Bar, y: float, scale) -> Markup:
    pieces = [*_label(row.label, row.words, y + 12), _zero(scale, y + 15, y + 18 + 9 * len(row.lengths))]
    for i, length in enumerate(row.lengths):
        if length is None:
            continue
        ends = sorted((scale(0.0), scale(length)))
        looks = "after" if i == len(row.lengths) - 1 else "before"
        width = max(ends[1] - ends[0], 0.5)
        pieces.append(
            tag("rect", x=tenth(ends[0]), y=tenth(y + 17 + 9 * i), width=tenth(width), height=7, class_=looks)
        )
    return join(pieces)


def _interval(row: Interval, y: float, scale) -> Markup:
    pieces = [*_label(row.label, row.words, y + 12), _zero(scale, y + 15, y + 37)]
    pieces += _whisker(scale, 0.0, 1.0, y + 20, "before")
    if row.centre is not None:
        pieces += _whisker(scale, row.centre, row.half or 0.0, y + 31, "after")
    return join(pieces)


def _zero(scale, top: float, bottom: float) -> Markup:
    """The axis beside one line of a chart, so that it crosses no words."""
    place = tenth(scale(0.0))
    return tag("line", x1=place, x2=place, y1=tenth(top), y2=tenth(bottom), class_="axis")


def _whisker(scale, centre: float, half: float, y: float, looks: str) -> list[Markup]:
    low, high = tenth(scale(centre - half)), tenth(scale(centre + half))
    line = tag("line", x1=low, x2=high, y1=tenth(y), y2=tenth(y), class_=f"{looks} whisker")
    return [line, tag("circle", cx=tenth(scale(centre)), cy=tenth(y), r=3.5, class_=looks)]


def _legend(series: Sequence[str]) -> Markup:
    pieces, x = [], _LEFT
    for i, name in enumerate(series):
        looks = "after" if i == len(series) - 1 else "before"
        pieces.append(tag("rect", x=tenth(x), y=5, width=14, height=7, class_=looks))
        pieces.append(_words(x + 18, 13, name))
        x += 36 + 7 * len(name)
    return join(pieces)


def _label(label: str, words: str, y: float) -> list[Markup]:
    room = max(8, _LONGEST - len(words))
    short = label if len(label) <= room else f"{label[: room - 1]}…"
    return [_words(_LEFT, y, short), _words(_RIGHT, y, words, "end")]


def _words(x: float, y: float, words: str, anchor: str | None = None) -> Markup:
    return tag("text", words, x=tenth(x), y=tenth(y), text_anchor=anchor)


def _figure(key: str, title: str, description: str, height: float, pieces: Sequence[Markup | None]) -> Markup:
    return figure(key, title, description, (_WIDTH, height), *pieces)

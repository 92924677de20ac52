"""Several lines over one axis as inline SVG, with ticks at round numbers."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, floor, log10

from mouse_cli.page.html import Markup, tag
from mouse_cli.page.svg import figure, tenth

_WIDTH, _HEIGHT, _LEFT, _RIGHT, _TOP, _BOTTOM = 640.0, 304.0, 54.0, 626.0, 44.0, 262.0
_LEGEND = 130.0


@dataclass(frozen=True)
class Line:
    """Points (x, y) with a name and a class for its looks; joined, or each a dot, or the outline of a filled band."""

    name: str
    looks: str
    points: list[list[float]]
    dots: bool = False
    filled: bool = False


def lines(
    key: str, title: str, description: str, x: str, y: str, drawn: Sequence[Line], deep: float = float("inf")
) -> Markup:
    """`drawn` over the axes called x and y, down to `deep` below the highest point; empty without a point."""
    every = [point for line in drawn for point in line.points]
    if not every:
        return Markup("")
    low, high = ([pick(p[k] for p in every) for k in (0, 1)] for pick in (min, max))
    low[1] = max(low[1], high[1] - deep)
    across, upward = _scale(low[0], high[0], _LEFT, _RIGHT), _scale(low[1], high[1], _BOTTOM, _TOP)
    pieces = [*_grid(low[0], high[0], across, x, False), *_grid(low[1], high[1], upward, y, True)]
    for line in drawn:
        pieces.append(_drawn(line, [(across(a), upward(max(b, low[1]))) for a, b in line.points]))
    named = [line for line in drawn if line.name and line.points]
    pieces += [piece for i, line in enumerate(named) for piece in _named(line, _LEFT + i * _LEGEND * 1.3)]
    return figure(key, title, description, (_WIDTH, _HEIGHT), *pieces, class_="functions")


def _drawn(line: Line, at: list[tuple[float, float]]) -> Markup:
    if line.dots:
        return tag("path", d="".join(f"M{tenth(x)} {tenth(y)}h0" for x, y in at), class_=f"line dots {line.looks}")
    if line.filled:
        return tag("polygon", points=" ".join(f"{tenth(x)},{tenth(y)}" for x, y in at), class_=f"line {line.looks}")
    return tag("polyline", points=" ".join(f"{tenth(x)},{tenth(y)}" for x, y in at), class_=f"line {line.looks}")


def ticks(low: float, high: float, count: int = 6) -> list[float]:
    """Round numbers from `low` to `high`, about `count` of them.

    >>> ticks(0.0, 61.0), ticks(-3.0, 3.0, 4)
    ([0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0], [-2.0, 0.0, 2.0])
    """
    span = high - low
    if not 0 < span < float("inf"):
        return [low]
    rough = span / count
    base = 10.0 ** floor(log10(rough))
    step = next(m * base for m in (1, 2, 5, 10) if m * base >= 0.9 * rough)
    return [i * step for i in range(ceil(low / step - 1e-9), floor(high / step + 1e-9) + 1)]


def _scale(low: float, high: float, start: float, end: float):
    span = (high - low) or 1.0
    return lambda value: start + (end - start) * ((value - low) / span)


def _grid(low: float, high: float, scale, name: str, upward: bool) -> list[Markup]:
    found = []
    for value in ticks(low, high):
        at, words = tenth(scale(value)), f"{value:.6g}".replace("-", "−")
        if upward:
            found.append(tag("line", x1=_LEFT, x2=_RIGHT, y1=at, y2=at, class_="grid"))
            found.append(tag("text", words, x=_LEFT - 6, y=tenth(scale(value) + 4), text_anchor="end"))
        else:
            found.append(tag("line", x1=at, x2=at, y1=_TOP, y2=_BOTTOM, class_="grid"))
            found.append(tag("text", words, x=at, y=_BOTTOM + 16, text_anchor="middle"))
    if upward:
        return [*found, tag("text", name, x=4, y=_TOP - 10)]
    return [*found, tag("text", name, x=(_LEFT + _RIGHT) / 2, y=_HEIGHT - 6, text_anchor="middle")]


def _named(line: Line, x: float) -> list[Markup]:
    at = [(x + 13, 12.0)] if line.dots else [(x, 12.0), (x + 26, 12.0)]
    if line.filled:
        at = [(x, 7.0), (x + 26, 7.0), (x + 26, 17.0), (x, 17.0)]
    return [_drawn(line, at), tag("text", line.name, x=tenth(x + 32), y=16)]

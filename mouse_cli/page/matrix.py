"""Matrices of likeness, 0 to 1, as shaded squares in inline SVG."""

from collections.abc import Sequence

from mouse_cli.page.html import Markup, tag
from mouse_cli.page.svg import figure, tenth

SHADES = (0.2, 0.4, 0.6, 0.8, 0.9)  # where a darker shade begins
_WIDTH, _LEFT, _TOP = 320.0, 34.0, 26.0
_WRITTEN, _NAMED = 12, 24  # rows up to which each square holds its number, and rows and columns their names


def shade(value: float) -> str:
    """Class of the shade of `value`.

    >>> shade(0.0), shade(0.85), shade(1.0)
    ('shade0', 'shade4', 'shade5')
    """
    return f"shade{sum(value >= edge for edge in SHADES)}"


def matrix(key: str, title: str, description: str, names: Sequence[str], rows: Sequence[Sequence[float]]) -> Markup:
    """Rows and columns by `names`; NaN is left white. The numbers stand in a table beside it."""
    count = len(names)
    side = (_WIDTH - _LEFT - 4) / max(count, 1)
    pieces = [
        _square(value, _LEFT + j * side, _TOP + i * side, side, count)
        for i, row in enumerate(rows)
        for j, value in enumerate(row)
    ]
    for i, name in enumerate(names if count <= _NAMED else ()):
        middle = (i + 0.5) * side
        pieces.append(tag("text", name[:5], x=_LEFT - 5, y=tenth(_TOP + middle + 4), text_anchor="end"))
        pieces.append(tag("text", name[:5], x=tenth(_LEFT + middle), y=_TOP - 6, text_anchor="middle"))
    return figure(key, title, description, (_WIDTH, _TOP + count * side + 4), *pieces)


def _square(value: float, x: float, y: float, side: float, count: int) -> Markup:
    known = value == value
    looks = f"tile {shade(value) if known else 'unknown'}"
    drawn = tag("rect", x=tenth(x), y=tenth(y), width=tenth(side), height=tenth(side), class_=looks)
    if not known or count > _WRITTEN:
        return drawn
    words = tag(
        "text", f"{value:.2f}", x=tenth(x + side / 2), y=tenth(y + side / 2 + 4), text_anchor="middle", class_="tiled"
    )
    return Markup(drawn + words)

"""Matrices of likeness, 0 to 1, as shaded squares in inline SVG."""

from collections.abc import Sequence

from mouse_cli.page.html import Markup, tag

SHADES = (0.2, 0.4, 0.6, 0.8, 0.9)  # where a darker shade begins
_WIDTH, _LEFT, _TOP = 320.0, 34.0, 26.0
_WRITTEN, _NAMED = 12, 24  # rows up to which each square holds its number, and rows and columns their names


def shade(value: float) -> str:
    """Class of the shade of `value`.

    >>> shade(0.0), shade(0.85), shade(1.0)
    ('shade0', 'shade4', 'shade5')
    """
    return f"shade{sum(value >= edge for edge in SHADES)}"


def matrix(key: str, title: str, told: str, names: Sequence[str], rows: Sequence[Sequence[float]]) -> Markup:
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
        pieces.append(tag("text", name[:5], x=_LEFT - 5, y=_at(_TOP + middle + 4), text_anchor="end"))
        pieces.append(tag("text", name[:5], x=_at(_LEFT + middle), y=_TOP - 6, text_anchor="middle"))
    head = [tag("title", title, id=f"{key}-title"), tag("desc", told, id=f"{key}-told")]
    size = {"viewBox": f"0 0 {_WIDTH:g} {_at(_TOP + count * side + 4)}"}
    svg = tag("svg", *head, *pieces, role="img", aria_labelledby=f"{key}-title {key}-told", **size)
    return tag("figure", tag("figcaption", title), svg)


def _square(value: float, x: float, y: float, side: float, count: int) -> Markup:
    known = value == value
    drawn = tag(
        "rect",
        x=_at(x),
        y=_at(y),
        width=_at(side),
        height=_at(side),
        class_=f"tile {shade(value) if known else 'unknown'}",
    )
    if not known or count > _WRITTEN:
        return drawn
    words = tag(
        "text", f"{value:.2f}", x=_at(x + side / 2), y=_at(y + side / 2 + 4), text_anchor="middle", class_="tiled"
    )
    return Markup(drawn + words)


def _at(value: float) -> str:
    return f"{value:.1f}".removesuffix(".0")

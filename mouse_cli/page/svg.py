"""Inline SVG: a drawing with its title and its description in words, and how coordinates are written."""

from mouse_cli.page.html import Markup, tag


def svg(
    key: str, title: str, description: str, size: tuple[float, float], *pieces: Markup | None, **more: object
) -> Markup:
    """`pieces` in a drawing of `size`, width and height; `description` is read out where it cannot be seen."""
    head = [tag("title", title, id=f"{key}-title"), tag("desc", description, id=f"{key}-description")]
    more = {
        "role": "img",
        "aria_labelledby": f"{key}-title {key}-description",
        "viewBox": f"0 0 {tenth(size[0])} {tenth(size[1])}",
    } | more
    return tag("svg", *head, *pieces, **more)


def figure(
    key: str, title: str, description: str, size: tuple[float, float], *pieces: Markup | None, **more: object
) -> Markup:
    """The drawing under its title."""
    return tag("figure", tag("figcaption", title), svg(key, title, description, size, *pieces), **more)


def tenth(value: float) -> str:
    """A coordinate to a tenth; what is far beyond a drawing stays at its edge.

    >>> tenth(12.04), tenth(12.06)
    ('12', '12.1')
    """
    return f"{min(max(value, -1e4), 1e5):.1f}".removesuffix(".0")

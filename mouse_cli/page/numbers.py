"""Numbers as the page shows them; tables keep the whole number beside what is shown."""


def shown(value: float | None, digits: int = 5) -> str:
    """A number to so many digits that count; a dash where there is none.

    >>> shown(17.94151), shown(7.2e10), shown(None)
    ('17.942', '7.2e+10', '–')
    """
    if value is None:
        return "–"
    return f"{'−' if value < 0 else ''}{abs(value):.{digits}g}"


def signed_per_cent(value: float | None) -> str:
    """A difference in per cent with its sign.

    >>> signed_per_cent(6.2154), signed_per_cent(-0.012), signed_per_cent(None)
    ('+6.22 %', '−0.012 %', '–')
    """
    if value is None:
        return "–"
    size = f"{abs(value):.2f}" if 0.1 <= abs(value) < 1e4 else f"{abs(value):.2g}"
    return f"{'−' if value < 0 else '+'}{size} %"


def probable(p: float | None) -> str:
    """A probability as people read it.

    >>> probable(0.984), probable(0.99999), probable(1e-9), probable(None)
    ('0.984', '> 0.999', '< 0.001', '–')
    """
    return "–" if p is None else "> 0.999" if p > 0.999 else "< 0.001" if p < 0.001 else f"{p:.3f}"


def padded(values: list[float | None], count: int) -> list[float | None]:
    """As many values as `count`; None where there are none.

    >>> padded([1.5], 3), padded([1.5, 2.0, 3.0], 2)
    ([1.5, None, None], [1.5, 2.0])
    """
    return (values + [None] * count)[:count]


def apart(value: float | None, truth: float | None) -> float | None:
    """By how many per cent `value` is above `truth`; None where either is unknown or there is no truth to divide by."""
    if value is None or not truth:
        return None
    return 100.0 * (value / truth - 1.0)

"""Cross sections that PBARL and PBEAML of Nastran name by their dimensions (MSC Nastran Quick Reference Guide, PBARL).

Their vertical axis is y of the element: I1 is of bending in its x-y plane, and so Iz here. Open sections are sums of
rectangles; their torsion constant is the sum of b t^3 / 3 (Young and Budynas, Roark's Formulas, 7th ed., table 10.1). Closed
ones go by Bredt.
"""

from collections.abc import Callable
from math import pi

from mouse_cli.formats.yaml_deck.mesh_properties import circle, rectangle

Properties = dict[str, float]
_Rectangle = tuple[float, float, float, float]  # height along y, width along z, and its centre y, z


def _open(*parts: _Rectangle) -> Properties:
    """Of a section made of rectangles: A, Iy, Iz, Iyz about its centroid, J. Raises ValueError where one is of negative size."""
    if any(min(part[:2]) < 0 for part in parts):
        raise ValueError("walls that do not fit in")
    parts = tuple(part for part in parts if part[0] > 0 and part[1] > 0)
    A = sum(h * b for h, b, _, _ in parts)
    y0, z0 = (sum(part[0] * part[1] * part[k] for part in parts) / A for k in (2, 3))
    return {
        "A": A,
        "Iz": sum(b * h**3 / 12 + h * b * (y - y0) ** 2 for h, b, y, _ in parts),
        "Iy": sum(h * b**3 / 12 + h * b * (z - z0) ** 2 for h, b, _, z in parts),
        "Iyz": sum(h * b * (y - y0) * (z - z0) for h, b, y, z in parts),
        "J": sum(max(h, b) * min(h, b) ** 3 / 3 for h, b, _, _ in parts),
    }


def _solid(b: float, h: float) -> Properties:
    return rectangle(h, b)  # its width is along local y


def _ring(outer: float, inner: float) -> Properties:
    moment = pi * (outer**4 - inner**4) / 4
    thin = {"kappa_y": 0.5, "kappa_z": 0.5} if inner else {}
    return circle(2 * outer) | {"A": pi * (outer**2 - inner**2), "Iy": moment, "Iz": moment, "J": 2 * moment} | thin


def _box(b: float, h: float, top: float, side: float) -> Properties:
    return _unequal_box(b, h, top, top, side, side)


def _unequal_box(b: float, h: float, top: float, bottom: float, left: float, right: float) -> Properties:
    """Walls of four thicknesses; the pair along an axis carries the shear along it."""
    clear = h - top - bottom if left + right < b else -1.0
    y = (bottom - top) / 2
    found = _open((top, b, (h - top) / 2, 0), (bottom, b, (bottom - h) / 2, 0),
                  (clear, left, y, (left - b) / 2), (clear, right, y, (b - right) / 2))  # fmt: skip
    wide, high = b - (left + right) / 2, h - (top + bottom) / 2
    round_about = wide / top + wide / bottom + high / left + high / right
    kappas = {"kappa_y": h * (left + right) / found["A"], "kappa_z": b * (top + bottom) / found["A"]}
    return found | {"J": 4 * (wide * high) ** 2 / round_about} | kappas


def _i(h: float, bottom: float, top: float, web: float, low: float, high: float) -> Properties:
    """The web carries the shear along y, the flanges that along z."""
    clear = h - low - high
    found = _open((low, bottom, low / 2, 0), (clear, web, low + clear / 2, 0), (high, top, h - high / 2, 0))
    return found | {"kappa_y": web * h / found["A"], "kappa_z": 5 / 6 * (bottom * low + top * high) / found["A"]}


def _channel(b: float, h: float, web: float, flange: float) -> Properties:
    z = (b + web) / 2
    arms = ((flange, b - web, s * (h - flange) / 2, z) for s in (1, -1))
    return _open((h, web, 0, web / 2), *arms)


def _tee(b: float, h: float, flange: float, web: float) -> Properties:
    return _open((flange, b, h - flange / 2, 0), (h - flange, web, (h - flange) / 2, 0))


def _tee_aside(height: float, web: float, flange: float, thick: float) -> Properties:
    return _open((height, flange, 0, 0), (thick, web, 0, -(flange + web) / 2))


def _cross(arms: float, upright: float, h: float, thick: float) -> Properties:
    aside = (upright + arms / 2) / 2
    return _open((h, upright, 0, 0), (thick, arms / 2, 0, aside), (thick, arms / 2, 0, -aside))


def _h(inner: float, flanges: float, h: float, thick: float) -> Properties:
    aside = (inner + flanges / 2) / 2
    return _open((thick, inner, 0, 0), (h, flanges / 2, 0, aside), (h, flanges / 2, 0, -aside))


def _i1(overhang: float, web: float, clear: float, h: float) -> Properties:
    flange = (h - clear) / 2
    return _i(h, overhang + web, overhang + web, web, flange, flange)


def _channel1(overhang: float, web: float, clear: float, h: float) -> Properties:
    return _channel(overhang + web, h, web, (h - clear) / 2)


def _zed(overhang: float, web: float, clear: float, h: float) -> Properties:
    flange, aside = (h - clear) / 2, (overhang + web) / 2
    return _open(
        (h, web, 0, 0), (flange, overhang, (h - flange) / 2, -aside), (flange, overhang, (flange - h) / 2, aside)
    )


def _hat_up(side: float, bottom: float, h: float, b: float) -> Properties:
    legs = ((h - bottom, side, (h + bottom) / 2, s * (b - side) / 2) for s in (1, -1))
    return _open((bottom, b, bottom / 2, 0), *legs)


def _tee2(b: float, h: float, flange: float, web: float) -> Properties:
    return _open((flange, b, flange / 2, 0), (h - flange, web, (h + flange) / 2, 0))


def _angle(b: float, h: float, flat: float, upright: float) -> Properties:
    return _open((h, upright, h / 2, 0), (flat, b - upright, flat / 2, b / 2))


def _hat(h: float, thick: float, top: float, foot: float) -> Properties:
    aside = (top - thick) / 2
    legs = ((h - 2 * thick, thick, h / 2, s * aside) for s in (1, -1))
    feet = ((thick, foot + thick, thick / 2, s * (aside + foot / 2)) for s in (1, -1))
    return _open((thick, top, h - thick / 2, 0), *legs, *feet)


SHAPES: dict[str, tuple[int, Callable[..., Properties]]] = {  # how many dimensions, and what follows from them
    "ROD": (1, lambda r: _ring(r, 0.0)), "TUBE": (2, _ring), "TUBE2": (2, lambda r, t: _ring(r, r - t)), "BAR": (2, _solid),
    "BOX": (4, _box), "BOX1": (6, _unequal_box), "I": (6, _i), "I1": (4, _i1), "H": (4, _h), "CROSS": (4, _cross), "T": (4, _tee),
    "T1": (4, _tee_aside), "T2": (4, _tee2), "CHAN": (4, _channel), "CHAN1": (4, _channel1), "CHAN2": (4, _hat_up), "Z": (4, _zed),
    "L": (4, _angle), "HAT": (4, _hat),
}  # fmt: skip
CENTRED = {"ROD", "TUBE", "TUBE2", "BAR", "BOX", "I1", "H", "CROSS", "Z"}  # shear centre and centroid are at one point


def of_shape(kind: str, dimensions: list[float]) -> Properties | None:
    """A, Iy, Iz, J, Iyz and, where it is known, shares of shear; None where there is no such section."""
    try:
        found = SHAPES[kind][1](*dimensions)
    except (ZeroDivisionError, ValueError):
        return None
    return found if all(found[name] > 0 for name in ("A", "Iy", "Iz", "J")) else None

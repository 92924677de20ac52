"""What materials are like, and the units that their properties are quoted in: to tell a value in another unit from an odd value."""

from dataclasses import dataclass
from math import inf

GRAVITY = 9.80665


@dataclass(frozen=True)
class Material:
    """Ranges of Young's modulus, Pa, and of density, kg/m3, that handbooks give."""

    name: str
    E: tuple[float, float]
    density: tuple[float, float]


MATERIALS = (
    Material("steel", (185e9, 220e9), (7500, 8150)),
    Material("aluminium", (62e9, 78e9), (2550, 2900)),
    Material("concrete", (15e9, 50e9), (2000, 2700)),
    Material("timber", (5e9, 20e9), (300, 1000)),
    Material("titanium", (95e9, 125e9), (4300, 4800)),
    Material("copper", (105e9, 135e9), (8600, 9050)),
    Material("brass or bronze", (85e9, 125e9), (7400, 8900)),
    Material("cast iron", (80e9, 185e9), (6800, 7500)),
    Material("magnesium", (40e9, 47e9), (1700, 1900)),
    Material("glass", (45e9, 95e9), (2200, 2750)),
    Material("carbon composite", (40e9, 250e9), (1400, 1750)),
    Material("glass composite", (8e9, 55e9), (1500, 2150)),
    Material("masonry", (1e9, 25e9), (1500, 2500)),
    Material("plastic", (0.7e9, 6e9), (880, 1550)),
    Material("rubber", (5e5, 2e8), (850, 1600)),
    Material("lead", (13e9, 19e9), (11000, 11500)),
)
MODULI = {  # one of the unit in Pa
    "Pa": 1.0,
    "MPa": 1e6,
    "GPa": 1e9,
    "kPa": 1e3,
    "psi": 6894.757,
    "ksi": 6.894757e6,
    "kgf/mm2": 1e6 * GRAVITY,
    "kgf/cm2": 1e4 * GRAVITY,
}
DENSITIES = {  # one of the unit in kg/m3; of weights, by the mass that weighs so much
    "kg/m3": 1.0,
    "g/cm3": 1e3,
    "t/mm3": 1e12,
    "kg/mm3": 1e9,
    "kN/m3 (a weight)": 1e3 / GRAVITY,
    "N/m3 (a weight)": 1 / GRAVITY,
    "lb/in3": 27679.905,
    "lb/ft3": 16.018463,
}
_STRETCH_E, _STRETCH_DENSITY = 8.0, 4.0  # beyond the ranges: foams, smeared masses, softened joints are no mistakes


def known(E: float, density: float, loose: bool = False) -> str | None:
    """The material with such properties (Pa, kg/m3); loose: or somewhat like one. A density of 0 is that of every material.

    >>> known(2.1e11, 7850), known(2.1e5, 7850), known(2.1e11, 15000, loose=True)
    ('steel', None, 'steel')
    """
    e, d = (_STRETCH_E, _STRETCH_DENSITY) if loose else (1.0, 1.0)
    for each in MATERIALS:
        low, high = each.density if density else (-inf, inf)
        if each.E[0] / e <= E <= each.E[1] * e and low / d <= density <= high * d:
            return each.name
    return None

"""The units of a deck: consistent systems with seconds and hertz, and a name for what each number is in where none is declared."""

import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Units:
    """Names of the units of length, mass and force of a deck; metre: one of its units of length in m.

    Force is mass times length over s2, whatever the names are, since frequencies are in Hz.
    """

    length: str
    mass: str
    force: str
    metre: float = 1.0

    @property
    def declared(self) -> bool:
        """Whether the deck says what its units are."""
        return self != UNDECLARED

    def of(self, unit: str) -> str:
        """What is in `unit` in SI, in the units of the deck.

        >>> SYSTEMS["mm-t-N"].of("N m/rad"), SYSTEMS["in-lbf"].of("kg/m"), UNDECLARED.of("Pa"), UNDECLARED.of("1/s2")
        ('N mm/rad', 'slinch/in', '[force/length2]', '1/s2')
        """
        if self == SYSTEMS["SI"]:
            return unit
        names, plain = {"kg": self.mass, "N": self.force, "m": self.length}, unit.replace("Pa", "N/m2")
        found = re.sub(r"\b(kg|N|m)(?=\d?\b)", lambda at: names[at[1]], plain)
        return found if self.declared or found == plain else f"[{found}]"


UNDECLARED = Units("length", "mass", "force")
SYSTEMS = {
    "SI": Units("m", "kg", "N"),
    "mm-t-N": Units("mm", "t", "N", 1e-3),
    "mm-kg-mN": Units("mm", "kg", "mN", 1e-3),
    "m-t-kN": Units("m", "t", "kN"),
    "in-lbf": Units("in", "slinch", "lbf", 0.0254),
    "ft-lbf": Units("ft", "slug", "lbf", 0.3048),
}
KILOGRAM = {"kg": 1.0, "t": 1e-3, "slinch": 1 / 175.12683524647636, "slug": 1 / 14.593902937206364}
"""1 kg in units of mass, by their names."""


def system(units: Units) -> str:
    """Which of SYSTEMS it is; empty where nothing is declared."""
    return next((name for name, each in SYSTEMS.items() if each == units), "")

"""How numbers are written: as the printer of 1972 wrote them, or as people do now."""

from dataclasses import dataclass
from math import isinf, isnan

import numpy as np

STYLES = ("legacy", "modern")


@dataclass(frozen=True)
class Numbers:
    """Writes numbers in one of STYLES, with six significant digits; `digits`: modern ones with so many.

    >>> [Numbers("legacy")(v) for v in (12887.2, -0.670209, 0.0, 3)]
    ['1.28872+04', '-6.70209-01', '0.00000+00', '3']
    >>> [Numbers("modern")(v) for v in (12887.2, -0.670209, 0.0, 3)]
    ['12887.2', '-0.670209', '0', '3']
    """

    style: str = "legacy"
    digits: int = 6

    def __post_init__(self) -> None:
        if self.style not in STYLES:
            raise ValueError(f"numbers are written in one of the styles {', '.join(STYLES)}, not '{self.style}'")

    def __call__(self, value: float) -> str:
        """`value` as text: whole numbers as they are, NaN as nothing, others in the style."""
        if isinstance(value, int | np.integer):
            return str(int(value))
        value = float(value)
        if isnan(value):
            return ""
        if isinf(value):
            return "infinite" if value > 0 else "-infinite"
        return self._legacy(value) if self.style == "legacy" else f"{value + 0.0:.{self.digits}g}"

    @staticmethod
    def _legacy(value: float) -> str:
        """One digit before the point, five after it, exponent as sign and two digits without E (Table 5-1)."""
        mantissa, exponent = f"{value + 0.0:.5e}".split("e")
        return f"{mantissa}{exponent[0]}{int(exponent[1:]):02d}"

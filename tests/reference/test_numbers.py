"""Numbers as the report of 1972 prints them: Tables 5-1, 5-3 and 5-5."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mouse_cli.report.numbers import Numbers

LEGACY, MODERN = Numbers("legacy"), Numbers("modern")


@pytest.mark.parametrize(
    "printed",
    ["1.28872+04", "1.80676+01", "2.93227-01", "-6.70209-01", "5.12689+05", "1.13959+02", "4.33769-05"],
)
def test_numbers_of_the_report_come_back(printed: str) -> None:
    """Figures of Tables 5-1 and 5-5, read as FORTRAN reads them and printed again."""
    assert LEGACY(float(re.sub(r"([+-]\d\d)$", r"E\1", printed))) == printed


@pytest.mark.parametrize(
    ("value", "legacy", "modern"),
    [
        (0.0, "0.00000+00", "0"),
        (-0.0, "0.00000+00", "0"),
        (1.0, "1.00000+00", "1"),
        (9.999996, "1.00000+01", "10"),
        (-1e-100, "-1.00000-100", "-1e-100"),
        (1e300, "1.00000+300", "1e+300"),
        (np.float64(0.1), "1.00000-01", "0.1"),
        (np.int64(12), "12", "12"),
        (4, "4", "4"),
        (float("nan"), "", ""),
        (float("-inf"), "-infinite", "-infinite"),
    ],
)
def test_both_styles(value: float, legacy: str, modern: str) -> None:
    assert (LEGACY(value), MODERN(value)) == (legacy, modern)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_six_digits_are_kept(value: float) -> None:
    mantissa, sign, exponent = re.fullmatch(r"(-?\d\.\d{5})([+-])(\d{2,3})", LEGACY(value)).groups()
    assert f"{value + 0.0:.5e}" == f"{mantissa}e{sign}{exponent}"
    assert float(MODERN(value)) == pytest.approx(value, rel=5.1e-6, abs=1e-320)


def test_unknown_style() -> None:
    with pytest.raises(ValueError, match="legacy, modern"):
        Numbers("roman")

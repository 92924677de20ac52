"""Edit descriptors against fields that a real FORTRAN reader has read, with the refusals of the card rules
on top."""

import json
import math
from pathlib import Path

import pytest

from mouse_cli.formats.edit import FieldError, field_warnings, read_field

ORACLE = Path(__file__).resolve().parents[2].parent / "shared" / "fortran" / "oracle_fields.json"
if not ORACLE.exists():
    pytest.skip("the oracle's fields (shared/fortran) are not beside the repository", allow_module_level=True)

CASES = json.loads(ORACLE.read_text())["cases"]

# What the 1972 rules refuse although gfortran reads it: section 2 of the card rules.
LAX = {
    "comma",
    "one trailing blank after the exponent",
    "beyond the 1108 single range",
    "overflow of IEEE double",
    "underflow of IEEE double",
    "exponent only",
    "lone point",
    "Q exponent",
    "INF",
    "Infinity",
}


def _expected(case):
    """The value, or None for a refusal."""
    return None if case["note"] in LAX else case.get("value")


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case['format']}-{case['note']}-{case['mode']}")
def test_field_reads_as_fortran_read_it_or_is_refused(case):
    expected = _expected(case)
    if expected is None:
        with pytest.raises(FieldError) as raised:
            read_field(case["text"], case["format"])
        assert raised.value.reason and raised.value.help
        return
    value = read_field(case["text"], case["format"])
    assert value == expected and type(value) is type(expected)
    if isinstance(value, float):
        assert math.copysign(1, value) == math.copysign(1, expected)


def test_every_lax_case_is_in_the_oracle():
    assert {case["note"] for case in CASES} >= LAX


@pytest.mark.parametrize(
    ("format", "text", "value"),
    [
        ("E14.8", "           1E5", 0.001),
        ("E14.8", "85000         ", 850000.0),
        ("E16.8", "2               ", 2e7),
        ("E20.5", "             1806760", 18.0676),
        ("E14.8", "           1-5", 1e-13),
        ("E14.8", "      1.0E+00 ", 1.0),
        ("I8", "       +", None),
        ("I8", "      5-", None),
        ("E14.8", "       5.0-02 ", None),
        ("E14.8", "         1.0+ ", None),
        ("E14.8", "          1..0", None),
        ("E14.8", "         1_0.0", None),
        ("E14.8", "          ٣.٣", None),
        ("E14.8", "           NaN", None),
        ("E14.8", "       1.4E-39", None),
        ("E14.8", "       1.8E+38", None),
        ("E14.8", "       1.7E+38", 1.7e38),
        ("E14.8", "       1.5E-39", 1.5e-39),
        ("E14.8", "       0.0E-99", 0.0),
        ("I4", "12345", None),
    ],
)
def test_examples_of_the_rules(format, text, value):
    if value is None:
        with pytest.raises(FieldError):
            read_field(text, format)
    else:
        assert read_field(text, format) == value


@pytest.mark.parametrize(
    ("format", "text", "kinds"),
    [
        ("E14.8", "         85000", {"no-point"}),
        ("E14.8", "85000         ", {"no-point", "trailing-blank"}),
        ("E14.8", "         1 2.5", {"embedded-blank"}),
        ("E14.8", "1.5           ", set()),
        ("E14.8", "    1.28872+04", set()),
        ("I4", "  4 ", {"trailing-blank"}),
        ("I4", " 1 4", {"embedded-blank"}),
        ("I4", "   4", set()),
        ("I4", "0   ", set()),
    ],
)
def test_legal_but_suspicious_fields(format, text, kinds):
    assert {found.kind for found in field_warnings(text, format)} == kinds


def test_a_short_text_ends_the_record_and_a_padded_one_does_not():
    assert read_field("4", "I8") == 4 and read_field("4".ljust(8), "I8") == 40000000


def test_a_line_end_is_no_part_of_the_field():
    assert read_field("   4\r\n", "I4") == 4

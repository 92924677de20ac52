"""Edit descriptors: what is written reads back, whatever is legal can be written, bulk reading is single
reading."""

import math

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from mouse_cli.formats.edit import FieldError, read_field, read_fields, write_field
from mouse_cli.formats.edit.descriptor import LARGEST, SMALLEST, parse

FORMATS = st.sampled_from(["E14.8", "E16.8", "E20.5", "E8.3"])
REALS = st.floats(SMALLEST, LARGEST) | st.floats(1e-6, 1e6) | st.just(0.0)
ALPHABET = " 0123456789.+-EDe,N"


def _fields(format):
    """Texts of the field's width: numbers in every form, and noise."""
    width = parse(format).width
    number = st.from_regex(r"[+-]?(\d{0,9}\.\d{0,9}|\d{1,9})([ED][+-]?\d{1,2}|[+-]\d{1,2})?", fullmatch=True)
    placed = st.tuples(number, st.integers(0, 3)).map(lambda pair: (pair[0] + " " * pair[1])[-width:].rjust(width))
    return placed | st.text(ALPHABET, min_size=width, max_size=width)


def _read(text, format):
    try:
        return read_field(text, format)
    except FieldError:
        return None


@settings(max_examples=400, deadline=None)
@given(st.data(), FORMATS)
def test_whatever_a_field_holds_can_be_written_again(data, format):
    value = _read(data.draw(_fields(format)), format)
    if value is not None:
        text = write_field(value, format)
        assert len(text) == parse(format).width
        again = read_field(text, format)
        assert again == value and math.copysign(1, again) == math.copysign(1, value)


@settings(max_examples=400, deadline=None)
@given(REALS, st.booleans())
@example(5.960464477539063e-08, False)
def test_a_wide_field_holds_every_double(value, negative):
    value = -value if negative else value
    assert read_field(write_field(value, "E24.17"), "E24.17") == value


@settings(max_examples=400, deadline=None)
@given(REALS, st.booleans())
def test_fourteen_columns_hold_nine_digits(value, negative):
    value = -value if negative else value
    assert read_field(write_field(value, "E14.8"), "E14.8") == pytest.approx(value, rel=1e-8, abs=0)


@settings(max_examples=200, deadline=None)
@given(st.integers(-(10**8), 10**9), st.sampled_from(["I3", "I4", "I8"]))
def test_integers_read_back_or_do_not_fit(value, format):
    if len(str(value)) <= parse(format).width:
        assert read_field(write_field(value, format), format) == value
    else:
        with pytest.raises(FieldError):
            write_field(value, format)


@settings(max_examples=300, deadline=None)
@given(st.data(), st.sampled_from(["E14.8", "E20.5", "I4", "I8"]))
def test_bulk_reading_is_single_reading(data, format):
    texts = data.draw(st.lists(_fields(format), max_size=8))
    expected = [_read(text, format) for text in texts]
    if None in expected:
        with pytest.raises(FieldError) as raised:
            read_fields(texts, format)
        assert raised.value.index == expected.index(None)
    else:
        assert [repr(value) for value in read_fields(texts, format).tolist()] == [repr(value) for value in expected]


@pytest.mark.parametrize("value", [math.nan, math.inf, 1e-40, 2e38])
def test_what_no_card_holds_is_refused(value):
    with pytest.raises(FieldError):
        write_field(value, "E14.8")


def test_negative_numbers_give_up_the_leading_zero():
    assert write_field(-1.2345678e-25, "E14.8") in ("-1.2345678E-25", "-.12345678E-24")


@pytest.mark.parametrize("text", ["12345678901234", "-1234567890123", "12345678901+20", "-.12345678E+06"])
def test_a_full_field_is_written_as_full_again(text):
    value = read_field(text, "E14.8")
    assert read_field(write_field(value, "E14.8"), "E14.8") == value


@pytest.mark.parametrize("text", ["       1.4E-39", "       1.8E+38", "      1.0E-400", "      1.8E+400"])
def test_bulk_reading_keeps_the_range_of_the_1108(text):
    with pytest.raises(FieldError):
        read_fields([text], "E14.8")

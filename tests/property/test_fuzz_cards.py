"""Card decks with random damage: a Draft or a DeckError, soon, and nothing else."""

import random

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from mouse_cli._errors import DeckError, frame
from mouse_cli.formats import cards
from mouse_cli.formats.cards.show import describe
from mouse_cli.formats.draft import Draft

DECK = """\
FOUR MASSES
       2       2       2       0       2       2       1       1       2       3
       1       2
   1   1   2   2   0   0
   1   2
  1  1    1.0000E+03

  1  1            1.  2  1           -1.

                1.59                3.18
  1  1            .6  2  1            .8  1  2            .8  2  2           -.6

             .01             .02             .05             .05             .05
             .05
  1  1            1.  2  2            1.

  1  1     2.500D+02  1  2    -1.500D+02  2  2     2.650D+02

"""
pytestmark = pytest.mark.usefixtures("no_hang")


def _survives(deck, **options):
    try:
        draft = cards.read(deck, "deck.dat", **options)
    except DeckError as error:
        assert error.diagnostics
        found = error.diagnostics
    else:
        assert isinstance(draft, Draft)
        found = draft.diagnostics
    for diagnostic in found:
        assert diagnostic.code.startswith("MD1") and frame(diagnostic)
    assert len(found) < 400


def test_the_deck_itself_is_sound():
    assert cards.read(DECK, "deck.dat").diagnostics == []


@settings(max_examples=200, deadline=None)
@given(st.binary(max_size=2000))
@example(b"\xff\xfe")
@example(b"\n" * 5000)
@example(b" " * 100_000)
def test_random_bytes(data):
    _survives(data)


@settings(max_examples=200, deadline=None)
@given(st.text("0123456789 .+-ED\n", max_size=3000))
def test_random_numbers(text):
    _survives(DECK.splitlines()[0] + "\n" + text)


@settings(max_examples=300, deadline=None)
@given(st.integers(0, 2**32), st.booleans(), st.booleans())
def test_random_damage(seed, legacy, strip):
    _survives(_damaged(seed), legacy=legacy, strip_73_80=strip)


@settings(max_examples=50, deadline=None)
@given(st.integers(0, 2**32))
def test_any_deck_can_be_shown(seed):
    assert "Group 1" in describe(_damaged(seed))


def _damaged(seed):
    """A few random edits: characters changed, lines dropped, doubled, swapped or cut."""
    random_ = random.Random(seed)
    lines = DECK.split("\n")
    for _ in range(random_.randint(1, 4)):
        k = random_.randrange(len(lines))
        edit = random_.randrange(5)
        if edit == 0:
            lines.insert(k, random_.choice([*lines, ""]))
        elif edit == 1 and len(lines) > 1:
            del lines[k]
        elif edit == 2:
            lines[k] = lines[k][: random_.randrange(len(lines[k]) + 1)]
        else:
            at, line = random_.randrange(80), lines[k].ljust(80)
            lines[k] = line[:at] + random_.choice("0123456789 .-+E,\té") + line[at + 1 :]
    return "\n".join(lines)


@pytest.mark.parametrize("column", range(10))
@pytest.mark.parametrize("value", ["40000000", "99999999", "-9999999", "     999"])
def test_absurd_sizes_allocate_nothing(column, value):
    lines = DECK.split("\n")
    card = lines[1].ljust(80)
    lines[1] = card[: 8 * column] + value + card[8 * (column + 1) :]
    _survives("\n".join(lines))


def test_many_bad_fields_end_in_one_message():
    bad = "\n".join(["  1  1      1.0E5Q  2  2      1.0E5Q"] * 5000)
    lines = DECK.split("\n")
    with pytest.raises(DeckError) as raised:
        cards.read("\n".join([*lines[:16], bad, *lines[16:]]), "deck.dat")
    assert [d.code for d in raised.value.diagnostics][-1] == "MD128"


def test_many_warnings_are_counted():
    lines = DECK.split("\n")
    lines[16:17] = ["  1  1           250"] + ["  1  1           250"] * 3000
    draft = cards.read("\n".join(lines), "deck.dat")
    assert len(draft.diagnostics) < 50
    assert any("more warnings" in d.message for d in draft.diagnostics)

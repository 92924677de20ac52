"""Damaged decks: whatever is done to the bytes, the answer is a Draft or a DeckError, and soon."""

import random

import pytest

from mouse_cli._errors import DeckError, frame
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.formats.draft import Draft

DECK = b"""\
mouse: 1
title: A deck to be damaged
model:
  stiffness: {order: 3, entries: [[1,1,2.5e5],[1,2,-1.5e5],[2,2,2.65e5],[3,3,1.0]]}
  mass: {dense: [[1, 0, 0], [0, 2, 0], [0, 0, 3]]}
  labels: [base, mid, tip]
elements: {stiffness: [[1,1],[1,2],[2,2]], mass: [[3,3]]}
parameters:
  - {name: k1, nominal: 1.0e5, unit: N/m, sd: 5 %, lower: 0, upper: 2e5, transform: log, stiffness: [[1,1,1]]}
  - {name: k2, sd: 1.0e4, stiffness: [[1,1,1],[1,2,-1],[2,2,1]], mass: [[3,3,0.5]]}
prior: {correlations: [[k1, k2, 0.5]]}
test:
  modes:
    number: [1, 2]
    dofs: [base, 2, 3]
    frequency: [18.0, null]
    frequency_sd: 1 %
    shapes: [[1, 2], [3, ~], [.nan, 4]]
    shape_sd: [[0.1, 0.2], [0.1, 0.2], [0.1, 0.2]]
    scale: unit
run: {recursion: replaced, cycles: null, limit_sd: 3, fix_total_mass: false, print_partials: true}
"""
TOKENS = [
    b"[",
    b"]",
    b"{",
    b"}",
    b":",
    b",",
    b"&a ",
    b"*a",
    b"!!int ",
    b"|\n",
    b">\n",
    b"'",
    b'"',
    b"-",
    b"#",
    b"?",
    b"<<: ",
    b"null",
    b".inf",
    b"-.inf",
    b".nan",
    b"1e999",
    b"9" * 30,
    b"-1",
    b"0",
    b"5 %",
    b"\t",
    b"\x00",
    b"\xff",
    b"\xe2\x82\xac",
    b"%YAML 1.1\n",
    b"---\n",
    b"...\n",
    b"\r",
    b"[[]]",
    b"[]",
    b"{}",
    b"\\u0000",
    b'"\\0"',
    b"{file: x.mtx}",
    b"{file: .}",
]

pytestmark = pytest.mark.usefixtures("no_hang")


def byte_damage(rng: random.Random, deck: bytes) -> bytes:
    at, stop = sorted((rng.randrange(len(deck)), rng.randrange(len(deck))))
    kind = rng.randrange(5)
    if kind == 0:
        return deck[:at] + bytes([rng.randrange(256)]) + deck[at + 1 :]
    if kind == 1:
        return deck[:at] + rng.choice(TOKENS) + deck[at:]
    if kind == 2:
        return deck[:at] + deck[min(stop, at + 12) :]
    if kind == 3:
        return deck[:at]
    return deck[:at] + rng.choice(TOKENS) + deck[at + rng.randrange(1, 8) :]


def line_damage(rng: random.Random, deck: bytes) -> bytes:
    lines = deck.split(b"\n")
    i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
    kind = rng.randrange(4)
    if kind == 0:
        del lines[i]
    elif kind == 1:
        lines[i], lines[j] = lines[j], lines[i]
    elif kind == 2:
        lines.insert(i, lines[j])
    else:
        lines[i] = b" " * rng.randrange(8) + lines[i].lstrip()
    return b"\n".join(lines)


def outcome(deck: bytes, path: str) -> str:
    """What reading and assembling gave; any other exception is a failure of the test."""
    try:
        draft = yaml_deck.read(deck, path)
        assert isinstance(draft, Draft)
        assemble(draft)
    except DeckError as error:
        assert error.diagnostics
        for diagnostic in error.diagnostics:
            assert diagnostic.span is not None and frame(diagnostic)
        return error.diagnostics[0].code
    return "good"


def test_the_deck_is_good(tmp_path):
    assert outcome(DECK, str(tmp_path / "deck.yaml")) == "good"


@pytest.mark.parametrize("seed", range(8))
def test_damage_is_answered(seed, tmp_path):
    rng = random.Random(seed)
    outcomes = set()
    for _ in range(1000):
        deck = DECK
        for _ in range(rng.choice((1, 1, 1, 2, 4))):
            deck = rng.choice((byte_damage, byte_damage, line_damage))(rng, deck) or b"x"
        outcomes.add(outcome(deck, str(tmp_path / "deck.yaml")))
    assert len(outcomes) > 10, "the damage must reach many checks"


@pytest.mark.parametrize(
    "deck",
    [
        b"[" * 200_000,
        b"- " * 200_000,
        b"{a: " * 50_000,
        b"? " * 50_000,
        b"a: &a [*a, *a]",
        b"'" + b"x" * 1_000_000,
        b"a: " + b"&a " * 1000,
        b"!" * 100_000,
        b"\xef\xbb\xbf" * 1000,
        b"a: b\n" * 50_000,
        b"".join(b"k%d: 1\n" % i for i in range(50_000)),
        b"k: 1\n" + b"#" * 1_000_000,
    ],
    ids=range(12),
)
def test_hostile_decks_are_refused_soon(deck):
    assert outcome(deck, "deck.yaml") != "good"


def test_an_alias_bomb_is_refused_before_it_is_unfolded():
    lines = ["a0: &a0 [" + ",".join("[1,1,1]" for _ in range(10)) + "]"]
    lines += [f"a{i}: &a{i} [" + ",".join([f"*a{i - 1}"] * 10) + "]" for i in range(1, 12)]
    assert outcome("\n".join(lines).encode(), "deck.yaml") == "MD202"

"""Damaged decks of coupled and modified structures: an answer or diagnostics, never a traceback."""

import shutil
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from mouse_cli._errors import MouseError
from mouse_cli.coupling import couple, modify
from mouse_cli.formats.yaml_deck import coupled, modified

DECKS = Path(__file__).resolve().parents[2] / "decks" / "coupled"
COUPLED = """mouse: 1
couple:
  substructures: {a: {deck: portal_left.yaml}, b: {deck: portal_right.yaml, remove: false}}
  interfaces: [{a: [11TX, 11TY, 11RZ], b: [11TX, 11TY, 11RZ]}]
  connections:
    - {mass: 1.0, at: {a: 7TX}}
    - {spring: 100.0, dashpot: 2, at: {a: 7TX}, to: {b: 15TX}}
    - {absorber: {mass: 1, frequency: 6, damping_ratio: 0.1}, at: {b: 15TX}}
  responses: {a: 7TX, b: [15TX]}
  lines: {band: [2, 8], step: 2}
  modes: {count: 3, keep: [2], methods: [rubin]}
  truncate: 0.0
"""
MODIFY = """mouse: 1
modify:
  deck: portal_whole.yaml
  changes: [{mass: 3.0, at: 7TX}, {spring: 10, at: 7TX, to: 8TY}, {absorber: {mass: 1, tuned_to: 1}, at: 7TX}]
  targets: [{mode: 2, below: 6, by: mass, place: 7TX}]
  sweeps: [{mode: 2, by: spring, size: 10}]
  places: [7TX, 8TY]
  responses: [7TX]
  lines: {band: [2, 8], step: 2}
  count: 3
"""
WORDS = [
    "",
    "0",
    "-1",
    "1e400",
    ".nan",
    "null",
    "[]",
    "{}",
    "[[1]]",
    "{a: 1}",
    "x",
    "a",
    "7TX",
    "99TY",
    "true",
    "'",
    "*a",
    "12-TX",
    "\t",
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("decks")
    for path in DECKS.glob("*.yaml"):
        shutil.copy(path, folder)
    return folder


def damaged(text: str, cuts: list[tuple[int, int, str]]) -> str:
    """Tokens at some places replaced by words."""
    for at, length, word in cuts:
        at %= len(text)
        text = text[:at] + word + text[at + length :]
    return text


def tokens(text: str, draws: list[tuple[int, str]]) -> str:
    """Whole values between punctuation replaced by words."""
    import re

    for at, word in draws:
        found = list(re.finditer(r"[\w.]+", text))
        if found:
            one = found[at % len(found)]
            text = text[: one.start()] + word + text[one.end() :]
    return text


CUTS = st.lists(st.tuples(st.integers(0, 2000), st.integers(0, 12), st.sampled_from(WORDS)), min_size=1, max_size=2)
DRAWS = st.lists(st.tuples(st.integers(0, 500), st.sampled_from(WORDS)), min_size=1, max_size=2)


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(CUTS, DRAWS, st.booleans())
def test_coupled(folder, cuts, draws, whole):
    text = tokens(COUPLED, draws) if whole else damaged(COUPLED, cuts)
    try:
        couple(coupled.read(text, str(folder / "deck.yaml")))
    except MouseError as error:
        assert error.diagnostics and all(d.code and d.message for d in error.diagnostics)


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(CUTS, DRAWS, st.booleans())
def test_modified(folder, cuts, draws, whole):
    text = tokens(MODIFY, draws) if whole else damaged(MODIFY, cuts)
    try:
        modify(modified.read(text, str(folder / "deck.yaml")))
    except MouseError as error:
        assert error.diagnostics and all(d.code and d.message for d in error.diagnostics)

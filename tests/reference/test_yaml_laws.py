"""`laws:` of a deck: read, written, refused."""

import pytest

from mouse_cli._errors import DeckError
from mouse_cli.formats import read_deck
from mouse_cli.formats.yaml_deck.writer import write
from mouse_cli.model.local_law import LocalLaw

DECK = """mouse: 1
model:
  stiffness: {{order: 2, entries: [[1, 1, 5.0e4], [1, 2, -3.0e4], [2, 2, 3.0e4]]}}
  mass: {{diagonal: [1, 1]}}
laws:
  - {law}
"""
GAP = "{law: one-sided-gap, variant: negative side, at: [1, 2], values: {contact_stiffness: 2.0e4, clearance: 1.0e-3}}"


def read(tmp_path, law: str):
    path = tmp_path / "deck.yaml"
    path.write_text(DECK.format(law=law))
    return read_deck(path)


def test_a_law_is_read_and_written_again(tmp_path):
    problem = read(tmp_path, GAP)
    expected = LocalLaw("one-sided-gap", "negative side", (0, 1), {"contact stiffness": 2e4, "clearance": 1e-3})
    assert problem.laws == (expected,)
    (tmp_path / "again.yaml").write_text(write(problem)[0])
    assert read_deck(tmp_path / "again.yaml").laws == (expected,)


def test_the_variant_of_a_law_is_its_first_unless_given(tmp_path):
    found = read(tmp_path, "{law: cubic, at: [2], values: {cubic_stiffness: 1.0e8}}").laws[0]
    assert (found.variant, found.dofs) == ("hardening", (1,))


@pytest.mark.parametrize(
    ("law", "words"),
    [
        ("{law: cubic, at: [3], values: {cubic_stiffness: 1}}", "acts at '3'"),
        ("{law: cubic, at: [1, 1], values: {cubic_stiffness: 1}}", "expected one, or two different"),
        ("{law: cubic, at: [1], values: {clearance: 1}}", "has the sizes cubic_stiffness"),
        ("{law: cubic, at: [1], variant: positive side, values: {cubic_stiffness: 1}}", "has no variant"),
        ("{law: cubic, at: [1], values: {cubic_stiffness: 0}}", "must be positive"),
    ],
)
def test_a_law_that_cannot_be_is_refused_where_it_stands(tmp_path, law, words):
    with pytest.raises(DeckError) as refused:
        read(tmp_path, law)
    (found,) = refused.value.diagnostics
    assert found.code == "MD641" and words in found.message and found.span.line == 6

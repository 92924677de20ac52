"""The JSON documents of coupled and modified structures: every key is listed, and no other."""

import json

from pages import TOP
from test_reference import _documented, _paths, _told


def test_json_of_couple(tmp_path):
    """A deck with a connection, functions and reductions, so that every part of the document has an entry."""
    for name in ("portal_left.yaml", "portal_right.yaml"):
        (tmp_path / name).write_text((TOP / "decks" / "coupled" / name).read_text())
    text = (TOP / "decks" / "coupled" / "portal.yaml").read_text()
    (tmp_path / "deck.yaml").write_text(text + "  connections: [{mass: 1, at: {left: 7TX}}]\n")
    emitted = set(_paths(json.loads(_told("couple", tmp_path / "deck.yaml", "--json"))))
    assert emitted == _documented("mouse.coupling/1")


def test_json_of_modify(tmp_path):
    for name in ("portal_whole.yaml", "portal_calmed.yaml"):
        (tmp_path / name).write_text((TOP / "decks" / "coupled" / name).read_text())
    text = (
        (tmp_path / "portal_calmed.yaml")
        .read_text()
        .replace("  places:", "    - {mode: 1, by: absorber, size: 1}\n  places:")
    )
    (tmp_path / "deck.yaml").write_text(text)
    emitted = set(_paths(json.loads(_told("modify", tmp_path / "deck.yaml", "--json"))))
    assert emitted == _documented("mouse.modification/1")

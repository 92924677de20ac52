"""Masses that are lighter than in the deck, or gone, in recordings: truths integrated by scipy, the deck without them."""

from pathlib import Path

import numpy as np
import pytest
from test_record_diagnosis import STRUCTURE, answer
from two_masses import linear, record

from mouse_cli.diagnosis.extend.laws import with_linear
from mouse_cli.formats import read_deck
from mouse_cli.model.arrays import dense
from mouse_cli.terms.assembly import assembly
from mouse_cli.terms.laws import registry
from mouse_cli.updating.recordings.acting import Part
from mouse_cli.updating.recordings.records import records
from mouse_cli.updating.recordings.study import study


def heavier(deck: str, m: float) -> str:
    """The deck with m kg where scipy's second mass has 1 kg."""
    path = Path(deck)
    path.write_text(path.read_text().replace("mass: {diagonal: [1, 1]}", f"mass: {{diagonal: [1, {m}]}}"))
    return deck


def test_a_mass_that_is_lighter_than_in_the_deck_is_named_with_what_it_lost(tmp_path):
    found = answer(heavier(record(tmp_path, linear), 1.25))
    verdict, (size,) = found["verdict"], found["candidates"][0]["parameters"]
    assert (verdict["kind"], verdict["physics"], verdict["site"]["ids"]) == ("named", "mass-loss", [2])
    assert abs(size["value"] - 0.25) < 3 * size["sd"] and size["sd"] < 0.02


@pytest.mark.parametrize(("lost", "left"), [(0.3, 0.7), (1.2, None)])
def test_point_masses_of_a_structure_lose_what_is_lost(tmp_path, lost, left):
    text = Path(record(tmp_path, linear)).read_text()
    told = text[text.index("test:") :].replace("sensor: 1,", "sensor: 1TX,").replace("sensor: 2,", "sensor: 2TX,")
    (tmp_path / "structure.yaml").write_text(STRUCTURE + told)
    problem = read_deck(str(tmp_path / "structure.yaml"))
    own = study(problem, records(problem))
    at = next(one for one in own.places if one.site.ids == ("2TX",))
    deck = with_linear(problem, Part(at, registry()["mass-loss"], 0), np.array([lost]))
    if left is None:
        assert deck is None
        return
    M = dense(assembly(deck).matrices(deck.prior.mean)[1])
    where = [deck.structure.labels.index(f"{i}TX") for i in (1, 2)]
    assert M[where, where] == pytest.approx([1.0, left])

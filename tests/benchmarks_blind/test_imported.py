"""The blind benchmark of imported models: CalculiX makes a structure with a change, the deck says nothing of it."""

import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from benchmarks.blind.imported.__main__ import MODES, delivered, visible
from benchmarks.blind.imported.parts import Concealed, cards
from benchmarks.blind.imported.scoring import ALARM, CLEAN, NAMED, OPEN, WRONG, outcome
from benchmarks.blind.imported.structures import STRUCTURES
from benchmarks.blind.imported.trip import predicted
from mouse_cli import read_deck, write_deck
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.mechanisms import registry

TOP = Path(__file__).resolve().parents[2]


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not on the path")
def test_a_deck_of_the_panel_says_nothing_of_the_missing_stiffener(tmp_path):
    """Imported with its supports; its test has the frequencies of a panel whose stiffener is not there."""
    command = [sys.executable, "-m", "benchmarks.blind.imported", "--structures", "panel", "--kinds", "missing"]
    subprocess.run([*command, "--decks-only", "--output", str(tmp_path)], cwd=TOP, check=True, capture_output=True)
    (path,) = tmp_path.glob("*/panel.yaml")
    problem = read_deck(path)
    assert [each.name for each in problem.held.supports] == ["FOOT_1", "FOOT_2", "FOOT_3", "FOOT_4"]
    assert {group.name for group in problem.groups} == {"SKIN", *(f"STIFFENER_{k}" for k in (1, 2, 3, 4))}
    assert problem.test.m == 8 and len(problem.parameters) == 2


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not on the path")
def test_a_heavier_pad_on_the_ground_is_not_to_be_seen_and_a_softer_one_is():
    """Its nodes are held or nearly so: what it weighs moves nothing."""
    mesh = STRUCTURES["bracket"].build(np.random.default_rng(0))
    seen = {kind: visible(mesh, Concealed(kind, "PAD_1", size, {"ALU": 1.01})) for kind, size in
            {"control": 1.0, "heavier": 2.0, "softer": 0.5}.items()}  # fmt: skip
    assert seen["control"] < 1e-6 < seen["heavier"] < 1 < 100 < seen["softer"]


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not on the path")
def test_the_exported_job_predicts_modes_that_were_not_fitted(tmp_path):
    """One of four stiffeners of one material is softer; its share, put into the deck as a diagnosis does, fitted, back to ccx."""
    rng = np.random.default_rng(4)
    mesh, change = STRUCTURES["panel"].build(rng), Concealed("softer", "STIFFENER_3", 0.4, {"ALU": 1.02, "STEEL": 1.0})
    deck = delivered(tmp_path, "panel", mesh, change, rng)
    problem = read_deck(deck)
    recipes = reduced(problem, problem.prior.mean).recipes(registry()["stiffness-loss"])
    recipe = next(each for each in recipes if each.site(np.ones(1)).text == "element set STIFFENER_3")
    write_deck(recipe.extend(problem, np.array([0.5])), tmp_path / "extended.yaml")
    before, after = predicted(tmp_path / "panel.inp", tmp_path / "extended.yaml", mesh, change, MODES)
    assert before > 0.01 and after < 0.002  # at 0.1 % accuracy of the fitted ones


@pytest.mark.proof
@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not on the path")
def test_a_heavy_mass_on_a_thin_wall_is_looked_at_though_one_mode_hardly_moves_there(tmp_path):
    """At node 138: a force there makes seven modes of eight, and the eighth least of all places."""
    command = [sys.executable, "-m", "benchmarks.blind.imported", "--structures", "box", "--kinds", "mass"]
    given = ["--seed", "98402", "--decks-only", "--output", str(tmp_path)]
    subprocess.run([*command, *given], cwd=TOP, check=True, capture_output=True)
    problem = read_deck(next(tmp_path.glob("*/box.yaml")))
    places = reduced(problem, problem.prior.mean).places
    assert "138TX" in {problem.structure.labels[i] for i in places}


@pytest.mark.parametrize(
    ("kind", "name", "said", "text", "result"),
    [
        ("missing", "RIB_1", "named", "element set RIB_1", NAMED),
        ("missing", "RIB_1", "named", "element set RIB_2", WRONG),
        ("loose", "BOLT_1", "named", "the support BOLT_1, all directions", NAMED),
        ("loose", "BOLT_1", "named", "the support BOLT_10, TZ", WRONG),
        ("two", "BOLT_1 and BOLT_3", "named", "the supports BOLT_1 and BOLT_3, all directions, alike", NAMED),
        ("two", "BOLT_1 and BOLT_3", "named", "the support BOLT_1, all directions", WRONG),
        ("rubber", "all supports", "named", "all supports, along TZ and across it, alike", NAMED),
        ("softer", "RIB_1", "unknown", "element set RIB_1", OPEN),
        ("control", "", "named", "element set RIB_1", ALARM),
        ("control", "", "nothing-missing", "", CLEAN),
    ],
)
def test_an_answer_is_right_only_with_the_name_of_what_was_changed(kind, name, said, text, result):
    mesh = STRUCTURES["box"].build(np.random.default_rng(0))
    document = {"verdict": {"kind": said, "sites": [{"text": text, "position": None}] if text else []}}
    assert outcome(Concealed(kind, name), document, mesh)[0] == result


def test_feet_stand_on_springs_at_each_node_or_on_nothing():
    mesh = STRUCTURES["box"].build(np.random.default_rng(0))
    rubber = cards(mesh, Concealed("rubber", "all supports", 8e5, {}, 0.25))
    assert "*BOUNDARY" not in rubber and rubber.count("*SPRING") == 12
    assert rubber.count(f"\n1\n{5e4:.9e}\n") == 4 and rubber.count(f"\n3\n{2e5:.9e}\n") == 4  # four nodes a bolt
    two = cards(mesh, Concealed("two", "BOLT_1 and BOLT_3"))
    assert "*SPRING" not in two and two.count("*BOUNDARY") == 2

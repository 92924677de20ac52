"""The blind benchmark: its truth solver on closed forms, its decks, its scoring. `python -m benchmarks.blind` prints the tables."""

import dataclasses
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))
from benchmarks.blind import beams, chains, crack_sizes, cracks, decks, frames, plate, scoring, verify
from benchmarks.blind.test_data import CONFIGS, measured
from mouse_cli.formats import read_deck

needs_ccx = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
SCARCE = {
    "chain of nine equal masses": 1e-6,
    "thick free beam, L/h = 10, Timoshenko": 1e-3,
    "slender portal, Euler-Bernoulli": 3e-4,
}


@needs_ccx
@pytest.mark.parametrize("title", SCARCE)
def test_truths_agree_with_closed_forms(title):
    found, exact = verify.CHECKS[title]()
    assert found == pytest.approx(exact, rel=SCARCE[title])


@needs_ccx
@pytest.mark.parametrize(
    "family", [beams, chains, frames, plate], ids=lambda module: module.__name__.rsplit(".", 1)[-1]
)
def test_decks_hold_the_test_and_not_the_cause(family, tmp_path):
    """The deck of a structure with a mass is sound, holds data out, and is that of the structure without the mass."""
    case = next(case for case in family.cases("development", 7, 1) if case.truth == "mass")
    truth = case.make(case.inputs)
    test = measured(case, truth, CONFIGS["B"], ("B", 0))
    path = decks.write(tmp_path, "deck", case, test, CONFIGS["B"])
    problem = read_deck(path)
    assert problem.test.m == 5 and len(problem.hold_out.modes) == len(truth["frequency"]) - 5
    assert "mass" not in path.read_text().split("test:")[0].replace("type: mass", "").replace("mass: ", "")
    assert decks.answer(case, truth, ("B", 0))["groups"] == ("mass",)


def test_fresh_structures_are_others():
    drawn = {split: [case.inputs for case in chains.cases(split, 1, 2)] for split in ("development", "fresh")}
    assert all(a != b for a, b in zip(*drawn.values(), strict=True))
    assert drawn["fresh"] == [case.inputs for case in chains.cases("fresh", 1, 2)]


def test_noise_is_as_stated():
    """Over many draws: sd of frequencies 0.5 %, of shapes 3 % of the largest component."""
    case = next(chains.cases("development", 1, 1))
    flat = {"frequency": np.full(5, 10.0), "shapes": np.ones((5, len(case.sites))), "altered": np.full(5, 9.0)}
    tests = [measured(case, flat, CONFIGS["D"], (draw,)) for draw in range(400)]
    assert np.std([t.frequency for t in tests]) / 10 == pytest.approx(0.005, rel=0.1)
    assert np.std([t.shapes for t in tests]) == pytest.approx(0.03, rel=0.1)
    twice = [measured(case, flat, CONFIGS["D"], (draw,), "understated") for draw in range(400)]
    assert np.std([t.shapes for t in twice]) == pytest.approx(0.06, rel=0.1)


def test_faults_of_sensors():
    case = dataclasses.replace(
        next(chains.cases("development", 1, 1)), sensor_fault={"kind": "swap", "gain": 1.0, "pick": [0, 0]}
    )
    shapes = np.tile(np.linspace(0.1, 1, len(case.sites)), (5, 1))
    truth = {"frequency": np.ones(5), "shapes": shapes, "altered": np.ones(5)}
    quiet = dataclasses.replace(CONFIGS["A"], shape_sd=0.0)
    sound = measured(dataclasses.replace(case, sensor_fault={}), truth, quiet, ("A",)).shapes
    swapped = measured(case, truth, quiet, ("A",)).shapes
    assert (swapped != sound).any(axis=1).sum() == 2 and sorted(swapped[:, 0]) == sorted(sound[:, 0])


ANSWER = {"kind": "beam", "truth": "crack", "groups": ["local-stiffness"], "places": [[0.5, 0, 0]], "span": 1.0}
ANSWER |= {"outside": False, "tolerated": ["shear"]}


def _said(kind: str, group: str | None = None, x: float = 0.5) -> dict:
    site = [{"position": [x, 0, 0]}] if group else []
    return {
        "verdict": {"kind": kind, "group": group, "sites": site, "probability": 0.98 if group else None},
        "seconds": 1.0,
    }


@pytest.mark.parametrize(
    ("said", "outcome"),
    [
        (_said("named", "local-stiffness", 0.54), "right"),
        (_said("named", "local-stiffness + shear"), "right"),
        (_said("named", "local-stiffness", 0.56), "wrong"),
        (_said("named", "mass"), "wrong"),
        (_said("named", "local-stiffness + mass"), "wrong"),
        (_said("one-of", "local-stiffness"), "abstained"),
        (_said("unknown"), "abstained"),
        (_said("nothing-missing"), "missed"),
        ({"refused": "MD331", "seconds": 0.1}, "refused"),
    ],
)
def test_scores(said, outcome):
    assert scoring.scored(ANSWER, said).outcome == outcome


@pytest.mark.parametrize(("ids", "outcome"), [([3, 8], "right"), ([8, 3], "right"), ([4, 7], "wrong")])
def test_a_brace_is_where_both_of_its_ends_are(ids, outcome):
    """The other diagonal of a panel has the same middle."""
    said = _said("named", "brace")
    said["verdict"]["sites"][0]["ids"] = ids
    assert scoring.scored(ANSWER | {"groups": ["brace"], "ends": [[3, 8]]}, said).outcome == outcome


def test_scores_of_controls_and_of_causes_without_a_name():
    control = ANSWER | {"groups": [], "places": []}
    assert scoring.scored(control, _said("nothing-missing")).outcome == "right"
    assert scoring.scored(control, _said("named", "mass")).outcome == "wrong"
    outside = control | {"outside": True}
    assert [scoring.scored(outside, _said(kind)).outcome for kind in ("unknown", "one-of", "nothing-missing")] == [
        "right",
        "right",
        "missed",
    ]
    table = scoring.tables([scoring.scored(one, _said("nothing-missing")) for one in (control, ANSWER, outside)])
    assert "controls: 0 of 1 not said to lack nothing" in table


def test_a_cracked_cantilever_has_the_frequencies_of_its_closed_form():
    """Roots of the exact solution of two pieces, the rotational spring of the crack between them; it slides by next to nothing."""
    case = next(case for case in cracks.cases("development", 1, 40) if case.inputs["held"] == [["TX", "TY", "RZ"], []])
    inputs = case.inputs | {"axial": False}
    EI, L, a = inputs["E"] * inputs["I"], inputs["L"], inputs["place"]
    c = cracks.compliance(inputs["depth"], inputs["height"], EI)[2, 2]

    def condition(omega: float) -> float:
        k = (inputs["density"] * inputs["A"] * omega**2 / EI) ** 0.25
        rows = lambda x: np.array(
            [
                [np.sin(k * x), np.cos(k * x), np.sinh(k * x), np.cosh(k * x)],
                [np.cos(k * x), -np.sin(k * x), np.cosh(k * x), np.sinh(k * x)],
                [-np.sin(k * x), -np.cos(k * x), np.sinh(k * x), np.cosh(k * x)],
                [-np.cos(k * x), np.sin(k * x), np.cosh(k * x), np.sinh(k * x)],
            ]
        )
        A = np.zeros((8, 8))
        A[:2, :4], A[2:4, 4:] = rows(0.0)[:2], rows(L)[2:]
        A[4:, :4], A[4:, 4:] = rows(a), -rows(a)
        A[5, :4] += c * EI * k * rows(a)[2]
        return float(np.linalg.det(A))

    for hz in cracks.modes(inputs)[0][:4]:
        below, above = (condition(2 * np.pi * hz * (1 + side * 3e-4)) for side in (-1, 1))
        assert below * above < 0


def test_sizes_of_cracks_are_within_their_errors():
    """Three fits of the 200 of `python -m benchmarks.blind.crack_sizes`, and its table."""
    found = np.array([crack_sizes.errors(case, "A", 1) for case in cracks.cases("development", 1, 3)])
    assert np.abs(found[:, 0]).max() < 4 and (found[:, 1] > 0).all()
    assert "depth" in crack_sizes.table(found)


def test_sizes_are_scored_by_their_sd():
    own = {"name": "depth over height", "value": 0.3, "sd": 0.01}
    found = _said("named", "local-stiffness") | {"candidates": [{"parameters": [own]}]}
    one = scoring.scored(ANSWER | {"sizes": {"depth over height": 0.325}}, found)
    assert one.sizes == ((0.325, 0.3, 0.01),)
    assert "0 within 1.645 sd, 1 within 3 sd, mean of errors -2.50 sd" in scoring.sizes([one])

"""The sealed trials: seal, answer and open of the smallest trial; a broken seal is refused; the rules of scoring."""

import json
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))
from benchmarks.trials import draw
from benchmarks.trials import seal as sealing
from benchmarks.trials.__main__ import main
from benchmarks.trials.calibration import calibration_error, table
from benchmarks.trials.case import Blank, Mechanism
from benchmarks.trials.draw import trials
from benchmarks.trials.frame import frame
from benchmarks.trials.kinds import CLASSES, Kind, kinds
from benchmarks.trials.page import _outside
from benchmarks.trials.scoring import Scored, scored
from benchmarks.trials.test_data import QUALITIES, difference, measured, truth_of
from mouse_cli.formats import read_deck

SMALL = ["single/chain/mass"]


@pytest.fixture
def folder(tmp_path):
    sealing.seal(tmp_path / "trial", 3, 1, SMALL)
    return tmp_path / "trial"


def changed(folder: Path, key: str, value: object) -> None:
    lines = (folder / "seal.txt").read_text().splitlines()
    lines = [f"{key}: {json.dumps(value)}" if line.startswith(f"{key}:") else line for line in lines]
    (folder / "seal.txt").write_text("\n".join(lines) + "\n")


def test_seal_answer_open(folder, capsys):
    """An answer is given once, whatever was asked again; the page has its counts."""
    assert main(["answer", str(folder)]) == 0
    (answer,) = (folder / "answers").iterdir()
    before = answer.stat().st_mtime_ns
    assert main(["answer", str(folder)]) == 0 and answer.stat().st_mtime_ns == before
    assert json.loads(answer.read_text())["seconds"] > 0
    assert main(["open", str(folder), "--page", str(folder / "page.md")]) == 0
    text = (folder / "page.md").read_text()
    assert "| single |" in text and "Calibration" in text and json.dumps(SMALL[0].split("/")[1])[1:-1] in text
    assert "0 decks diagnosed" in capsys.readouterr().out


@pytest.mark.parametrize(
    "key, value", [("seed", 4), ("truths", "0" * 64), ("salt", "00"), ("kinds", ["single/chain/*"]), ("edition", 0)]
)
def test_what_was_not_sealed_is_refused(folder, key, value, capsys):
    changed(folder, key, value)
    assert main(["open", str(folder)]) == 1
    assert "sealed" in capsys.readouterr().err


def test_a_deck_that_was_changed_is_refused(folder):
    (deck,) = (folder / "decks").glob("*.yaml")
    deck.write_text(deck.read_text().replace("sd: 7 %", "sd: 70 %"))
    assert main(["answer", str(folder)]) == 1 and main(["open", str(folder)]) == 1
    assert not (folder / "answers").exists()


def test_a_truth_that_is_made_otherwise_is_refused(folder, monkeypatch):
    """Somebody who has seen an answer changes how truths are made."""
    monkeypatch.setattr(draw.Trial, "truth", lambda self: {"mechanisms": []})
    with pytest.raises(sealing.BrokenSeal, match="truths"):
        sealing.opened(folder)


def test_a_seed_may_be_withheld(tmp_path):
    sealing.seal(tmp_path, 3, 1, SMALL, secret=True)
    assert "seed: null" in (tmp_path / "seal.txt").read_text()
    with pytest.raises(sealing.BrokenSeal, match="--seed"):
        sealing.opened(tmp_path)
    with pytest.raises(sealing.BrokenSeal):
        sealing.opened(tmp_path, 4)
    assert len(sealing.opened(tmp_path, 3)) == 1


def test_decks_are_sound_and_say_nothing(tmp_path):
    """Every kind once: its deck is read without an error, and has no word of what is missing; names are names of one kind."""
    names = [kind.name for kind in kinds()]
    assert len(names) == len(set(names))
    for kind in (kind for kind in kinds() if not kind.error):
        blank, mechanisms = kind.made(7)
        test = measured(np.random.default_rng(1), blank, truth_of(blank, 5), QUALITIES["B"], 1, "")
        deck = sealing.write(tmp_path, "deck", draw.Trial(kind.name, "B", blank, mechanisms, test, "", 0.0))
        problem = read_deck(deck)
        assert problem.test.m == 4 and len(problem.hold_out.modes) == 1
        assert not any(own.kind in deck.read_text() for own in mechanisms if own.kind != "mass")


def test_the_seed_alone_decides():
    drawn = [[one.truth() for one in trials(seed, 4, ["*/chain/*"])] for seed in (1, 1, 2)]
    assert drawn[0] == drawn[1] != drawn[2]


def test_all_classes_are_drawn():
    plan = {name.split("/")[0] for name in (one.kind for one in trials(1, 12, ["*/chain/*", "*/storeys/*"]))}
    assert plan == set(CLASSES)


def test_what_parameters_make_up_for_is_not_felt():
    """A modulus 2 sd off costs its prior about 4, and the test thousands before the parameters are fitted."""

    def off(blank: Blank, rng: np.random.Generator) -> Mechanism:
        blank.priors["E columns"].scale(np.exp(2 * blank.priors["E columns"].sd))
        return Mechanism("a modulus")

    kind = Kind("single/frame/modulus", frame, (off,))
    after = truth_of(kind.made(5)[0], 5)
    raw = difference(truth_of(kind.made(5, 0)[0], 5), after, QUALITIES["A"], 5)
    assert draw._felt(kind, 5, 0, after, "A") < 12 < 3000 < raw @ raw


def verdict(kind: str, physics: str, group: str, *at: float, **more: object) -> dict:
    sites = [{"kind": "node", "ids": [1], "position": [x, 0.0, 0.0], "text": f"x = {x}"} for x in at]
    named = {"kind": kind, "physics": physics, "group": group, "sites": sites, "probability": 0.95, "rivals": []}
    return {"verdict": named | more, "groups": [], "seconds": 1.0}


@pytest.fixture(scope="module")
def pair():
    """Two masses on a beam."""
    return next(trials(2, 1, ["several/beam/two masses"]))


def test_all_must_be_named_at_their_sites(pair):
    a, b = (one.at[0] for one in pair.mechanisms)
    near = pair.blank.near()
    two = ("mass + mass", "mass + mass")
    outcome = lambda *said: scored("x", pair, verdict("named", *said)).outcome
    assert outcome(*two, a, b) == outcome(*two, b + 0.9 * near, a) == "right"
    assert outcome("mass", "mass", a) == "part"
    assert outcome(*two, a, b + 1.1 * near) == outcome(*two, a, a) == "misplaced"
    assert outcome("mass + crack", "mass + local-stiffness", a, b) == "wrong"
    assert outcome("mass + mass + mass", "mass + mass + mass", a, b, b) == "wrong"
    assert scored("x", pair, verdict("one-of", *two, a, b)).outcome == "abstained"
    assert scored("x", pair, verdict("nothing-missing", None, None)).outcome == "missed"


def test_the_error_of_a_site_is_over_the_span(pair):
    a, b = (one.at[0] for one in pair.mechanisms)
    found = scored("x", pair, verdict("named", "mass + mass", "mass + mass", a, b + 0.03 * pair.blank.span))
    assert found.error == pytest.approx(0.03) and found.true


def test_one_of_two_is_true_and_not_complete(pair):
    """A name says that something is missing, not that nothing else is; how probable that is, what may act beside it says."""
    beside = [{"group": "mass", "probability": 0.7}, {"group": "none", "probability": 0.3}]
    said = lambda **more: scored("x", pair, verdict("named", "mass", "mass", pair.mechanisms[0].at[0], **more))
    found = said(companions=beside)
    assert (found.outcome, found.true, found.complete) == ("part", True, False)
    assert found.alone == pytest.approx(0.3 * found.probability)
    assert said(companions=beside[:1]).alone == 0.0
    assert said().alone == said(companions=[]).alone == found.probability


def test_supports_that_are_named_one_by_one_count_each():
    """They are one group, and three mechanisms."""
    feet = next(trials(1, 1, ["several/frame/three feet"]))
    said = verdict("named", " + ".join(["support-rotation"] * 3), "support")
    said["verdict"]["sites"] = [
        {"kind": "node", "ids": [], "position": list(own.at), "text": ""} for own in feet.mechanisms
    ]
    found = scored("x", feet, said)
    assert (found.outcome, found.true, found.complete) == ("right", True, True)


def test_supports_that_are_alike_are_named_each():
    """All three feet of a frame, by one stiffness."""
    feet = next(trials(1, 1, ["several/frame/three feet"]))
    nodes = [
        key for key, at in feet.truth()["nodes"].items() if any(np.allclose(at[:2], m.at[:2]) for m in feet.mechanisms)
    ]
    said = verdict("named", "support-rotation", "support", None)
    said["verdict"]["sites"] = [{"kind": "node", "ids": nodes, "position": None, "text": "all alike"}]
    assert scored("x", feet, said).outcome == "right"
    said["verdict"]["sites"][0]["ids"] = nodes[:2]
    assert scored("x", feet, said).outcome == "part"


def test_a_name_on_a_control_is_a_false_alarm():
    control = next(trials(1, 1, ["control/chain/none"]))
    said = scored("x", control, verdict("named", "mass", "mass", 3.0))
    assert said.outcome == "wrong" and said.alarm and not said.true
    doubt = verdict("one-of", "mass", "mass", 3.0, rivals=["mass", "none"])
    assert not scored("x", control, doubt).alarm
    assert scored("x", control, verdict("unknown", None, None)).alarm
    assert scored("x", control, verdict("nothing-missing", None, None)).outcome == "right"


def test_only_declared_names_are_true_outside_of_the_library():
    bed = next(trials(1, 1, ["outside/beam/half bed"]))
    x = bed.mechanisms[0].at[0]
    assert scored("x", bed, verdict("named", "foundation", "foundation", x)).outcome == "right"
    assert scored("x", bed, verdict("named", "foundation", "foundation", bed.blank.span / 2 * 1.05)).outcome != "wrong"
    assert scored("x", bed, verdict("named", "ground-spring", "ground-spring", x)).outcome == "wrong"


def test_fields_are_scored_by_property_and_region():
    bed = next(trials(1, 1, ["outside/beam/half bed"]))
    inside = min(bed.blank.elements, key=lambda i: abs(bed.blank.elements[i][0] - bed.mechanisms[0].at[0]))
    far = min(bed.blank.elements, key=lambda i: -abs(bed.blank.elements[i][0] - bed.mechanisms[0].at[0]))
    field = lambda own, name, largest: {
        "property": name,
        "sites": [{"ids": [int(i)], "value": 2.0 if i == largest else 0.5, "sd": 0.1} for i in own],
    }
    said = lambda name, at: scored("x", bed, verdict("unknown", None, None, field=field((inside, far), name, at))).field
    assert said("bed", inside) == (True, True) and said("mass", far) == (False, False)
    assert scored("x", bed, verdict("unknown", None, None, field=None)).field == (None, None)


@pytest.mark.parametrize(("kind", "right"), [("beam/elastomer", "law"), ("beam/axial gradient", "axial")])
def test_what_a_truth_is_makes_a_property_right(kind, right):
    """A mount whose stiffness is its own in each mode is a law at one place; a bed along a beam is none."""
    one, bed = next(trials(1, 1, [f"outside/{kind}"])), next(trials(1, 1, ["outside/beam/half bed"]))
    site = {"ids": [int(next(iter(one.blank.elements)))], "value": 1.0, "sd": 0.1}
    said = lambda own: scored(
        "x", own, verdict("unknown", None, None, field={"property": right, "sites": [site]})
    ).field[0]
    assert said(one) is True and said(bed) is False


def test_what_is_held_out_is_predicted_by_the_model_of_the_answer():
    """Where there is no name that is the one with the field in it, not that of a mechanism which was rejected."""
    bed = next(trials(1, 1, ["outside/beam/half bed"]))
    held = lambda after: {"measured_hz": [100.0], "baseline": {"hz": [110.0]}, "revised": {"hz": [after]}}
    field = {"property": "mass", "sites": [{"ids": [1], "value": 1.0}], "held_out": held(101.0)}
    said = verdict("unknown", None, None, field=field)
    assert scored("x", bed, said | {"held_out": held(108.0)}).gain == pytest.approx((10.0, 1.0))
    said = verdict("one-of", "mass", "mass", 0.1)
    assert scored("x", bed, said | {"held_out": held(108.0)}).gain == pytest.approx((10.0, 8.0))


def test_no_model_halves_what_is_noise():
    """An error of less than twice the noise of a frequency is counted apart: the truth itself would leave the noise."""
    bed = next(trials(1, 1, ["outside/beam/half bed"]))
    noise = 100 * QUALITIES[bed.quality].frequency_sd
    gain = lambda before: Scored("x", bed, "abstained", "unknown", 1.0, gain=(before * noise, 0.4 * before * noise))
    text = _outside([gain(1.9), replace(gain(1.9), gain=(1.9 * noise, 1.8 * noise)), gain(2.1)])
    assert "half of the error in 2 of 3," in text and "in 1 of 1 where" in text


def test_calibration_error():
    p, true = np.array([0.92] * 10 + [0.55] * 10), np.array([1] * 9 + [0] + [1] * 5 + [0] * 5)
    assert calibration_error(p, true) == pytest.approx(0.5 * 0.02 + 0.5 * 0.05)
    assert "| 0.9 to 1.0 | 10 | 0.920 | 0.900 |" in table(list(zip(p, true.astype(bool), strict=True)))

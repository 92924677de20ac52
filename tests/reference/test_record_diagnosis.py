"""Diagnosis by recordings: truths integrated by scipy, decks read from files, answers by the command."""

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from proofs import proofs
from two_masses import linear, record

from mouse_cli.cli.main import cli


def answer(deck: str) -> dict:
    done = CliRunner().invoke(cli, ["diagnose", deck, "--json", "-q"])
    assert done.exit_code in (0, 1), done.output
    return json.loads(done.stdout)


def test_a_linear_record_lacks_nothing(tmp_path):
    found = answer(record(tmp_path, linear))
    assert found["verdict"]["kind"] == "nothing-missing" and found["exit_code"] == 0
    assert found["residual"]["chi2"] / found["residual"]["dof"] == pytest.approx(1, abs=0.1)


def test_the_zero_of_an_accelerometer_is_no_motion(tmp_path):
    """Amplifiers have one of their own: at 4 % of the rms the misfit was 20 times its degrees of freedom."""
    deck, run = record(tmp_path, linear), tmp_path / "run.npz"
    channels = dict(np.load(run))
    np.savez(run, f=channels.pop("f"), **{name: a + 0.04 * a.std() for name, a in channels.items()})
    found = answer(deck)
    assert found["verdict"]["kind"] == "nothing-missing" and found["noise"] is None
    assert found["residual"]["chi2"] / found["residual"]["dof"] == pytest.approx(1, abs=0.1)


def test_a_disturbing_force_that_nobody_measured_is_noise(tmp_path):
    """It leaves many times the accuracy of the channels, in the shape of the resonances."""
    found = answer(record(tmp_path, linear, disturbance=2.0))
    assert found["residual"]["chi2"] / found["residual"]["dof"] > 2
    assert found["verdict"]["kind"] == "nothing-missing" and found["exit_code"] == 0
    assert found["noise"]["explained"] < 0.1


@pytest.mark.proof
def test_a_law_is_found_above_a_disturbing_force(tmp_path):
    def law(u, v):
        F = 2e8 * (u[1] - u[0]) ** 3
        return np.array([-F, F])

    found = answer(record(tmp_path, law, disturbance=2.0))
    assert (found["verdict"]["physics"], found["verdict"]["site"]["ids"]) == ("cubic", [1, 2])


@pytest.mark.parametrize("sensors", [(2,), *proofs([((1, 2),)])])
def test_a_cubic_spring_between_two_masses(tmp_path, sensors):
    k3 = 2e8

    def law(u, v):
        F = k3 * (u[1] - u[0]) ** 3
        return np.array([-F, F])

    found = answer(record(tmp_path, law, sensors))
    verdict, leader = found["verdict"], found["candidates"][0]
    assert (verdict["kind"], verdict["physics"], verdict["site"]["ids"]) == ("named", "cubic", [1, 2])
    size = leader["parameters"][0]
    assert abs(size["value"] - k3) < 4 * size["sd"] + 0.01 * k3
    held = found["held_out"]["records"][0]
    assert max(held["error"]["with the cause"]) < 0.2 * max(held["error"]["as it is"])


@pytest.mark.parametrize(("place", "k", "g"), [([1, 2], 3.06e4, 3e-4), *proofs([([1], 2.04e4, 5e-4)])])
def test_play_in_a_spring_of_the_model(tmp_path, place, k, g):
    """No stop that is added: within the play the spring is not there."""

    def law(u, v):
        F = -k * np.clip(u[place[-1] - 1] - (u[0] if len(place) > 1 else 0.0), -g, g)
        return np.array([-F, F]) if len(place) > 1 else np.array([F, 0.0])

    found = answer(record(tmp_path, law))
    verdict, sizes = found["verdict"], found["candidates"][0]["parameters"]
    assert (verdict["kind"], verdict["physics"], verdict["site"]["ids"]) == ("named", "play", place)
    for size, true in zip(sizes, (k, g), strict=True):
        assert abs(size["value"] - true) < 3 * size["sd"] + 0.01 * true


def test_two_masses_that_no_spring_links_pound(tmp_path):
    def law(u, v):
        """The spring between the two stands on the ground instead."""
        x = u[1] - u[0]
        stop = 4e4 * max(-x - 2e-3, 0.0)
        return np.array([3.06e4 * x + stop, 3.06e4 * (u[1] - x) - stop])

    deck = Path(record(tmp_path, law))
    text = deck.read_text().replace("[[1, 1, 5.0e4], [1, 2, -3.0e4], [2, 2, 3.0e4]]", "[[1, 1, 2.0e4], [2, 2, 3.0e4]]")
    deck.write_text(text.replace("[[1, 1, 1], [1, 2, -1], [2, 2, 1]]", "[[2, 2, 1]]"))
    found = answer(str(deck))
    verdict, (stiffness, clearance) = found["verdict"], found["candidates"][0]["parameters"]
    assert (verdict["kind"], verdict["physics"], verdict["site"]["ids"]) == ("named", "one-sided-gap", [1, 2])
    assert stiffness["value"] == pytest.approx(4e4, rel=0.05)
    assert clearance["value"] == pytest.approx(2e-3, rel=0.15)  # a constant force on channel f is as free


def test_another_damping_in_one_direction(tmp_path):
    def law(u, v):
        F = 9.0 * max(v[1] - v[0], 0.0)
        return np.array([-F, F])

    found = answer(record(tmp_path, law))
    verdict, size = found["verdict"], found["candidates"][0]["parameters"][0]
    assert (verdict["kind"], verdict["physics"], verdict["site"]["ids"]) == ("named", "one-way-damping", [1, 2])
    assert size["value"] == pytest.approx(9.0, rel=0.05)


def test_friction_to_the_ground(tmp_path):
    """Regularised Coulomb friction: tanh of the velocity; no law of the library is exactly that."""
    found = answer(record(tmp_path, lambda u, v: np.array([6 * np.tanh(v[0] / 1e-3), 0.0])))
    assert found["verdict"]["kind"] != "nothing-missing"
    assert found["candidates"][0]["physics"] in ("coulomb", "friction", "iwan")
    assert found["candidates"][0]["site"]["ids"] == [1]


def test_the_extended_deck_lacks_nothing(tmp_path):
    def law(u, v):
        F = 3e4 * (u[1] - u[0] - np.clip(u[1] - u[0], -1.5e-3, 1.5e-3))
        return np.array([-F, F])

    deck, revised = record(tmp_path, law), str(tmp_path / "revised.yaml")
    done = CliRunner().invoke(cli, ["diagnose", deck, "--json", "-q", "-o", revised])
    assert json.loads(done.stdout)["verdict"]["physics"] == "gap"
    assert answer(revised)["verdict"]["kind"] == "nothing-missing"


STRUCTURE = """mouse: 1
model:
  structure:
    nodes: {line: {from: 0, to: 2, start: [0, 0, 0], end: [2, 0, 0]}}
    elements:
      - {id: 1, type: spring, nodes: [0, 1], stiffness: {TX: 2.0e4}, stiffness_damping: 1.2e-4}
      - {id: 2, type: spring, nodes: [1, 2], stiffness: {TX: 3.0e4}, stiffness_damping: 1.2e-4}
      - {id: 11-12, type: mass, nodes: [1, 2], mass: 1.0}
    supports: {0: [TX, TY, TZ, RX, RY, RZ]}
parameters:
  - {name: k, elements: 1-2, property: TX, each: 1, sd: 5 %}
"""


def test_damping_of_springs_is_uncertain_beside_their_stiffness(tmp_path):
    """Parameters that move both in proportion leave the damping, 10 % off, to be found as physics unless it is free by itself."""
    text = Path(record(tmp_path, linear)).read_text()
    told = text[text.index("test:") :].replace("sensor: 1,", "sensor: 1TX,").replace("sensor: 2,", "sensor: 2TX,")
    (tmp_path / "structure.yaml").write_text(STRUCTURE + told)
    assert answer(str(tmp_path / "structure.yaml"))["verdict"]["kind"] == "nothing-missing"


@pytest.mark.proof
def test_two_causes_at_two_places_and_the_deck_with_both_runs(tmp_path):
    """A clearance between the masses, and a spring to the ground that the deck does not have."""

    def law(u, v):
        F = 3e4 * (u[1] - u[0] - np.clip(u[1] - u[0], -1.5e-3, 1.5e-3))
        return np.array([-F, F + 4000 * u[1]])

    deck, revised = record(tmp_path, law), str(tmp_path / "revised.yaml")
    done = CliRunner().invoke(cli, ["diagnose", deck, "--json", "-q", "-o", revised])
    found = json.loads(done.stdout)
    assert found["verdict"]["kind"] == "named"
    causes = dict(zip(found["verdict"]["physics"].split(" + "), found["verdict"]["sites"], strict=True))
    assert {name: site["ids"] for name, site in causes.items()} == {"gap": [1, 2], "spring": [2]}
    sizes = {one["name"]: one["value"] for one in found["candidates"][0]["parameters"]}
    assert sizes["clearance"] == pytest.approx(1.5e-3, rel=0.02) and sizes["stiffness"] == pytest.approx(4000, rel=0.1)
    assert CliRunner().invoke(cli, ["run", revised, "-q"], standalone_mode=False).return_value == 0


def test_a_linear_cause_is_written_as_a_deck_that_lacks_nothing(tmp_path):
    deck, revised = record(tmp_path, lambda u, v: np.array([0.0, 6000 * u[1]])), str(tmp_path / "revised.yaml")
    done = CliRunner().invoke(cli, ["diagnose", deck, "--json", "-q", "-o", revised])
    assert json.loads(done.stdout)["verdict"]["physics"] == "spring"
    assert answer(revised)["verdict"]["kind"] == "nothing-missing"


MILLIMETRES = """mouse: 1
units: mm-t-N
model:
  stiffness: {order: 2, entries: [[1, 1, 50], [1, 2, -30], [2, 2, 30]]}
  mass: {diagonal: [1e-3, 1e-3]}
  damping: {order: 2, entries: [[1, 1, 6e-3], [1, 2, -3.6e-3], [2, 2, 3.6e-3]]}
parameters:
  - {name: k1, nominal: 20, sd: 5 %, stiffness: [[1, 1, 1]]}
  - {name: k2, nominal: 30, sd: 5 %, stiffness: [[1, 1, 1], [1, 2, -1], [2, 2, 1]]}
"""


def test_sizes_are_in_the_units_of_the_deck(tmp_path):
    """A cubic spring of 2e8 N/m3 has 0.2 N/mm3, to diagnose and to run alike; reports say which."""

    def law(u, v):
        F = 2e8 * (u[1] - u[0]) ** 3
        return np.array([-F, F])

    text = Path(record(tmp_path, law)).read_text()
    deck, revised = tmp_path / "millimetres.yaml", str(tmp_path / "revised.yaml")
    deck.write_text(MILLIMETRES + text[text.index("test:") :])
    done = CliRunner().invoke(cli, ["diagnose", str(deck), "--json", "-q", "-o", revised])
    size = json.loads(done.stdout)["candidates"][0]["parameters"][0]
    assert size["unit"] == "N/mm^3" and size["value"] == pytest.approx(0.2, rel=0.05)
    told = CliRunner().invoke(cli, ["run", revised, "-q"]).stdout
    assert "N/mm^3" in told and "N/m^3" not in told


def test_a_stop_much_softer_than_the_structure_is_no_smooth_spring(tmp_path):
    """A contact of 1.5 % of the structure's stiffness, over the rms stretch of its spring."""

    def stop(u, v) -> np.ndarray:
        force = 500.0 * max(u[1] - u[0] - 1e-3, 0.0)
        return np.array([-force, force])

    laws = ["--candidates", "one-sided-gap,cubic,quadratic"]
    found = json.loads(CliRunner().invoke(cli, ["diagnose", record(tmp_path, stop), "--json", "-q", *laws]).stdout)
    assert found["verdict"]["physics"] == "one-sided-gap" and found["candidates"][0]["probability"] > 0.95
    assert found["candidates"][0]["parameters"][0]["value"] == pytest.approx(500, rel=0.2)

"""Hum and drift that a deck does not state, on displacements that scipy integrated; once stated, nothing is missing."""

import json

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.signal import lsim
from two_masses import DECK, K, linear, record, shaking

from mouse_cli.cli.main import cli
from mouse_cli.formats import read_deck
from mouse_cli.updating.recordings.disturbed import disturbed, unmeasured
from mouse_cli.updating.recordings.records import records
from mouse_cli.updating.recordings.study import fitted, study
from mouse_cli.updating.recordings.tone import tone

RATE, FINER, SECONDS = 512, 8, 12.0
MOTOR = 11.3  # Hz


def rig(folder, hum: float, drift: float, stiffer: float = 1.01, motor: float = 0.0) -> str:
    """A deck whose record has a hum of 50 Hz and a slow drift, of so many times the rms of the channels; motor: N, of one on the
    first mass at MOTOR Hz.
    """
    rng, t = np.random.default_rng(9), np.arange(int(SECONDS * RATE * FINER)) / (RATE * FINER)
    f = 40 * shaking(t, rng) * np.minimum(t / 0.2, 1)
    A = np.block([[np.zeros((2, 2)), np.eye(2)], [-stiffer * K, -1.2e-4 * K]])
    forces = np.column_stack([motor * np.sin(2 * np.pi * MOTOR * t), f])
    x = lsim((A, np.eye(4)[:, 2:], np.eye(4)[:2], np.zeros((2, 2))), forces, t)[1][::FINER]
    t, f = t[::FINER, None], f[::FINER]
    x = x + x.std(axis=0) * (0.005 * rng.standard_normal(x.shape) + hum * np.sin(2 * np.pi * 50 * t + np.arange(2)))
    x = 1e3 * (x + x.std(axis=0) * drift * np.sin(2 * np.pi * t / 20))
    np.savez(folder / "run.npz", f=f, a1=x[:, 0], a2=x[:, 1])
    outputs = ", ".join(f"{{sensor: {i}, channel: a{i}, quantity: displacement, unit: mm}}" for i in (1, 2))
    (folder / "deck.yaml").write_text(DECK.format(rate=RATE, outputs=outputs))
    return str(folder / "deck.yaml")


@pytest.mark.parametrize(("hum", "drift", "keys"), [(0.04, 0.5, "mains: 50, drift: "), (0.05, 0.0, "mains: 50 ")])
def test_what_to_state_is_said(tmp_path, hum, drift, keys):
    problem = read_deck(rig(tmp_path, hum, drift))
    own = study(problem, records(problem))
    assert f"Write {keys}" in disturbed(own, fitted(own, None))


def test_no_law_is_sought_for_it_and_once_stated_there_is_nothing_to_say(tmp_path):
    """All laws were tried for half a minute; where damping was left out of the deck, it ended in friction that was refuted."""
    deck = rig(tmp_path, 0.04, 0.5)
    found = json.loads(CliRunner().invoke(cli, ["diagnose", deck, "--json", "-q"]).stdout)
    (said,) = [one for one in found["cautions"] if "mains: 50" in one]
    assert found["verdict"]["kind"] == "nothing-missing" and len(found["candidates"]) <= 1
    keys = said.split("Write ")[1].split(" for the")[0].split(", ")
    lines = "".join(f"      {key}\n" for key in keys)
    text = (tmp_path / "deck.yaml").read_text()
    (tmp_path / "deck.yaml").write_text(text.replace("      inputs:", f"{lines}      inputs:"))
    again = json.loads(CliRunner().invoke(cli, ["diagnose", deck, "--json", "-q"]).stdout)
    assert again["verdict"]["kind"] == "nothing-missing" and not again["cautions"]


@pytest.mark.parametrize(("hum", "stiffer"), [(0.0, 1.01), (0.04, 1.6)], ids=["clean", "stiffer than its prior allows"])
def test_no_hum_is_blamed_for_what_the_structure_does(tmp_path, hum, stiffer):
    problem = read_deck(rig(tmp_path, hum, 0.0, stiffer))
    own = study(problem, records(problem))
    assert disturbed(own, fitted(own, None)) == ""


def test_a_motor_that_runs_is_no_hidden_oscillator(tmp_path):
    """Within a stretch its free state is any sinusoid: it was named with P > 0.999, and predicted what was held out."""
    deck = rig(tmp_path, 0.0, 0.0, motor=6.0)
    found = json.loads(CliRunner().invoke(cli, ["diagnose", deck, "--json", "-q"]).stdout)
    (said,) = [one for one in found["cautions"] if "steady tone" in one]
    assert found["verdict"]["physics"] is None and "mains: 11.3 " in said
    text = (tmp_path / "deck.yaml").read_text()
    (tmp_path / "deck.yaml").write_text(text.replace("      inputs:", "      mains: 11.3\n      inputs:"))
    again = json.loads(CliRunner().invoke(cli, ["diagnose", deck, "--json", "-q"]).stdout)
    assert again["verdict"]["kind"] == "nothing-missing"


@pytest.mark.parametrize(("motor", "stiffer"), [(6.0, 1.01), (0.0, 1.6)], ids=["motor", "resonance"])
def test_a_tone_is_steady_throughout(tmp_path, motor, stiffer):
    """What a random force drives through a light resonance is of no one amplitude and phase over the record."""
    problem = read_deck(rig(tmp_path, 0.0, 0.0, stiffer, motor))
    own = study(problem, records(problem))
    found = tone(own.spectrum, own.base, own.places)
    assert (found is not None) == (motor > 0)
    if found is not None:
        assert found.hz == pytest.approx(MOTOR, abs=0.005) and found.share > 0.5


@pytest.mark.parametrize("law", [False, True], ids=["unmeasured force", "cubic spring"])
def test_a_loud_force_that_nobody_measured_is_said_to_be_one(tmp_path, law):
    """Too loud to pass for noise, it was friction that was refuted; a law, which follows from the motion, is none."""
    of = (lambda u, v: 2e9 * (u[1] - u[0]) ** 3 * np.array([-1.0, 1.0])) if law else linear
    problem = read_deck(record(tmp_path, of, disturbance=0.0 if law else 12.0))
    own = study(problem, records(problem))
    said = unmeasured(own, fitted(own, None))
    assert said == "" if law else said.startswith("What the model leaves (") and "coherent with no measured force" in said

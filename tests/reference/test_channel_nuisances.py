"""Gain and delay of channels, hum and drift as a deck states them, against records that scipy integrated, then falsified."""

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from proofs import proofs
from test_channel_errors import late
from two_masses import RATE, SECONDS, linear, record

from mouse_cli.cli.main import cli
from mouse_cli.updating.recordings.disturbance import Disturbance

K3 = 2e8
T = np.arange(int(SECONDS * RATE)) / RATE
HUM = 3.0 * np.sin(2 * np.pi * 50.02 * T + 0.3) + 1.0 * np.cos(2 * np.pi * 150.06 * T)
DRIFT = 8.0 * np.sin(2 * np.pi * 0.11 * T + 1.0) + 0.5 * T


def cubic(u, v) -> np.ndarray:
    """A hardening spring between the masses."""
    force = K3 * (u[1] - u[0]) ** 3
    return np.array([-force, force])


def answer(folder: Path, law, keys: str, **channels) -> dict:
    """The answer to a record some of whose channels went through functions, with `keys` in the deck."""
    deck = Path(record(folder, law))
    kept = dict(np.load(folder / "run.npz"))
    np.savez(folder / "run.npz", **kept | {name: of(kept[name]) for name, of in channels.items()})
    deck.write_text(deck.read_text().replace("      sample_rate", f"      {keys}\n      sample_rate"))
    done = CliRunner().invoke(cli, ["diagnose", str(deck), "--json", "-q"])
    assert done.exit_code in (0, 1), done.output
    return json.loads(done.stdout)


def remark(found: dict, words: str) -> str:
    return next(one for one in found["remarks"] if words in one)


def test_a_gain_within_its_prior_is_no_missing_physics_and_is_reported(tmp_path):
    found = answer(tmp_path, linear, "gain_sd: 4 %", a1=lambda x: 1.05 * x)
    assert found["verdict"]["kind"] == "nothing-missing"
    value, sd = (
        float(one.strip("(sd)%+ ")) for one in remark(found, "gain of channel a1").split(": ")[1].split("%")[:2]
    )
    assert abs(value - 5.0) < 3 * sd + 0.1 and sd < 3


def test_a_delay_within_its_prior_is_no_missing_physics_and_is_reported(tmp_path):
    found = answer(tmp_path, linear, "delay_sd: 0.001", a2=lambda x: late(x, 0.7))
    assert found["verdict"]["kind"] == "nothing-missing"
    assert float(remark(found, "delay of channel a2").split(": ")[1].split()[0]) == pytest.approx(700 / RATE, abs=0.05)


@pytest.mark.parametrize(
    ("law", "keys", "added"),
    [
        (linear, "mains: 50", HUM),
        (linear, "drift: 1", DRIFT),
        (cubic, "{mains: 50, drift: 1}", HUM + DRIFT),
        *proofs([(linear, "{mains: 50, drift: 1}", HUM + DRIFT), (cubic, "mains: 50", HUM), (cubic, "drift: 1", DRIFT)]),
    ],
)
def test_hum_and_drift_that_are_stated_hide_nothing_and_are_no_physics(tmp_path, keys, added, law):
    keys = keys.strip("{}").replace(", ", "\n      ")
    found = answer(tmp_path, law, keys, a1=lambda x: x + added, a2=lambda x: x - 0.5 * added)
    assert "left out of every fit" in remark(found, "left out")
    if law is linear:
        assert found["verdict"]["kind"] == "nothing-missing"
    else:
        assert (found["verdict"]["kind"], found["verdict"]["physics"]) == ("named", "cubic")
        assert found["candidates"][0]["parameters"][0]["value"] == pytest.approx(K3, rel=0.03)


def test_a_sinusoid_of_the_mains_and_a_line_vanish_in_every_stretch():
    own, t = Disturbance(50.0, 0.5), np.arange(700) / 1000
    x = np.stack([np.sin(2 * np.pi * 50 * t + 0.4) + np.cos(2 * np.pi * 350 * t), 3 + 7 * t], axis=1)
    other = np.sin(2 * np.pi * 23.0 * t)
    assert np.abs(own.cleared(x, 1e-3)).max() < 1e-9
    assert np.abs(own.cleared_by(x, 1e-3, 300)).max() < 1e-9
    assert np.linalg.norm(own.cleared(other, 1e-3)) > 0.99 * np.linalg.norm(other)


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ("mains: 300", "half of the sample rate"),
        ("drift: -1", "half of the sample rate"),
        ("delay_sd: -1", "0 or more"),
        ("gain_sd: 2", "between 0 and 1"),
    ],
)
def test_what_no_record_has_is_refused(tmp_path, keys, words):
    deck = Path(record(tmp_path, linear))
    deck.write_text(deck.read_text().replace("      sample_rate", f"      {keys}\n      sample_rate"))
    done = CliRunner().invoke(cli, ["check", str(deck)], standalone_mode=False)
    assert done.return_value == 4 and "MD215" in done.output and words in done.output


@pytest.mark.parametrize(
    ("old", "new"),
    [("quantity: force", "quantity: force, delay_sd: 0.001"), ("{sensor: 2, channel: f, quantity: force, unit: N}",
                                                              "{sensor: ground, channel: f, unit: m/s2, gain_sd: 2 %}")],
)  # fmt: skip
def test_an_error_that_no_record_shows_is_refused(tmp_path, old, new):
    deck = Path(record(tmp_path, linear))
    deck.write_text(deck.read_text().replace(old, new))
    done = CliRunner().invoke(cli, ["check", str(deck)], standalone_mode=False)
    assert done.return_value == 4 and "MD646" in done.output


def test_noise_of_more_than_all_of_a_channel_is_refused(tmp_path):
    deck = Path(record(tmp_path, linear))
    deck.write_text(deck.read_text().replace("quantity: force", "quantity: force, noise_sd: 150 %"))
    done = CliRunner().invoke(cli, ["check", str(deck)], standalone_mode=False)
    assert done.return_value == 4 and "MD215" in done.output and "between 0 and 1" in done.output

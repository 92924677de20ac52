"""`mouse identify` as users call it: sources, exit codes, files."""

import json
import sys
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "property"))
import vibrating

from mouse_cli._errors import DeckError
from mouse_cli.cli.main import cli

OMEGA, _, _ = vibrating.modes(0.01)
DECK = """mouse: 1
title: chain
model:
  stiffness: {order: 3, entries: [[1,1,7.0e4],[1,2,-3.0e4],[2,2,6.5e4],[2,3,-3.5e4],[3,3,3.5e4]]}
  mass: {diagonal: [1.0, 1.2, 0.9]}
parameters:
  - {name: k1, nominal: 4.0e+4, sd: 10 %, stiffness: [[1,1,1]]}
test:
  frf: [{file: frf.npz}]
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    hz = np.arange(2.0, 80.0, 0.1)
    H, variance = vibrating.disturbed(
        vibrating.accelerance(hz, *vibrating.modes(0.01), [2]), 0.01, np.random.default_rng(3)
    )
    names = {"output_names": np.array(["1", "2", "3"]), "input_names": np.array(["3"]), "kind": "accelerance"}
    np.savez("frf.npz", frequency_hz=hz, H=H, variance=variance, **names)
    Path("chain.yaml").write_text(DECK)
    return tmp_path


def call(*arguments: str):
    return CliRunner().invoke(cli, ["identify", *arguments], standalone_mode=False)


def test_functions_become_a_piece_and_a_document(folder):
    done = call("frf.npz", "-o", "test.yaml", "--json")
    found = json.loads(done.stdout)
    assert done.return_value == 0 and found["schema"] == "mouse.identification/1" and found["trusted"]
    assert [mode["frequency_hz"] for mode in found["modes"]] == pytest.approx(OMEGA / 2 / np.pi, rel=1e-4)
    assert Path("test.yaml").read_text().count("\ntest:") == 1


def test_a_deck_becomes_a_deck_that_runs(folder):
    assert call("chain.yaml", "-o", "identified.yaml").return_value == 0
    run = CliRunner().invoke(cli, ["run", "identified.yaml", "--json"], standalone_mode=False)
    (k1,) = json.loads(run.stdout)["parameters"]
    assert abs(k1["posterior"] - 4e4) < 4 * k1["posterior_sd"] < 400


def test_a_recording_with_a_force_becomes_modes_in_one_command(folder):
    from scipy.signal import cont2discrete, dlsim

    omega, zeta, shapes = vibrating.modes(0.01)
    rate, random = 400.0, np.random.default_rng(4)
    force = random.standard_normal(60000)
    A = np.block([[np.zeros((3, 3)), np.eye(3)], [-np.diag(omega**2), -np.diag(2 * zeta * omega)]])
    B, C = np.r_[np.zeros(3), shapes[2]][:, None], shapes @ A[3:]
    whole = A, B, C, (shapes @ shapes[2])[:, None]
    system = (*cont2discrete(whole, 1 / rate, method="foh")[:4], 1 / rate)
    _, answers, _ = dlsim(system, force)
    answers += 0.01 * answers.std(axis=0) * random.standard_normal(answers.shape)
    table = np.column_stack([np.arange(60000) / rate, force, answers])
    np.savetxt("run.csv", table, delimiter=",", header="t,F,a1,a2,a3", comments="")
    done = call("run.csv", "--force", "3=F", "--response", "1=a1", "--response", "2=a2", "--response", "3=a3",
                "--lines", "4096", "--band", "5", "80", "--json", "-q")  # fmt: skip
    found = json.loads(done.stdout)
    assert done.return_value == 0, found["doubts"]
    for mode, hz in zip(found["modes"], OMEGA / 2 / np.pi, strict=True):
        assert mode["frequency_hz"] == pytest.approx(hz, rel=1e-3)
        assert mode["scale"] == "unit modal mass"


def test_repeats_without_a_force_are_one_answer(folder):
    """Four records of one test in four files; a deck of them likewise, of which --recording chooses."""
    names = [f"night{k}.csv" for k in range(4)]
    for k, name in enumerate(names):
        samples = vibrating.responses(150.0, 2500, 0.01, 0.01, np.random.default_rng(k))
        table = np.column_stack([np.arange(2500) / 150, samples])
        np.savetxt(name, table, delimiter=",", header="t,1,2,3", comments="")
    done = call(*names, "--output-only", "--band", "4", "70", "--json", "-q")
    found = json.loads(done.stdout)
    assert done.return_value == 0 and found["sources"] == names
    for mode, hz in zip(found["modes"], OMEGA / 2 / np.pi, strict=True):
        assert abs(mode["frequency_hz"] - hz) < 4 * mode["frequency_sd_hz"]
    listed = ", ".join(f"{{file: {name}, outputs: {{1: '1', 2: '2', 3: '3'}}}}" for name in names)
    Path("nights.yaml").write_text(DECK.replace("frf: [{file: frf.npz}]", f"recordings: [{listed}]"))
    whole, one = (
        json.loads(call("nights.yaml", "--band", "4", "70", "--json", *more).stdout)
        for more in ((), ("--recording", "night1"))
    )
    assert [each["frequency_hz"] for each in whole["modes"]] == [each["frequency_hz"] for each in found["modes"]]
    assert one["sources"] == ["night1.csv"]


def test_a_ring_down_needs_no_force(folder):
    """Released from a displacement, in closed form; the whole record, or from where the user says that it is free."""
    t, w, zeta = np.arange(3000) / 500.0, 2 * np.pi * 12.0, 0.02
    ring = np.exp(-zeta * w * t) * np.cos(w * np.sqrt(1 - zeta**2) * t)
    samples = np.concatenate([np.zeros(200), ring]) + 1e-3 * np.random.default_rng(0).standard_normal(3200)
    table = np.column_stack([np.arange(3200) / 500.0, samples])
    np.savetxt("ring.csv", table, delimiter=",", header="t,tip", comments="")
    for more in ((), ("--segment", "200", "3200")):
        done = call("ring.csv", "--free-decay", "--unit", "tip=m", *more, "--json", "-q")
        (mode,) = json.loads(done.stdout)["modes"]
        assert done.return_value == 0
        assert abs(mode["frequency_hz"] - 12.0) < 4 * mode["frequency_sd_hz"] < 0.01
        assert abs(mode["damping"] - zeta) < 4 * mode["damping_sd"] < 1e-3


def test_no_mode_is_exit_one_and_writes_nothing(folder):
    done = call("frf.npz", "--band", "17", "30", "-o", "none.yaml")
    assert done.return_value == 1 and "MD650" in done.output and not Path("none.yaml").exists()


def test_damage_is_rejected(folder):
    Path("bad.npz").write_bytes(Path("frf.npz").read_bytes()[:500])
    done = call("bad.npz")
    assert isinstance(done.exception, DeckError) and done.exception.exit_code == 4


def test_figures(folder):
    pytest.importorskip("matplotlib")
    call("frf.npz", "--plot", "figures")
    assert {path.name for path in Path("figures").iterdir()} == {"stabilisation.png", "frf-fit.png"}

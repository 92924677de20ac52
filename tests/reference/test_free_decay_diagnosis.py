"""Diagnosis by free decays, without a force: two masses released from rest, integrated by Runge and Kutta's eighth order."""

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.integrate import solve_ivp
from two_masses import DECK, RATE, K

from mouse_cli.cli.main import cli

C = 1.2e-4 * K
K3 = 2e8
STOP, GAP = 2e4, 1e-3  # N/m, as the spring to the ground; m, a fifth of the largest motion
INPUTS = "      inputs: [{{sensor: 2, channel: f, quantity: force, unit: N}}]\n"


def decays(folder: Path, law: float, noise: float = 0.01, stop: float = 0.0) -> Path:
    """A deck with two decays from rest, a cubic spring between the masses or a stop beyond GAP of the second one; springs 2 % off
    those of the deck, damping 10 %.
    """
    t, rng, text = np.arange(int(2.0 * RATE)) / RATE, np.random.default_rng(5), ""
    head, item = DECK.split("  recordings:\n")
    item = item.replace(INPUTS, "      free_decay: true\n")
    outputs = ", ".join(f"{{sensor: {i}, channel: a{i}, quantity: acceleration, unit: m/s2}}" for i in (1, 2))
    for run, begin in enumerate(([0.004, -0.003], [-0.001, 0.005])):

        def rates(_, s):
            F = law * (s[1] - s[0]) ** 3
            against = np.array([0.0, stop * max(s[1] - GAP, 0.0)])
            return np.concatenate([s[2:], -1.02 * K @ s[:2] - 1.1 * C @ s[2:] - np.array([-F, F]) - against])

        s = solve_ivp(rates, (0, t[-1]), [*begin, 0, 0], "DOP853", t, rtol=1e-10, atol=1e-14).y
        a = np.array([rates(0, each)[2:] for each in s.T])
        a += noise * a.std(axis=0) * rng.standard_normal(a.shape)
        np.savez(folder / f"run{run}.npz", a1=a[:, 0], a2=a[:, 1])
        text += item.format(rate=RATE, outputs=outputs).replace("run.npz", f"run{run}.npz")
    path = folder / "deck.yaml"
    path.write_text(head.format() + "  recordings:\n" + text)
    return path


def answer(*words: str) -> dict:
    done = CliRunner().invoke(cli, [*words, "--json", "-q"])
    assert done.exit_code in (0, 1), done.output
    return json.loads(done.stdout)


def test_a_linear_decay_lacks_nothing(tmp_path):
    found = answer("diagnose", str(decays(tmp_path, 0.0)))
    assert found["verdict"]["kind"] == "nothing-missing"
    assert found["residual"]["chi2"] < found["residual"]["dof"]


def test_a_cubic_spring_is_found_without_a_force(tmp_path):
    found = answer("diagnose", str(decays(tmp_path, K3)))
    verdict, size = found["verdict"], found["candidates"][0]["parameters"][0]
    assert (verdict["kind"], verdict["physics"], verdict["site"]["ids"]) == ("named", "cubic", [1, 2])
    assert abs(size["value"] - K3) < 4 * size["sd"] + 0.01 * K3
    assert found["held_out"]["records"][0]["title"] == "run1"


def test_a_stop_that_bears_from_the_beginning_is_found(tmp_path):
    """It hides the place where the decay begins: the model as it is would need another one to move so, and stray by ten times."""
    path = decays(tmp_path, 0.0, stop=STOP)
    found = answer("diagnose", str(path), "--candidates", "one-sided-gap,bilinear,spring,cubic,gap")
    verdict, (stiffness, gap) = found["verdict"], found["candidates"][0]["parameters"]
    assert (verdict["kind"], verdict["physics"], verdict["site"]["ids"]) == ("named", "one-sided-gap", [2])
    assert stiffness["value"] == pytest.approx(STOP, rel=0.02) and gap["value"] == pytest.approx(GAP, rel=0.02)


def test_identify_takes_the_decays_of_a_deck(tmp_path):
    """K of the truth is 1.02 times that of the deck: frequencies in closed form."""
    found = answer("identify", str(decays(tmp_path, 0.0)))
    hz = np.sqrt(1.02 * np.linalg.eigvalsh(K)) / (2 * np.pi)
    assert [mode["frequency_hz"] for mode in found["modes"]] == pytest.approx(hz.tolist(), rel=1e-3)


def test_a_free_decay_has_no_inputs(tmp_path):
    path = decays(tmp_path, 0.0)
    path.write_text(path.read_text().replace("free_decay: true", "free_decay: true\n      inputs: {2: a2}", 1))
    done = CliRunner().invoke(cli, ["check", str(path)], standalone_mode=False)
    assert done.return_value == 4 and "MD645" in done.output

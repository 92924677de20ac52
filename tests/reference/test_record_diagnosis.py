"""Diagnosis by recordings: truths integrated by scipy, decks read from files, answers by the command."""

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.integrate import solve_ivp

from mouse_cli.cli.main import cli

RATE, SECONDS, NOISE = 512.0, 8.0, 0.01
K = np.array([[5e4, -3e4], [-3e4, 3e4]])  # springs 2e4 and 3e4 N/m of the deck, masses of 1 kg
DECK = """mouse: 1
title: two masses
model:
  stiffness: {{order: 2, entries: [[1, 1, 5.0e4], [1, 2, -3.0e4], [2, 2, 3.0e4]]}}
  mass: {{diagonal: [1, 1]}}
  damping: {{order: 2, entries: [[1, 1, 6.0], [1, 2, -3.6], [2, 2, 3.6]]}}
parameters:
  - {{name: k1, nominal: 2.0e4, sd: 5 %, stiffness: [[1, 1, 1]]}}
  - {{name: k2, nominal: 3.0e4, sd: 5 %, stiffness: [[1, 1, 1], [1, 2, -1], [2, 2, 1]]}}
test:
  recordings:
    - file: run.npz
      sample_rate: {rate}
      inputs: [{{sensor: 2, channel: f, quantity: force, unit: N}}]
      outputs: [{outputs}]
"""


def record(folder, law, sensors=(1, 2)):
    """A deck whose record scipy integrated, the springs 2 % off those of the deck, damping 10 %."""
    rng, t = np.random.default_rng(7), np.arange(int(SECONDS * RATE)) / RATE
    lines = np.fft.rfftfreq(len(t), 1 / RATE)
    spectrum = np.where((lines > 2) & (lines < 60), np.exp(2j * np.pi * rng.uniform(size=len(lines))), 0)
    ramp = np.minimum(t / 0.2, 1)
    f = np.fft.irfft(spectrum, len(t))
    f *= 40 * ramp / f.std()
    fine = np.fft.irfft(np.pad(np.fft.rfft(f), (0, 15 * len(lines))), 16 * len(t)) * 16
    times = np.arange(len(fine)) / RATE / 16
    stiff, damp = K * 1.02, 1.2e-4 * K * 1.1
    force = lambda s: np.interp(s, times, fine)
    rhs = lambda s, y: np.concatenate(
        [y[2:], np.array([0, force(s)]) - stiff @ y[:2] - damp @ y[2:] - law(y[:2], y[2:])]
    )
    done = solve_ivp(rhs, (0, t[-1]), np.zeros(4), method="RK45", t_eval=t, rtol=1e-7, atol=1e-9, max_step=5e-4)
    a = np.array([rhs(s, y)[2:] for s, y in zip(t, done.y.T, strict=True)])
    a += NOISE * a.std(axis=0) * rng.standard_normal(a.shape)
    np.savez(folder / "run.npz", f=f, **{f"a{i}": a[:, i - 1] for i in sensors})
    outputs = ", ".join(f"{{sensor: {i}, channel: a{i}, quantity: acceleration, unit: m/s2}}" for i in sensors)
    (folder / "deck.yaml").write_text(DECK.format(rate=RATE, outputs=outputs))
    return str(folder / "deck.yaml")


def answer(deck: str) -> dict:
    done = CliRunner().invoke(cli, ["diagnose", deck, "--json", "-q"])
    assert done.exit_code in (0, 1), done.output
    return json.loads(done.stdout)


def test_a_linear_record_lacks_nothing(tmp_path):
    found = answer(record(tmp_path, lambda u, v: np.zeros(2)))
    assert found["verdict"]["kind"] == "nothing-missing" and found["exit_code"] == 0
    assert found["residual"]["chi2"] / found["residual"]["dof"] == pytest.approx(1, abs=0.1)


@pytest.mark.parametrize("sensors", [(1, 2), (2,)])
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


def test_friction_to_the_ground(tmp_path):
    """Regularised Coulomb friction: tanh of the velocity; no law of the library is exactly that."""
    found = answer(record(tmp_path, lambda u, v: np.array([6 * np.tanh(v[0] / 1e-3), 0.0])))
    assert found["verdict"]["kind"] != "nothing-missing"
    assert found["candidates"][0]["physics"] in ("friction", "iwan")
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
    text = Path(record(tmp_path, lambda u, v: np.zeros(2))).read_text()
    told = text[text.index("test:") :].replace("sensor: 1,", "sensor: 1TX,").replace("sensor: 2,", "sensor: 2TX,")
    (tmp_path / "structure.yaml").write_text(STRUCTURE + told)
    assert answer(str(tmp_path / "structure.yaml"))["verdict"]["kind"] == "nothing-missing"

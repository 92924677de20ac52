"""Diagnosis by few modes and a short record together: truths discretised exactly by scipy, answers by the command."""

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.linalg import eigh, expm
from two_masses import K, linear, record

from mouse_cli.cli.main import cli

RATE, SECONDS, NOISE = 256.0, 6.0, 0.03
N, STIFFNESS, LOSS = 5, 2.0e4, 1.5e-4
ACCURACY = 0.003  # of the frequencies
DECK = """mouse: 1
title: a chain of five masses
model:
  stiffness: {{order: 5, entries: {entries}}}
  mass: {{diagonal: [1, 1, 1, 1, 1]}}
  damping: {{order: 5, entries: {damping}}}
parameters:
{parameters}
test:
"""
MODES = """  modes: {{frequency: [{modes}], frequency_sd: 0.3 %}}
"""
RECORD = """  recordings:
    - file: run.npz
      sample_rate: {rate}
      inputs: [{{sensor: 5, channel: f, quantity: force, unit: N}}]
      outputs:
        - {{sensor: 2, channel: a2, quantity: acceleration, unit: m/s2}}
        - {{sensor: 4, channel: a4, quantity: acceleration, unit: m/s2}}
"""


def chain(springs) -> np.ndarray:
    """K of masses in a row, the first spring to the ground."""
    D = np.eye(N) - np.eye(N, k=-1)
    return D.T @ np.diag(springs) @ D


def measured(K: np.ndarray, seed: int = 3) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Two frequencies in Hz and a record of the structure of stiffness K from rest, each with noise.

    A random force on the last mass held between samples by straight lines: exact by the exponential of [A B 0; 0 0 I; 0 0 0] dt
    (Franklin, Powell and Workman, Digital Control of Dynamic Systems, 4.3).
    """
    rng, t = np.random.default_rng(seed), int(SECONDS * RATE)
    hz = np.sqrt(eigh(K, eigvals_only=True)[:2]) / 2 / np.pi * (1 + ACCURACY * rng.standard_normal(2))
    lines = np.fft.rfftfreq(t, 1 / RATE)
    force = np.fft.irfft(np.where((lines > 2) & (lines < 60), np.exp(2j * np.pi * rng.uniform(size=len(lines))), 0), t)
    force *= 20 * np.minimum(np.arange(t) / RATE / 0.3, 1) / force.std()
    fine = (
        np.fft.irfft(np.pad(np.fft.rfft(force), (0, 7 * len(lines))), 8 * t) * 8
    )  # between samples as the band has it
    C, load = LOSS * chain(np.full(N, STIFFNESS)), np.eye(N)[-1]
    A = np.block([[np.zeros((N, N)), np.eye(N)], [-K, -C]])
    whole = np.zeros((2 * N + 2, 2 * N + 2))
    whole[: 2 * N, : 2 * N], whole[N : 2 * N, 2 * N], whole[2 * N, 2 * N + 1] = A, load, 1.0
    step = 1 / RATE / 8
    E = expm(whole * step)[: 2 * N]
    y, found = np.zeros(2 * N), np.zeros((t, N))
    for i, (f, rise) in enumerate(zip(fine, np.diff(fine, append=fine[:1]) / step, strict=True)):
        if i % 8 == 0:
            found[i // 8] = (A @ y)[N:] + load * f
        y = E @ np.concatenate([y, [f, rise]])
    noisy = {f"a{i}": found[:, i - 1] + NOISE * found[:, i - 1].std() * rng.standard_normal(t) for i in (2, 4)}
    return hz, {"f": force, **noisy}


def answer(folder: Path, K: np.ndarray, modes: bool = True, record: bool = True) -> dict:
    """What is said of the structure of stiffness K when the deck has the plain chain, each spring known to 5 %."""
    hz, channels = measured(K)
    np.savez(folder / "run.npz", **channels)
    nominal = chain(np.full(N, STIFFNESS))
    entries = lambda matrix: [[int(i) + 1, int(j) + 1, float(matrix[i, j])] for i, j in np.argwhere(np.triu(matrix))]
    units = [entries(chain(np.eye(N)[i])) for i in range(N)]
    lines = [
        f"  - {{name: k{i + 1}, nominal: {STIFFNESS}, sd: 5 %, stiffness: {unit}}}" for i, unit in enumerate(units)
    ]
    text = DECK.format(entries=entries(nominal), damping=entries(LOSS * nominal), parameters="\n".join(lines))
    text += MODES.format(modes=", ".join(f"{f:.5f}" for f in hz)) if modes else ""
    text += RECORD.format(rate=RATE) if record else ""
    (folder / "deck.yaml").write_text(text)
    done = CliRunner().invoke(cli, ["diagnose", str(folder / "deck.yaml"), "--json", "-q"])
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exc_info
    assert done.exit_code in (0, 1), done.output
    return json.loads(done.stdout)


SPRINGS = STIFFNESS * np.array([1.02, 0.97, 1.03, 0.99, 1.01])
GROUND = 6000.0  # N/m, from the third mass


def test_a_record_tells_the_place_that_two_frequencies_leave_open(tmp_path):
    truth = chain(SPRINGS)
    truth[2, 2] += GROUND
    (tmp_path / "few").mkdir()
    few, both = answer(tmp_path / "few", truth, record=False), answer(tmp_path, truth)
    assert few["verdict"]["kind"] == "one-of"
    verdict, size = both["verdict"], both["candidates"][0]["parameters"][0]
    assert (verdict["kind"], verdict["physics"], verdict["site"]["ids"]) == ("named", "ground-spring", [3])
    assert abs(size["value"] - GROUND) < 4 * size["sd"] + 0.01 * GROUND and size["sd"] < 0.02 * GROUND
    assert any("recordings judged too" in text and "1 in all" in text for text in both["remarks"])


@pytest.mark.proof
def test_modes_and_a_record_of_the_model_as_it_is_lack_nothing(tmp_path):
    found = answer(tmp_path, chain(SPRINGS))
    assert (found["verdict"]["kind"], found["exit_code"]) == ("nothing-missing", 0)
    assert any("recordings judged too" in text for text in found["remarks"])


def with_modes(deck: str) -> dict:
    """What is said of a deck of `two_masses` that has the frequencies of its structure too, stiffness 1.02 K and masses of 1 kg."""
    hz, path = np.sqrt(eigh(1.02 * K, eigvals_only=True)) / 2 / np.pi, Path(deck)
    path.write_text(path.read_text() + MODES.format(modes=", ".join(f"{f:.5f}" for f in hz)))
    done = CliRunner().invoke(cli, ["diagnose", deck, "--json", "-q"])
    assert done.exit_code in (0, 1), done.output
    return json.loads(done.stdout)


@pytest.mark.proof
def test_a_law_shows_in_a_record_beside_sound_modes(tmp_path):
    """A clearance that is open in the modes, at low level: no mode shows it, and no linear mechanism explains the record."""

    def law(u, v):
        F = 3e4 * (u[1] - u[0] - np.clip(u[1] - u[0], -1.5e-3, 1.5e-3))
        return np.array([-F, F])

    found = with_modes(record(tmp_path, law))
    verdict = found["verdict"]
    assert (verdict["kind"], verdict["physics"], found["exit_code"]) == ("named", "gap", 1)
    assert verdict["site"]["ids"] == [1, 2] and any("more than a linear mechanism" in text for text in found["remarks"])


def test_a_linear_record_beside_sound_modes_lacks_nothing(tmp_path):
    found = with_modes(record(tmp_path, linear))
    assert (found["verdict"]["kind"], found["exit_code"]) == ("nothing-missing", 0)

"""Bootstraps of functions and of recordings, against decks edited by hand and systems simulated by numpy and scipy."""

import json
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import cont2discrete, dlsim, firwin, lfilter

from mouse_cli.batch.drawn import drawn, functions, stretches
from mouse_cli.cli.main import _run
from mouse_cli.formats import read_deck
from mouse_cli.updating import run

K = np.array([[5e4, -3e4, 0], [-3e4, 5e4, -2e4], [0, -2e4, 2e4]])
MODEL = """mouse: 1
model:
  stiffness: {order: 3, entries: [[1, 1, 5.0e4], [1, 2, -3.0e4], [2, 2, 5.0e4], [2, 3, -2.0e4], [3, 3, 2.0e4]]}
  mass: {diagonal: [1, 1, 1]}
  damping: {order: 3, entries: [[1, 1, 5.0], [1, 2, -3.0], [2, 2, 5.0], [2, 3, -2.0], [3, 3, 2.0]]}
parameters:
  - {name: k1, nominal: 2.0e4, sd: 100 %, stiffness: [[1, 1, 1]]}
run: {recursion: anchored}
"""
SENSORS = {1: "a1", 2: "a2", 3: "a3"}


def functions_deck(folder: Path, outputs: dict[int, str]) -> Path:
    """Receptances for a force on mass 1 at 60 lines, 2 % of noise, by numpy; the first spring is 1 % stiffer."""
    rng, hz = np.random.default_rng(4), np.linspace(5, 60, 60)
    true = K + np.diag([200.0, 0, 0])
    w = 2 * np.pi * hz[:, None, None]
    H = np.linalg.inv(true - w**2 * np.eye(3) + 1j * w * 1e-4 * K)[:, :, 0]
    noise = rng.standard_normal((2, *H.shape))
    H = H * (1 + 0.02 / np.sqrt(2) * (noise[0] + 1j * noise[1]))
    rows = [",".join([f"{f:.6g}", *(f"{h.real:.9g}{h.imag:+.9g}j" for h in row)]) for f, row in zip(hz, H, strict=True)]
    (folder / "h.csv").write_text("\n".join(["frequency (Hz),a1,a2,a3", *rows]) + "\n")
    named = ", ".join(f"{dof}: {name}" for dof, name in outputs.items())
    path = folder / "deck.yaml"
    test = f"test: {{frf: [{{file: h.csv, kind: receptance, unit: m/N, input: 1, outputs: {{{named}}}, sd: 2 %}}]}}\n"
    path.write_text(MODEL + test)
    return path


def recorded_deck(folder: Path, samples: int) -> Path:
    """A random force on mass 3 below the Nyquist frequency and accelerations with 2 % of noise, by scipy at 16 times the rate."""
    a = np.block([[np.zeros((3, 3)), np.eye(3)], [-K, -1e-4 * K]])
    b = np.zeros((6, 1))
    b[5] = 1.0
    rng = np.random.default_rng(2)
    force = lfilter(firwin(401, 0.7 / 16), 1, 400 * rng.standard_normal(samples * 16))
    seen = dlsim(cont2discrete((a, b, a[3:], b[3:]), 1 / 512 / 16, "foh"), force)[1][::16]
    seen = seen + 0.02 * seen.std(axis=0) * rng.standard_normal(seen.shape)
    table = np.column_stack([np.arange(samples) / 512, force[::16], seen[:, 0], seen[:, 2]])
    np.savetxt(
        folder / "r.csv", table, delimiter=",", header="t (s),f (N),a1 (m/s2),a3 (m/s2)", comments="", fmt="%.8g"
    )
    places = [f"{{sensor: {i}, channel: a{i}, quantity: acceleration, unit: m/s2}}" for i in (1, 3)]
    inputs = "inputs: [{sensor: 3, channel: f, quantity: force, unit: N}]"
    text = f"test: {{recordings: [{{title: run, file: r.csv, {inputs}, outputs: [{', '.join(places)}]}}]}}\n"
    path = folder / "deck.yaml"
    path.write_text(MODEL + text)
    return path


def told(capsys, *arguments: object) -> tuple[int, dict]:
    status = _run([str(each) for each in ("bootstrap", *arguments, "-j", "1", "--json", "-q")])
    return status, json.loads(capsys.readouterr().out)


def test_a_function_left_out_is_the_deck_without_its_column(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    status, found = told(capsys, functions_deck(tmp_path, SENSORS), "--jackknife")
    assert status == 0 and found["over"] == "functions"
    k = found["parameters"][0]
    for i, (dof, name) in enumerate(SENSORS.items()):
        rest = {key: value for key, value in SENSORS.items() if key != dof}
        (tmp_path / name).mkdir()
        answer = run(read_deck(functions_deck(tmp_path / name, rest)))
        assert found["left_out"][i]["without"] == f"function H({dof},1)"
        assert found["left_out"][i]["posterior"]["k1"] == pytest.approx(answer.revised.theta[0], rel=1e-9)
    assert k["predicted_sd"] == pytest.approx(np.sqrt(2 / 3) * k["posterior_sd"], rel=1e-3)  # the prior says nothing


def test_a_function_drawn_twice_has_half_the_variance(tmp_path):
    problem = read_deck(functions_deck(tmp_path, SENSORS))
    assert functions(problem) == ("function H(1,1)", "function H(2,1)", "function H(3,1)")
    once, twice = run(problem), run(drawn(problem, {"functions": [2, 2, 2]}))
    assert twice.sd_theta[0] == pytest.approx(once.sd_theta[0] / np.sqrt(2), rel=1e-3)
    assert twice.revised.theta[0] == pytest.approx(once.revised.theta[0], abs=0.02 * once.sd_theta[0])


def test_stretches_are_all_that_is_fitted_and_what_is_held_out_stays(tmp_path):
    problem = read_deck(recorded_deck(tmp_path, 3000))
    parts, held = stretches(problem)
    whole = problem.recordings[0].samples
    assert len(parts) == 7 and np.array_equal(np.vstack([one.samples for one in parts]), whole[:2100])
    assert np.array_equal(held.recordings[0].samples, whole[2100:]) and held.recordings[0].start == 2100
    found = drawn(problem, {"records": [2, 0, 1, 0, 0, 3, 1]})
    assert [one.start for one in found.recordings] == [0, 0, 600, 1500, 1500, 1500, 1800]
    assert found.held_records.recordings[0].start == 2100


def test_stretches_of_a_record_spread_as_its_noise_does(tmp_path, capsys, monkeypatch):
    """The jackknife over 7 stretches is the posterior's within what 6 degrees of freedom allow 199 times in 200."""
    monkeypatch.chdir(tmp_path)
    status, found = told(capsys, recorded_deck(tmp_path, 3000), "--jackknife")
    assert status == 0 and found["over"] == "records" and found["left_out"][1]["without"] == "samples 300 to 600 of run"
    k = found["parameters"][0]
    assert k["value"] == pytest.approx(2e4, abs=3 * k["posterior_sd"])
    assert 0.3 < k["jackknife_sd"] / k["posterior_sd"] < 1.8


def test_a_short_record_and_a_deck_of_another_kind_have_none_to_draw(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert _run(["bootstrap", str(recorded_deck(tmp_path, 700))]) == 4
    assert "MD934" in capsys.readouterr().err
    for over in ("modes", "records"):
        assert _run(["bootstrap", str(functions_deck(tmp_path, SENSORS)), "--over", over]) == 4
        assert "MD934" in capsys.readouterr().err

"""The blind benchmark of base excitation: its decks, and its truth solver beside scipy's."""

import importlib.util
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from benchmarks.blind.base.decks import answer, write
from benchmarks.blind.base.storeys import CUBIC_TO, KINDS, PHYSICS, RATE, RUNS, buildings, matrices, modes, table
from mouse_cli.formats import read_deck


@pytest.mark.skipif(importlib.util.find_spec("openseespy") is None, reason="openseespy is not installed")
def test_the_truth_solver_meets_modal_superposition():
    """Relative displacements of a sound building on a moving table, mode by mode with scipy's exact first-order hold."""
    from scipy.signal import lsim

    from benchmarks.blind.base.opensees import STEPS, simulated

    case = next(one for one in buildings(5, 1, 0) if one.kind == "loose-brace")
    case = type(case)(**{**vars(case), "kind": "none", "values": None})
    h = 1 / (RATE * STEPS)
    given, t = table(case, 0, 1 / h)[:6000], np.arange(6000) * h
    w, shapes = modes(case)
    parts = [
        lsim(([-s @ case.m], [1, 2 * z * own, own**2]), given, t)[1]
        for own, z, s in zip(w, case.zeta, shapes.T, strict=True)
    ]
    exact = (shapes @ np.array(parts)).T
    found = simulated(case, given, h, "disp")
    assert np.abs(found - exact).max() < 0.01 * np.abs(exact).max()


@pytest.mark.skipif(importlib.util.find_spec("openseespy") is None, reason="openseespy is not installed")
def test_a_softening_storey_stays_where_its_curve_is_cubic():
    from benchmarks.blind.base.opensees import STEPS, simulated

    case = next(one for one in buildings(4211, 2, 0) if one.name == "base-4211-softening-1")
    assert case.place == 0
    for run in range(RUNS):
        moved = simulated(case, table(case, run, RATE * STEPS), 1 / (RATE * STEPS), "disp")[:, 0]
        assert np.abs(moved).max() < CUBIC_TO * np.sqrt(case.k[0] / case.values["k3"])


def test_decks_tell_nothing_of_the_answer(tmp_path):
    for case in buildings(5, 1, 1):
        n = len(case.m)
        noise = np.random.default_rng(1).standard_normal((400, n + 1))
        path = write(tmp_path, case, [(noise[:, 0], noise[:, 1:])] * 2)
        assert not any(word in path.read_text() + path.name for word in KINDS)
        problem = read_deck(path)
        np.testing.assert_allclose(problem.structure.K, matrices(case.nominal_k))
        assert problem.recordings[0].channels[0].ground
        assert len(problem.held_records.recordings) == 1
        assert answer(case)["physics"] == PHYSICS.get(case.kind)


def test_seeds_differ():
    first, second = (buildings(seed, 1, 0)[0] for seed in (1, 2))
    assert first.values != second.values and len(first.m) in (3, 4, 5)


@pytest.mark.skipif(importlib.util.find_spec("openseespy") is None, reason="openseespy is not installed")
def test_the_benchmark_runs(tmp_path):
    """One sound building, from its truth to the table."""
    command = [sys.executable, "-m", "benchmarks.blind.base", "--seed", "5", "--count", "0", "--controls", "1"]
    top = Path(__file__).resolve().parents[2]
    done = subprocess.run([*command, "--output", str(tmp_path)], cwd=top, capture_output=True, text=True, check=True)
    assert "base-5-none-0" in done.stdout and "nothing-missing" in done.stdout

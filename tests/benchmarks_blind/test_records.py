"""The blind benchmark of diagnosis by recordings: its truth solver on closed forms, its decks, its scores."""

import importlib.util
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from benchmarks.blind_records.__main__ import outcome
from benchmarks.blind_records.chain import LAWS, chains, force, matrices
from benchmarks.blind_records.decks import Setup, answer, write
from mouse_cli.formats import read_deck

TOP = Path(__file__).resolve().parents[2]


@pytest.mark.skipif(importlib.util.find_spec("openseespy") is None, reason="openseespy is not installed")
def test_the_truth_solver_meets_closed_forms():
    command = [sys.executable, "-m", "benchmarks.blind_records", "--verify"]
    done = subprocess.run(command, cwd=TOP, capture_output=True, text=True, check=True)
    errors = dict(re.findall(r"^  (\S+) +([\d.]+)$", done.stdout, re.MULTILINE))
    assert set(errors) == set(LAWS) and max(map(float, errors.values())) < 0.1


def test_decks_tell_nothing_of_the_answer(tmp_path):
    for case in chains("development", 5, 1, 1):
        n = len(case.m)
        path = write(tmp_path, case, np.random.default_rng(1).standard_normal((16384, n)), Setup())
        assert not any(law in path.read_text() + path.name for law in LAWS)
        problem = read_deck(path)
        np.testing.assert_allclose(problem.structure.K, matrices(case.nominal_k))
        assert problem.recordings[0].samples.shape == (16384, n + 1)
        assert np.abs(case.k / case.nominal_k - 1).max() <= 0.02


def test_half_of_the_sensors_without_damping_and_with_more_noise(tmp_path):
    case = chains("development", 5, 1, 0)[0]
    motion = np.random.default_rng(1).standard_normal((16384, len(case.m)))
    loud = read_deck(write(tmp_path, case, motion, Setup(half=True, noise=0.05, undamped=True), "velocity"))
    quiet = read_deck(write(tmp_path, case, motion, Setup(half=True, noise=0.0), "velocity"))
    assert loud.structure.C is None and quiet.structure.C is not None
    one, other = loud.recordings[0], quiet.recordings[0]
    assert one.samples.shape[1] - 1 == (len(case.m) + 1) // 2 and one.channels[-1].quantity == "velocity"
    assert (one.samples - other.samples)[:, 1:].std(axis=0) == pytest.approx(0.05, rel=0.05)


def test_splits_and_seeds_differ():
    first = {(split, seed): chains(split, seed, 1, 0)[0] for split in ("development", "fresh") for seed in (1, 2)}
    assert len({one.values["k3"] for one in first.values()}) == 4
    assert force(first["fresh", 1], 1024.0).std() == pytest.approx(50, rel=0.02)


def test_outcomes():
    case = next(one for one in chains("fresh", 1, 1, 0) if one.law == "gap")
    known = answer(case)
    site = {"ids": known["ids"]}
    said = lambda kind, physics: {"verdict": {"kind": kind, "physics": physics, "site": site}}
    assert outcome(known, said("named", "gap"))[0] == "right"
    assert outcome(known, said("named", "cubic"))[0] == "wrong"
    assert outcome(known, said("one-of", "gap"))[0] == "abstained"
    assert outcome(known, said("nothing-missing", None))[0] == "missed"
    sound = {"physics": None, "ids": []}
    assert outcome(sound, said("nothing-missing", None))[0] == "right"
    assert outcome(sound, said("named", "gap"))[0] == "wrong"

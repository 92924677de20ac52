"""Runs of one test whose files call their channels otherwise, or whose deck names them in another order."""

import numpy as np
import pytest
from two_masses import record

from mouse_cli.formats import read_deck
from mouse_cli.updating.recordings.mistakes import check
from mouse_cli.updating.recordings.records import records
from mouse_cli.updating.recordings.study import study

SOFT = lambda u, v: np.array([-8e3 * u[0], 0.0])  # of 20 kN/m: so much is left that other readings are tried


def two_runs(folder, second: str):
    """The problem of two runs, the channels of the second one as `second` names them."""
    deck = record(folder, SOFT)
    kept = dict(np.load(folder / "run.npz"))
    np.savez(folder / "run2.npz", **{name.replace("a", "Run2_a").replace("f", "Run2_f"): -x for name, x in kept.items()})
    text = (folder / "deck.yaml").read_text()
    entry = text[text.index("    - file") :]
    channel = lambda at, name, rest: f"{{sensor: {at}, channel: {name}, {rest}}}"
    motion, force = "quantity: acceleration, unit: m/s2", "quantity: force, unit: N"
    outputs = {"1": channel(1, "Run2_a1", motion), "2": channel(2, "Run2_a2", motion)}
    other = f"    - file: run2.npz\n      sample_rate: 512.0\n      inputs: [{channel(2, 'Run2_f', force)}]\n"
    other += f"      outputs: [{', '.join(outputs[k] for k in second)}]\n"
    (folder / "deck.yaml").write_text(text.replace(entry, entry + other))
    return read_deck(deck)


@pytest.mark.parametrize("second", ["12", "21"])
def test_runs_are_told_by_what_they_measure(tmp_path, second):
    problem = two_runs(tmp_path, second)
    found = records(problem)
    one, other = found.fitted
    assert np.abs(one.measured + other.measured).max() < 1e-9 * np.abs(one.measured).max()
    assert not any("left out" in said for said in found.remarks)
    check(study(problem, found))  # looks at each of them, and finds none misread


def test_a_run_without_one_of_the_channels_is_left_out(tmp_path):
    found = records(two_runs(tmp_path, "1"))
    assert len(found.fitted) == 1 and any("1 recordings have other channels" in said for said in found.remarks)

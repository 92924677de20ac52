"""Records that are sweeps, against a chain in closed form under forces made here."""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "property"))
import vibrating

from mouse_cli.model.recording import OUTPUT, Channel, Recording
from mouse_cli.records.identify import identify_recordings
from mouse_cli.records.sweep import sweep


def run_down(first_hz: float, seed: int) -> Recording:
    """150 s of an unbalance at the third mass, its frequency first_hz exp(-t / 50 s), beside weak white forces."""
    rate, random = 300.0, np.random.default_rng(seed)
    hz = first_hz * np.exp(-np.arange(int(150 * rate)) / rate / 50)
    forces = 30.0 * random.standard_normal((len(hz), 3))
    forces[:, 2] += (hz / 10) ** 2 * 200 * np.cos(2 * np.pi * hz.cumsum() / rate)
    channels = tuple(Channel(str(k + 1), OUTPUT, "acceleration") for k in range(3))
    return Recording("run-down", 1 / rate, channels, vibrating.forced(rate, forces, 0.01))


def test_where_a_run_down_begins_is_no_mode():
    """At 48.7 Hz its jump looks like a resonance at 48.1 Hz, and hides the one at 50.1 Hz."""
    found = identify_recordings([run_down(48.7, seed) for seed in (0, 1)], (2.0, 110.0))
    assert nearest(found) < 0.01
    assert any(each.reason == "lies where a sweep begins or ends" for each in found.rejected)
    said = next(each for each in found.remarks if each.code == "MD684")
    assert "2 of 2 records are one frequency that passes through the band" in said.message


def test_a_run_down_from_above_the_modes_keeps_them():
    found = identify_recordings([run_down(65.0, seed) for seed in (0, 1)], (2.0, 110.0))
    assert found.modes.m == 3 and nearest(found) < 0.01


def nearest(found) -> float:
    """The largest distance of a mode found from the nearest true frequency, over that."""
    true = vibrating.modes(0.01)[0] / 2 / np.pi
    return np.abs(found.modes.frequency_hz[:, None] / true - 1).min(axis=1).max()


@pytest.mark.parametrize("tone", [0.0, 300.0])
def test_broadband_and_steady_forces_are_no_sweep(tone):
    random = np.random.default_rng(3)
    forces = 30.0 * random.standard_normal((45000, 3))
    forces[:, 1] += tone * np.cos(2 * np.pi * 25.0 * np.arange(45000) / 300.0)
    assert sweep(vibrating.forced(300.0, forces, 0.01), 300.0) is None

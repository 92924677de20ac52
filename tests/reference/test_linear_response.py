"""Simulations of linear models by lines, against the same models stepped from sample to sample."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from two_masses import linear, record

import mouse_cli
from mouse_cli.dynamics.response import Plant, simulate
from mouse_cli.updating.recordings.linear_response import answered
from mouse_cli.updating.recordings.records import records
from mouse_cli.updating.recordings.series import sampled
from mouse_cli.updating.recordings.simulator import Simulator
from mouse_cli.updating.recordings.study import study

FACTOR, RATE, SAMPLES = 8, 512.0, 300


def plant(damping: float, hz=(6.7, 42.0, 117.0, 230.0, 381.0, 900.0)) -> Plant:
    """Two models of six modes, two excitations, a sensor of each order."""
    rng, w = np.random.default_rng(1), 2 * np.pi * np.array(hz)
    n, many = len(w), (1.0, 1.03)
    by = lambda one: np.array([np.diag(one(w * scale)) for scale in many])
    M, C, K = by(np.ones_like), by(lambda w: 2 * damping * w), by(np.square)
    return Plant(M, C, K, rng.standard_normal((2, n, 2)), np.zeros((n, 0)), rng.standard_normal((3, n)), np.arange(3))


def force(rng: np.random.Generator) -> np.ndarray:
    """Three stretches at every step, of which the second excitation is a constant."""
    from scipy.signal import resample_poly

    slow = resample_poly(rng.standard_normal((SAMPLES, 3)), FACTOR, 1, axis=0, window=("kaiser", 8.0))
    slow = slow[: (SAMPLES - 1) * FACTOR + 1]
    return np.stack([slow, np.ones_like(slow)], axis=1)


@pytest.mark.parametrize("damping", [0.004, 0.05, 1.7])
def test_lines_and_steps_agree(damping):
    rng, one, h = np.random.default_rng(2), plant(damping), 1 / RATE / FACTOR
    given, n = force(rng), one.states // 2
    start = rng.standard_normal((2, 2 * n, 3)) * np.repeat([1e-3, 1.0], n)[:, None]
    stepped = sampled(simulate(one, h, given, start), FACTOR)
    found = answered(one, h, given, start, FACTOR)
    assert found.shape == stepped.shape
    for a, b in zip(found.swapaxes(0, 1), stepped.swapaxes(0, 1), strict=True):
        assert np.abs(a - b).max() < 3e-4 * b.std()


def test_what_nothing_holds_is_stepped():
    free = plant(0.01, hz=(0.0, 42.0))
    given = force(np.random.default_rng(3))
    assert answered(free, 1 / RATE / FACTOR, given, np.zeros((2, 4, 3)), FACTOR) is None


def test_slopes_by_states_are_free_motion(tmp_path):
    own = study(problem := mouse_cli.read_deck(str(Path(record(tmp_path, linear)))), records(problem))
    own.data = [replace(part, series=replace(part.series, factor=4)) for part in own.data]
    its, x = Simulator(own.base, own.data), np.zeros(len(own.base.mean))
    spread = np.ones(2 * len(own.model.linear.M))
    states = np.zeros((len(spread), its.read.shape[2]))
    left = its.left(x, states)
    slopes = its.slopes(x, states, spread)
    for j, at in enumerate(np.eye(len(spread))):
        moved = its.seen(x[None], (states + at[:, None])[None])[0] - its.measured + left
        np.testing.assert_allclose(slopes.X[..., j], moved, atol=1e-6 * np.abs(moved).max())

"""Noise of a force channel is passed on to what simulations predict: against its covariance by definition, and on records
that scipy integrated, whose force was then falsified.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import eigh, expm, solve_discrete_lyapunov
from test_channel_nuisances import K3, answer, cubic
from two_masses import linear, record

import mouse_cli
from mouse_cli.updating.recordings.excitation_noise import Repeated
from mouse_cli.updating.recordings.excited import repeated
from mouse_cli.updating.recordings.records import records
from mouse_cli.updating.recordings.series import Series
from mouse_cli.updating.recordings.study import fitted, study


def noisy(x: np.ndarray, share: float = 0.02) -> np.ndarray:
    """A force channel with white noise."""
    return x + share * x.std() * np.random.default_rng(5).standard_normal(len(x))


@pytest.mark.parametrize("strokes", [None, (3, 17, 18, 40)])
def test_stretches_are_made_white_by_the_covariance_of_what_the_excitation_passes_on(strokes):
    """Noise that acts all the time, or at some samples of the second stretch alone."""
    rng, t, s = np.random.default_rng(1), 60, 2
    w, h = 9.0, 0.02
    step = expm(np.array([[0, 1], [-(w**2), -1.0]]) * h)
    given, read = np.array([[0.0], [0.6]]), np.array([[4.0, 0.0], [0.3, 0.7]])
    direct, own = np.array([[0.2], [0.9]]), np.array([0.8, 0.5])
    G = np.zeros((s, t, t))
    for j in range(t):
        G[:, j, j] = direct[:, 0]
        for k in range(j + 1, t):
            G[:, k, j] = (read @ np.linalg.matrix_power(step, k - j) @ given)[:, 0]
    G = G.reshape(s * t, t)
    acts = np.ones((t, 1, 4))
    if strokes:
        acts[:] = 0.0
        acts[list(strokes), 0, 1] = 1.5, 1.0, 1.0, 0.5
    x = rng.standard_normal((3, s, t, 4))
    filter = Repeated(step, given, read, direct, own).over(t, acts if strokes else None)
    found = filter.whitened(x)
    as_one = lambda y: y.reshape(3, s * t, 4)
    for g, passed in enumerate(np.moveaxis(acts[:, 0], 1, 0)):
        covariance = G * passed**2 @ G.T + np.diag(np.repeat(own, t))
        exact = as_one(x)[:, :, g] @ np.linalg.inv(covariance) @ as_one(x)[:, :, g].T
        np.testing.assert_allclose(as_one(found)[:, :, g] @ as_one(found)[:, :, g].T, exact, rtol=1e-9, atol=1e-9)
    assert np.abs(filter.coloured(found) - x).max() < 1e-9
    assert np.abs(filter.whitened(x[:, :, :20]) - found[:, :, :20]).max() < 1e-12  # of what follows nothing is known


@pytest.mark.parametrize("stated", ["", ", noise_sd: 2 %"])
def test_two_percent_of_noise_in_the_force_is_neither_physics_nor_strain(tmp_path, stated):
    deck = Path(record(tmp_path, linear))
    kept = dict(np.load(tmp_path / "run.npz"))
    np.savez(tmp_path / "run.npz", **kept | {"f": noisy(kept["f"])})
    deck.write_text(deck.read_text().replace("quantity: force", f"quantity: force{stated}"))
    problem = mouse_cli.read_deck(str(deck))
    own = study(problem, records(problem))
    one = fitted(own, None)
    assert 0.85 < one.misfit / one.dof < 1.1
    assert np.abs(one.x).max() < 3.5


def test_noise_of_the_force_is_amplified_as_the_structure_of_the_first_fit_amplifies_it(tmp_path):
    deck = Path(record(tmp_path, linear))
    kept = dict(np.load(tmp_path / "run.npz"))
    np.savez(tmp_path / "run.npz", **kept | {"f": noisy(kept["f"])})
    deck.write_text(deck.read_text().replace("quantity: force", "quantity: force, noise_sd: 2 %"))
    problem = mouse_cli.read_deck(str(deck))
    own = study(problem, records(problem))
    one, poles = fitted(own, None), lambda: np.sort(np.abs(np.angle(np.linalg.eigvals(own.look.repeated.step))))
    M, _, K = (each[0] for each in own.model.linear.matrices(one.x[None, : own.model.linear.k]))
    before, there = poles(), np.sqrt(np.repeat(eigh(K, M, eigvals_only=True), 2)) * own.look.dt
    assert np.abs(before / there - 1).min() > 0.005  # the springs are 2 % off those of the deck
    assert own.tune(one)
    np.testing.assert_allclose(poles(), there, rtol=1e-3)
    assert all(part.series.repeated is own.look.repeated for part in own.data)


def test_a_law_is_named_beside_noise_in_the_force(tmp_path):
    found = answer(tmp_path, cubic, "mains: 200", f=noisy)
    assert (found["verdict"]["kind"], found["verdict"]["physics"]) == ("named", "cubic")
    assert found["candidates"][0]["parameters"][0]["value"] == pytest.approx(K3, rel=0.03)


def test_an_excitation_as_wide_as_its_samples_shows_no_noise(tmp_path):
    deck = record(tmp_path, linear)
    kept = dict(np.load(tmp_path / "run.npz"))
    np.savez(tmp_path / "run.npz", **kept | {"f": np.random.default_rng(3).standard_normal(len(kept["f"]))})
    assert not records(mouse_cli.read_deck(deck)).fitted[0].force_noise.any()


@pytest.mark.parametrize("absolute", [True, False])
def test_noise_of_the_ground_is_in_absolute_channels_as_the_transmissibility_has_it(absolute):
    """A mass on a spring, its ground's acceleration read with noise: variances by the line integral of what it passes on."""
    w0, zeta, dt, sd = 2 * np.pi * 9, 0.03, 1 / 100, 0.2
    one, none = np.ones((1, 1)), np.zeros((1, 1))
    series = Series("r", dt, none, none, np.ones(1), none, one, np.array([2]), one, force_noise=np.array([sd]))
    series = replace(series, carried=one if absolute else 0.0)
    found = repeated(series, one, 2 * zeta * w0 * one, w0**2 * one)
    P = solve_discrete_lyapunov(found.step, found.step @ found.given @ found.given.T @ found.step.T)
    w = np.linspace(0, np.pi / dt, 200_001)
    answer = w**2 / (w0**2 - w**2 + 2j * zeta * w0 * w) + absolute
    expected = sd**2 * (np.abs(answer) ** 2).mean()
    assert (found.read @ P @ found.read.T + found.direct**2).item() == pytest.approx(expected, rel=0.03)


def test_modes_above_half_the_sample_rate_are_not_rung_by_samples():
    """A mode at 9 Hz and one at 70 Hz, sampled at 100 Hz: what the second adds is its answer without inertia."""
    w0, dt = 2 * np.pi * np.array([9.0, 70.0]), 1 / 100
    M, C, K = np.eye(2), np.diag(0.02 * w0), np.diag(w0**2)
    read = lambda n: repeated(
        Series("r", dt, np.zeros((1, 1)), np.zeros((1, 1)), np.ones(1), np.ones((n, 1)), np.ones((1, n)), np.array([0]),
               np.zeros((n, 1)), force_noise=np.ones(1)), M[:n, :n], C[:n, :n], K[:n, :n])  # fmt: skip
    both, first = read(2), read(1)
    assert both.step.shape == first.step.shape
    middle = (2 * np.pi * 25) ** 2
    assert (both.direct - first.direct).item() == pytest.approx(1 / (w0[1] ** 2 - middle))

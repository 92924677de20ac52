"""Simulation with local nonlinear forces against scipy's integrators and closed forms of one mass."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.signal import lsim
from scipy.special import ellipk

from benchmarks.blind.drives.exact import Drive, run
from mouse_cli.dynamics.response import LocalForces, Plant, simulate
from mouse_cli.terms.laws import registry

K, W = 1e4, 100.0  # N/m and rad/s of a mass of 1 kg


def one_mass(order: int = 0, damping: float = 0.0) -> Plant:
    one = np.ones((1, 1, 1))
    return Plant(one, damping * one, K * one, one, np.ones((1, 1)), np.ones((1, 1)), np.array([order]))


def free(law: str, p: list[float], h: float, seconds: float, speed: float = 1.0, damping: float = 0.0) -> np.ndarray:
    """Displacement (t,) from the middle with a speed."""
    found = registry()[law]
    values = np.array(p)[:, None, None, None]
    local = lambda x, v, z: found.force(x, v, z, values)
    z = np.zeros((found.states, 1, 1, 1)) if found.states else None
    start = np.array([0.0, speed]).reshape(1, 2, 1)
    out = simulate(one_mass(damping=damping), h, np.zeros((int(seconds / h), 1, 1)), start, local, z)
    return out[0, 0, :, 0]


def crossings(x: np.ndarray, h: float) -> np.ndarray:
    at = np.flatnonzero(x[1:-1] * x[2:] <= 0) + 1
    return (at + x[at] / (x[at] - x[at + 1])) * h


def test_linear_part_is_exact_for_forces_linear_between_steps():
    rng = np.random.default_rng(1)
    M, C = np.diag([1.0, 2.0, 0.5]), np.array([[3.0, -1, 0], [-1, 4, -2], [0, -2, 2]])
    stiff = 1e3 * np.array([[3.0, -1, 0], [-1, 4, -2], [0, -2, 2]])
    inputs, t, h = rng.standard_normal((3, 2)), 400, 2e-3
    force = rng.standard_normal((t, 2))
    A = np.block([[np.zeros((3, 3)), np.eye(3)], [-np.linalg.solve(M, stiff), -np.linalg.solve(M, C)]])
    B = np.vstack([np.zeros((3, 2)), np.linalg.solve(M, inputs)])
    rows = [np.eye(6)[0], np.eye(6)[4], A[5]]
    direct = np.vstack([np.zeros((2, 2)), B[5]])
    begin = rng.standard_normal(6) * 1e-2
    _, exact, _ = lsim((A, B, np.array(rows), direct), force, np.arange(t) * h, X0=begin)
    plant = Plant(M[None], C[None], stiff[None], inputs[None], np.zeros((3, 0)), np.eye(3), np.array([0, 1, 2]))
    found = simulate(plant, h, force[:, :, None], begin.reshape(1, 6, 1))
    np.testing.assert_allclose(found[0, :, :, 0].T, exact, rtol=0, atol=1e-10 * np.abs(exact).max())


def test_duffing_period_is_that_of_the_elliptic_integral():
    k3, h = 4e8, 1e-4
    A2 = (-(W**2) + np.sqrt(W**4 + 2 * k3)) / k3
    w2 = W**2 + k3 * A2
    exact = 2 * ellipk(k3 * A2 / (2 * w2)) / np.sqrt(w2)
    found = np.diff(crossings(free("cubic", [k3], h, 0.4), h))
    np.testing.assert_allclose(found, exact, rtol=2e-5)


def test_error_falls_with_the_square_of_the_step():
    errors = []
    for h in (4e-4, 2e-4, 1e-4):
        x = free("cubic", [4e8], h, 0.2)
        done = solve_ivp(
            lambda t, s: [s[1], -K * s[0] - 4e8 * s[0] ** 3],
            (0, 0.2),
            [0, 1],
            rtol=1e-11,
            atol=1e-14,
            dense_output=True,
        )
        errors.append(np.abs(x - done.sol(np.arange(len(x)) * h)[0]).max())
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(4, rel=0.1)


def test_bilinear_half_periods():
    h = 1e-4
    found = np.diff(np.concatenate([[0.0], crossings(free("bilinear", [0.5 * K], h, 0.3), h)]))
    np.testing.assert_allclose(found[0::2], np.pi / (W * np.sqrt(1.5)), rtol=1e-4)
    np.testing.assert_allclose(found[1::2], np.pi / W, rtol=1e-4)


def test_play_takes_its_own_time_on_the_way():
    """Half a period of the spring beyond the play, and 2 g at constant speed through it."""
    h, g = 5e-5, 2e-3
    found = np.diff(crossings(free("play", [K, g], h, 0.3), h))
    np.testing.assert_allclose(found, np.pi / W + 2 * g / 1.0, rtol=1e-4)


def test_coulomb_friction_takes_the_same_from_each_peak():
    F, h = 2.0, 2e-5
    x = free("friction", [1000 * K, F], h, 0.15)
    slope = np.diff(x)
    peaks = np.abs(x[1:-1][slope[:-1] * slope[1:] <= 0])[:4]
    np.testing.assert_allclose(-np.diff(peaks), 2 * F / K, rtol=3e-3)


def test_one_way_damping_decays_in_every_other_half_period():
    """Only while the velocity is positive: a half cycle of damping ratio c / 2 m W there, none on the way back."""
    c, h = 20.0, 2e-5
    x = free("one-way-damping", [c], h, 0.3)
    slope = np.diff(x)
    peaks = np.abs(x[1:-1][slope[:-1] * slope[1:] <= 0])
    ratio = c / 2 / W
    np.testing.assert_allclose(peaks[2::2] / peaks[1:-1:2], np.exp(-np.pi * ratio / np.sqrt(1 - ratio**2)), rtol=1e-3)
    np.testing.assert_allclose(peaks[1::2] / peaks[0:-1:2], 1.0, rtol=1e-3)


def test_quadratic_damping_peaks():
    a, h = 10.0, 1e-4  # c2/m
    x = free("quadratic-damping", [a], h, 0.2)
    slope = np.diff(x)
    peaks = np.abs(x[1:-1][slope[:-1] * slope[1:] <= 0])
    left = (1 + 2 * a * peaks[:-1]) * np.exp(-2 * a * peaks[:-1])
    right = (1 - 2 * a * peaks[1:]) * np.exp(2 * a * peaks[1:])
    np.testing.assert_allclose(left, right, rtol=1e-5)


def test_stops_on_a_forced_mass_agree_with_an_integrator():
    kc, g, c, h = 4e4, 4e-3, 5.0, 5e-5
    t = np.arange(4000) * h
    f = 60 * np.sin(83 * t) + 40 * np.sin(131 * t)
    law, p = registry()["one-sided-gap"], np.array([kc, g])[:, None, None, None]
    out = simulate(
        one_mass(damping=c), h, f[:, None, None], np.zeros((1, 2, 1)), lambda x, v, z: law.force(x, v, z, p, sign=-1.0)
    )
    stop = lambda x: -kc * max(-x - g, 0.0)
    rhs = lambda s, y: [y[1], 60 * np.sin(83 * s) + 40 * np.sin(131 * s) - K * y[0] - c * y[1] - stop(y[0])]
    exact = solve_ivp(rhs, (0, t[-1]), [0, 0], rtol=1e-10, atol=1e-13, t_eval=t, max_step=1e-4).y[0]
    assert (np.abs(exact) > g).any()
    np.testing.assert_allclose(out[0, 0, :, 0], exact, atol=1e-4 * np.abs(exact).max())


def test_models_and_segments_side_by_side_are_those_one_by_one():
    rng, t = np.random.default_rng(2), 300
    M, C = np.ones((3, 1, 1)), np.array([1.0, 5.0, 500.0]).reshape(3, 1, 1)  # the last one is overdamped
    stiff, force = K * np.array([1.0, 1.2, 1.5]).reshape(3, 1, 1), rng.standard_normal((t, 1, 2))
    start, law = rng.standard_normal((3, 2, 2)) * 1e-2, registry()["cubic"]
    local = lambda p: lambda x, v, z: law.force(x, v, z, p)
    values = np.array([1e7, 2e7, 3e7]).reshape(1, 3, 1, 1)
    plant = lambda i: Plant(
        M[i], C[i], stiff[i], np.ones((len(M[i]), 1, 1)), np.ones((1, 1)), np.ones((1, 1)), np.array([2])
    )
    every = simulate(plant(slice(None)), 1e-4, force, start, local(values))
    for i in range(3):
        for j in range(2):
            own = slice(i, i + 1)
            alone = simulate(plant(own), 1e-4, force[:, :, [j]], start[own][:, :, [j]], local(values[:, own]))
            np.testing.assert_allclose(every[i, 0, :, j], alone[0, 0, :, 0], rtol=1e-9, atol=1e-9)


def test_coulomb_friction_stops_and_holds_as_from_event_to_event():
    """A mass between slip and stick against its integration by events, at 60 steps in the shortest period and more."""
    law, (m, c, Fs), rng = registry()["coulomb"], (2.0, 3.0, 4.0), np.random.default_rng(1)
    t = np.arange(8000) / 4000
    f = sum(6 * np.sin(2 * np.pi * hz * t + rng.uniform(0, 6)) for hz in (0.7, 1.9, 3.3, 6.1))
    truth = run(Drive(np.array([m]), np.array([c]), friction=Fs), np.column_stack([f, 0 * f]), 1 / 4000)
    assert (truth["v"] == 0).mean() > 0.02
    one, size = np.ones((1, 1, 1)), np.full((1, 1, 1), Fs)
    forces = LocalForces(lambda x, v, z: (Fs * np.sign(v), z), {0: lambda *step: law.implicit(*step, size)})
    plant = Plant(m * one, c * one, 0 * one, one, np.ones((1, 1)), np.ones((2, 1)), np.array([0, 1]))
    for step, error in ((1, 1e-4), (8, 2e-3)):
        found = simulate(plant, step / 4000, f[::step, None, None], np.zeros((1, 2, 1)), forces, [None])
        for own, key in zip(found[0, :, :, 0], "xv", strict=True):
            assert (own - truth[key][::step, 0]).std() < error * truth[key].std()

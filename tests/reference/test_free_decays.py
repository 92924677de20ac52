"""Modes of free decays against the closed form: chains released from a displacement, their modes of another damping each."""

import numpy as np
import pytest

from mouse_cli.model.recording import OUTPUT, Channel, Recording
from mouse_cli.records.identify import identify_decaying
from mouse_cli.records.identify_decays import begun

RATE = 1000.0


def chain(rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Circular frequencies (n,), shapes (n, n) and damping ratios (n,) of 2 to 4 masses between springs, the first held."""
    n = int(rng.integers(2, 5))
    m, k = rng.uniform(0.6, 1.6, n), rng.uniform(6e4, 2.2e5, n)
    K = np.diag(k + np.append(k[1:], 0)) - np.diag(k[1:], 1) - np.diag(k[1:], -1)
    w2, V = np.linalg.eigh(K / np.sqrt(np.outer(m, m)))
    return np.sqrt(w2), V / np.sqrt(m)[:, None], rng.uniform(0.003, 0.03, n)


def released(rng, w, shapes, zeta, seconds: float, noise: float, title: str = "ring", quiet: int = 0) -> Recording:
    """Accelerations from a displacement at rest, u = sum phi Re(q (1 - i zeta w/wd) exp(lambda t)); `quiet` samples before it."""
    n, damped = len(w), w * np.sqrt(1 - zeta**2)
    pole = -zeta * w + 1j * damped
    q = np.linalg.solve(shapes, rng.standard_normal(n))
    amplitude = (q * (1 - 1j * zeta * w / damped) * pole**2)[:, None]
    y = (shapes @ (amplitude * np.exp(np.outer(pole, np.arange(int(seconds * RATE)) / RATE)))).real.T
    size = noise * y.std(axis=0)
    y = np.concatenate([np.zeros((quiet, n)), y])
    y = y + size * rng.standard_normal(y.shape)
    return Recording(title, 1 / RATE, tuple(Channel(f"a{i}", OUTPUT, "acceleration", "m/s2") for i in range(n)), y)


def errors(seed: int, noise: float) -> list[tuple[float, float]]:
    """Errors of frequency and damping over their sd, of every mode of a chain; nan where it was not found, or one that is none."""
    rng = np.random.default_rng(seed)
    w, shapes, zeta = chain(rng)
    records = [released(rng, w, shapes, zeta, rng.uniform(1, 3), noise, f"ring {i}") for i in range(rng.integers(1, 3))]
    modes = identify_decaying(records).modes
    if modes.m != len(w):
        return [(np.nan, np.nan)] * len(w)
    z = (modes.frequency_hz - w / 2 / np.pi) / modes.frequency_sd_hz, (modes.damping - zeta) / modes.damping_sd
    return list(zip(*z, strict=True))


@pytest.mark.parametrize("noise", [0.01, 0.1])
def test_errors_are_as_large_as_stated(noise):
    z = np.array([pair for seed in range(8) for pair in errors(int(1000 * noise) + seed, noise)])
    found = np.isfinite(z[:, 0])
    assert found.mean() > 0.9
    assert (np.abs(z[found]) < 3.5).all()
    assert 0.75 < np.sqrt((z[found] ** 2).mean()) < 1.3


def test_shapes_are_those_of_the_structure():
    rng = np.random.default_rng(4)
    w, shapes, zeta = chain(rng)
    modes = identify_decaying([released(rng, w, shapes, zeta, 2.0, 0.02, title) for title in "ab"]).modes
    assert modes.m == len(w)
    for r in range(modes.m):
        true = shapes[:, r] / shapes[np.abs(shapes[:, r]).argmax(), r]
        own = modes.shapes[:, r].real / modes.shapes[np.abs(true).argmax(), r].real
        assert (np.abs(own - true) < 4 * modes.shape_sd[:, r] * np.abs(own / modes.shapes[:, r].real) + 1e-3).all()


def test_a_decay_begins_at_its_largest():
    rng = np.random.default_rng(2)
    w, shapes, zeta = chain(rng)
    record = begun(released(rng, w, shapes, zeta, 2.0, 0.01, quiet=700))
    assert 700 <= record.start < 740
    modes = identify_decaying([record]).modes
    assert np.abs(modes.frequency_hz / (w / 2 / np.pi) - 1).max() < 2e-3


def test_noise_alone_has_no_modes():
    y = np.random.default_rng(1).standard_normal((2000, 2))
    channels = tuple(Channel(name, OUTPUT, "acceleration", "m/s2") for name in "ab")
    found = identify_decaying([Recording("noise", 1 / RATE, channels, y)])
    assert found.modes.m == 0 and found.exit_code == 1


def test_a_frequency_that_follows_the_amplitude_is_remarked_upon():
    """Duffing's free decay, x'' + 2 zeta w x' + w^2 x + k3 x^3 = 0, by Runge and Kutta's eighth order."""
    from scipy.integrate import solve_ivp

    w, t = 2 * np.pi * 10, np.arange(4000) / RATE
    rates = lambda _, s: [s[1], -0.02 * w * s[1] - w**2 * s[0] - 0.8 * w**2 * s[0] ** 3]
    x = solve_ivp(rates, (0, 4), [1.0, 0.0], "DOP853", t, rtol=1e-10, atol=1e-12).y[0]
    y = x + 1e-3 * np.random.default_rng(0).standard_normal(len(x))
    found = identify_decaying(
        [Recording("duffing", 1 / RATE, (Channel("x", OUTPUT, "displacement", "m"),), y[:, None])]
    )
    assert "MD683" in [one.code for one in found.remarks]

"""Signs of nonlinearity on signals whose distortion is known."""

import numpy as np
import pytest

from mouse_cli.records.linearity import distortion, incoherent, period

T = 1024


def multisine(periods: int = 4, skipped: tuple[int, ...] = (9, 21)) -> np.ndarray:
    """Odd lines 1 to 39 but for `skipped`, random phases."""
    rng, spectrum = np.random.default_rng(3), np.zeros(T // 2 + 1, complex)
    for line in range(1, 40, 2):
        if line not in skipped:
            spectrum[line] = np.exp(2j * np.pi * rng.uniform())
    one = np.fft.irfft(spectrum, T)
    return np.tile(one / one.std(), periods)


def test_a_linear_response_has_no_distortion():
    u = multisine()
    found = distortion(u, np.roll(3 * u, 5), T)
    assert found.even < 1e-12 * found.excited and found.odd < 1e-12 * found.excited


def test_a_square_shows_at_even_lines_and_a_cube_at_odd_ones():
    u = multisine()
    square, cube = distortion(u, u + 0.1 * u**2, T), distortion(u, u + 0.1 * u**3, T)
    assert square.even > 0.01 * square.excited and square.odd < 1e-10 * square.excited
    assert cube.odd > 0.01 * cube.excited and cube.even < 1e-10 * cube.excited


def test_noise_is_seen_between_periods():
    u, rng = multisine(30), np.random.default_rng(4)
    found = distortion(u, u + 0.05 * rng.standard_normal(len(u)), T)
    expected = 0.05 / np.sqrt(T) / np.sqrt(29)  # of a line of the mean of 29 periods
    assert found.noise == pytest.approx(expected, rel=0.1)
    assert found.even == pytest.approx(expected, rel=0.5)


def test_even_excitation_gives_no_sign():
    assert distortion(multisine() ** 2, multisine(), T) is None


def test_period():
    assert period(multisine()) == T
    assert period(np.random.default_rng(5).standard_normal(4 * T)) is None


def test_coherence_falls_with_noise():
    rng = np.random.default_rng(6)
    u, noise = rng.standard_normal((2, 65536))
    assert incoherent(u, np.roll(u, 1), 1e-3) == 0
    assert incoherent(u, np.roll(u, 1) + noise, 1e-3) > 0.9

"""The accuracy of a channel: its own resolution, and what forces make of a stretch of it."""

import numpy as np
import pytest

from mouse_cli.updating.recordings.accuracy import forced, resolution
from mouse_cli.updating.recordings.series import Series, quick


def series(x: np.ndarray, order: int) -> Series:
    one = np.ones((1, 1))
    return Series("r", 1e-3, np.zeros((len(x), 1)), x[:, None], np.ones(1), one, one, np.array([order]), 0 * one)


def test_an_encoder_is_as_fine_as_its_counts():
    rng = np.random.default_rng(1)
    x = 0.4 * np.sin(np.arange(16000) / 700) + 0.01 * rng.standard_normal(16000)
    assert resolution(x) == 0.0
    assert resolution(1e-6 * np.round(x / 1e-6)) == pytest.approx(1e-6, rel=1e-6)
    assert resolution(0.02 * np.round(x / 0.02)) == pytest.approx(0.02, rel=1e-6)
    assert resolution(np.full(100, 0.3)) == 0.0


def test_a_place_and_a_speed_are_no_measure_of_a_theory():
    t = np.arange(4096) / 1000
    wave = 1e-3 * np.sin(2 * np.pi * 20 * t)
    size = 1e-3 / np.sqrt(2)
    assert forced(series(wave + 0.5 + 0.3 * t, 0), 512)[0] == pytest.approx(size, rel=0.02)
    assert forced(series(wave + 0.5, 1), 512)[0] == pytest.approx(size, rel=0.02)
    assert forced(series(wave + 0.5, 2), 512)[0] == pytest.approx(np.hypot(0.5, size), rel=0.02)


def test_what_is_slower_than_a_stretch_is_taken_out_of_places_and_speeds():
    t = np.arange(4000) / 1000
    drift, wave = 1 + 2 * t - t**2 + 0.3 * t**3, np.sin(2 * np.pi * 30 * t)
    left = quick(np.column_stack([drift, 1 + 2 * t, drift]), np.array([0, 1, 2]), 400)[800:-800]
    assert np.abs(left[:, :2]).max() < 1e-9
    np.testing.assert_array_equal(left[:, 2], drift[800:-800])
    np.testing.assert_allclose(quick(wave[:, None], np.zeros(1), 400)[800:-800, 0], wave[800:-800], atol=2e-3)

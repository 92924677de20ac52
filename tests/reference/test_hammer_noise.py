"""Noise of the channel of a hammer: seen beside strokes that are short."""

import numpy as np
import pytest

from mouse_cli.updating.recordings.records import _excitation_noise


@pytest.mark.parametrize("strokes", [1, 2, 8])
def test_noise_between_strokes_is_seen_however_few_they_are(strokes):
    """Two strokes in 3 s have a rms of a fortieth of their peak: noise of 0.2 % of that is 8 % of it, and was none. It shook the
    model at its resonances, and a sound cantilever lacked something.
    """
    rng, rate, width = np.random.default_rng(2), 4000, 2.2e-3
    t = np.arange(3 * rate) / rate
    force = np.zeros(len(t))
    for begin in np.linspace(0.1, 2.7, strokes):
        x = (t - begin) / width
        force += 45 * np.where((x > 0) & (x < 1), np.sin(np.pi * x) ** 2, 0)
    noisy = force + 0.09 * rng.standard_normal(len(t))
    assert _excitation_noise(noisy[:, None], np.zeros(1))[0] == pytest.approx(0.09, rel=0.35)


def test_an_excitation_as_wide_as_the_samples_allow_shows_none():
    force = 45 * np.random.default_rng(3).standard_normal((12000, 1))
    assert _excitation_noise(force, np.zeros(1))[0] == 0

"""Noise of the channel of a hammer: seen beside strokes that are short, wherever they are, and not simulated."""

from types import SimpleNamespace

import numpy as np
import pytest

from mouse_cli.model.recording import Recording
from mouse_cli.records.strokes import struck
from mouse_cli.updating.recordings.quietened import excitation_noise, quietened

RATE, NOISE = 4000, 0.09


def hit(times, seconds=3.0, width=2.2e-3):
    """A force (t,) of strokes that begin at `times`, s."""
    t = np.arange(int(seconds * RATE)) / RATE
    each = [(t - begin) / width for begin in times]
    return sum(45 * np.where((x > 0) & (x < 1), np.sin(np.pi * x) ** 2, 0) for x in each)


def read(force: np.ndarray) -> Recording:
    """A record of it."""
    channel = SimpleNamespace(ground=False, quantity="force")
    return Recording("one", 1 / RATE, (channel,), force[:, None])


@pytest.mark.parametrize("strokes", [1, 2, 8])
def test_noise_between_strokes_is_not_simulated_however_few_they_are(strokes):
    """Two strokes in 3 s have a rms of a fortieth of their peak: noise of 0.2 % of that is 8 % of it, and was none. It shook the
    model at its resonances, and a sound cantilever lacked something.
    """
    force = hit(np.linspace(0.1, 2.7, strokes))
    noisy = force + NOISE * np.random.default_rng(2).standard_normal(len(force))
    sd = excitation_noise(noisy[:, None], np.zeros(1))
    left = quietened(read(noisy), [0], sd).samples[:, 0] - force
    assert sd == pytest.approx(NOISE, rel=0.05) and np.abs(left).max() < 5 * NOISE
    assert (np.abs(left) < 0.1 * NOISE).mean() > 0.97


@pytest.mark.parametrize("begin", [0.003, 0.01, 0.04, 1.5, 2.99])
def test_a_stroke_near_an_end_of_the_record_is_kept(begin):
    """A window that falls to 0 at both ends took one 40 ms after the beginning of 8 s for noise, and a sound structure for a test
    whose force is read wrong.
    """
    force = hit([begin], 8.0 if begin < 1 else 3.0)
    noisy = force + NOISE * np.random.default_rng(4).standard_normal(len(force))
    found = quietened(read(noisy), [0], excitation_noise(noisy[:, None], np.zeros(1))).samples[:, 0]
    assert np.abs(found - force).max() < 5 * NOISE


def test_what_acts_softly_between_strokes_is_no_noise():
    """A shaker that goes on at a hundredth of the strokes."""
    force = hit([0.5, 1.5])
    soft = 0.3 * np.sin(2 * np.pi * 30 * np.arange(len(force)) / RATE)
    assert struck(force + soft) is None
    assert quietened(read(force + soft), [0], np.zeros(1)).samples[:, 0] == pytest.approx(force + soft)


def test_an_excitation_as_wide_as_the_samples_allow_shows_none():
    force = 45 * np.random.default_rng(3).standard_normal((12000, 1))
    assert excitation_noise(force, np.zeros(1))[0] == 0 and struck(force[:, 0]) is None


@pytest.mark.parametrize("part", [slice(None), slice(0, 6000), slice(6000, None)])
def test_noise_beside_a_band_is_seen_whichever_end_is_quiet(part):
    """A burst that rises from nothing and dies away, the whole of it or a half."""
    rng, t = np.random.default_rng(5), np.arange(12000) / RATE
    burst = sum(rng.standard_normal() * np.sin(2 * np.pi * hz * t + rng.uniform(0, 6)) for hz in np.linspace(20, 300, 60))
    noisy = (burst * np.sin(np.pi * t / t[-1]) ** 2 + NOISE * rng.standard_normal(len(t)))[part]
    assert excitation_noise(noisy[:, None], np.zeros(1))[0] == pytest.approx(NOISE, rel=0.3)

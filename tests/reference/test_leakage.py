"""What windows make of functions of random records, against sums over impulse responses, and damping without it."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "property"))
import vibrating

from mouse_cli.model.recording import INPUT, OUTPUT, Channel, Recording
from mouse_cli.model.spectra import SpectraOptions
from mouse_cli.records.identify import identify_frf
from mouse_cli.records.leakage import lag_window, leakage
from mouse_cli.records.measurements import measure
from mouse_cli.records.modal_model import Lines, ModalModel

RATE, COUNT, ZETA = 200.0, 200_000, 0.02


def record(seed: int) -> Recording:
    """A period of the response to white noise, exact for the continuous structure as it was made line by line; 0.1 % noise."""
    random, hz = np.random.default_rng(seed), np.fft.rfftfreq(COUNT, 1 / RATE)
    force = np.fft.rfft(random.standard_normal(COUNT))
    y = np.fft.irfft(vibrating.accelerance(hz, *vibrating.modes(ZETA), [2])[:, :, 0] * force[:, None], COUNT, axis=0)
    y += 1e-3 * y.std(axis=0) * random.standard_normal(y.shape)
    motions = (Channel(name, OUTPUT, "acceleration", "m/s2", name) for name in "123")
    samples = np.column_stack([np.fft.irfft(force, COUNT), y])
    return Recording("white", 1 / RATE, (Channel("f", INPUT, "force", "N", "3"), *motions), samples)


@pytest.mark.parametrize("kind", [0, 1])
def test_leakage_is_that_of_the_impulse_response(kind):
    """h of one mode: e^(-a t) sin(w t) / w, and its derivative; sums over lags, with the lag window and without."""
    b, T, a, w = 256, 2.0, 1.1, 2 * np.pi * 9.3
    window = np.hanning(b + 1)[:-1]
    r = np.correlate(window, window, "full")[b - 1 :] / (window @ window)
    assert lag_window(window) == pytest.approx(r, abs=1e-14)
    t = np.arange(64 * b) * T / b
    h = np.exp(-a * t) * np.sin(w * t) / w if kind == 0 else np.exp(-a * t) * (np.cos(w * t) - a / w * np.sin(w * t))
    s = 2j * np.pi * np.arange(5, 60) / T
    less = np.zeros(len(t))
    less[:b] = r
    expected = T / b * np.exp(-np.outer(s, t)) @ (h * (less - 1))
    one = np.ones((1, 1), complex)
    model = ModalModel(np.array([-a + 1j * w]), one, one / (2j * w), np.zeros((0, 1, 1)), ())
    lines = Lines(s, np.zeros((len(s), 1, 1), complex), np.ones((len(s), 1, 1)), kind)
    assert leakage(lines, model, r)[:, 0, 0] == pytest.approx(expected, abs=1e-9 * np.abs(expected).max())


@pytest.mark.parametrize("lines", [160, 256])
def test_damping_is_that_of_the_structure_at_two_lines_a_bandwidth(lines):
    """Of resonances 2.4 and 3.2 lines wide leakage makes some 4 % more damping; taken out, nothing is left beyond the sd."""
    test = measure([record(1)], SpectraOptions(lines=lines)).measured[0].frf
    found = identify_frf([test], (4.0, 70.0))
    modes = found.modes
    omega = vibrating.modes(ZETA)[0][-2:] / 2 / np.pi
    assert np.abs(modes.damping[-2:] / ZETA - 1).max() < 0.01
    assert (np.abs(modes.damping[-2:] - ZETA) < 4 * modes.damping_sd[-2:]).all()
    assert (np.abs(modes.frequency_hz[-2:] - omega) < 4 * modes.frequency_sd_hz[-2:]).all()
    assert found.misfit < 1.5
    left = identify_frf([replace(test, lag_window=None)], (4.0, 70.0)).modes.damping[-2:]
    assert (left > 1.02 * ZETA).all() if lines == 160 else (left > ZETA).all()

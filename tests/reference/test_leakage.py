"""What windows make of functions of random records, against sums over impulse responses, and damping without it."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "property"))
import vibrating

from mouse_cli.model.block_window import BlockWindow
from mouse_cli.model.recording import INPUT, OUTPUT, Channel, Recording
from mouse_cli.model.spectra import SpectraOptions
from mouse_cli.observables import frf_leakage
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
    left = identify_frf([replace(test, window=None)], (4.0, 70.0)).modes.damping[-2:]
    assert (left > 1.02 * ZETA).all() if lines == 160 else (left > ZETA).all()


def hann_lags(x: np.ndarray) -> np.ndarray:
    """r of the Hann window at lags of x blocks: (1 - x)(2 + cos 2 pi x) / 3 + sin(2 pi x) / 2 pi."""
    return (1 - x) * (2 + np.cos(2 * np.pi * x)) / 3 + np.sin(2 * np.pi * x) / (2 * np.pi)


@pytest.mark.parametrize("zeta", [5e-4, 3e-3, 2e-2])
@pytest.mark.parametrize(
    ("name", "burst", "r", "least"),
    [
        ("hann", 1.0, hann_lags, 3e-4),
        ("uniform", 1.0, lambda x: 1 - x, 3e-4),
        ("uniform", 0.5, lambda x: np.minimum(1, 2 * (1 - x)), 1e-3),
    ],
)
def test_averages_of_a_model_are_its_impulse_response_times_the_lag_window(name, burst, r, least, zeta):
    """Accelerance of one mass with a resonance of 0.02 to 0.8 lines: 1 + int h r e^(-s t) dt over a block, by the midpoint rule."""
    T, w, n = 4.0, 2 * np.pi * 5.08, 200_000
    pole, s = w * (-zeta + 1j * np.sqrt(1 - zeta**2)), 2j * np.pi * np.arange(2, 60) / T
    t = (np.arange(n) + 0.5) * T / n
    h = (pole**2 * np.exp(pole * t)).imag / pole.imag
    exact = 1 + np.array([np.sum(h * r(t / T) * np.exp(-each * t)) for each in s]) * T / n
    H = lambda s: s**2 / (s**2 + 2 * zeta * w * s + w**2)
    leakage = frf_leakage.leakage(BlockWindow(name, T, burst), s)
    found = leakage.expected(H(leakage.nodes)[:, None])[:, 0]
    assert np.abs(found - exact).max() < least * np.abs(exact).max()
    assert np.abs(H(s) - exact).max() > 0.1 * np.abs(exact).max()  # it matters


@pytest.mark.parametrize("window", ["hann", "uniform"])
def test_averages_of_a_record_scatter_about_those_of_its_structure_by_what_coherence_says(window):
    """Lines of 2.5 Hz, three times as wide as the lowest resonance."""
    test = measure([record(2)], SpectraOptions(lines=40, window=window)).measured[0].frf
    omega, modes = test.omega, vibrating.modes(ZETA)
    leakage = frf_leakage.of_window(test, 1j * omega)
    exact = lambda s: vibrating.accelerance(s / (2j * np.pi), *modes, [2])[:, :, 0]
    used = (test.frequency_hz > 4) & (test.frequency_hz < 70)
    scatter = lambda H: np.mean(np.abs(test.H[:, :, 0] - H)[used] ** 2 / test.variance[:, :, 0][used])
    assert 0.7 < scatter(leakage.expected(exact(leakage.nodes))) < 1.4
    assert scatter(exact(1j * omega)) > 5


def blows(seed: int) -> Recording:
    """Ten strokes of 4 ms, 20 s apart, as bands of the exact response; 0.1 % noise."""
    random, count, zeta = np.random.default_rng(seed), 40_000, 0.005
    t, hz = np.arange(count) / RATE, np.fft.rfftfreq(count, 1 / RATE)
    force = sum((1 + random.random()) * np.exp(-(((t - 1 - 20 * k) / 0.004) ** 2) / 2) for k in range(10))
    H = vibrating.accelerance(hz, *vibrating.modes(zeta), [2])[:, :, 0]
    y = np.fft.irfft(H * np.fft.rfft(force)[:, None], count, axis=0)
    y += 1e-3 * y.std(axis=0) * random.standard_normal(y.shape)
    motions = (Channel(name, OUTPUT, "acceleration", "m/s2", name) for name in "123")
    return Recording(
        "hits", 1 / RATE, (Channel("f", INPUT, "force", "N", "3"), *motions), np.column_stack([force, y])
    )


@pytest.mark.parametrize("window", [None, "exponential"])
def test_damping_is_that_of_a_structure_whose_response_outlasts_the_block(window):
    """Blocks of 2.56 s: the first mode has fallen to a third where they end."""
    test = measure([blows(3)], SpectraOptions(impact=True, window=window, lines=256, final=0.3)).measured[0].frf
    assert test.window == BlockWindow("uniform", 2.56, 0.0)
    modes = identify_frf([test], (4.0, 70.0)).modes
    assert len(modes.frequency_hz) == 3
    assert np.abs(modes.damping / 0.005 - 1).max() < 0.02
    cut = identify_frf([replace(test, window=None)], (4.0, 70.0)).modes
    assert len(cut.damping) < 3 or np.abs(cut.damping / 0.005 - 1).max() > 0.05


def test_a_window_that_weakens_strokes_is_refused():
    from mouse_cli._errors import RecordError

    with pytest.raises(RecordError, match="weakens a stroke"):
        measure([blows(3)], SpectraOptions(impact=True, window="hann", lines=256))

"""Noise larger than stated, integrated out: the closed form against numerical integration of what it is said to be."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from mouse_cli.diagnosis.noise import log_density, scale
from mouse_cli.diagnosis.validate.held_out import HeldOutDensity

RATE = 6.0  # of ln s, before the test: s is 2 or more in 1 of 64


def integrated(misfit: float, dof: float) -> float:
    """ln of the integral over t = ln s >= 0 of 6 exp(-6 t) exp(-d t) exp(-m exp(-2 t) / 2), about its peak."""
    a = dof + RATE
    exponent = lambda t: -a * t - 0.5 * misfit * np.exp(-2 * t)
    peak = max(0.0, 0.5 * np.log(max(misfit, 1e-300) / a))
    top, width = exponent(peak), 1 / np.sqrt(2 * a) if peak else min(1.0, 1 / abs(misfit - a)) if misfit != a else 1.0
    edges = np.unique(np.clip(peak + width * np.array([-40, -12, -4, 0, 4, 12, 60.0]), 0, None))
    edges = np.append(edges, edges[-1] + 40 / a)
    total = sum(
        quad(lambda t: np.exp(exponent(t) - top), a, b, epsabs=0, epsrel=1e-11, limit=200)[0]
        for a, b in pairwise(edges)
    )
    return float(np.log(RATE) + top + np.log(total))


@pytest.mark.parametrize("dof", [0, 1, 3, 20, 150, 2000])
@pytest.mark.parametrize("misfit", [1e-3, 0.3, 1.0, 7.0, 20.0, 300.0, 2000.0, 1e5])
def test_it_is_the_integral_over_the_scale(misfit, dof):
    assert float(log_density(np.array([misfit]), dof)[0]) == pytest.approx(integrated(misfit, dof), rel=1e-9, abs=1e-9)


def test_without_misfit_or_degrees_of_freedom():
    """No misfit: 6 / (d + 6). No degree of freedom: what is left may be left for nothing."""
    for dof in (0, 1, 50):
        assert float(log_density(np.zeros(1), dof)[0]) == pytest.approx(np.log(6 / (dof + 6)), abs=1e-12)
    assert float(log_density(np.zeros(1), -2)[0]) == 0.0


def test_it_is_finite_where_the_closed_form_underflows():
    """A misfit of 1 on 5000 degrees of freedom: gamma(a, x) is no number there; the integral is."""
    for misfit, dof in ((1.0, 5000), (30.0, 900), (1e-8, 40), (1e7, 3)):
        assert float(log_density(np.array([misfit]), dof)[0]) == pytest.approx(integrated(misfit, dof), rel=1e-9)


def test_all_misfits_at_once():
    misfits = np.array([[0.0, 1.0], [40.0, 1e4]])
    each = [[float(log_density(np.array([value]), 12)[0]) for value in row] for row in misfits]
    assert log_density(misfits, 12) == pytest.approx(np.array(each), rel=1e-12)


@pytest.mark.parametrize(("misfit", "dof"), [(40.0, 5), (1e4, 97), (12.0, 0), (50.0, 60), (0.0, 7)])
def test_the_scale_is_where_the_integrand_is_largest(misfit, dof):
    """On a grid of s^2 >= 1, in ln s."""
    s2 = np.exp(np.linspace(0, 10, 200_001))
    most = s2[np.argmax(-0.5 * (dof + RATE) * np.log(s2) - 0.5 * misfit / s2)]
    assert scale(misfit, dof) == pytest.approx(most, rel=1e-4)


def test_more_than_all_degrees_of_freedom_is_none():
    assert scale(12.0, -4) == scale(12.0, 0) == 2.0


@pytest.mark.parametrize(("misfit", "off"), [(9.0, 0.0), (36.4, 0.0), (36.4, 58.1)])
def test_a_prediction_pays_for_the_noise_that_it_needs(misfit, off):
    """ln of the density of nine data, less what a scale of one takes: by numerical integration; two that both err by more than
    their uncertainty differ by less than their chi-squares do.
    """
    over_noise = lambda m: HeldOutDensity(-0.5 * m - 20.0, m, 9).over_noise
    assert over_noise(misfit) == pytest.approx(integrated(misfit, 9) - 20.0, rel=1e-9)
    assert not off or 0 < over_noise(misfit) - over_noise(off) < 0.5 * (off - misfit) - 5.0

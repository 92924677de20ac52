"""Predictions of several hypotheses as one: mean, variance and density of a mixture of normal distributions."""

import numpy as np
import pytest
from scipy.stats import norm

from mouse_cli.diagnosis.validate.averaged import _mixed
from mouse_cli.diagnosis.validate.held_out import Prediction
from mouse_cli.model.modal_test import ModalTest

HZ, SD = (10.2, 9.7, 10.0), (0.1, 0.3, 0.02)
WEIGHTS = np.array([0.5, 0.3, 0.2])


def prediction(hz: float, sd: float, measured: float) -> Prediction:
    """Of one mode, by a hypothesis that predicts N(hz, sd^2)."""
    unmeasured = np.zeros((0, 1))
    test = ModalTest(
        np.array([1]), np.array([measured]), np.array([0.01]), np.zeros(0, int), unmeasured, unmeasured, "fitted"
    )
    off = (measured - hz) / sd
    density = float(norm.logpdf(measured, hz, sd))
    return Prediction(
        test, np.array([hz]), np.array([sd]), np.array([1.0]), density, np.array([abs(off) < 1.64]), off**2, 1
    )


@pytest.mark.parametrize("measured", [9.8, 10.9])
def test_a_mixture(measured):
    """By sampling it, and by its density; the weights need not sum to one."""
    told = [
        (np.log(7 * w), prediction(*each, measured)) for w, each in zip(WEIGHTS, zip(HZ, SD, strict=True), strict=True)
    ]
    found, rng = _mixed(told), np.random.default_rng(0)
    which = rng.choice(3, 400_000, p=WEIGHTS)
    drawn = rng.normal(np.array(HZ)[which], np.array(SD)[which])
    assert found.hz[0] == pytest.approx(drawn.mean(), abs=2e-3)
    assert found.sd_hz[0] == pytest.approx(drawn.std(), rel=5e-3)
    assert found.density == pytest.approx(np.log(WEIGHTS @ norm.pdf(measured, HZ, SD)))
    assert found.covered[0] == (abs(measured - drawn.mean()) < 1.645 * drawn.std())

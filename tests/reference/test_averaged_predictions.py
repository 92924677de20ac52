"""Predictions of several hypotheses as one: mean, variance and density of a mixture of normal distributions."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.stats import norm

from mouse_cli.diagnosis.likelihoods.modal.data import Data
from mouse_cli.diagnosis.search.rank import Ranking
from mouse_cli.diagnosis.validate.averaged import _mixed, _weighed, _widened, members
from mouse_cli.diagnosis.validate.held_out import Prediction
from mouse_cli.model.modal_test import ModalTest, restricted
from mouse_cli.model.theory import Theory

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
    low, middle, high = np.quantile(drawn, [0.05, 0.5, 0.95])
    assert found.hz[0] == pytest.approx(middle, abs=2e-3)
    assert found.sd_hz[0] == pytest.approx((high - low) / 3.2897, rel=5e-3)
    assert found.density == pytest.approx(np.log(WEIGHTS @ norm.pdf(measured, HZ, SD)))
    assert found.covered[0] == (low < measured < high)


def test_a_mode_left_out_is_none_of_those_that_were_fitted():
    """Storeys that twist have modes in pairs whose sway is alike: 9 and 11 Hz are 10.2 and 12.6 Hz of a model 14 % too stiff.

    By itself 11 Hz lies nearer to 10.2 Hz, and would be predicted 7 % too low, not 14 % too high.
    """
    sway = np.array([0.3, 0.7, 1.0])
    hz, shapes = np.array([9.0, 11.0]), np.stack([sway, sway], axis=1)
    test = ModalTest(np.array([1, 2]), hz, 0.01 * hz, np.arange(3), shapes, 0 * shapes + 0.01, "fitted")
    apart = [restricted(test, np.array(mask)) for mask in ([False, True], [True, False])]
    eigenvalues, seen = (2 * np.pi * np.array([10.2, 12.6, 60.0])) ** 2, np.column_stack([shapes, [1.0, -0.9, 0.4]])
    assert Data(apart[0], Theory(), apart[1]).pair(eigenvalues, seen).tolist() == [1]
    assert Data(apart[1], Theory(), apart[0]).pair(eigenvalues, seen).tolist() == [0]


def test_the_model_as_it_is_predicts_too():
    """Without a mode it may be as probable as what explains that mode."""
    baseline, other = (SimpleNamespace(variants=()) for _ in range(2))
    ranking = Ranking(baseline, (other, baseline), 1.0, np.array([0.9, 0.1]), (), np.ones(2), np.zeros(2))
    assert [one.fit for one in members(ranking)] == [other, baseline]


def test_vague_predictions_of_little_weight_move_nothing():
    """0.04 of the weight on 30 +- 20 Hz beside 10 +- 0.01 Hz: the mean is 10.8 Hz, the median 10 Hz."""
    found = _mixed([(np.log(0.96), prediction(10.0, 0.01, 10.0)), (np.log(0.04), prediction(30.0, 20.0, 10.0))])
    assert found.hz[0] == pytest.approx(10.0, abs=1e-3) and found.covered[0]
    assert found.sd_hz[0] < 0.05


def test_a_prediction_is_as_uncertain_as_its_errors_elsewhere():
    """2 % of error in other modes beside an sd of 0.1 %: all of its variances grow by that, and its density with them."""
    found = _widened(one := prediction(10.0, 0.01, 10.3), 0.02**2)
    assert found.sd_hz[0] == pytest.approx(0.2)
    assert found.density == pytest.approx(norm.logpdf(10.3, 10.0, 0.2))
    assert _widened(one, 1e-12) == one


def test_of_refuted_hypotheses_one_that_knows_little_of_a_mode_weighs_little():
    """Errors of 1 % elsewhere beside 95 % of its own in this mode, and of 3 % beside 3 %: by errors elsewhere the first leads."""
    sharp, vague = [0.03, -0.03, 0.03, 0.03], [0.01, -0.01, 0.01, 0.01]
    found = _mixed(
        [_weighed(0.0, prediction(23.0, 9.5, 10.0), vague), _weighed(0.0, prediction(10.1, 0.3, 10.0), sharp)]
    )
    assert found.hz[0] == pytest.approx(10.1, abs=0.01)
    assert _weighed(0.0, prediction(10.0, 0.1, 10.0), [0.01, np.inf])[0] == -np.inf

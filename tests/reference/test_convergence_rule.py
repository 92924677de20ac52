"""The report's convergence test beside scipy's normal distribution, and counts that its rule allows."""

import numpy as np
import pytest
from scipy.stats import norm

from mouse_cli.updating.convergence import ExceedanceTest


@pytest.mark.parametrize("confidence", [90, 95, 99])
def test_limits_hold_the_stated_share(confidence):
    """Two-sided limits, to the digits that the report prints."""
    rule = ExceedanceTest(confidence, "ratio")
    assert 1 - 2 * norm.sf(rule.z) == pytest.approx(confidence / 100, abs=1e-4)
    sd = np.array([1.0, 2.0, 2.0, 1.0])
    just = rule.z * sd * np.array([1.001, -1.001, 0.999, -0.999])
    assert rule.exceeding(just, sd).tolist() == [True, True, False, False]


@pytest.mark.parametrize("confidence, share", [(90, 10), (95, 20), (99, 100)])
def test_a_share_that_is_whole(confidence, share):
    """One in ten, twenty or a hundred: of all data, or beside as many that hold."""
    for k in range(1, 40):
        assert ExceedanceTest(confidence, "fraction").allowed(k * share) == k
        assert ExceedanceTest(confidence, "ratio").allowed(k * (share + 1)) == k
        assert ExceedanceTest(confidence, "ratio").allowed(k * (share + 1) - 1) == k - 1

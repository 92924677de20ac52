"""The tail of the chi-square distribution against the incomplete gamma function of mpmath."""

import numpy as np
import pytest
from mpmath import mp

from mouse_cli.updating import model_form
from mouse_cli.updating.chi_square import upper_tail

DOFS = (1, 2, 3, 4, 5, 9, 20, 31, 100, 499, 1000, 1999, 2000)


def reference(chi2: float, dof: int) -> float:
    """Q(dof/2, chi2/2) with 60 digits."""
    with mp.workdps(60):
        return float(mp.gammainc(mp.mpf(dof) / 2, mp.mpf(chi2) / 2, mp.inf, regularized=True))


@pytest.mark.parametrize("dof", DOFS)
def test_bulk_and_tail(dof):
    """From the lower tail to 1e-300, relative to the tail itself."""
    for share in (1e-3, 0.1, 0.5, 0.9, 1.0, 1.1, 1.5, 2.0, 5.0, 20.0, 100.0):
        chi2 = share * dof
        expected = reference(chi2, dof)
        if expected > 1e-300:
            assert upper_tail(chi2, dof) == pytest.approx(expected, rel=1e-11), (chi2, dof)
        else:
            assert 0.0 <= upper_tail(chi2, dof) <= 1e-299


@pytest.mark.parametrize("dof", (1, 2, 7, 50, 2000))
def test_tail_of_1e_300(dof):
    """The chi2 whose tail is about 1e-300, found by bisection on our own answer, has that tail in mpmath."""
    low, high = float(dof), 1e5
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if upper_tail(middle, dof) > 1e-300 else (low, middle)
    assert upper_tail(low, dof) == pytest.approx(1e-300, rel=1e-6)
    assert reference(low, dof) == pytest.approx(1e-300, rel=1e-6)


@pytest.mark.parametrize("dof", (1, 2, 3, 10, 101, 2000))
def test_monotone_and_finite(dof):
    values = np.array([upper_tail(c, dof) for c in np.concatenate([[0.0], np.logspace(-300, 300, 4001)])])
    assert np.isfinite(values).all() and values[0] == 1.0 and values[-1] == 0.0
    assert (np.diff(values) <= 1e-11 * values[:-1]).all()  # the accuracy of the sum
    for c in np.logspace(-2, 4, 100):
        assert upper_tail(c, dof) <= upper_tail(c, dof + 1) * (1 + 1e-11)


def test_nothing_to_test_and_beyond_all_bounds():
    assert upper_tail(5.0, 0) == 1.0 and upper_tail(-1e-20, 3) == 1.0
    assert upper_tail(float("inf"), 3) == 0.0 and upper_tail(float("nan"), 3) == 0.0


def test_a_million_degrees_of_freedom():
    """Three sd above the mean of 10^6 degrees of freedom."""
    chi2 = 1e6 + 3 * np.sqrt(2e6)
    assert upper_tail(chi2, 10**6) == pytest.approx(reference(chi2, 10**6), rel=1e-8)


@pytest.mark.parametrize(("q", "k"), [(700, 520), (520, 700)])
def test_large_problems_split_by_a_triangle(q, k):
    """The same sums from singular values and from a triangle; a problem of lower rank is left to singular values."""
    rng = np.random.default_rng(5)
    B, d = rng.standard_normal((q, k)) * 10.0 ** rng.uniform(-2, 2, k), rng.standard_normal(q)
    outside, moved, rank = model_form._split(B, d)
    assert model_form._well_determined(B, d) == (
        pytest.approx(outside, abs=1e-10 * (d @ d)),
        pytest.approx(moved, rel=1e-9),
        rank,
    )
    B[:, : k - 510] = 0.0
    assert model_form._well_determined(B, d) is None or q < k

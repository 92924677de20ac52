"""What holds for any shapes: MAC knows neither scale nor sign, and pairs do not depend on the order of modes."""

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from mouse_cli.dynamics.correlation import Measured, comac, distance, ecomac, mac, match, pair, paired, subspace_cosines

seeds = st.integers(0, 2**32 - 1)


def drawn(seed: int, s: int = 6, m: int = 3, k: int = 5):
    """Measured shapes (s, m), some components missing, and frequencies; model shapes (s, k) and frequencies."""
    rng = np.random.default_rng(seed)
    test, model = rng.standard_normal((s, m)), rng.standard_normal((s, k))
    test[rng.random((s, m)) < 0.1] = np.nan
    return rng, test, np.sort(rng.uniform(1, 9, m)), model, np.sort(rng.uniform(1, 9, k))


@given(seeds)
def test_mac_is_blind_to_scale_and_sign(seed):
    rng, test, _, model, _ = drawn(seed)
    factors = rng.choice([-1, 1], 3) * 10 ** rng.uniform(-6, 6, 3)
    np.testing.assert_allclose(mac(test * factors, model), mac(test, model), rtol=1e-9, atol=1e-14)
    np.testing.assert_allclose(mac(model, test).T, mac(test, model), rtol=1e-12)
    assert (mac(test, model) <= 1 + 1e-12).all()


@given(seeds)
def test_sensor_criteria_are_blind_to_scale_and_sign_of_modes(seed):
    rng, test, _, model, _ = drawn(seed, k=3)
    factors = rng.choice([-1, 1], 3) * 10 ** rng.uniform(-3, 3, 3)
    np.testing.assert_allclose(comac(test * factors, model), comac(test, model), rtol=1e-9)
    np.testing.assert_allclose(ecomac(test * factors, model), ecomac(test, model), rtol=1e-7, atol=1e-12)
    found = comac(test, model)
    assert ((found >= 0) & (found <= 1 + 1e-12))[np.isfinite(found)].all()


@given(seeds)
def test_subspaces_do_not_depend_on_their_basis(seed):
    rng, _, _, model, _ = drawn(seed, s=8, k=4)
    mixed = model[:, :2] @ rng.standard_normal((2, 2)) + 0.0
    if np.linalg.cond(mixed) < 1e6:
        np.testing.assert_allclose(
            subspace_cosines(mixed, model[:, 2:]), subspace_cosines(model[:, :2], model[:, 2:]), atol=1e-8
        )


@given(seeds)
def test_pairs_do_not_depend_on_the_order_of_modes(seed):
    """Shapes of two components or more: with fewer, two assignments can be equally good."""
    rng, test, test_hz, model, hz = drawn(seed)
    assume(np.isfinite(test).sum(axis=0).min() > 1)
    ours, theirs = rng.permutation(3), rng.permutation(5)
    where = np.append(np.argsort(theirs), -1)  # place of each model mode after the permutation; -1 stays -1
    apart = distance(mac(test, model), test_hz, hz)
    np.testing.assert_array_equal(match(apart[np.ix_(ours, theirs)]), where[match(apart)[ours]])
    shuffled = pair(test[:, ours], test_hz[ours], model[:, theirs], hz[theirs])
    np.testing.assert_array_equal(shuffled, where[pair(test, test_hz, model, hz)[ours]])


@given(seeds, st.floats(0.05, 3))
def test_no_pair_is_farther_apart_than_allowed(seed, limit):
    _, test, test_hz, model, hz = drawn(seed)
    apart = distance(mac(test, model), test_hz, hz)
    found = match(apart, limit)
    assert all(apart[i, j] <= limit for i, j in enumerate(found) if j >= 0)
    assert len(set(found[found >= 0])) == (found >= 0).sum()


@settings(deadline=None)  # the first example imports scipy.optimize
@given(seeds, st.integers(1, 8), st.integers(1, 12), st.booleans())
def test_the_assignment_is_that_of_scipy(seed, m, k, crowded):
    from scipy.optimize import linear_sum_assignment

    rng = np.random.default_rng(seed)
    apart = rng.random((m, k))
    if crowded:  # all rows want much the same columns
        apart = apart[:1] + 0.05 * rng.random((m, k))
    rows, columns = linear_sum_assignment(apart)
    found = paired(apart)
    np.testing.assert_array_equal(found[rows], columns)
    assert (np.delete(found, rows) == k).all() and len(found) == m  # of fewer columns than rows: k, which is none


@given(seeds)
def test_measured_modes_kept_for_many_models_are_paired_alike(seed):
    _, test, test_hz, model, hz = drawn(seed)
    np.testing.assert_array_equal(Measured(test, test_hz).pair(model, hz), pair(test, test_hz, model, hz))
    test_hz[seed % 3], hz[seed % 2] = np.nan, 0.0
    np.testing.assert_array_equal(Measured(test, test_hz).pair(model, hz), pair(test, test_hz, model, hz))


@given(seeds, st.floats(0.0, np.pi))
def test_the_partner_of_a_double_mode_does_not_depend_on_its_basis(seed, angle):
    """Beside it another double mode is a tenth higher, and nearly as like the measured shapes as their own plane."""
    rng = np.random.default_rng(seed)
    plane = np.linalg.qr(rng.standard_normal((8, 2)))[0]
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    near = plane + 0.1 * np.linalg.qr(np.hstack([plane, rng.standard_normal((8, 2))]))[0][:, 2:]
    hz, test_hz, shapes = np.array([3.0, 3.0, 3.3, 3.3]), np.array([3.001, 3.002]), np.hstack([plane @ turn, near])
    assert set(pair(plane, test_hz, shapes, hz).tolist()) == {0, 1}
    assert set(Measured(plane, test_hz).pair(shapes, hz).tolist()) == {0, 1}
    missing = plane.copy()
    missing[0, 0] = np.nan
    assert set(pair(missing, test_hz, shapes, hz).tolist()) == {0, 1}

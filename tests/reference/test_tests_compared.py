"""Tests before and after, each beside the other: by draws of noise, and in a diagnosis whose model is wrong."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import kstest

from mouse_cli.diagnosis.likelihoods.configurations.compared import between
from mouse_cli.model.modal_test import ModalTest
from tests.reference.test_arrangements import measured
from tests.reference.test_state_before import OTHER_MASSES, answered, edited

SHAPES = np.random.default_rng(5).standard_normal((9, 6))
SHAPES /= np.abs(SHAPES).max(axis=0)
HZ = np.array([4.0, 4.1, 7.0, 11.0, 15.0, 21.0])
SD, SHAPE_SD = 1e-3, 0.01
OF_MODES = ("frequency_hz", "frequency_sd_hz", "shapes", "shape_sd")


def drawn(rng: np.random.Generator, hz: np.ndarray = HZ, times: float = 1.0) -> ModalTest:
    """A test of these modes, its shapes at another scale."""
    seen = times * (SHAPES + SHAPE_SD * rng.standard_normal(SHAPES.shape))
    noisy = hz * np.exp(SD * rng.standard_normal(6))
    return ModalTest(np.arange(1, 7), noisy, SD * hz, np.arange(9), seen, np.full((9, 6), times * SHAPE_SD))


@pytest.mark.parametrize("times", [1.0, -7.0])
def test_of_noise_alone_the_chi_square_is_one(times):
    rng = np.random.default_rng(8)
    found = [between(drawn(rng), drawn(rng, times=times)) for _ in range(400)]
    assert {each.dof for each in found} == {6 + 6 * 8}
    assert kstest([each.chi2 for each in found], "chi2", args=(54,)).pvalue > 0.01
    assert sum(each.alike for each in found) >= 398


@pytest.mark.parametrize("mode", range(6))
def test_one_frequency_of_many_data_is_enough(mode):
    rng, hz = np.random.default_rng(mode), HZ.copy()
    hz[mode] *= 1 - 12 * SD
    before, after = drawn(rng), drawn(rng, hz)
    assert not between(before, after).alike
    assert between(after, before).p == pytest.approx(between(before, after).p, rel=0.05)


def test_a_shape_that_turned_is_a_difference():
    rng = np.random.default_rng(2)
    before, after = drawn(rng), drawn(rng)
    shapes = after.shapes.copy()
    shapes[3, 2] += 8 * SHAPE_SD
    assert not between(before, replace(after, shapes=shapes)).alike


def test_modes_in_another_order_are_paired_and_what_was_not_measured_counts_for_nothing():
    rng = np.random.default_rng(3)
    before, after = drawn(rng), drawn(rng)
    order = np.array([1, 0, 2, 3, 5, 4])
    mixed = replace(after, **{name: getattr(after, name)[..., order] for name in OF_MODES})
    assert between(before, mixed).chi2 == pytest.approx(between(before, after).chi2)
    shapes, hz = before.shapes.copy(), before.frequency_hz.copy()
    shapes[0], hz[2] = np.nan, np.nan
    assert between(replace(before, shapes=shapes, frequency_hz=hz), after).dof == 54 - 6 - 1


def test_tests_of_other_sensors_or_modes_are_not_compared():
    test = drawn(np.random.default_rng(1))
    fewer = {"number": np.arange(1, 6)} | {name: getattr(test, name)[..., :5] for name in OF_MODES}
    assert between(test, replace(test, dofs=np.arange(1, 10))) is None
    assert between(test, replace(test, **fewer)) is None


def test_nothing_has_changed_whatever_the_model_errs(tmp_path, monkeypatch):
    """The masses of the model are other ones altogether, so that it explains neither test; and nothing is sought."""
    monkeypatch.setattr("mouse_cli.diagnosis.likelihoods.configurations.diagnose.rank", None)
    before, after = (measured(tmp_path, *each) for each in (("before", 1), ("after", 2)))
    for path in (before, after):
        edited(path, "nodes: 1-8, mass: 1.0", OTHER_MASSES)
    code, found = answered(tmp_path, before, after)
    assert (code, found["verdict"]["kind"], found["turns"]) == (0, "nothing-missing", [])
    assert found["residual"]["p"] < 1e-6 < found["tests"]["p"]
    first, second = found["verdict"]["sentences"]
    assert "Nothing has changed" in first and "diagnose the state before by itself" in second

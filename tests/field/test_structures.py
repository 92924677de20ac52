"""Measured structures as frames of elements: what their published frequencies make of the models."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mouse_cli.formats import read_deck
from mouse_cli.updating import forecast, run

DECKS = Path(__file__).resolve().parents[2] / "decks"


def errors(hz: np.ndarray, test: np.ndarray) -> np.ndarray:
    """Per cent by which a model is above the test."""
    return 100 * (hz / test - 1)


def test_eighteen_storeys_as_built_are_a_shear_building_that_misses_the_test():
    """Errors of the nominal shear chain as they are known of it: +5.1, -7.5, -16.1 %."""
    hz = forecast(read_deck(DECKS / "eighteen_storeys.yaml"), 3).frequencies_hz
    assert errors(hz, np.array([0.86517642, 2.68683262, 4.84910401])) == pytest.approx([5.1, -7.5, -16.1], abs=0.05)


def test_eighteen_storeys_two_modes_are_fitted_only_by_improbable_stiffnesses():
    """Bending of the frame as a whole is left out: the ratio 1 : 3.1 : 5.6 of the frequencies is that of no shear building."""
    result = run(read_deck(DECKS / "eighteen_storeys.yaml"))
    assert result.exit_code == 1 and result.prior_shift.rejects
    hz = np.sqrt(result.revised.eigenvalues[:3]) / (2 * np.pi)
    before = np.sqrt(result.prior.eigenvalues[:3]) / (2 * np.pi)
    test = np.array([0.86517642, 2.68683262, 4.84910401])
    assert (np.abs(errors(hz, test))[:2] < 0.4 * np.abs(errors(before, test))[:2]).all()
    assert errors(hz, test)[2] < -10  # the mode that was kept back is no better: the model lacks something
    assert (result.revised.mac > 0.99).all()


def test_garteur_comes_within_three_per_cent():
    deck = read_deck(DECKS / "garteur_smag19.yaml")
    result = run(deck)
    assert result.exit_code == 0 and result.rigid_modes == 6
    test = deck.test.frequency_hz
    before, after = (np.sqrt(s.eigenvalues[s.modes]) / (2 * np.pi) for s in (result.prior, result.revised))
    assert np.abs(errors(before, test)).max() > 10
    assert np.abs(errors(after, test)).max() < 3
    assert 0 < result.revised.theta[2] < 1  # the tape passes on a part of the plate's stiffness


def test_garteur_without_soft_joints_is_refused():
    """The same with rigid joints: no modulus, density, plate or tip mass explains the frequencies."""
    deck = read_deck(DECKS / "garteur_smag19.yaml")
    rigid = [replace(p, nominal=1e8, sd=0.0) if "joint" in p.name else p for p in deck.parameters]
    mean, cov = deck.prior.mean.copy(), deck.prior.cov.copy()
    for i, parameter in enumerate(rigid):
        mean[i], cov[i] = parameter.nominal, parameter.sd**2
    result = run(replace(deck, parameters=tuple(rigid), prior=replace(deck.prior, mean=mean, cov=cov)))
    assert result.residual.rejects and result.exit_code == 1

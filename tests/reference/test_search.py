"""What misleads a search for causes: modes that nobody measured, places that are counted otherwise at other parameters."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh

from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.unseen import unseen
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.parameter import Gaussian, Parameter
from mouse_cli.model.problem import Problem
from mouse_cli.model.structure import ListedElements, Structure

K = 100e3 * (2 * np.eye(5) - np.eye(5, k=1) - np.eye(5, k=-1))  # five equal masses of 1 kg between two walls


def chain(count_from: int) -> Reduced:
    """The chain and its three lowest modes, which the test counts from `count_from`."""
    lam, X = eigh(K, np.eye(5))
    hz, shapes = np.sqrt(lam[:3]) / (2 * np.pi), X[:, :3]
    numbers = np.arange(count_from, count_from + 3)
    test = ModalTest(numbers, hz, 1e-3 * hz, np.arange(5), shapes, np.full((5, 3), 0.01))
    row, col = np.nonzero(np.triu(K))
    listed = ListedElements(np.zeros(len(row), bool), row, col)
    prior = Gaussian(np.ones(1), np.array([0.05**2]))
    parameters = (Parameter("factor", 0.05, 1.0),)
    deck = Problem("chain", Structure(K, np.eye(5)), listed, K[row, col][:, None], parameters, prior, test)
    return reduced(deck, prior.mean)


def with_oscillator(model: Reduced, hz: float, kg: float):
    """The model with an oscillator on its second mass, nothing fitted."""
    recipe = Study(model).recipes("oscillator")[1]
    return fit(Model(model, (recipe,)), recipe.coordinates(np.array([kg, hz])), most=0)


def test_an_oscillator_below_all_measured_modes_would_have_been_seen():
    """One of 1 kg at half the first frequency moves the chain with it; r from the modes of the six masses, solved here."""
    model = chain(1)
    hz = 0.5 * model.data.test.frequency_hz[0]
    arm = np.array([0, 1, 0, 0, 0, -1.0])
    _, X = eigh(np.pad(K, (0, 1)) + (2 * np.pi * hz) ** 2 * np.outer(arm, arm), np.eye(6))
    size = np.abs(X[:5]).max(axis=0)
    expected = np.log1p((size[0] / np.median(size[1:4]) / 0.03) ** 2)
    assert expected > 3
    assert unseen(with_oscillator(model, hz, 1.0)) == pytest.approx(expected, rel=1e-6)


def test_a_mode_that_the_test_counts_is_no_evidence():
    model = chain(2)
    assert unseen(with_oscillator(model, 0.5 * model.data.test.frequency_hz[0], 1.0)) == 0.0


def test_an_oscillator_above_the_measured_modes_is_not_expected_to_be_seen():
    model = chain(1)
    assert unseen(with_oscillator(model, 1.4 * model.data.test.frequency_hz[2], 0.05)) == 0.0


def test_a_cause_keeps_its_place_where_places_are_counted_otherwise():
    """A candidate that lists its places by how much they matter, which depends on the parameters."""
    candidate, model = registry()["ground-spring"], chain(1)

    def reversed_elsewhere(here: Reduced, own):
        found = candidate.recipes(here, own)
        return found if here.theta[0] == 1.0 else found[::-1]

    study = Study(model, {"ground-spring": replace(candidate, recipes=reversed_elsewhere)})
    recipe = study.recipes("ground-spring")[1]
    one = fit(Model(model, (recipe,)), recipe.coordinates(np.array([1e3])), np.array([2.0]), most=0)
    (same,) = study.at(one).own((recipe,))
    assert same.site(np.array([1e3])).text == recipe.site(np.array([1e3])).text
    assert same.number == 3

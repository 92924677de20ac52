"""The proof on an altered configuration, and that the deck which a diagnosis writes says the same as the fit inside it."""

from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import eigh

from mouse_cli.diagnosis import diagnose
from mouse_cli.formats import read_deck, write_deck
from mouse_cli.model.arrays import dense
from mouse_cli.terms.assembly import assembly
from mouse_cli.updating import run

DECKS = Path(__file__).resolve().parents[2] / "decks"
SPRINGS, HELD, ADDED = np.array([1100.0, 950.0, 1050.0, 900.0]), 400.0, 3.0  # of the head of the deck


def altered_hz(problem, theta):
    """Frequencies of the model of `problem` at theta with the masses of its altered configuration, by LAPACK."""
    K, M = (np.array(dense(matrix)) for matrix in assembly(problem).matrices(theta))
    for dof, kg in problem.hold_out.altered[0].masses.items():
        M[dof, dof] += kg
    return np.sqrt(eigh(K, M, eigvals_only=True)) / (2 * np.pi)


@pytest.fixture(scope="module")
def found():
    return diagnose(read_deck(DECKS / "ground_spring_proved.yaml"))


def test_the_deck_holds_what_its_head_says(found):
    """Typed frequencies within 2.5 sd of a chain solved anew."""
    K = np.diag(SPRINGS + np.append(SPRINGS[1:], 0)) - np.diag(SPRINGS[1:], 1) - np.diag(SPRINGS[1:], -1)
    K[1, 1] += HELD
    hz = np.sqrt(eigh(K, np.diag([1.0, 1.0 + ADDED, 1.0, 1.0]), eigvals_only=True)) / (2 * np.pi)
    altered = found.problem.hold_out.altered[0]
    assert np.abs(altered.frequency_hz / hz - 1).max() < 2.5 * 0.002
    assert altered.masses == {1: ADDED}


def test_a_configuration_that_no_fit_has_seen(found):
    held = found.held_out
    assert found.kind == "named" and found.best.physics == "ground-spring"
    assert 0.08 < held.baseline.rms_frequency_error < 0.12
    assert held.revised.rms_frequency_error < 0.01
    assert held.revised.log_predictive_density > held.baseline.log_predictive_density + 3
    assert held.revised.covered >= 0.75


def test_the_written_deck_predicts_the_same(found, tmp_path):
    """`mouse run` on it, then the masses added to its matrices: what the report says of the extended model, within its sd."""
    written = read_deck(write_deck(found.extended, tmp_path / "revised.yaml")[-1])
    result = run(written)
    hz = altered_hz(written, result.revised.theta)
    measured = found.held_out.measured_hz
    assert result.status.answered and not result.rejected
    assert np.sqrt(np.mean((hz / measured - 1) ** 2)) < 0.01
    assert (np.abs(hz - found.held_out.revised.frequencies_hz) < 0.5 * found.held_out.revised.sd_hz).all()
    as_it_is = altered_hz(found.problem, found.result.revised.theta)
    assert np.sqrt(np.mean((as_it_is / measured - 1) ** 2)) > 0.08

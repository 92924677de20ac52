"""Data held out where two modes of the model cross within what the fit leaves open: their density against quadrature.

Two masses, joined by a soft spring c, each on its own spring to the ground, and a third that stands alone, whose mode is all that
is fitted: it says nothing of the second spring k2, so that p(held | fitted) = integral of p(held | k2) p(k2).
"""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh

from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.diagnosis.validate.held_out import held_out, held_out_density
from mouse_cli.dynamics.solver import EigenSolver
from mouse_cli.formats import read_deck

COUPLED, ALONE, PRIOR, SD = 0.05, 9.0, 1.2, 0.24
ACCURACY, SHAPE_SD = 2e-3, 0.02
DECK = """\
mouse: 1
model:
  stiffness: {{dense: [[1.05, -0.05, 0], [-0.05, 1.25, 0], [0, 0, 9]]}}
  mass: {{identity: 3}}
parameters:
  - {{name: k2, nominal: 1.2, sd: 20 %, stiffness: [[2, 2, 1.0]]}}
theory: {{frequency: 1e-9, shape: 1e-9, mechanism: 0.01}}
test:
  modes:
    frequency: {frequency}
    frequency_sd: 0.2 %
    dofs: [1, 2, 3]
    shapes: {shapes}
    shape_sd: 0.02
  hold_out: {{modes: [1, 2]}}
"""


def modes(k2):
    """Frequencies in Hz and shapes, largest component 1, of the whole."""
    K = np.array([[1 + COUPLED, -COUPLED, 0], [-COUPLED, k2 + COUPLED, 0], [0, 0, ALONE]])
    rates, X = eigh(K)
    return np.sqrt(rates) / (2 * np.pi), X / X[np.abs(X).argmax(axis=0), range(3)]


def log_density(k2, hz, shapes):
    """ln p of the first two modes, the lengths of their shapes fitted."""
    own, X = modes(k2)
    alike = np.abs(X[:, :2].T @ shapes) / np.linalg.norm(X[:, :2], axis=0)[:, None]
    pair = [0, 1] if alike[0, 0] + alike[1, 1] > alike[0, 1] + alike[1, 0] else [1, 0]
    own, f = own[pair], X[:, pair]
    off = np.log(hz / own) / ACCURACY
    left = (shapes - f * (f * shapes).sum(axis=0) / (f**2).sum(axis=0)) / SHAPE_SD
    constants = 2 * np.log(np.sqrt(2 * np.pi) * ACCURACY) + 6 * np.log(np.sqrt(2 * np.pi) * SHAPE_SD)
    return -0.5 * ((off**2).sum() + (left**2).sum()) - constants


@pytest.mark.parametrize("true", [1.35, 0.8])
def test_density_of_what_was_held_out(true, tmp_path):
    rng = np.random.default_rng(5)
    hz, shapes = modes(true)
    hz, shapes = hz * (1 + ACCURACY * rng.standard_normal(3)), shapes + SHAPE_SD * rng.standard_normal((3, 3))
    path = tmp_path / "deck.yaml"
    path.write_text(DECK.format(frequency=hz.tolist(), shapes=shapes.tolist()))
    problem = read_deck(path)
    model = reduced(problem, problem.prior.mean, EigenSolver(lambda text: None))
    found = held_out(model, fit(Model(model), np.zeros(0)), None)
    k2 = np.linspace(PRIOR - 4 * SD, PRIOR + 4 * SD, 40001)[1:]
    p = np.array([log_density(value, hz[:2], shapes[:, :2]) for value in k2]) - 0.5 * ((k2 - PRIOR) / SD) ** 2
    largest = p.max()
    exact = largest + np.log(np.exp(p - largest).sum() * (k2[1] - k2[0]) / (np.sqrt(2 * np.pi) * SD))
    assert found.baseline.log_predictive_density == pytest.approx(exact, abs=0.5)
    assert found.baseline.p > 0.01


def test_a_crossing_in_what_the_new_data_do_not_feel_at_the_fit(tmp_path):
    """k2 far from where the modes cross, and wide: there neither mode feels it as the true one does."""
    hz, shapes = modes(0.95)
    text = DECK.format(frequency=hz.tolist(), shapes=shapes.tolist()).replace(
        "nominal: 1.2, sd: 20 %", "nominal: 1.2, sd: 60 %"
    )
    (path := tmp_path / "deck.yaml").write_text(text)
    problem = read_deck(path)
    model = reduced(problem, problem.prior.mean, EigenSolver(lambda text: None))
    found = held_out(model, fit(Model(model), np.zeros(0)), None)
    assert found.baseline.p > 0.05


def test_a_fit_that_is_no_optimum_gains_nothing_by_more_data(tmp_path):
    """New data may lead a descent to where the old ones misfit less, too: they add their own chi-square all the same."""
    hz, shapes = modes(1.35)
    (path := tmp_path / "deck.yaml").write_text(DECK.format(frequency=hz.tolist(), shapes=shapes.tolist()))
    problem = read_deck(path)
    found = fit(Model(reduced(problem, problem.prior.mean, EigenSolver(lambda text: None))), np.zeros(0))
    poor = held_out_density(replace(found, misfit=found.misfit + 30.0))
    assert 0.0 <= poor.misfit <= held_out_density(found).misfit and np.isfinite(poor.over_noise)

"""Two modes of almost one frequency, held out: an error of theory far below every accuracy turns their shapes into one another.

Two masses on springs of their own, 0.1 % apart, which nothing joins in the model; in truth a random coupling does, whose variance
is half of that which `theory.frequency` gives the springs (random symmetric errors). The truth is solved here, by `eigh`.
"""

import numpy as np
import pytest
from scipy.linalg import eigh

from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.diagnosis.validate.held_out import held_out
from mouse_cli.dynamics.solver import EigenSolver
from mouse_cli.formats import read_deck

THEORY, ACCURACY, SHAPE_SD = 4e-4, 3e-3, 0.02
DECK = """\
mouse: 1
model:
  stiffness: {{dense: [[1, 0, 0], [0, {second}, 0], [0, 0, 9]]}}
  mass: {{identity: 3}}
parameters:
  - {{name: k3, nominal: 9, sd: 5 %, stiffness: [[3, 3, 1.0]]}}
theory: {{frequency: 4e-4}}
test:
  modes:
    frequency: {frequency}
    frequency_sd: 0.3 %
    dofs: [1, 2, 3]
    shapes: {shapes}
    shape_sd: 0.02
  hold_out: {{modes: [1, 2]}}
"""


def predicted(second: float, rng: np.random.Generator, folder):
    """The score of a model of springs 1 and `second`, on a truth with an error of theory in it."""
    E = 2 * THEORY * rng.standard_normal((2, 2))
    K = np.diag([1.0, second, 9.0])
    K[:2, :2] += (E + E.T) / 2
    rates, X = eigh(K)
    hz = np.sqrt(rates) / (2 * np.pi) * (1 + ACCURACY * rng.standard_normal(3))
    shapes = X / X[np.abs(X).argmax(axis=0), range(3)] + SHAPE_SD * rng.standard_normal((3, 3))
    path = folder / "deck.yaml"
    path.write_text(DECK.format(second=second, frequency=hz.tolist(), shapes=shapes.tolist()))
    problem = read_deck(path)
    model = reduced(problem, problem.prior.mean, EigenSolver(lambda text: None))
    return held_out(model, fit(Model(model), np.zeros(0)), None).baseline


@pytest.mark.parametrize("second", [1.002, 1.01])
def test_close_modes_are_predicted_but_for_how_they_turn(second, tmp_path):
    """p-values of what is true are even between 0 and 1: of 40 hardly any is below 0.01."""
    rng = np.random.default_rng(11)
    p = np.array([predicted(second, rng, tmp_path).p for _ in range(40)])
    assert (p < 0.01).sum() <= 3


def test_modes_apart_are_predicted_as_before(tmp_path):
    """The density has no allowance where there is nothing to allow for."""
    found = predicted(1.5, np.random.default_rng(3), tmp_path)
    assert found.p > 0.01 and found.log_predictive_density > 15


def test_frequencies_alone_have_no_shapes_to_turn(tmp_path):
    path = tmp_path / "deck.yaml"
    text = DECK.format(second=1.002, frequency=(np.sqrt([1.0, 1.002, 9.0]) / (2 * np.pi)).tolist(), shapes=[])
    path.write_text("\n".join(line for line in text.splitlines() if "shape" not in line and "dofs" not in line))
    problem = read_deck(path)
    model = reduced(problem, problem.prior.mean, EigenSolver(lambda text: None))
    assert held_out(model, fit(Model(model), np.zeros(0)), None).baseline.p > 0.01

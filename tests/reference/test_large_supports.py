"""Flexible supports of models that are reduced, away from the parameters where they were, against finite elements written here."""

import numpy as np
import pytest
from scipy.linalg import eigh

from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import WHOLE
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble

ELEMENTS = 120
TURNS, SHIFTS = 2.0, 400.0  # springs of a bar with EI = mass per length = length = 1
DECK = f"""\
mouse: 1
model:
  structure:
    nodes: {{line: {{from: 1, to: {ELEMENTS + 1}, start: [0, 0, 0], end: [1, 0, 0]}}}}
    elements:
      - {{id: 1-{ELEMENTS}, type: beam, nodes: 1-{ELEMENTS + 1}, E: 1, nu: 0.3, density: 1, A: 1, Iz: 1}}
    supports: {{1: [TY, RZ], {ELEMENTS + 1}: [TY]}}
    directions: [TY, RZ]
parameters:
  - {{name: E, elements: 1-{ELEMENTS}, property: E, sd: 5 %}}
  - {{name: density, elements: 1-{ELEMENTS}, property: density, sd: 5 %}}
test:
  modes: {{number: [1, 2, 3, 4], frequency: [2.45, 7.95, 16.6, 28.4], frequency_sd: 1 %}}
"""


def eigenvalues(E: float, density: float, turns: float, shifts: float) -> np.ndarray:
    """The lowest six of a bar of Hermite elements on a spring against turning at its left end, and one under its right end."""
    l = 1 / ELEMENTS
    unit = np.outer([1, l, 1, l], [1, l, 1, l])
    k = unit / l**3 * np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])
    m = unit * l / 420 * np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]])
    K, M = np.zeros((2, 2 * ELEMENTS + 2, 2 * ELEMENTS + 2))
    for e in range(ELEMENTS):
        at = slice(2 * e, 2 * e + 4)
        K[at, at] += E * k
        M[at, at] += density * m
    held = {0}
    if np.isfinite(turns):
        K[1, 1] += turns
    if np.isfinite(shifts):
        K[-2, -2] += shifts
    held |= ({1} if turns == np.inf else set()) | ({2 * ELEMENTS} if shifts == np.inf else set())
    free = np.setdiff1d(np.arange(len(K)), list(held))
    return eigh(K[np.ix_(free, free)], M[np.ix_(free, free)], eigvals_only=True)[:6]


@pytest.fixture(scope="module")
def model():
    problem = assemble(yaml_deck.read(DECK, "bar.yaml"))
    found = reduced(problem, problem.prior.mean)
    assert found.V.shape[0] > WHOLE > found.r
    return found


def recipes(model, turns: float, shifts: float):
    """Recipes and coordinates of the supports that are flexible."""
    found, c = [], []
    for key, where, k in (("support-rotation", "node 1,", turns), ("support-translation", "121,", shifts)):
        if np.isfinite(k):
            made = registry()[key].recipes(model, registry()[key])
            found.append(next(each for each in made if where in each.site(each.grid[0]).text))
            c.append(found[-1].coordinates(np.array([k])))
    return tuple(found), np.concatenate(c)


@pytest.mark.parametrize(("turns", "shifts"), [(TURNS, np.inf), (np.inf, SHIFTS), (TURNS, SHIFTS)])
@pytest.mark.parametrize("weighed", [0.0, 0.04])
@pytest.mark.parametrize("density", [0.93, 1.07])
def test_the_mass_of_a_support_follows_the_parameters(model, turns, shifts, weighed, density):
    """Weighed where the model was reduced or elsewhere, M stays definite, and modes are those of all elements."""
    theta = model.problem.prior.mean * np.array([1 + weighed, 1 - weighed])
    there = model.at(theta)
    own, c = recipes(there, turns, shifts)
    z = np.array([0.95 - 1, density - 1]) / 0.05
    point = Model(there, own).point(np.concatenate([z, c]))
    assert point is not None
    np.testing.assert_allclose(
        point.eigenvalues[:6], eigenvalues(0.95, density, turns, shifts), rtol=1e-5
    )  # what 150 coordinates leave

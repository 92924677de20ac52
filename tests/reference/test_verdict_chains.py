"""Verdicts of small chains whose answers are known in closed form: a mode nobody measured, data that anything fits."""

import numpy as np
from made_up_rankings import ranked
from scipy.linalg import eigh

from mouse_cli.diagnosis import gates
from mouse_cli.diagnosis.diagnose import diagnose
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.diagnosis.verdict import decide
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import NAMED, ONE_OF
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.parameter import Gaussian, Parameter
from mouse_cli.model.problem import Problem
from mouse_cli.model.structure import ListedElements, Structure

# --- chains of unit masses between two walls

N, UNIT = 5, 1e5
K = UNIT * (2 * np.eye(N) - np.eye(N, k=1) - np.eye(N, k=-1))


def problem(numbers, hz: np.ndarray, shapes: np.ndarray) -> Problem:
    """The chain with a common factor of 5 %, frequencies to 0.1 %, shapes to 1 %."""
    test = ModalTest(np.array(numbers), hz, 1e-3 * hz, np.arange(N), shapes, np.full(shapes.shape, 0.01))
    row, col = np.nonzero(np.triu(K))
    listed = ListedElements(np.zeros(len(row), bool), row, col)
    prior = Gaussian(np.ones(1), np.array([0.05**2]))
    return Problem(
        "chain", Structure(K, np.eye(N)), listed, K[row, col][:, None], (Parameter("all", 0.05, 1.0),), prior, test
    )


def test_a_mode_that_was_not_measured_is_told_with_its_frequency():
    """An oscillator of 0.8 kg on the second mass; the test has the modes of all six masses but the one of the oscillator."""
    kg, hz = 0.8, 40.0
    arm = np.array([0, 1, 0, 0, 0, -1.0])
    M = np.diag([1, 1, 1, 1, 1, kg])
    lam, X = eigh(np.pad(K, (0, 1)) + kg * (2 * np.pi * hz) ** 2 * np.outer(arm, arm), M)
    of_it = int(np.argmax(np.abs(X[5])))
    kept = [i for i in range(4) if i != of_it]
    found = np.sqrt(lam) / (2 * np.pi)
    assert found[of_it] < found[kept[-1]]
    shapes = X[:N, kept] / np.abs(X[:N, kept]).max(axis=0)
    model = reduced(problem([1, 2, 3], found[kept], shapes), np.ones(1))
    recipe = Study(model).recipes("oscillator")[1]
    one = fit(Model(model, (recipe,)), recipe.coordinates(np.array([kg, hz])))
    baseline = fit(Model(model), np.zeros(0))
    assert one.misfit < 0.01
    kind, reasons = decide(ranked(one, baseline, p=(1 - 1e-9, 1e-9)))
    assert kind == ONE_OF and f"{found[of_it]:.4g} Hz" in reasons[0]


def test_two_frequencies_that_anything_fits():
    """A spring of 4e4 N/m at mass 1: no degree of freedom is left to a mechanism, and the noise is as stated."""
    lam, _ = eigh(K + 0.4 * UNIT * np.diag([1.0, 0, 0, 0, 0]))
    rows = [f"[{i + 1}, {j + 1}, {K[i, j]}]" for i in range(N) for j in range(i, N) if K[i, j]]
    deck = f"""mouse: 1
model: {{stiffness: {{order: {N}, entries: [{", ".join(rows)}]}}, mass: {{identity: {N}}}}}
parameters: [{{name: all, nominal: 1, sd: 1 %, stiffness: [{", ".join(rows)}]}}]
test: {{modes: {{frequency: [{", ".join(f"{f:.8g}" for f in np.sqrt(lam[:2]) / (2 * np.pi))}], frequency_sd: 0.1 %}}}}
"""
    found = diagnose(assemble(yaml_deck.read(deck, "chain.yaml")))
    assert found.noise_scale == 1.0 and dict(found.groups)["none"] < gates.LIKELY
    assert found.kind in (NAMED, ONE_OF)
    if found.kind == ONE_OF:
        assert "ground-spring" in dict(found.rivals)
    spring = next(one for one in found.explanations if one.physics == "ground-spring")
    assert spring.causes[0].site.text in ("degree of freedom 1", "degree of freedom 5")

"""The law that data imply at a place, against chains with a known spring, mass or oscillator: exact data, modes by numpy."""

import numpy as np
import pytest

from mouse_cli.diagnosis.effects.change import Change
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.localise.implied_law import _gram, implied_law
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.parameter import Gaussian, Parameter
from mouse_cli.model.problem import Problem
from mouse_cli.model.structure import ListedElements, Structure

K = np.array([[2.0, -1, 0, 0], [-1, 2, -1, 0], [0, -1, 2, -1], [0, 0, -1, 1]]) * 1000
OSCILLATOR = (0.3, 3.5)  # kg, Hz


def _truth(cause: str) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies in Hz and shapes of the chain with the mechanism at its second degree of freedom."""
    k, m = K.copy(), np.eye(4)
    if cause == "ground-spring":
        k[1, 1] += 400
    elif cause == "mass":
        m[1, 1] += 0.5
    else:
        own = OSCILLATOR[0] * (2 * np.pi * OSCILLATOR[1]) ** 2
        k, m = np.pad(k, (0, 1)), np.diag([1, 1, 1, 1, OSCILLATOR[0]])
        k[np.ix_([1, 4], [1, 4])] += own * np.array([[1, -1], [-1, 1]])
    root = np.diag(m.diagonal() ** -0.5)
    values, vectors = np.linalg.eigh(root @ k @ root)
    return np.sqrt(values) / (2 * np.pi), (root @ vectors)[:4]


def _law(cause: str):
    hz, shapes = _truth(cause)
    m = len(hz)
    test = ModalTest(np.arange(1, m + 1), hz, 1e-4 * hz, np.arange(4), shapes, np.full((4, m), 1e-3), "fitted")
    problem = Problem(
        "chain", Structure(K, np.eye(4)), ListedElements([0], [0], [0]), np.ones((1, 1)), (Parameter("k1", 1e-3, 1000.0),),
        Gaussian([1000.0], [1e-6]), test,
    )  # fmt: skip
    model = reduced(problem, problem.prior.mean)
    candidate = registry()[cause]
    recipe = next(r for r in candidate.recipes(model, candidate) if r.site(r.grid[0]).ids == ("2",))
    starts = [Model(model, (recipe,)).point(np.append(0.0, recipe.coordinates(values))) for values in recipe.grid]
    best = min((at for at in starts if at is not None), key=lambda at: at.chi2)
    return implied_law(fit(Model(model, (recipe,)), best.x[1:]))


@pytest.mark.parametrize("cause", ["ground-spring", "mass", "oscillator"])
def test_the_law_of_the_cause_is_read_off_the_data(cause):
    law = _law(cause)
    lam = (2 * np.pi * law.frequency_hz) ** 2
    own = (2 * np.pi * OSCILLATOR[1]) ** 2
    exact = {
        "ground-spring": np.full(len(lam), 400.0),
        "mass": -0.5 * lam,
        "oscillator": OSCILLATOR[0] * own * lam / (lam - own),
    }[cause]
    assert law.unit == "[force/length]"  # the deck declares no units
    np.testing.assert_allclose(law.stiffness, exact, rtol=1e-4)
    np.testing.assert_allclose(law.fitted, exact, rtol=2e-2)


def test_its_standard_deviation_is_that_of_the_frequency():
    """sd(d) against the change of d when the frequency moves by one standard deviation, by numpy."""
    law = _law("ground-spring")
    B = np.eye(4)[1]

    def implied(hz):
        return -1 / np.linalg.inv(K - (2 * np.pi * hz) ** 2 * np.eye(4))[1, 1] * (B @ B)

    for hz, sd in zip(law.frequency_hz, law.sd, strict=True):
        moved = abs(implied(hz * (1 + 1e-6)) - implied(hz * (1 - 1e-6))) / 2e-6 * 1e-4
        assert sd == pytest.approx(moved, rel=1e-3)


def test_other_changes_have_none():
    """A crack has no stiffness to the ground, and a change of K and M at once no law of one constant."""
    spring = np.diag([2.0, 0.0])
    assert _gram(Change(K=spring), 2, 2.0, "N/m").tolist() == [[1.0, 0.0], [0.0, 0.0]]
    assert _gram(Change(K=spring), 2, 1.0, "1") is None
    assert _gram(Change(K=spring, M=spring), 2, 1.0, "N/m") is None
    assert _gram(Change(sensing=np.eye(2)), 2, 1.0, "kg") is None

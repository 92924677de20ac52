"""Laplace's evidence against integrals: exact ones of a linear model with Gaussian errors, and numerical ones of a chain."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import dblquad, quad
from scipy.linalg import eigh
from scipy.stats import multivariate_normal

from mouse_cli.diagnosis.evidence import at_ends, laplace, marginal
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.diagnosis.search.rank import ranking
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.parameter import Gaussian, Parameter
from mouse_cli.model.problem import Problem
from mouse_cli.model.structure import ListedElements, Structure


class Linear:
    """Data y (q,) = T x + noise of unit variance; x: k of the prior N(0, 1), then d uniform in [-w/2, w/2]."""

    def __init__(self, T: np.ndarray, y: np.ndarray, width: np.ndarray):
        self.T, self.y, self.width = T, y, width
        self.t, self.k = len(width), T.shape[1] - len(width)
        self.bounds = np.stack([-width / 2, width / 2], axis=1)
        self.recipes = ()
        self.base = SimpleNamespace(z=np.zeros(self.k), data=SimpleNamespace(slack=0.0))

    def point(self, x: np.ndarray):
        residual = self.y - self.T @ x
        return SimpleNamespace(x=x, residual=residual, chi2=float(residual @ residual), nats=0.0, free=0.0)

    def jacobian(self, at) -> np.ndarray:
        return self.T

    def curvature(self, at) -> float:
        return 0.0


def exact(model: Linear, c: np.ndarray) -> float:
    """ln p(y | c), z integrated out, but for (2 pi)^(-q/2)."""
    Tz, Tc = model.T[:, : model.k], model.T[:, model.k :]
    q = len(model.y)
    return multivariate_normal(Tc @ c, np.eye(q) + Tz @ Tz.T).logpdf(model.y) + q / 2 * np.log(2 * np.pi)


@pytest.fixture
def linear():
    rng = np.random.default_rng(3)
    T = rng.standard_normal((8, 5)) * np.array([1.0, 2.0, 0.5, 3.0, 1.5])
    return lambda d: Linear(
        T, T @ np.array([0.5, -1.0, 0.3, 0.8, -0.6]) + rng.standard_normal(8), np.array([30.0, 50.0][:d])
    )


def test_without_causes_it_is_the_density_of_the_data(linear):
    model = linear(0)
    assert fit(model, np.zeros(0)).log_evidence == pytest.approx(exact(model, np.zeros(0)), abs=1e-6)


def test_of_one_unknown_it_is_its_integral(linear):
    model = linear(1)
    Z, _ = quad(lambda c: np.exp(exact(model, np.array([c]))), *model.bounds[0], points=[0.0], limit=200)
    assert fit(model, np.zeros(1)).log_evidence == pytest.approx(np.log(Z / model.width[0]), abs=5e-3)


def test_of_two_unknowns_it_is_their_integral(linear):
    model = linear(2)
    one = fit(model, np.zeros(2))
    sd = np.sqrt(np.diag(one.covariance)[model.k :])
    (a, b), (c, d) = [(m - 8 * s, m + 8 * s) for m, s in zip(one.c, sd, strict=True)]
    Z, _ = dblquad(lambda v, u: np.exp(exact(model, np.array([u, v])) + 50), a, b, c, d)
    assert one.log_evidence == pytest.approx(np.log(Z) - 50 - np.log(model.width).sum(), abs=5e-3)


@pytest.mark.parametrize("sds", [0.0, 1.0, 3.0, 50.0])
def test_a_share_of_the_prior_at_the_end_of_a_range_adds_what_the_data_say_there(linear, sds):
    """The end so many sd above what the data say; that the range ends there is nothing that Laplace's method knows."""
    model = linear(1)
    free = fit(model, np.zeros(1))
    end = free.c[0] + sds * np.sqrt(free.covariance[-1, -1])
    model.bounds = np.array([[end - model.width[0], end]])
    model.recipes = (SimpleNamespace(log_prior=0.0, unknowns=(SimpleNamespace(at_end=0.25),)),)
    Z, _ = quad(lambda c: np.exp(exact(model, np.array([c]))), -60.0, 60.0, points=[free.c[0]], limit=300)
    whole = 0.75 * Z / model.width[0] + 0.25 * np.exp(exact(model, np.array([end])))
    assert fit(model, free.c).log_evidence == pytest.approx(np.log(whole), abs=5e-3)


def test_a_share_at_an_end_survives_unknowns_that_the_data_cannot_tell_apart():
    """Two shares of which the data feel the sum alone, and a Hessian that has no numbers."""
    H = 1e12 * np.ones((2, 2))
    assert np.isfinite(at_ends(np.zeros(2), H, np.ones(2), np.full(2, 0.5)))
    assert at_ends(np.zeros(1), np.array([[np.nan]]), np.ones(1), np.full(1, 0.5)) == 0.0


@pytest.mark.parametrize("nats", [-np.inf, np.inf, np.nan])
def test_a_fit_without_a_finite_evidence_is_none(linear, nats, monkeypatch):
    model = linear(1)
    known = model.point
    monkeypatch.setattr(model, "point", lambda x: SimpleNamespace(**(vars(known(x)) | {"nats": nats})))
    assert fit(model, np.zeros(1)) is None


@pytest.mark.parametrize("evidence", [-np.inf, np.inf, np.nan])
def test_what_has_no_finite_evidence_is_not_ranked(evidence):
    """Two springs between two walls; beside the model as it is, twice the same of which one has no number."""
    K = np.array([[2.0, -1.0], [-1.0, 2.0]])
    hz, shapes = np.sqrt([1.0, 3.0]) / (2 * np.pi), np.array([[1.0, 1.0], [1.0, -1.0]])
    test = ModalTest(np.array([1, 2]), hz, 0.01 * hz, np.arange(2), shapes, np.full((2, 2), 0.05))
    row, col = np.nonzero(np.triu(K))
    listed, prior = ListedElements(np.zeros(3, bool), row, col), Gaussian(np.ones(1), np.array([0.03**2]))
    parameters = (Parameter("factor", 0.03, 1.0),)
    deck = Problem("chain", Structure(K, np.eye(2)), listed, K[row, col][:, None], parameters, prior, test)
    one = fit(Model(reduced(deck, prior.mean)), np.zeros(0))
    found = ranking(one, [replace(one, log_evidence=evidence), one])
    assert [each is one for each in found.fits] == [True]
    assert found.probabilities.tolist() == [1.0] and found.groups == (("none", 1.0),)


def test_what_the_data_do_not_feel_leaves_it_as_it_is():
    hessian = np.diag([5.0, 3.0])
    wider = np.diag([5.0, 3.0, 0.0])
    assert laplace(7.0, wider, np.array([40.0])) == pytest.approx(laplace(7.0, hessian, np.zeros(0)), abs=1e-12)


def test_of_a_spring_under_a_chain_it_is_its_integral():
    """A factor of all stiffness, 5 %, and the logarithm of a spring to the ground; the grid of a sum over both."""
    K = 100e3 * (2 * np.eye(4) - np.eye(4, k=1) - np.eye(4, k=-1))
    truth = K + 2e4 * np.diag([0, 1.0, 0, 0])
    lam, X = eigh(truth)
    hz = np.sqrt(lam[:3]) / (2 * np.pi)
    test = ModalTest(np.arange(1, 4), hz, 5e-3 * hz, np.arange(4), X[:, :3], np.full((4, 3), 0.02))
    row, col = np.nonzero(np.triu(K))
    deck = Problem(
        "chain", Structure(K, np.eye(4)), ListedElements(np.zeros(len(row), bool), row, col), K[row, col][:, None],
        (Parameter("factor", 0.05, 1.0),), Gaussian(np.ones(1), np.array([0.05**2])), test,
    )  # fmt: skip
    model = reduced(deck, deck.prior.mean)
    recipe = next(each for each in Study(model).recipes("ground-spring") if "2" in each.site(each.grid[0]).text)
    own = Model(model, (recipe,))
    one = fit(own, recipe.coordinates(np.array([2e4])))
    sd = np.sqrt(np.diag(one.covariance))
    z, c = (np.linspace(m - 6 * s, m + 6 * s, 81) for m, s in zip(one.point.x, sd, strict=True))
    C = np.array([[own.point(np.array([u, v])).chi2 + u * u for v in c] for u in z])
    Z = np.exp(-0.5 * C).sum() * (z[1] - z[0]) * (c[1] - c[0]) / np.sqrt(2 * np.pi) / own.width[0]
    assert one.log_evidence - recipe.log_prior == pytest.approx(np.log(Z), abs=0.05)


@pytest.mark.parametrize("noise", [0.0, 1e-3, -1e-3])
def test_rounding_is_no_evidence(noise):
    """Two unknowns of which the data feel the sum alone, 1e10 times as well as the prior: |H| = 2e20, which rounding hides."""
    hessian = 1e20 * np.ones((2, 2)) + np.diag([1.0, 1.0 + noise])
    expected = -0.5 * np.log(2e20)
    assert expected - 10 < laplace(0.0, hessian, np.zeros(0)) < expected + 0.1
    assert laplace(0.0, np.full((2, 2), np.nan), np.zeros(0)) == -np.inf


def test_an_open_unknown_takes_its_direction_out_of_a_prediction():
    """At moderate sizes the density of a normal distribution; of unknowns without bound the chi-square of what they cannot make."""
    rng = np.random.default_rng(5)
    B, left = rng.standard_normal((7, 2)), rng.standard_normal(7)
    misfit, size = marginal(left, B)
    density = multivariate_normal(np.zeros(7), np.eye(7) + B @ B.T).logpdf(left)
    assert -0.5 * (misfit + size + 7 * np.log(2 * np.pi)) == pytest.approx(density, rel=1e-12)
    beyond = left - B @ np.linalg.lstsq(B, left, rcond=None)[0]
    misfit, size = marginal(left, 1e12 * B)
    assert misfit == pytest.approx(beyond @ beyond, rel=1e-9)
    assert size == pytest.approx(np.linalg.slogdet(B.T @ B)[1] + 4 * np.log(1e12), rel=1e-9)

"""What the standard deviations and probabilities of a run claim, held against simulated tests; and what must not change.

Truths are drawn from the prior, tests simulated by scipy.linalg.eigh. A claim fails when chance would give so bad a count
less than once in 10^4 (binomial) or 10^3 (Kolmogorov-Smirnov).
"""

from dataclasses import replace

import numpy as np
import pytest
from chains import Chain, simulate
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import binomtest, kstest

from mouse_cli.estimators import bayes
from mouse_cli.estimators.linear import LinearProblem
from mouse_cli.model.parameter import Gaussian
from mouse_cli.model.problem import Problem
from mouse_cli.model.structure import ListedElements, Structure
from mouse_cli.updating import run

CHAIN = Chain(np.array([1000.0, 1300.0, 900.0, 1100.0]), np.array([1.0, 0.8, 1.2, 1.0]))
QUANTILE = {90: 1.6448536269514722, 95: 1.959963984540054, 99: 2.5758293035489004}
TRIALS = 500


def trials(seed: int, prior_error: float, frequency_error: float, shape_sd: float, **options: object):
    """(truth, result) of TRIALS runs, each with its own truth from the prior and its own test."""
    rng = np.random.default_rng(seed)
    sd = prior_error * CHAIN.springs
    for _ in range(TRIALS):
        truth = CHAIN.springs + sd * rng.standard_normal(4)
        test = simulate(CHAIN.stiffness(truth), np.diag(CHAIN.masses), rng, frequency_error, shape_sd)
        yield truth, run(CHAIN.problem(test, sd, **options))


@pytest.fixture(scope="module")
def wide():
    """A prior of 10 %, as an analyst has it."""
    return list(trials(1, 0.10, 0.01, 0.05))


@pytest.fixture(scope="module")
def narrow():
    """A prior of 1 %: all is linear."""
    return list(trials(2, 0.01, 0.005, 0.01))


@pytest.mark.parametrize("confidence", QUANTILE)
@pytest.mark.parametrize("parameter", range(4))
def test_intervals_cover_the_truth(wide, confidence, parameter):
    """Of 500 intervals theta +- z sd the stated share contains the truth, for each property by itself."""
    z = QUANTILE[confidence]
    hits = sum(abs(r.revised.theta[parameter] - truth[parameter]) <= z * r.sd_theta[parameter] for truth, r in wide)
    assert binomtest(hits, TRIALS, confidence / 100).pvalue > 1e-4, hits / TRIALS


def test_all_runs_converge(wide):
    assert {r.status.key for _, r in wide} == {"converged"}


@pytest.mark.proof
def test_joint_coverage(narrow):
    """(theta - truth)' S*^-1 (theta - truth) is chi-square with p degrees of freedom."""
    distance = [(r.revised.theta - t) @ np.linalg.solve(r.covariance, r.revised.theta - t) for t, r in narrow]
    assert kstest(distance, "chi2", args=(4,)).pvalue > 1e-3


@pytest.mark.parametrize("name", ["innovation", "residual", "prior_shift"])
def test_probabilities_of_a_right_model_are_uniform(narrow, name):
    tests = [getattr(r, name) for _, r in narrow]
    assert {t.dof for t in tests} == {{"innovation": 20, "residual": 16, "prior_shift": 4}[name]}
    assert kstest([t.p for t in tests], "uniform").pvalue > 1e-3


def test_residual_and_shift_add_up_to_the_innovation(narrow):
    """In the linear limit the innovation splits exactly in two."""
    for _, r in narrow[:50]:
        assert r.residual.chi2 + r.prior_shift.chi2 == pytest.approx(r.innovation.chi2, rel=0.05, abs=0.1)


def test_accuracies_stated_too_small_are_found_out(narrow):
    """The same tests with half the accuracies claimed: the residual is no longer uniform (the check above can fail)."""
    values = []
    for _, r in narrow[:100]:
        test = r.problem.test
        claimed = replace(test, frequency_sd_hz=test.frequency_sd_hz / 2, shape_sd=test.shape_sd / 2)
        values.append(run(replace(r.problem, test=claimed)).residual.p)
    assert kstest(values, "uniform").pvalue < 1e-6


@pytest.mark.parametrize("key", ["least-squares", "weighted-least-squares"])
def test_least_squares_is_unbiased(key):
    """Without a prior the mean error over 500 tests is zero within four standard errors, and the spread is what sd says."""
    errors = np.array([(r.revised.theta - t) / r.sd_theta for t, r in trials(3, 0.01, 0.002, 0.002, estimator=key)])
    assert (np.abs(errors.mean(axis=0)) < 4 / np.sqrt(TRIALS)).all()
    assert errors.std(axis=0, ddof=1) == pytest.approx(1, abs=4 / np.sqrt(2 * TRIALS))


sizes = st.tuples(st.integers(1, 9), st.integers(1, 7), st.integers(0, 2**32 - 1))


def random_problem(q: int, p: int, seed: int) -> tuple[LinearProblem, np.random.Generator]:
    """Any sizes, columns and accuracies over several decades, sometimes a column of zeros."""
    rng = np.random.default_rng(seed)
    T = rng.standard_normal((q, p)) * 10 ** rng.uniform(-3, 3, p)
    if seed % 3 == 0:
        T[:, 0] = 0.0
    return LinearProblem(T, rng.standard_normal(q), 10 ** rng.uniform(-2, 2, q), 10 ** rng.uniform(-1, 1, p)), rng


def never_wider(before: LinearProblem, after: LinearProblem) -> None:
    """No combination of the properties has a larger variance `after` than `before`."""
    wide, slim = bayes.solve(before), bayes.solve(after)
    assert (slim.variance <= wide.variance * (1 + 1e-9)).all()
    unit = np.sqrt(np.outer(wide.variance, wide.variance))
    gain = np.linalg.eigvalsh((wide.covariance() - slim.covariance()) / unit)
    assert gain.min() > -1e-9 * len(gain)


@given(sizes, st.floats(0.01, 1.0))
@settings(max_examples=200, deadline=None, derandomize=True)
def test_more_accurate_data_never_widen_the_posterior(size, share):
    problem, rng = random_problem(*size)
    better = np.where(rng.random(size[0]) < 0.5, share, 1.0)
    never_wider(problem, replace(problem, noise=problem.noise * better))


@given(sizes)
@settings(max_examples=200, deadline=None, derandomize=True)
def test_one_more_datum_never_widens_the_posterior(size):
    problem, rng = random_problem(*size)
    row = rng.standard_normal((1, size[1])) * 10 ** rng.uniform(-3, 3)
    more = replace(
        problem,
        T=np.vstack([problem.T, row]),
        d=np.append(problem.d, 0.3),
        noise=np.append(problem.noise, 0.1),
    )
    never_wider(problem, more)


@given(sizes)
@settings(max_examples=100, deadline=None, derandomize=True)
def test_posterior_never_exceeds_the_prior(size):
    problem, _ = random_problem(*size)
    assert (bayes.solve(problem).variance <= problem.L**2 * (1 + 1e-12)).all()


def simulated(**options: object) -> Problem:
    """One noisy test, 15 % off."""
    truth = CHAIN.springs * [0.9, 1.1, 1.15, 0.95]
    rng = np.random.default_rng(5)
    scale = options.pop("scale", "none")
    test = simulate(CHAIN.stiffness(truth), np.diag(CHAIN.masses), rng, 0.01, 0.03, modes=3, scale=scale)
    return CHAIN.problem(test, 0.1 * CHAIN.springs, **options)


def same(one, other, theta=1.0, order=slice(None)) -> None:
    """Equal answers, with theta in another unit or order."""
    assert other.revised.theta / theta == pytest.approx(one.revised.theta[order], rel=1e-8)
    assert other.sd_theta / theta == pytest.approx(one.sd_theta[order], rel=1e-7)
    for name in ("innovation", "residual", "prior_shift"):
        assert getattr(other, name).chi2 == pytest.approx(getattr(one, name).chi2, rel=1e-7)
    assert [c.exceedances for c in other.cycles] == [c.exceedances for c in one.cycles]


@pytest.mark.parametrize("recursion", ["anchored", "replaced"])
@pytest.mark.parametrize("stiffness_unit, mass_unit", [(1e3, 1e3), (1e6, 1e3), (1e-5, 1e-3)])
def test_units_do_not_matter(recursion, stiffness_unit, mass_unit):
    """N/m and kg, N/mm and t, kN/mm and t (with time in units of 1/sqrt(1000) s), dyn/m and g."""
    p = simulated(recursion=recursion)
    time = np.sqrt(mass_unit / stiffness_unit)
    test, length = p.test, np.sqrt(mass_unit)  # a mass-normalised shape is 1/sqrt(mass)
    changed = replace(
        p,
        structure=Structure(p.structure.K / stiffness_unit, p.structure.M / mass_unit),
        parameters=tuple(
            replace(v, sd=v.sd / stiffness_unit, nominal=v.nominal / stiffness_unit) for v in p.parameters
        ),
        prior=Gaussian(p.prior.mean / stiffness_unit, p.prior.cov / stiffness_unit**2),
        test=replace(
            test,
            frequency_hz=test.frequency_hz * time,
            frequency_sd_hz=test.frequency_sd_hz * time,
            shapes=test.shapes * length,
            shape_sd=test.shape_sd * length,
        ),
    )
    same(run(p), run(changed), theta=1 / stiffness_unit)


@pytest.mark.parametrize("pairing", ["number", "mac"])
def test_order_of_degrees_of_freedom_does_not_matter(pairing):
    p = simulated(pairing=pairing)
    new = np.array([2, 0, 3, 1])  # old number of each new degree of freedom
    place = np.argsort(new)
    row, col = np.sort([place[p.elements.row], place[p.elements.col]], axis=0)
    changed = replace(
        p,
        structure=Structure(p.structure.K[np.ix_(new, new)], p.structure.M[np.ix_(new, new)]),
        elements=ListedElements(p.elements.is_mass, row, col),
        test=replace(p.test, dofs=place[p.test.dofs]),
    )
    same(run(p), run(changed))


def test_order_of_parameters_and_of_measured_points_does_not_matter():
    p = simulated()
    order, points = [3, 1, 0, 2], [1, 3, 2, 0]
    changed = replace(
        p,
        A=p.A[:, order],
        parameters=tuple(p.parameters[i] for i in order),
        prior=Gaussian(p.prior.mean[order], p.prior.cov[order]),
        test=replace(
            p.test,
            dofs=p.test.dofs[points],
            shapes=p.test.shapes[points],
            shape_sd=p.test.shape_sd[points],
        ),
    )
    same(run(p), run(changed), order=order)


@pytest.mark.parametrize("recursion", ["anchored", "replaced"])
@pytest.mark.parametrize("scale", ["fitted", "least-squares"])
def test_scale_and_sign_in_which_a_shape_is_punched_do_not_matter(recursion, scale):
    p = simulated(scale=scale, recursion=recursion)
    factor = np.array([-1.0, 250.0, -3e-4])
    changed = replace(p, test=replace(p.test, shapes=p.test.shapes * factor, shape_sd=p.test.shape_sd * np.abs(factor)))
    same(run(p), run(changed))


def test_fitted_scale_does_not_depend_on_the_prior_model_scale():
    """Its answer is a minimum of its own: the same whether the masses of the prior model are those of the test or not."""
    p = simulated(scale="fitted")
    once = run(p)
    again = run(replace(p, test=replace(p.test, shapes=once.test_shapes, shape_sd=once.test_shape_sd)))
    same(once, again)

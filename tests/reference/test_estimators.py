"""Every row of Table 3-1 of the report against its textbook formula in 60-digit arithmetic.

Where the formula itself fails in double precision (accurate or correlated data, columns over four decades, a rank-deficient
prior) the tests show that it does and that the square-root form does not. Limits: scipy.optimize.lsq_linear.
"""

from dataclasses import replace

import numpy as np
import pytest
from mpmath import mp
from scipy.optimize import lsq_linear

from mouse_cli.estimators import estimator
from mouse_cli.estimators.linear import Infeasible, LinearProblem, Unobservable

WITHOUT_PRIOR = ("least-squares", "weighted-least-squares", "minimum-variance", "maximum-likelihood")
EVERY = (*WITHOUT_PRIOR, "bayes")


def textbook(key: str, T, d, R, S) -> tuple[np.ndarray, np.ndarray]:
    """x* and the diagonal of S* by the formula of Table 3-1, literally, in 60 digits."""
    with mp.workdps(60):
        T, d, R, S = (mp.matrix(v.tolist()) for v in (T, d[:, None], R, S))
        if key == "bayes":
            W = S * T.T * mp.inverse(R + T * S * T.T)
            covariance = S - W * T * S
        else:
            P = mp.eye(R.rows) if key == "least-squares" else mp.inverse(R)
            W = mp.inverse(T.T * P * T) * T.T * P
            covariance = W * R * W.T
        x = W * d
        p = T.cols
        return (
            np.array([float(x[i]) for i in range(p)]),
            np.array([float(covariance[i, i]) for i in range(p)]),
        )


def textbook_in_double(T, d, R, S) -> np.ndarray:
    """Diagonal of S* = S - S T'(R + T S T')^-1 T S as the report writes it, in double precision."""
    return np.diag(S - S @ T.T @ np.linalg.inv(R + T @ S @ T.T) @ T @ S)


def linear(seed: int, q: int = 12, p: int = 5, **change: object) -> LinearProblem:
    """A well conditioned problem with every number of order one."""
    rng = np.random.default_rng(seed)
    problem = LinearProblem(
        rng.standard_normal((q, p)),
        rng.standard_normal(q),
        rng.uniform(0.1, 0.5, q),
        rng.uniform(0.5, 2.0, p),
    )
    return replace(problem, **change)


def covariances(problem: LinearProblem) -> tuple[np.ndarray, np.ndarray]:
    """R (q, q) and S (p, p), full."""
    R = np.diag(problem.noise**2) if problem.noise.ndim == 1 else problem.noise
    return R, np.diag(problem.L**2) if problem.L.ndim == 1 else problem.L @ problem.L.T


def correlated(seed: int, q: int) -> np.ndarray:
    """A well conditioned full covariance matrix (q, q)."""
    factor = np.random.default_rng(seed).standard_normal((q, 2 * q)) / np.sqrt(2 * q)
    return factor @ factor.T


@pytest.mark.parametrize("key", EVERY)
@pytest.mark.parametrize("shape", [(12, 5), (5, 5), (30, 2)])
@pytest.mark.parametrize("full", [False, True], ids=["independent", "correlated"])
def test_rows_of_table_3_1(key, shape, full):
    q, p = shape
    problem = linear(q + p, q, p)
    if full:
        root = np.linalg.cholesky(correlated(2, p))
        problem = replace(problem, noise=0.1 * correlated(1, q), L=root)
    x, variance = textbook(key, problem.T, problem.d, *covariances(problem))
    answer = estimator(key).solve(problem)
    assert answer.x == pytest.approx(x, rel=1e-10, abs=1e-10)
    assert answer.variance == pytest.approx(variance, rel=1e-10)
    assert np.diag(answer.covariance()) == pytest.approx(variance, rel=1e-10)


@pytest.mark.parametrize("q, p", [(3, 8), (1, 4), (8, 20)])
def test_bayes_with_fewer_data_than_properties(q, p):
    problem = linear(q, q, p)
    x, variance = textbook("bayes", problem.T, problem.d, *covariances(problem))
    answer = estimator("bayes").solve(problem)
    assert answer.x == pytest.approx(x, rel=1e-10, abs=1e-12)
    assert answer.variance == pytest.approx(variance, rel=1e-10)
    assert np.diag(answer.covariance()) == pytest.approx(variance, rel=1e-10)


def ill_conditioned(case: str, q: int = 40, p: int = 25) -> LinearProblem:
    """The hard problems: 40 data, 25 properties, columns over four decades."""
    rng = np.random.default_rng(40)
    T = rng.standard_normal((q, p)) * np.logspace(-2, 2, p)
    d, L = rng.standard_normal(q), np.ones(p)
    sd = 1e-6 if case == "R = 1e-12" else 1e-4
    noise = np.full(q, sd)
    if case == "S rank deficient":
        L = rng.standard_normal((p, 15)) / 4
    if case == "R correlated":
        noise = sd**2 * (0.9 * np.ones((q, q)) + 0.1 * np.eye(q))
    return LinearProblem(T, d, noise, L)


@pytest.mark.parametrize("case", ["R = 1e-8", "R = 1e-12", "S rank deficient", "R correlated"])
def test_accurate_data_and_columns_over_four_decades(case):
    problem = ill_conditioned(case)
    R, S = covariances(problem)
    with mp.workdps(60):
        root = mp.matrix((np.diag(problem.L) if problem.L.ndim == 1 else problem.L).tolist())
        exact_S = root * root.T  # not rounded to double: S - S T'(...)TS cancels sixteen digits and more
        T, N = mp.matrix(problem.T.tolist()), mp.matrix(problem.noise.tolist())
        exact_R = mp.diag([v**2 for v in N]) if problem.noise.ndim == 1 else N
        W = exact_S * T.T * mp.inverse(exact_R + T * exact_S * T.T)
        covariance, x = exact_S - W * T * exact_S, W * mp.matrix(problem.d.tolist())
        variance = np.array([float(covariance[i, i]) for i in range(T.cols)])
        mean = np.array([float(v) for v in x])
    naive = textbook_in_double(problem.T, problem.d, R, S)
    assert (naive < 0).any(), "the textbook formula gives negative variances here"
    answer = estimator("bayes").solve(problem)
    assert np.abs(answer.variance / variance - 1).max() < 1e-9
    assert np.abs(np.diag(answer.covariance()) / variance - 1).max() < 1e-9
    assert np.abs((answer.x - mean) / np.sqrt(variance)).max() < 1e-5


@pytest.mark.parametrize("sd", [1e-3, 1e-6, 1e-9])
def test_accurate_data_and_fewer_of_them_than_properties(sd):
    """q < p: variances of what the data fix shrink to nothing against the prior; none may come out negative."""
    rng = np.random.default_rng(9)
    T = np.hstack([np.eye(6) + 0.1 * rng.standard_normal((6, 6)), 1e-4 * rng.standard_normal((6, 9))])
    problem = LinearProblem(T, rng.standard_normal(6), np.full(6, sd), np.ones(15))
    x, variance = textbook("bayes", T, problem.d, np.diag(problem.noise**2), np.eye(15))
    answer = estimator("bayes").solve(problem)
    assert np.abs(answer.variance / variance - 1).max() < 1e-9
    assert np.abs(np.diag(answer.covariance()) / variance - 1).max() < 1e-9
    assert answer.x == pytest.approx(x, rel=1e-7, abs=1e-9)


@pytest.mark.parametrize("sd", [1e-2, 1e-4, 1e-6])
def test_accurate_data_that_tell_only_a_sum(sd):
    """Two equal columns: the difference of both properties keeps its prior variance, however accurate their sum is."""
    T = np.random.default_rng(12).standard_normal((9, 4))
    T[:, 3] = T[:, 0]
    problem = LinearProblem(T, T @ [1.0, 2.0, 3.0, 1.0], np.full(9, sd), np.ones(4))
    x, variance = textbook("bayes", T, problem.d, np.diag(problem.noise**2), np.eye(4))
    answer = estimator("bayes").solve(problem)
    assert answer.variance == pytest.approx(variance, rel=1e-9)
    assert answer.variance[[0, 3]] == pytest.approx(0.5, rel=1e-3)
    assert answer.x == pytest.approx(x, rel=1e-6)


@pytest.mark.parametrize("key", WITHOUT_PRIOR)
def test_columns_over_many_decades_are_not_taken_for_rank_deficient(key):
    problem = linear(3, 20, 6)
    problem = replace(problem, T=problem.T * np.logspace(-9, 9, 6), L=np.logspace(3, -3, 6))
    x, variance = textbook(key, problem.T, problem.d, *covariances(problem))
    answer = estimator(key).solve(problem)
    assert answer.x == pytest.approx(x, rel=1e-9)
    assert answer.variance == pytest.approx(variance, rel=1e-9)


@pytest.mark.parametrize("key", WITHOUT_PRIOR)
@pytest.mark.parametrize(
    "flaw, loose",
    [
        ("proportional", [1, 3]),
        ("silent", [2]),
        ("dependent", [0, 2, 4]),
        ("underdetermined", [0, 1, 2, 3, 4]),
    ],
)
def test_what_the_data_do_not_determine_is_named(key, flaw, loose):
    problem = linear(1)
    T = problem.T.copy()
    if flaw == "proportional":
        T[:, 3] = -2.5e4 * T[:, 1]
    elif flaw == "silent":
        T[:, 2] = 0.0
    elif flaw == "dependent":
        T[:, 4] = T[:, 0] - 3 * T[:, 2]
    else:
        problem = replace(problem, d=problem.d[:3], noise=problem.noise[:3])
        T = T[:3]
    with pytest.raises(Unobservable) as caught:
        estimator(key).solve(replace(problem, T=T))
    assert np.flatnonzero(caught.value.loose).tolist() == loose
    assert np.isfinite(estimator("bayes").solve(replace(problem, T=T)).x).all()


@pytest.mark.parametrize("key", EVERY)
@pytest.mark.parametrize("seed", range(4))
def test_limits_equal_bounded_least_squares(key, seed):
    """The stacked system [R^-1/2 T; L^-1] x = [R^-1/2 d; 0] within bounds, by scipy's bounded least squares."""
    free = linear(seed, 10, 6)
    rng = np.random.default_rng(seed + 100)
    centre = estimator(key).solve(free).x
    width = 0.3 * np.abs(centre).mean()
    lower = centre + rng.uniform(-2, 0.5, 6) * width
    upper = lower + rng.uniform(0.5, 3, 6) * width
    lower[0], upper[1], upper[2] = -np.inf, np.inf, 1.7e308
    weight = 1.0 if key == "least-squares" else 1 / free.noise
    stacked, right = (free.T.T * weight).T, free.d * weight
    if key == "bayes":
        stacked, right = np.vstack([stacked, np.diag(1 / free.L)]), np.append(right, np.zeros(6))
    expected = lsq_linear(stacked, right, (lower, upper), method="bvls", tol=1e-14).x
    answer = estimator(key).solve(replace(free, lower=lower, upper=upper))
    assert answer.x == pytest.approx(expected, rel=1e-8, abs=1e-9)
    at = (np.abs(expected - lower) < 1e-9) | (np.abs(expected - upper) < 1e-9)
    assert at.any() and (answer.variance < 1e-20).tolist() == at.tolist()


@pytest.mark.parametrize("key", EVERY)
def test_limits_that_contradict_a_fixed_sum(key):
    """x1 + x2 is held at 0 (L has no other direction), yet both must exceed 1."""
    problem = LinearProblem(
        np.eye(2), np.zeros(2), np.ones(2), np.array([[1.0], [-1.0]]), np.ones(2), np.full(2, np.inf)
    )
    with pytest.raises(Infeasible):
        estimator(key).solve(problem)


@pytest.mark.parametrize("key", WITHOUT_PRIOR)
def test_weights_are_unbiased(key):
    """WT = I: data T x without error give x back, for every x."""
    problem = linear(6)
    WT = np.array([estimator(key).solve(replace(problem, d=column)).x for column in problem.T.T]).T
    assert np.abs(WT - np.eye(5)).max() < 1e-12


@pytest.mark.parametrize("key", WITHOUT_PRIOR)
def test_mean_of_many_answers_is_the_truth(key):
    """2000 draws of the noise: the mean error of every property is within four of its standard errors, its spread is S*."""
    problem, truth = linear(7), np.array([1.0, -2.0, 3.0, 0.5, 10.0])
    rng = np.random.default_rng(17)
    noise = rng.standard_normal((2000, 12)) * problem.noise
    answers = np.array([estimator(key).solve(replace(problem, d=problem.T @ truth + e)).x for e in noise])
    sd = np.sqrt(estimator(key).solve(problem).variance)
    assert (np.abs(answers.mean(axis=0) - truth) < 4 * sd / np.sqrt(2000)).all()
    assert answers.std(axis=0, ddof=1) == pytest.approx(sd, rel=4 / np.sqrt(4000))


def test_gauss_markov():
    """Of the unbiased estimators minimum variance has the least variances, property by property."""
    problem = linear(8)
    plain, best = (estimator(key).solve(problem).variance for key in ("least-squares", "minimum-variance"))
    assert (best < 0.99 * plain).all()

"""Directions that may not vary: a fixed total mass (the prior conditioned on the sum, in closed form), a rank-deficient S."""

from dataclasses import replace

import numpy as np
import pytest

from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.parameter import Gaussian, Parameter
from mouse_cli.model.problem import Problem, RunOptions
from mouse_cli.model.structure import ListedElements, Structure
from mouse_cli.updating import run


def mass_problem(**options: object) -> Problem:
    """Three masses on springs; all three masses uncertain, correlated; two frequencies measured."""
    K = np.array([[3.0, -1.0, 0], [-1.0, 2.0, -1.0], [0, -1.0, 2.5]]) * 1e4
    cov = np.array([[0.04, 0.01, 0.0], [0.01, 0.09, -0.01], [0.0, -0.01, 0.05]])
    lam = np.linalg.eigvalsh(K)[:2] * 1.002
    hz = np.sqrt(lam) / (2 * np.pi)
    test = ModalTest([1, 2], hz, 2e-3 * hz, np.zeros(0, int), np.zeros((0, 2)), np.zeros((0, 2)), "none")
    parameters = tuple(Parameter(f"m{i}", np.sqrt(cov[i, i]), 1.0) for i in range(3))
    elements = ListedElements([True] * 3, range(3), range(3))
    prior = Gaussian(np.ones(3), cov)
    return Problem("", Structure(K, np.eye(3)), elements, np.eye(3), parameters, prior, test, RunOptions(**options))


def test_total_mass_held_equals_conditioning_on_the_sum():
    """S given 1'x = 0 is S - S1(1'S1)^-1 1'S; then one Bayes step, all in closed form."""
    problem = mass_problem(fix_total_mass=True, recursion="replaced", cycles=1, print_partials=True)
    free = run(replace(problem, run=replace(problem.run, fix_total_mass=False)))
    result = run(problem)
    S, one = problem.prior.cov, np.ones(3)
    S = S - np.outer(S @ one, S @ one) / (one @ S @ one)
    K = problem.structure.K
    lam, X = np.linalg.eigh(K)
    T = -(lam[:2, None] * (X[:, :2] ** 2).T)  # d lambda / d m_i = -lambda x_i^2
    noise = np.diag(result.sd**2)
    expected = S @ T.T @ np.linalg.solve(T @ S @ T.T + noise, result.y - lam[:2])
    assert result.revised.theta - 1 == pytest.approx(expected, rel=1e-9)
    assert abs(result.revised.theta.sum() - 3) < 1e-14
    T = result.T
    S_revised = S - S @ T.T @ np.linalg.solve(T @ S @ T.T + noise, T @ S)
    assert result.covariance == pytest.approx(S_revised, abs=1e-12)
    assert abs(one @ result.covariance @ one) < 1e-16
    assert abs(free.revised.theta.sum() - 3) > 1e-3, "the total would change if it were not held"


@pytest.mark.parametrize("recursion", ["replaced", "anchored"])
def test_total_mass_is_held_through_every_cycle(recursion):
    cycles = run(mass_problem(fix_total_mass=True, recursion=recursion, cycles=4)).cycles
    assert len(cycles) == 5 and all(abs(c.theta.sum() - 3) < 1e-13 for c in cycles)


def test_total_mass_of_some_degrees_of_freedom():
    problem = mass_problem(fix_total_mass=True, total_mass_dofs=(0, 2))
    theta = run(problem).revised.theta
    assert abs(theta[0] + theta[2] - 2) < 1e-14 and abs(theta[1] - 1) > 1e-4


@pytest.mark.parametrize("key", ["bayes", "weighted-least-squares"])
def test_properties_that_the_prior_ties_stay_tied(key):
    """S of rank 2: mass 2 deviates twice as much as mass 1. Two free directions, two data: least squares has an answer."""
    problem = mass_problem(estimator=key)
    ties = np.array([[1.0, 0.0], [2.0, 0.0], [0.0, 1.0]])
    cov = 0.01 * ties @ ties.T
    change = run(replace(problem, prior=Gaussian(np.ones(3), cov))).revised.theta - 1
    assert change[1] == pytest.approx(2 * change[0], rel=1e-9) and np.abs(change).min() > 1e-4

"""Minimum variance: the unbiased W (WT = I) that makes every variance of x* least. Eqs. (3-15) to (3-32).

Its weight matrix is that of weighted least squares with P = R^-1, as the report shows by Lagrange multipliers.
"""

from mouse_cli.estimators.linear import Estimator, LinearEstimate, LinearProblem, without_prior


def solve(problem: LinearProblem) -> LinearEstimate:
    """W = (T'R^-1T)^-1 T'R^-1 and S* = W R W'. Raises Unobservable when WT = I has no solution."""
    return without_prior(problem, weighted=True)


ESTIMATOR = Estimator(
    "minimum-variance",
    "Minimum variance",
    "W = (T'R^-1T)^-1 T'R^-1; S* = W R W' = (T'R^-1T)^-1",
    True,
    False,
    solve,
)

"""Least squares: every datum counts alike. x* = (T'T)^-1 T'y, Eqs. (3-12) to (3-14)."""

from mouse_cli.estimators.linear import Estimator, LinearEstimate, LinearProblem, without_prior


def solve(problem: LinearProblem) -> LinearEstimate:
    """x* = (T'T)^-1 T'y with covariance W R W'. Raises Unobservable when T has not full column rank."""
    return without_prior(problem, weighted=False)


ESTIMATOR = Estimator(
    "least-squares", "Least squares", "x* = (T'T)^-1 T'y; S* = (T'T)^-1 T'RT (T'T)^-1", False, False, solve
)

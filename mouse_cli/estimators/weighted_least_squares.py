"""Weighted least squares: data weighed by the inverse of their variances. x* = (T'R^-1T)^-1 T'R^-1 y, Eqs. (3-33) to (3-38)."""

from mouse_cli.estimators.linear import Estimator, LinearEstimate, LinearProblem, without_prior


def solve(problem: LinearProblem) -> LinearEstimate:
    """Minimises (Tx - y)'R^-1(Tx - y). Raises Unobservable when R^-1/2 T has not full column rank."""
    return without_prior(problem, weighted=True)


ESTIMATOR = Estimator(
    "weighted-least-squares",
    "Weighted least squares",
    "x* = (T'R^-1T)^-1 T'R^-1 y; S* = (T'R^-1T)^-1",
    True,
    False,
    solve,
)

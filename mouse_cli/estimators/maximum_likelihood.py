"""Maximum likelihood: the x* under which the measured data are most probable, for normal errors. Eqs. (3-39) to (3-44)."""

from mouse_cli.estimators.linear import Estimator, LinearEstimate, LinearProblem, without_prior


def solve(problem: LinearProblem) -> LinearEstimate:
    """Minimises (y - Tx)'R^-1(y - Tx); S* is the inverse of the Fisher information. Raises Unobservable."""
    return without_prior(problem, weighted=True)


ESTIMATOR = Estimator(
    "maximum-likelihood",
    "Maximum likelihood",
    "x* = (T'R^-1T)^-1 T'R^-1 y; S* = (T'R^-1T)^-1 (normal errors)",
    True,
    False,
    solve,
)

"""One file, one row of the report's Table 3-1: from a linear problem y = T x + e to an estimate and its covariance."""

from functools import cache

from mouse_cli import _registry
from mouse_cli.estimators.linear import Estimator


def registry() -> dict[str, Estimator]:
    """All estimators by key."""
    return _registry.discover(__name__, "ESTIMATOR")


@cache
def estimator(key: str) -> Estimator:
    """The estimator called `key`. Raises ValueError that lists the known ones."""
    return _registry.member(__name__, "ESTIMATOR", key, "estimator")

"""One file, one row of the report's Table 3-1: from a linear problem y = T x + e to an estimate and its covariance."""

from functools import cache

from mouse_cli import _registry
from mouse_cli.estimators._linear import Estimator


@cache
def estimator(key: str) -> Estimator:
    """The estimator called `key`; its file alone is loaded when it bears that name.

    Raises ValueError that lists the known ones.
    """
    from importlib import import_module

    if key.replace("-", "_") in _registry.names(__name__):
        return import_module(f"{__name__}.{key.replace('-', '_')}").ESTIMATOR
    known = _registry.discover(__name__, "ESTIMATOR")
    if key not in known:
        raise ValueError(f"no estimator is called '{key}'; there are {', '.join(known)}")
    return known[key]

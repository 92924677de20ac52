"""Where each measured quantity stands in the data y of a result: eigenvalues first, then shapes mode by mode."""

import numpy as np

from mouse_cli.model.result import Result

NOT_MEASURED = -1


def eigenvalue_index(result: Result) -> np.ndarray:
    """Index (m,) in y of each mode's eigenvalue; NOT_MEASURED where the frequency was not measured."""
    return _numbered(np.isfinite(result.problem.test.frequency_hz), 0)


def shape_index(result: Result) -> np.ndarray:
    """Index (s, m) in y of each shape component; NOT_MEASURED where it is missing."""
    start = int(np.isfinite(result.problem.test.frequency_hz).sum())
    return _numbered(np.isfinite(result.test_shapes).T, start).T


def _numbered(have: np.ndarray, start: int) -> np.ndarray:
    """`have` with its true places numbered from `start`, row by row."""
    index = np.full(have.shape, NOT_MEASURED)
    index[have] = start + np.arange(int(have.sum()))
    return index


def positions(result: Result) -> tuple[str, ...]:
    """Names (s,) of the sensors, or of the degrees of freedom they measure."""
    labels, test = result.problem.structure.labels, result.problem.test
    return test.sensors or tuple(labels[d] for d in test.dofs)

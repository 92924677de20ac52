"""Modal expansion: the combination of model modes that lies nearest to what was measured."""

import numpy as np

from mouse_cli.dynamics.expansion import Expansion, Measured
from mouse_cli.dynamics.sensing import read


def expand(measured: Measured) -> np.ndarray:
    """Shapes (n, m) u = X q with q = argmin |(t - S X q) / sd| (O'Callahan, Avitabile and Riemer 1989, weighted).

    A shape with fewer components than there are model modes uses as many modes, those nearest in frequency.
    """
    X = measured.model_shapes
    columns = []
    for eigenvalue, (sensing, t, sd) in zip(measured.eigenvalues, measured.modes(), strict=True):
        near = np.argsort(np.abs(measured.model_eigenvalues - eigenvalue), kind="stable")[: len(t)]
        seen = read(sensing, X[:, near])
        columns.append(X[:, near] @ np.linalg.lstsq(seen / sd[:, None], t / sd, rcond=None)[0])
    return np.column_stack(columns)


EXPANSION = Expansion(
    "serep", "modal expansion (SEREP)", "u = X q, minimise |(t - S X q) / sd|, X the model's modes in the range of the test",
    "always", expand,
)  # fmt: skip

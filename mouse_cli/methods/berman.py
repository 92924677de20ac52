"""Berman's incomplete stiffness (section 2 of the report): the sum of what each measured mode contributes to K."""

import numpy as np

from mouse_cli.methods import SHAPES, Method
from mouse_cli.methods.found import Found
from mouse_cli.methods.given import Given
from mouse_cli.model.updated import KEPT, LOST


def incomplete(M: np.ndarray, X: np.ndarray, eigenvalues: np.ndarray) -> np.ndarray:
    """K = M X L X'M, of rank m, for shapes X (n, m) with X'MX = 1.

    >>> import numpy as np
    >>> incomplete(2 * np.eye(2), np.array([[0.5], [0.5]]), np.array([3.0])).tolist()
    [[3.0, 3.0], [3.0, 3.0]]
    """
    MX = M @ X
    return (MX * eigenvalues) @ MX.T


def update(given: Given) -> Found:
    """K from M and the measured modes alone, expanded once by the model."""
    X = given.orthonormal(given.expanded(given.K))
    return Found(incomplete(given.M, X, given.eigenvalues), given.M)


METHOD = Method(
    "berman",
    "Berman's incomplete stiffness",
    "K = sum_i lambda_i M x_i x_i' M",
    "section 2 of the 1972 report, reference 7",
    (
        (KEPT, "each is a term of the sum"),
        (KEPT, "a sum of semidefinite matrices"),
        (KEPT, "and every other motion is without stiffness too"),
        (LOST, "M x x'M is full"),
        (LOST, "there is no stiffness against any motion that was not measured: K has the rank of the test"),
    ),
    (SHAPES,),
    update,
    dense=True,
)

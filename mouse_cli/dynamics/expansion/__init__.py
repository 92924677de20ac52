"""Expansion of measured mode shapes to all degrees of freedom; one file = one method, found by `registry`."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mouse_cli import _registry
from mouse_cli.model.arrays import Matrix


@dataclass(frozen=True)
class Measured:
    """What a method may use: K, M (n, n); sensing (s,) or (s, n); m measured shapes with their accuracies; modes of the model.

    shapes, sd (s, m): NaN where not measured; eigenvalues (m,): measured, (rad/s)^2. model_eigenvalues (k,), model_shapes (n, k):
    modes of the model in the range of the test, mass-normalised. exact: measured components are kept as they are by methods that
    would smooth them.
    """

    K: Matrix
    M: Matrix
    sensing: Matrix
    shapes: np.ndarray
    sd: np.ndarray
    eigenvalues: np.ndarray
    model_eigenvalues: np.ndarray
    model_shapes: np.ndarray
    exact: bool = False

    def modes(self):
        """For each measured shape: the sensing of its components (r, ...), the components (r,) and their sd (r,)."""
        for i in range(self.shapes.shape[1]):
            have = np.flatnonzero(np.isfinite(self.shapes[:, i]))
            yield self.sensing[have], self.shapes[have, i], self.sd[have, i]


@dataclass(frozen=True)
class Expansion:
    """A method: `expand` gives the shapes (n, m) at the scale of the test. Raises LooseError when they are not determined.

    smooths: measured components are trusted only as far as their standard deviations allow (`never`, `optional`, `always`).
    """

    key: str
    title: str
    equation: str
    smooths: str
    expand: Callable[[Measured], np.ndarray]


def registry() -> dict[str, Expansion]:
    """All methods by key."""
    return _registry.discover(__name__, "EXPANSION")


def expansion(key: str) -> Expansion:
    """The method called `key`. Raises ValueError that lists the known ones."""
    return _registry.member(__name__, "EXPANSION", key, "expansion")

"""Chains of masses and springs with a simulated modal test: truth by scipy, independent of the engine."""

from dataclasses import dataclass, field, replace

import numpy as np
from scipy.linalg import eigh

from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.parameter import Gaussian, Parameter
from mouse_cli.model.problem import Problem, RunOptions
from mouse_cli.model.structure import ListedElements, Structure


@dataclass(frozen=True)
class Chain:
    """Ground - k1 - m1 - k2 - m2 - ...: n springs (N/m), which are the parameters, and n masses (kg)."""

    springs: np.ndarray
    masses: np.ndarray = field(default_factory=lambda: np.ones(4))

    @property
    def n(self) -> int:
        return len(self.springs)

    def stiffness(self, springs: np.ndarray) -> np.ndarray:
        """K (n, n) with the given springs."""
        return stretches(self.n).T @ np.diag(springs) @ stretches(self.n)

    def elements(self) -> tuple[ListedElements, np.ndarray]:
        """The tridiagonal of K and the matrix A that ties it to the springs."""
        n = self.n
        row = np.concatenate([np.arange(n), np.arange(n - 1)])
        col = np.concatenate([np.arange(n), np.arange(1, n)])
        d = stretches(n)
        return ListedElements([False] * len(row), row, col), d[:, row].T * d[:, col].T

    def problem(self, test: ModalTest, sd: np.ndarray, transform: str = "identity", **options: object) -> Problem:
        """A deck that knows the springs to within `sd`."""
        elements, A = self.elements()
        parameters = tuple(
            Parameter(f"k{i + 1}", s, k, transform=transform)
            for i, (k, s) in enumerate(zip(self.springs, sd, strict=True))
        )
        return Problem(
            title="simulated chain",
            structure=Structure(self.stiffness(self.springs), np.diag(self.masses)),
            elements=elements,
            A=A,
            parameters=parameters,
            prior=Gaussian(self.springs, np.asarray(sd) ** 2),
            test=test,
            run=replace(RunOptions(pairing="number"), **options),
        )


def stretches(n: int) -> np.ndarray:
    """Stretch of every spring (n, n) per displacement of every mass."""
    return np.eye(n) - np.eye(n, k=-1)


def simulate(
    K: np.ndarray,
    M: np.ndarray,
    rng: np.random.Generator | None,
    frequency_error: float = 0.01,
    shape_sd: float = 0.02,
    modes: int | None = None,
    scale: str = "none",
) -> ModalTest:
    """A modal test of the structure K, M at all its points, with normal errors; rng None: without errors."""
    lam, X = eigh(K, M)
    m = modes or len(lam)
    hz, X = np.sqrt(lam[:m]) / (2 * np.pi), X[:, :m]
    sd_hz = frequency_error * hz
    noise, noise_hz = (np.zeros(X.shape), np.zeros(m))
    if rng is not None:
        noise, noise_hz = rng.standard_normal(X.shape), rng.standard_normal(m)
    shapes = X + shape_sd * noise
    return ModalTest(
        np.arange(1, m + 1),
        hz + sd_hz * noise_hz,
        sd_hz,
        np.arange(len(lam)),
        shapes,
        np.full(X.shape, shape_sd),
        scale,
    )

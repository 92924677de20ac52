"""Uniform and uneven beams of Hermite elements written here, and decks of them with what is uneven left out."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.linalg import eigh

LENGTH, WIDTH, DEPTH, YOUNG, DENSITY = 1.2, 0.02, 0.006, 2.1e11, 7850.0
EI, MASS = YOUNG * WIDTH * DEPTH**3 / 12, DENSITY * WIDTH * DEPTH  # N m2, kg/m
FINE, COARSE = 120, 30  # elements of the truth, and of the deck
_ONE = lambda x: 1.0


@dataclass(frozen=True)
class Truth:
    """Relative stiffness and mass along x / L; a bed in EI / L^4; axial force in EI / L^2; springs and masses at (x / L, size).

    Springs, and ties at (x / L, x / L, size), in EI / L^3; springs against turns in EI / L; masses in the mass of the beam.
    """

    stiffness: Callable[[float], float] = _ONE
    mass: Callable[[float], float] = _ONE
    bed: Callable[[float], float] = lambda x: 0.0
    tension: float | Callable[[float], float] = 0.0
    springs: tuple[tuple[float, float], ...] = ()
    masses: tuple[tuple[float, float], ...] = field(default=())
    ties: tuple[tuple[float, float, float], ...] = ()
    turns: tuple[tuple[float, float], ...] = ()

    def modes(self, free: bool, count: int) -> tuple[np.ndarray, np.ndarray]:
        """Hz (count,) and deflections (121, count); free: of a free beam, without rigid motion; else of a cantilever."""
        n, l = FINE, LENGTH / FINE
        unit = np.outer([1, l, 1, l], [1, l, 1, l])
        k = EI / l**3 * unit * np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])
        m = l / 420 * unit * np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]])
        g = 1 / (30 * l) * unit * np.array([[36, 3, -36, 3], [3, 4, -3, -1], [-36, -3, 36, -3], [3, -1, -3, 4]])
        K, M = np.zeros((2, 2 * n + 2, 2 * n + 2))
        pull = self.tension if callable(self.tension) else lambda x: self.tension
        for e in range(n):
            x, at = (e + 0.5) / n, slice(2 * e, 2 * e + 4)
            K[at, at] += self.stiffness(x) * k + self.bed(x) * EI / LENGTH**4 * m + pull(x) * EI / LENGTH**2 * g
            M[at, at] += self.mass(x) * MASS * m
        for x, size in self.springs:
            K[2 * round(x * n), 2 * round(x * n)] += size * EI / LENGTH**3
        for one, other, size in self.ties:
            b = np.zeros(len(K))
            b[2 * round(one * n)], b[2 * round(other * n)] = 1.0, -1.0
            K += size * EI / LENGTH**3 * np.outer(b, b)
        for x, size in self.turns:
            K[2 * round(x * n) + 1, 2 * round(x * n) + 1] += size * EI / LENGTH
        for x, size in self.masses:
            M[2 * round(x * n), 2 * round(x * n)] += size * MASS * LENGTH
        own, rigid = (np.arange(2 * n + 2), 2) if free else (np.arange(2, 2 * n + 2), 0)
        lam, X = eigh(K[np.ix_(own, own)], M[np.ix_(own, own)], subset_by_index=[rigid, rigid + count - 1])
        shapes = np.zeros((2 * n + 2, count))
        shapes[own] = X
        return np.sqrt(lam) / (2 * np.pi), shapes[::2]


def deck(
    truth: Truth, free: bool = False, sensors: int = 14, modes: int = 5, held: int = 2, seed: int = 1, more: str = ""
) -> str:
    """A uniform beam and the test of `truth`: frequencies to 0.1 %, shapes to 1 %, the last `held` modes held out.

    more: further lines of the structure.
    """
    rng = np.random.default_rng(seed)
    hz, shapes = truth.modes(free, modes + held)
    nodes = np.unique(np.round(np.linspace(0.0 if free else 0.08, 1.0, sensors) * COARSE).astype(int))
    shapes = shapes[nodes * (FINE // COARSE)]
    shapes = shapes / np.abs(shapes).max(axis=0) + 0.01 * rng.standard_normal(shapes.shape)
    hz = hz * (1 + 1e-3 * rng.standard_normal(len(hz)))
    numbers = np.arange(len(hz)) + (3 if free else 1)
    rows = "\n".join(f"      - [{', '.join(f'{value:.5f}' for value in row)}]" for row in shapes)
    return f"""mouse: 1
title: beam
model:
  structure:
    nodes: {{line: {{from: 1, to: {COARSE + 1}, start: [0, 0], end: [{LENGTH}, 0]}}}}
    materials: {{steel: {{E: {YOUNG}, nu: 0.3, density: {DENSITY}}}}}
    sections: {{bar: {{A: {WIDTH * DEPTH}, Iz: {WIDTH * DEPTH**3 / 12}}}}}
    elements:
      - {{id: 1-{COARSE}, type: beam, nodes: 1-{COARSE + 1}, material: steel, section: bar}}
{more}    directions: [TY, RZ]
{"" if free else "    supports: {1: all}"}
parameters:
  - {{name: E, elements: 1-{COARSE}, property: E, sd: 3 %}}
  - {{name: density, elements: 1-{COARSE}, property: density, sd: 1 %}}
test:
  modes:
    number: [{", ".join(map(str, numbers))}]
    frequency: [{", ".join(f"{value:.8g}" for value in hz)}]
    frequency_sd: 0.1 %
    dofs: [{", ".join(f"{n + 1}TY" for n in nodes)}]
    shapes:
{rows}
    shape_sd: 1 %
  hold_out: {{modes: [{", ".join(map(str, numbers[len(numbers) - held :]))}]}}
"""

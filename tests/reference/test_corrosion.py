"""A beam with a stretch of thinner wall; truth by finite elements (Hermite) written here."""

import numpy as np
import pytest
from scipy.linalg import eigh

from mouse_cli.diagnosis import diagnose
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import NAMED, Choices

E, A, I, RHO, L, N = 2.1e11, 3e-3, 4e-6, 7850.0, 6.0, 24
LOST, FIRST, LAST = 0.25, 0.4, 0.75  # of the wall, between these shares of the length
SENSORS, MODES, FINE = range(3, N + 2, 2), 6, 5


def modes() -> tuple[np.ndarray, np.ndarray]:
    """Frequencies (m,) and deflections (m of every node of the deck) of the beam, clamped at its first end."""
    h, n = L / N / FINE, N * FINE
    k = np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                  [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]]) / h**3  # fmt: skip
    m = np.array([[156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h],
                  [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h * h, -22 * h, 4 * h * h]]) * h / 420  # fmt: skip
    K, M = np.zeros((2, 2 * n + 2, 2 * n + 2))
    for i in range(n):
        left = 1 - LOST if FIRST < (i + 0.5) / n < LAST else 1.0
        at = slice(2 * i, 2 * i + 4)
        K[at, at] += left * E * I * k
        M[at, at] += left * RHO * A * m
    eigenvalues, X = eigh(K[2:, 2:], M[2:, 2:])
    return np.sqrt(eigenvalues[:MODES]) / (2 * np.pi), np.vstack([np.zeros((2, MODES)), X[:, :MODES]])[:: 2 * FINE]


def deck() -> str:
    hz, w = modes()
    rng = np.random.default_rng(5)
    shapes = w[[node - 1 for node in SENSORS]]
    shapes = shapes / np.abs(shapes).max(axis=0) + 0.01 * rng.standard_normal(shapes.shape)
    hz = hz * (1 + 0.001 * rng.standard_normal(MODES))
    rows = "\n".join(f"      - [{', '.join(f'{v:.5f}' for v in row)}]" for row in shapes)
    return f"""\
mouse: 1
model:
  structure:
    nodes: {{line: {{from: 1, to: {N + 1}, start: [0, 0], end: [{L}, 0]}}}}
    elements:
      - {{id: 1-{N}, type: beam, nodes: 1-{N + 1}, E: {E}, G: 8.0e+10, density: {RHO}, A: {A}, Iy: {I}, Iz: {I}, J: 1.0e-6}}
    supports: {{1: all}}
    plane: XY
parameters:
  - {{name: E, elements: 1-{N}, property: E, sd: 2 %}}
test:
  modes:
    frequency: [{", ".join(f"{f:.6g}" for f in hz)}]
    frequency_sd: 0.1 %
    dofs: [{", ".join(f"{node}TY" for node in SENSORS)}]
    shapes:
{rows}
    shape_sd: 0.01
"""


def test_a_thinner_wall_is_named_with_its_extent():
    problem = assemble(yaml_deck.read(deck(), "deck.yaml"))
    found = diagnose(problem, choices=Choices(("corrosion", "stiffness-loss", "added-mass", "mass"), causes=1))
    assert (found.kind, found.best.physics) == (NAMED, "corrosion")
    lost, width, before = (size.value for size in found.best.causes[0].sizes)
    first = before * (1 - width)
    assert lost == pytest.approx(LOST, abs=0.05)
    assert (first, first + width) == pytest.approx((FIRST, LAST), abs=0.06)

"""A machine on isolators that the model lacks: truths by elements of numpy, a plane frame of an upright and an arm."""

import numpy as np
import pytest
from scipy.linalg import block_diag, eigh

from mouse_cli.diagnosis import diagnose
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import NAMED, Choices
from mouse_cli.terms.assembly import assembly

E, A, INERTIA, RHO = 2.1e11, 4e-4, 3e-8, 7850.0
POINTS = np.array([[0, y / 8] for y in range(9)] + [[x / 8, 1] for x in range(1, 7)])
HOST, MASS = 12, 1.5  # node (from 0) and kg
SENSORS = [(4, 0), (6, 0), (8, 0), (8, 1), (10, 1), (12, 0), (12, 1), (14, 0), (14, 1)]  # nodes (from 0) and directions
MODES = 6


def element(a: np.ndarray, b: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """K and M (6, 6) of a bar that bends in the plane."""
    length = float(np.linalg.norm(b - a))
    c, s = (b - a) / length
    T = block_diag(*[[[c, s, 0], [-s, c, 0], [0, 0, 1]]] * 2)
    k, m = np.zeros((6, 6)), np.zeros((6, 6))
    along, across = [0, 3], [1, 2, 4, 5]
    k[np.ix_(along, along)] = E * A / length * np.array([[1, -1], [-1, 1]])
    m[np.ix_(along, along)] = RHO * A * length / 6 * np.array([[2, 1], [1, 2]])
    q = length
    k[np.ix_(across, across)] = (E * INERTIA / q**3) * np.array(
        [
            [12, 6 * q, -12, 6 * q],
            [6 * q, 4 * q**2, -6 * q, 2 * q**2],
            [-12, -6 * q, 12, -6 * q],
            [6 * q, 2 * q**2, -6 * q, 4 * q**2],
        ]
    )
    m[np.ix_(across, across)] = (RHO * A * q / 420) * np.array(
        [
            [156, 22 * q, 54, -13 * q],
            [22 * q, 4 * q**2, 13 * q, -3 * q**2],
            [54, 13 * q, 156, -22 * q],
            [-13 * q, -3 * q**2, -22 * q, 4 * q**2],
        ]
    )
    return T.T @ k @ T, T.T @ m @ T


def modes(hz: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies (m,) and what sensors see (s, m), the body hung with such frequencies along X and Y."""
    n = 3 * len(POINTS) + 2
    K, M = np.zeros((n, n)), np.zeros((n, n))
    for i in range(len(POINTS) - 1):
        at = slice(3 * i, 3 * i + 6)
        for whole, own in zip((K, M), element(*POINTS[i : i + 2]), strict=True):
            whole[at, at] += own
    for d, f in enumerate(hz):
        own = np.ix_([3 * HOST + d, n - 2 + d], [3 * HOST + d, n - 2 + d])
        K[own] += MASS * (2 * np.pi * f) ** 2 * np.array([[1, -1], [-1, 1]])
        M[n - 2 + d, n - 2 + d] += MASS
    rates, shapes = eigh(K[3:, 3:], M[3:, 3:])
    seen = shapes[[3 * node + d - 3 for node, d in SENSORS], :MODES]
    return np.sqrt(rates[:MODES]) / (2 * np.pi), seen / np.abs(seen).max(axis=0)


@pytest.mark.parametrize(
    ("hz", "said"),
    [
        ((18.0, 18.0), "all directions alike"),
        pytest.param((14.0, 24.0), "each direction its own", marks=pytest.mark.proof),
    ],
)
def test_a_machine_on_isolators_is_named_by_its_place_mass_and_frequencies(hz, said):
    frequency, shapes = modes(hz)
    rng = np.random.default_rng(7)
    frequency = frequency * (1 + 1e-3 * rng.standard_normal(MODES))
    shapes = shapes + 0.01 * rng.standard_normal(shapes.shape)
    text = f"""\
mouse: 1
model:
  structure:
    nodes: {{{", ".join(f"{i}: {xy.tolist()}" for i, xy in enumerate(POINTS, 1))}}}
    elements: [{{id: 1-14, type: beam, nodes: 1-15, E: {E}, A: {A}, Iz: {INERTIA}, density: {RHO}}}]
    supports: {{1: all}}
    plane: XY
parameters:
  - {{name: E, elements: 1-14, property: E, sd: 3 %, transform: log}}
test:
  modes:
    dofs: [{", ".join(f"{node + 1}T{'XY'[d]}" for node, d in SENSORS)}]
    frequency: {frequency.tolist()}
    frequency_sd: 0.1 %
    shapes: {shapes.tolist()}
    shape_sd: 0.01
"""
    found = diagnose(
        assemble(yaml_deck.read(text, "arm.yaml")), choices=Choices(("mounted-mass", "oscillator", "mass"), causes=1)
    )
    (cause,) = found.best.causes
    assert found.kind == NAMED and cause.physics == "mounted-mass" and said in cause.site.text
    np.testing.assert_allclose(cause.site.position[:2], POINTS[HOST], atol=0.03)
    for size, true in zip(cause.sizes, (MASS, *sorted(set(hz))), strict=False):
        assert abs(size.value - true) < 3 * size.sd and size.sd < 0.05 * true
    K, M = assembly(found.extended).matrices(found.extended.prior.mean)
    np.testing.assert_allclose(np.sqrt(eigh(K, M, eigvals_only=True)[:MODES]) / (2 * np.pi), frequency, rtol=0.02)

"""Supports on blocks with a mass or in walls, and storeys of springs under weight, by closed forms and the bars of the trials.

A cantilever whose clamp turns on a spring k with a block of inertia J behind it: EI w''(0) = (k - omega^2 J) w'(0), so that with
c(z) = (k - omega^2 J) L / EI, z^4 = omega^2 m L^4 / EI:  c (1 + cos z cosh z) = z (sin z cosh z - cos z sinh z)
(Blevins, Formulas for Natural Frequency and Mode Shape, 1979, table 8-1, for J = 0).
Storeys that shear, each with the weight N above it: k - N / h in place of k (Clough and Penzien, sect. 9-6).
"""

import numpy as np
import pytest
from scipy.linalg import eigh

import mouse_cli
from benchmarks.blind import verify
from benchmarks.trials.bars import Bars
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.arrays import dense
from mouse_cli.terms.assembly import assembly

E, A, I, RHO, L, ELEMENTS = 2.1e11, 6e-4, 4.5e-8, 7850.0, 2.0, 24
K, OWN, FLOORS, HEIGHT, FLOOR = 6.0, 55.0, 6, 3.0, 4e5
G = 9.80665

CANTILEVER = f"""\
mouse: 1
model:
  structure:
    nodes: {{line: {{from: 1, to: {ELEMENTS + 1}, start: [0, 0], end: [{L}, 0]}}}}
    materials: {{steel: {{E: {E}, nu: 0.3, density: {RHO}}}}}
    sections: {{bar: {{A: {A}, Iz: {I}, Iy: {I}, J: {2 * I}}}}}
    elements:
      - {{id: 1-{ELEMENTS}, type: beam, nodes: 1-{ELEMENTS + 1}, material: steel, section: bar}}
    supports: {{1: all}}
    plane: XY
parameters:
  - {{name: E, material: steel, property: E, sd: 3 %, transform: log}}
test:
  modes:
    frequency: [6, 40, 110, 210]
    frequency_sd: 0.1 %
"""
BUILDING = f"""\
mouse: 1
model:
  structure:
    nodes: {{line: {{from: 0, to: {FLOORS}, start: [0, 0, 0], end: [0, 0, {FLOORS * HEIGHT}]}}}}
    elements:
      - {{id: 1-{FLOORS}, type: spring, nodes: 0-{FLOORS}, TX: STIFFNESS}}
      - {{id: 101-{100 + FLOORS}, type: mass, nodes: 1-{FLOORS}, mass: {FLOOR}}}
    supports: {{0: all}}
    directions: [TX]
parameters:
  - {{name: k, elements: 1-{FLOORS}, property: TX, factor: true, sd: 3 %, transform: log}}
"""


def problem_of(text: str):
    return assemble(yaml_deck.read(text.encode(), "deck.yaml"))


def turning_clamp(k: float, J: float, count: int) -> np.ndarray:
    """Frequencies (Hz) of the cantilever, k in EI/L and J in m L^3."""
    end = lambda z: np.cos(z) + 1 / np.cosh(z)
    f = lambda z: (k - z**4 * J) * end(z) - z * (np.sin(z) - np.cos(z) * np.tanh(z))
    z = verify.roots(f, 0.5, 20, count, 0.05)
    return z**2 * np.sqrt(E * I / (RHO * A * L**4)) / (2 * np.pi)


def test_a_clamp_on_a_block_turns_as_the_closed_form_says():
    """In the coordinates of the model that is clamped, and in the deck with the block in it."""
    problem = problem_of(CANTILEVER)
    model = reduced(problem, problem.prior.mean)
    (recipe,) = registry()["block-rotation"].recipes(model, registry()["block-rotation"])
    k = K * E * I / L
    J = k / (2 * np.pi * OWN) ** 2
    exact = turning_clamp(K, J / (RHO * A * L**3), 4)
    point = Model(model, (recipe,)).solved(np.concatenate([[0.0], recipe.coordinates(np.array([k, OWN]))]))
    assert np.sqrt(point[0][:4]) / (2 * np.pi) == pytest.approx(exact, rel=1e-4)
    deck = recipe.extend(problem, np.array([k, OWN]))
    eigenvalues = eigh(*(dense(each) for each in assembly(deck).matrices(deck.prior.mean)), eigvals_only=True)
    assert np.sqrt(eigenvalues[:4]) / (2 * np.pi) == pytest.approx(exact, rel=1e-4)


def in_a_bed(a: float, count: int) -> np.ndarray:
    """Frequencies (Hz) of the cantilever that goes on by 10 a without mass on a bed of 4 EI / a^4, by the bars of the trials."""
    wall = np.linspace(-10 * a, 0, 101)
    x = np.concatenate([wall[:-1], np.linspace(0, L, 41)])
    index = np.arange(len(x))
    bars = Bars(np.column_stack([x, 0 * x]), np.column_stack([index[:-1], index[1:]]), x[:-1])
    inside = bars.where()[:, :, 0] < 0
    bars.EI[:], bars.EA[:] = E * I, E * A
    bars.m[:], bars.bed[:] = np.where(inside, 0.0, RHO * A), np.where(inside, 4 * E * I / a**4, 0.0)
    bars.held = set(range(0, 3 * len(x), 3))
    return bars.modes(count)[0]


@pytest.mark.parametrize("a", [0.02, 0.15])
def test_a_clamp_in_a_wall_is_a_beam_that_goes_on_in_a_bed(a):
    """In the coordinates of the model that is clamped, and in the deck with two springs in its place."""
    problem = problem_of(CANTILEVER)
    model = reduced(problem, problem.prior.mean)
    (recipe,) = registry()["embedment"].recipes(model, registry()["embedment"])
    exact = in_a_bed(a, 4)
    assert exact[0] < 0.99 * np.sqrt(model.eigenvalues[0]) / (2 * np.pi)
    point = Model(model, (recipe,)).solved(np.concatenate([[0.0], recipe.coordinates(np.array([a]))]))
    assert np.sqrt(point[0][:4]) / (2 * np.pi) == pytest.approx(exact, rel=2e-4)
    deck = recipe.extend(problem, np.array([a]))
    eigenvalues = eigh(*(dense(each) for each in assembly(deck).matrices(deck.prior.mean)), eigvals_only=True)
    assert np.sqrt(eigenvalues[:4]) / (2 * np.pi) == pytest.approx(exact, rel=2e-4)


def chain(k: np.ndarray, base: tuple[float, float] | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies (Hz) and shapes (floors, 5) of storeys; base: stiffness and mass of what they stand on."""
    n = len(k) + (base is not None)
    springs = k if base is None else np.concatenate([base[:1], k])
    D = np.eye(n) - np.eye(n, k=-1)
    m = np.full(n, FLOOR)
    if base is not None:
        m[0] = base[1]
    values, X = np.linalg.eigh((D.T * springs) @ D / np.sqrt(np.outer(m, m)))
    X = (X / np.sqrt(m)[:, None])[n - len(k) :, :5]
    return np.sqrt(values[:5]) / (2 * np.pi), X / np.abs(X).max(axis=0)


def building(k: np.ndarray, truth: tuple[np.ndarray, np.ndarray]) -> str:
    """The deck with springs k and a test of the truth."""
    rng = np.random.default_rng(11)
    hz = truth[0] * (1 + 0.001 * rng.standard_normal(5))
    shapes = truth[1] + 0.01 * rng.standard_normal(truth[1].shape)
    rows = "\n".join(f"      - [{', '.join(f'{x:.5f}' for x in row)}]" for row in shapes)
    test = f"test:\n  modes:\n    frequency: [{', '.join(f'{x:.6g}' for x in hz)}]\n    frequency_sd: 0.1 %\n"
    dofs = ", ".join(f"{floor}TX" for floor in range(1, FLOORS + 1))
    return BUILDING.replace("STIFFNESS", str(k.tolist())) + test + (
        f"    dofs: [{dofs}]\n    shapes:\n{rows}\n    shape_sd: 0.01\n"
    )  # fmt: skip


STOREYS = np.array([4.0, 4.0, 3.5, 3.5, 3.0, 3.0])


def test_a_foundation_that_slides_and_has_a_mass_is_named():
    """It had been a soft first storey and an oscillator (P > 0.999)."""
    k, ground, mass = 1e7 * STOREYS, 1.5e8, 6e5
    found = mouse_cli.diagnose(problem_of(building(k, chain(k, (ground, mass)))))
    assert (found.kind, found.best.physics, found.best.group) == ("named", "block-translation", "support")
    stiffness, hz = found.best.causes[0].sizes
    assert stiffness.value == pytest.approx(ground, abs=3 * stiffness.sd)
    assert hz.value == pytest.approx(np.sqrt(ground / mass) / (2 * np.pi), abs=3 * hz.sd)


def test_storeys_of_springs_lose_stiffness_under_weight():
    """The height that their drift says is that of the deck."""
    k, above = 1e7 * STOREYS, FLOOR * G * np.arange(FLOORS, 0, -1)
    found = mouse_cli.diagnose(problem_of(building(k, chain(k - above / HEIGHT))))
    assert (found.kind, found.best.physics) == ("named", "gravity")
    (size,) = found.best.causes[0].sizes
    assert size.value == pytest.approx(G / HEIGHT, abs=3 * size.sd) and size.sd < 0.1 * size.value


@pytest.mark.parametrize("change", [("TX", "TZ"), (f"[0, 0, {FLOORS * HEIGHT}]", f"[4, 0, {FLOORS * HEIGHT}]")])
def test_springs_along_their_row_or_in_a_slanting_one_are_no_storeys(change):
    k = 1e7 * STOREYS
    problem = problem_of(building(k, chain(k)).replace(*change))
    candidate = registry()["gravity"]
    assert not candidate.recipes(reduced(problem, problem.prior.mean), candidate)

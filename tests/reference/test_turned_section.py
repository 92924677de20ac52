"""A beam whose outer part was mounted on its side; truth by finite elements (Hermite) written here."""

import numpy as np
import pytest
from scipy.linalg import block_diag, eigh

from mouse_cli.diagnosis import diagnose
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.arrays import dense
from mouse_cli.model.diagnosis import NAMED, NOTHING, Choices
from mouse_cli.terms.assembly import assembly

E, A, RHO, L, N, INNER = 2.1e11, 4e-3, 7850.0, 3.0, 12, 8
IY, IZ, OUTER_Y, OUTER_Z = 1.6e-6, 2.6e-6, 0.9e-6, 1.5e-6
SENSORS, MODES = (4, 7, 9, 11, 13), 6


def plane(inner: float, outer: float) -> tuple[np.ndarray, np.ndarray]:
    """K and M of a cantilever of N elements with two second moments of area, deflection and slope of nodes 2 to N + 1."""
    h, n = L / N, 2 * N + 2
    k = E / h**3 * np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                             [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]])  # fmt: skip
    m = RHO * A * h / 420 * np.array([[156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h],
                                      [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h * h, -22 * h, 4 * h * h]])  # fmt: skip
    total = np.zeros((2, n, n))
    for i in range(N):
        at = slice(2 * i, 2 * i + 4)
        total[0, at, at] += (inner if i < INNER else outer) * k
        total[1, at, at] += m
    return total[0, 2:, 2:], total[1, 2:, 2:]


def modes(outer_y: float, outer_z: float) -> tuple[np.ndarray, np.ndarray]:
    """Eigenvalues and shapes; deflections along Y come before those along Z."""
    K, M = (block_diag(*each) for each in zip(plane(IZ, outer_z), plane(IY, outer_y), strict=True))
    return eigh(K, M)


def deck(outer_y: float, outer_z: float, more: str = "") -> str:
    """The model with the outer part upright, and measured modes of a beam of which it is as given."""
    eigenvalues, X = modes(outer_y, outer_z)
    read = [plane * 2 * N + 2 * (node - 2) for node in SENSORS for plane in (0, 1)]
    rng = np.random.default_rng(3)
    shapes = X[read, :MODES] / np.abs(X[read, :MODES]).max(axis=0)
    shapes = shapes + 0.01 * rng.standard_normal(shapes.shape)
    hz = np.sqrt(eigenvalues[:MODES]) / (2 * np.pi) * (1 + 0.001 * rng.standard_normal(MODES))
    rows = "\n".join(f"      - [{', '.join(f'{x:.5f}' for x in row)}]" for row in shapes)
    beam = f"type: beam, E: {E}, G: 8.0e+10, density: {RHO}, A: {A}, J: 4.0e-6"
    return f"""\
mouse: 1
model:
  structure:
    nodes: {{line: {{from: 1, to: {N + 1}, start: [0, 0, 0], end: [{L}, 0, 0]}}}}
    elements:
      - {{id: 1-{INNER}, nodes: 1-{INNER + 1}, {beam}, Iy: {IY}, Iz: {IZ}}}
      - {{id: {INNER + 1}-{N}, nodes: {INNER + 1}-{N + 1}, {beam}, Iy: {OUTER_Y}, Iz: {OUTER_Z}}}
    supports: {{1: all}}
parameters:
  - {{name: E, elements: 1-{N}, property: E, sd: 3 %, transform: log}}
{more}test:
  modes:
    frequency: [{", ".join(f"{x:.6g}" for x in hz)}]
    frequency_sd: 0.1 %
    dofs: [{", ".join(f"{node}T{d}" for node in SENSORS for d in "YZ")}]
    shapes:
{rows}
    shape_sd: 0.01
"""


def test_a_part_on_its_side_is_named_with_its_place():
    choices = Choices(("turned-section", "member", "stiffness-loss", "stiffness-gain"), causes=2)
    found = diagnose(assemble(yaml_deck.read(deck(OUTER_Z, OUTER_Y), "beam.yaml")), choices=choices)
    assert (found.kind, found.best.physics) == (NAMED, "turned-section")
    (cause,) = found.best.causes
    assert cause.site.ids == tuple(range(INNER + 1, N + 1)) and not cause.sizes


def test_a_beam_as_it_is_drawn_has_nothing_turned():
    choices = Choices(("turned-section", "member"), causes=1)
    found = diagnose(assemble(yaml_deck.read(deck(OUTER_Y, OUTER_Z), "beam.yaml")), choices=choices)
    assert found.kind == NOTHING


def test_the_deck_with_a_turned_section_exchanges_its_parameters_too():
    more = f"  - {{name: Iz, elements: {INNER - 1}-{N}, property: Iz, factor: true, sd: 5 %}}\n"
    problem = assemble(yaml_deck.read(deck(OUTER_Z, OUTER_Y, more), "beam.yaml"))
    model, key = reduced(problem, problem.prior.mean), registry()["turned-section"]
    recipe = next(one for one in key.recipes(model, key) if len(one.site(one.grid[0]).ids) == N - INNER)
    extended = recipe.extend(problem, np.zeros(0))
    K, M = (dense(part) for part in assembly(extended).matrices(extended.prior.mean))
    exact = modes(OUTER_Z, OUTER_Y)[0]
    assert eigh(K, M, eigvals_only=True)[:MODES] == pytest.approx(exact[:MODES], rel=1e-6)
    bound = sorted((b.property, b.set, len(b.members)) for b in extended.bindings if b.property in ("Iy", "Iz"))
    assert bound == [("Iy", 1, 4), ("Iz", 0, 2)]

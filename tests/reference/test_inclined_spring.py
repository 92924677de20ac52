"""A guy on a cantilever that bends in two planes, which it couples; truth by finite elements (Hermite) written here."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.linalg import block_diag, eigh

from mouse_cli.diagnosis import diagnose
from mouse_cli.diagnosis.explained import _elsewhere
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import NAMED, Choices, Site

E, A, RHO, L, N = 2.1e11, 4e-3, 7850.0, 3.0, 12
IY, IZ = 1.6e-6, 2.6e-6
NODE, K, ANGLE = 9, 6e5, 0.7  # node of the guy, its stiffness in N/m and its angle from Y towards Z
SENSORS, MODES = (5, 8, 11, 13), 6


def plane(I: float) -> tuple[np.ndarray, np.ndarray]:
    """K and M of a cantilever of N elements, deflection and slope of nodes 2 to N + 1."""
    h, n = L / N, 2 * N + 2
    k = E * I / h**3 * np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                                 [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]])  # fmt: skip
    m = RHO * A * h / 420 * np.array([[156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h],
                                      [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h * h, -22 * h, 4 * h * h]])  # fmt: skip
    total = np.zeros((2, n, n))
    for i in range(N):
        at = slice(2 * i, 2 * i + 4)
        total[0, at, at] += k
        total[1, at, at] += m
    return total[0, 2:, 2:], total[1, 2:, 2:]


def deck() -> str:
    """Measured modes of the beam with its guy, and the model without."""
    parts = [block_diag(*each) for each in zip(plane(IZ), plane(IY), strict=True)]
    b = np.zeros(4 * N)
    b[2 * (NODE - 2)], b[2 * N + 2 * (NODE - 2)] = np.cos(ANGLE), np.sin(ANGLE)
    eigenvalues, X = eigh(parts[0] + K * np.outer(b, b), parts[1])
    read = [plane * 2 * N + 2 * (node - 2) for node in SENSORS for plane in (0, 1)]
    rng = np.random.default_rng(3)
    shapes = X[read, :MODES] / np.abs(X[read, :MODES]).max(axis=0)
    shapes = shapes + 0.01 * rng.standard_normal(shapes.shape)
    hz = np.sqrt(eigenvalues[:MODES]) / (2 * np.pi) * (1 + 0.001 * rng.standard_normal(MODES))
    rows = "\n".join(f"      - [{', '.join(f'{x:.5f}' for x in row)}]" for row in shapes)
    return f"""\
mouse: 1
model:
  structure:
    nodes: {{line: {{from: 1, to: {N + 1}, start: [0, 0, 0], end: [{L}, 0, 0]}}}}
    elements:
      - {{id: 1-{N}, type: beam, nodes: 1-{N + 1}, E: {E}, G: 8.0e+10, density: {RHO}, A: {A}, Iy: {IY}, Iz: {IZ}, J: 4.0e-6}}
    supports: {{1: all}}
parameters:
  - {{name: E, elements: 1-{N}, property: E, sd: 3 %, transform: log}}
test:
  modes:
    frequency: [{", ".join(f"{x:.6g}" for x in hz)}]
    frequency_sd: 0.1 %
    dofs: [{", ".join(f"{node}T{d}" for node in SENSORS for d in "YZ")}]
    shapes:
{rows}
    shape_sd: 0.01
"""


def test_a_guy_is_named_with_its_node_its_stiffness_and_its_direction():
    choices = Choices(("ground-spring", "inclined-spring", "mass"), causes=2)
    found = diagnose(assemble(yaml_deck.read(deck(), "beam.yaml")), choices=choices)
    assert (found.kind, found.best.physics) == (NAMED, "inclined-spring")
    assert not found.best.elsewhere  # a direction and its opposite are one spring
    (cause,) = found.best.causes
    k, angle = cause.sizes[:2]
    assert cause.site.position[0] == pytest.approx((NODE - 1) * L / N, abs=0.02 * L)
    assert k.value == pytest.approx(K, abs=3 * k.sd) and k.sd < 0.1 * K
    assert angle.value == pytest.approx(ANGLE, abs=3 * angle.sd) and angle.sd < 0.05
    assert found.extended_result.status.key == "converged"


def test_a_direction_and_its_opposite_read_alike():
    problem = assemble(yaml_deck.read(deck(), "deck.yaml"))
    candidate = registry()["inclined-spring"]
    recipe = candidate.recipes(reduced(problem, problem.prior.mean), candidate)[0]
    up, down = ([recipe.grid[0][0], angle, *recipe.grid[0][2:]] for angle in (np.pi / 2, -np.pi / 2))
    assert recipe.site(np.array(up)).text == recipe.site(np.array(down)).text


def test_other_sites_that_read_alike_are_one():
    at = lambda text: (Site("element", (1,), None, text),)
    others = [(SimpleNamespace(sites=at(text)), share) for text, share in (("b", 0.04), ("a", 0.3), ("b", 0.03), ("c", 5e-4))]
    found = _elsewhere(SimpleNamespace(sites=at("a"), elsewhere=tuple(others)))
    assert [(sites[0].text, round(share, 9)) for sites, share in found] == [("b", 0.07)]

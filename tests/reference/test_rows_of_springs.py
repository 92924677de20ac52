"""Springs next to one another in a row that are lost together: truth by the eigenvalues of a beam on springs of its own."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.linalg import eigh

import mouse_cli
from mouse_cli.diagnosis.diagnose import diagnose
from mouse_cli.diagnosis.effects.rows import runs
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import Choices

EI, MASS, STEP, COUNT, K = 4.0e8, 900.0, 2.0, 14, 2.4e7  # N m2, kg/m, m between nodes, nodes, N/m of each spring
GONE = range(9, 13)  # nodes, from 1, whose springs scour took


def modes(gone=()) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies in Hz and deflections (COUNT, m) of a pile of four cubic elements to a bay, on springs but those `gone`."""
    fine, h = 4, STEP / 4
    n = fine * (COUNT - 1) + 1
    stiff, heavy = np.zeros((2, 2 * n, 2 * n))
    k = EI / h**3 * np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h**2, -6 * h, 2 * h**2]])
    k = np.vstack([k, -k[0], [k[1, 0], k[1, 3], -k[1, 0], k[1, 1]]])
    m = np.array([[156, 22 * h, 54, -13 * h], [0, 4 * h**2, 13 * h, -3 * h**2], [0, 0, 156, -22 * h], [0, 0, 0, 4 * h**2]])
    m = MASS * h / 420 * (m + m.T - np.diag(m.diagonal()))
    for a, b in pairwise(range(n)):
        at = np.ix_([2 * a, 2 * a + 1, 2 * b, 2 * b + 1], [2 * a, 2 * a + 1, 2 * b, 2 * b + 1])
        stiff[at] += k
        heavy[at] += m
    for node in range(COUNT):
        if node + 1 not in gone:
            stiff[2 * fine * node, 2 * fine * node] += K
    rates, u = eigh(stiff, heavy)
    return np.sqrt(rates) / (2 * np.pi), u[:: 2 * fine]


def deck(gone=GONE) -> str:
    rng = np.random.default_rng(5)
    hz, shapes = (each[..., :6] for each in modes(gone))
    shapes = shapes / np.abs(shapes).max(axis=0)
    hz = hz * (1 + 2e-3 * rng.standard_normal(6))
    shapes = shapes[1::2] + 0.01 * rng.standard_normal(shapes[1::2].shape)
    rows = "\n".join(f"      - [{', '.join(f'{x:.5f}' for x in row)}]" for row in shapes)
    nodes = "\n".join(f"      - {{{i + 1}: [{STEP * i}, 0]}}" for i in range(COUNT))
    beams = "\n".join(
        f"      - {{id: {i}, type: beam, nodes: [{i}, {i + 1}], material: steel, section: pile}}" for i in range(1, COUNT)
    )
    springs = "\n".join(f"      - {{id: {30 + i}, type: spring, nodes: [{i}], TY: {K}}}" for i in range(1, COUNT + 1))
    return f"""\
mouse: 1
model:
  structure:
    nodes:
{nodes}
    materials: {{steel: {{E: 2e11, density: 7850}}}}
    sections: {{pile: {{A: {MASS / 7850}, Iz: {EI / 2e11}}}}}
    elements:
{beams}
{springs}
    directions: [TY, RZ]
parameters:
  - {{name: E, material: steel, property: E, sd: 3 %, transform: log}}
  - {{name: soil, elements: 31-{30 + COUNT}, property: TY, factor: true, sd: 10 %, transform: log}}
test:
  modes:
    frequency: [{", ".join(f"{x:.7g}" for x in hz)}]
    frequency_sd: 0.2 %
    dofs: [{", ".join(f"{i}TY" for i in range(2, COUNT + 1, 2))}]
    shapes:
{rows}
    shape_sd: 1 %
"""


def test_springs_that_scour_took_are_named_as_the_run_that_they_are(tmp_path):
    """Each alone does next to nothing, for its neighbours hold the pile: together they were an axial force that no name had."""
    path = tmp_path / "pile.yaml"
    path.write_text(deck())
    rivals = ("stiffness-loss", "foundation", "ground-spring", "tension", "compression", "member", "joint", "mass")
    found = diagnose(mouse_cli.read_deck(str(path)), choices=Choices(rivals))
    (cause,) = found.best.causes
    assert (found.kind, cause.site.text) == ("named", "springs 39 to 42, alike")
    assert cause.sizes[0].value > 0.9


@pytest.mark.parametrize(("rows", "count"), [(1, 2 + 3), (2, 2 * (2 + 3))])
def test_runs_are_of_two_and_more_but_not_of_the_whole_row(rows, count):
    """Of four springs in a row, two runs of three and three of two; of two rows beside one another none crosses over."""
    nodes = [f"{{{4 * r + i + 1}: [{i}, {r}]}}" for r in range(rows) for i in range(4)]
    springs = [f"{{id: {i}, type: spring, nodes: [{i}], TY: 1000}}" for i in range(1, 4 * rows + 1)]
    text = f"""\
mouse: 1
model:
  structure:
    nodes: [{", ".join(nodes)}]
    elements: [{", ".join(springs)}, {{id: 90, type: mass, nodes: 1, mass: 1}}]
    directions: [TY]
"""
    mesh = assemble(yaml_deck.read(text, "springs.yaml")).mesh
    members = [(s, i) for s, each in enumerate(mesh.elements) for i in range(len(each))]
    found = runs(mesh, members)
    assert len(found) == count == len({frozenset(each) for each in found})
    for run in found:
        at = mesh.coordinates[[mesh.elements[s].nodes[i][0] for s, i in run]]
        assert np.ptp(at[:, 1]) == 0 and set(np.diff(at[:, 0])) == {1.0}

"""A floor that is stiff in its plane: diagonals are added to the matrices of a frame by numpy, and found as the slab they are."""

import numpy as np
import pytest
from scipy.linalg import eigh

from mouse_cli.diagnosis import diagnose
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.arrays import dense
from mouse_cli.model.diagnosis import NAMED, Choices
from mouse_cli.terms.assembly import assembly

SHEAR = 2.0e6  # N/m
X, Y, Z = (0.0, 4.0, 9.0), (0.0, 5.0), (0.0, 3.0, 6.0)
NODE = {(i, j, k): 1 + i + 3 * j + 6 * k for i in range(3) for j in range(2) for k in range(3)}
MODES = 5
SENSORS = [f"{NODE[at]}T{d}" for at in ((0, 0, 1), (2, 1, 1), (0, 1, 2), (1, 0, 2), (2, 0, 2)) for d in "XY"]


def deck(test: str) -> str:
    """Two bays by one, two storeys."""
    at = "\n".join(f"      - {{{n}: [{X[i]}, {Y[j]}, {Z[k]}]}}" for (i, j, k), n in NODE.items())
    columns = [[NODE[i, j, k], NODE[i, j, k + 1]] for k in (0, 1) for j in (0, 1) for i in range(3)]
    beams = [[NODE[i, j, k], NODE[i + 1, j, k]] for k in (1, 2) for j in (0, 1) for i in (0, 1)]
    beams += [[NODE[i, 0, k], NODE[i, 1, k]] for k in (1, 2) for i in range(3)]
    floors = [NODE[i, j, k] for k in (1, 2) for j in (0, 1) for i in range(3)]
    return f"""\
mouse: 1
model:
  structure:
    nodes:
{at}
    materials: {{steel: {{E: 2.1e+11, nu: 0.3, density: 7850}}}}
    sections: {{column: {{A: 6e-3, Iy: 4e-5, Iz: 4e-5, J: 6e-5}}, beam: {{A: 4e-3, Iy: 2e-5, Iz: 2e-5, J: 3e-5}}}}
    elements:
      - {{id: 1-12, type: beam, nodes: {columns}, material: steel, section: column}}
      - {{id: 13-26, type: beam, nodes: {beams}, material: steel, section: beam}}
      - {{id: 27-38, type: mass, nodes: {floors}, mass: 1500}}
    supports: {{1-6: all}}
parameters:
  - {{name: E, material: steel, property: E, sd: 5 %, transform: log}}
test:
{test}"""


def diagonals(labels: tuple[str, ...], k: int) -> np.ndarray:
    """What both panels of floor k add to K: each diagonal SHEAR d^2 / (2 a b) along itself."""
    K = np.zeros((len(labels), len(labels)))
    for i in (0, 1):
        for one, other in (((i, 0, k), (i + 1, 1, k)), ((i + 1, 0, k), (i, 1, k))):
            along = np.array([X[other[0]] - X[one[0]], Y[other[1]] - Y[one[1]]])
            length, row = np.linalg.norm(along), np.zeros(len(labels))
            for node, sign in ((NODE[other], 1), (NODE[one], -1)):
                row[[labels.index(f"{node}T{d}") for d in "XY"]] = sign * along / length
            K += SHEAR * length**2 / (2 * (X[i + 1] - X[i]) * (Y[1] - Y[0])) * np.outer(row, row)
    return K


@pytest.mark.parametrize(
    ("floors", "said"), [((2,), "the floor at Z = 6 m"), pytest.param((1, 2), "all floors", marks=pytest.mark.proof)]
)
def test_a_slab_is_named_by_its_floor_and_its_shear_stiffness(floors, said):
    bare = assemble(
        yaml_deck.read(
            deck(f"  modes: {{frequency: [1], frequency_sd: 1 %, dofs: [{SENSORS[0]}], shapes: [[1]], shape_sd: 1 %}}"),
            "bare.yaml",
        )
    )
    K, M = (dense(each) for each in assembly(bare).matrices(bare.prior.mean))
    labels = bare.structure.labels
    rates, shapes = eigh(K + sum(diagonals(labels, k) for k in floors), M)
    rng, seen = np.random.default_rng(11), shapes[[labels.index(s) for s in SENSORS], :MODES]
    seen = seen / np.abs(seen).max(axis=0) + 0.01 * rng.standard_normal(seen.shape)
    hz = np.sort(np.sqrt(rates[:MODES]) / (2 * np.pi) * (1 + 2e-3 * rng.standard_normal(MODES)))
    modes = f"frequency: {hz.tolist()}, frequency_sd: 0.2 %, dofs: [{', '.join(SENSORS)}], shapes: {seen.tolist()}, shape_sd: 1 %"
    problem = assemble(yaml_deck.read(deck(f"  modes: {{{modes}}}"), "frame.yaml"))
    found = diagnose(problem, choices=Choices(("slab", "brace", "ground-spring"), causes=1))
    (cause,) = found.best.causes
    assert found.kind == NAMED and (cause.physics, cause.site.text) == ("slab", said)
    (size,) = cause.sizes
    assert abs(np.log(size.value / SHEAR)) < 3 * size.sd / size.value and size.sd < 0.3 * size.value
    stiff, _ = (dense(each) for each in assembly(found.extended).matrices(found.extended.prior.mean))
    np.testing.assert_allclose(
        stiff - K, sum(diagonals(labels, k) for k in floors) * size.value / SHEAR, atol=1e-6 * SHEAR
    )

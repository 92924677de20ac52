"""Key `geometry` of documents: shapes on the nodes against closed forms, rigid links, sensors between axes."""

import numpy as np
import pytest

from mouse_cli import read_deck, run
from mouse_cli.report import document
from mouse_cli.report.coarsened import coarsened

CANTILEVER = """mouse: 1
model:
  structure:
    nodes:
      - {line: {from: 0, to: 20, start: [0, 0, 0], end: [1, 0, 0]}}
      - {30: [1, 0, 0.2]}
    materials: {steel: {E: 2.0e+11, nu: 0.3, density: 7800}}
    sections: {rod: {A: 1.0e-4, Iy: 1.0e-9, Iz: 1.0e-9, J: 2.0e-9}}
    elements: [{id: 1-20, type: beam, nodes: 0-20, material: steel, section: rod}]
    rigid_links: [{independent: 20, dependent: 30}]
    supports: {0: all}
    directions: [TX, TZ, RY]
parameters: [{name: E, material: steel, property: E, sd: 5 %}]
test:
  modes:
    frequency: [8.96, 56.15]
    frequency_sd: 1 %
    dofs: [10TZ, 20TZ]
    shapes: [[0.34, -0.71], [1, 1]]
    shape_sd: 0.05
"""


@pytest.fixture(scope="module")
def geometry(tmp_path_factory):
    path = tmp_path_factory.mktemp("deck") / "deck.yaml"
    path.write_text(CANTILEVER)
    return document(run(read_deck(str(path))))["geometry"]


def test_bending_shape_of_a_cantilever(geometry):
    """cosh - cos - sigma (sinh - sin), beta L = 1.8751 and 4.6941 (Blevins 1979, Table 8-1)."""
    x = np.array(geometry["positions"])[:21, 0]
    for shape, b, sigma in zip(geometry["shapes"], (1.87510407, 4.69409113), (0.734095514, 1.01846732), strict=True):
        exact = np.cosh(b * x) - np.cos(b * x) - sigma * (np.sinh(b * x) - np.sin(b * x))
        w = np.array(shape["displacements"])[:21, 2]
        assert w / w[-1] == pytest.approx(exact / exact[-1], abs=2e-3)


def test_nodes_of_rigid_links_move(geometry):
    """An arm of 0.2 upward from the tip: ux = 0.2 w'(L) backwards, where the closed form gives w'(L) = 1.3765 w(L) / L."""
    u = np.array(geometry["shapes"][0]["displacements"])
    tip, arm = geometry["nodes"].index(20), geometry["nodes"].index(30)
    assert u[arm, 2] == pytest.approx(u[tip, 2], abs=1e-4)
    assert abs(u[arm, 0]) == pytest.approx(0.2 * 1.3765 * abs(u[tip, 2]), rel=2e-3)
    assert [tip, arm] in geometry["lines"]


def test_lines_elements_and_sensors(geometry):
    assert len(geometry["lines"]) == 21 and len({tuple(line) for line in geometry["lines"]}) == 21
    assert geometry["elements"][4] == [5, 4, 5]
    assert [(s["dof"], s["node"], s["direction"]) for s in geometry["sensors"]] == [
        ("10TZ", 10, [0, 0, 1]),
        ("20TZ", 20, [0, 0, 1]),
    ]
    for shape in geometry["shapes"]:
        u = np.array(shape["displacements"])
        assert shape["model"] == pytest.approx([u[10, 2], u[20, 2]], abs=2e-4)
        assert np.linalg.norm(u, axis=1).max() == pytest.approx(1, abs=1e-4)


def test_a_coarser_chain_is_a_chain():
    lines = np.column_stack([np.arange(9999), np.arange(1, 10_000)])
    found = coarsened(10_000, lines, 1500, [4321])
    kept = found.nodes.tolist()
    assert len(kept) <= 1501 and 4321 in kept and found.fewer
    assert found.lines.tolist() == [[i, i + 1] for i in range(len(kept) - 1)]
    assert found.index[4321] == kept.index(4321)


def test_few_nodes_stay_as_they_are():
    found = coarsened(4, np.array([[1, 0], [0, 1], [2, 3], [3, 3]]), 10)
    assert found.nodes.tolist() == [0, 1, 2, 3] and not found.fewer
    assert found.lines.tolist() == [[0, 1], [2, 3]]


def test_beams_of_few_nodes_bend(tmp_path):
    """Two beams of a cantilever: points along them on the closed form, which straight lines between three nodes are far from."""
    path = tmp_path / "deck.yaml"
    path.write_text(CANTILEVER.replace("to: 20,", "to: 2,").replace("1-20", "1-2").replace("0-20", "0-2")
                    .replace("independent: 20", "independent: 2").replace("10TZ, 20TZ", "1TZ, 2TZ"))  # fmt: skip
    found = document(run(read_deck(str(path))))["geometry"]
    assert len(found["positions"]) == 4 + 2 * 5 and len(found["lines"]) == 1 + 2 * 6
    assert found["elements"][1] == [2, 1, 9, 10, 11, 12, 13, 2]
    x, u = np.array(found["positions"]), np.array(found["shapes"][0]["displacements"])
    on = np.abs(x[:, 2]) < 1e-9
    b, sigma = 1.87510407, 0.734095514
    exact = lambda s: np.cosh(b * s) - np.cos(b * s) - sigma * (np.sinh(b * s) - np.sin(b * s))
    tip = u[found["nodes"].index(2), 2]
    assert u[on, 2] / tip == pytest.approx(exact(x[on, 0]) / exact(1.0), abs=5e-3)
    assert abs(exact(0.25) - exact(0.5) / 2) / exact(1.0) > 0.05

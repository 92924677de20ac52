"""Sensors: what they read of motions known in closed form, how decks write them, and what is said of faulty ones."""

import numpy as np
import pytest

from mouse_cli._errors import DeckError, frame
from mouse_cli.dynamics.interpolation import at_point
from mouse_cli.formats import read_deck, write_deck
from mouse_cli.model.geometry import Geometry


def line(points: np.ndarray, rotates: bool = True) -> Geometry:
    """Nodes joined one after another, all directions free."""
    k, per = len(points), 6 if rotates else 3
    node, direction = np.repeat(np.arange(k), per), np.tile(np.arange(per), k)
    lines = np.column_stack([np.arange(k - 1), np.arange(1, k)])
    return Geometry(np.arange(1, k + 1), points, node, direction, lines)


def reading(geometry: Geometry, point, direction, motion: np.ndarray) -> float:
    dofs, weights = at_point(geometry, np.array(point, float)).along(np.array(direction, float))
    return float(weights @ motion[dofs])


def test_a_cubic_deflection_is_read_exactly():
    """w = x^3 - x^2 across a beam along x, slope 3 x^2 - 2 x as rotation about z; between nodes and beside the axis."""
    x = np.array([0.0, 0.7, 1.5])
    geometry = line(np.column_stack([x, 0 * x, 0 * x]))
    motion = np.zeros((3, 6))
    motion[:, 1], motion[:, 5] = x**3 - x**2, 3 * x**2 - 2 * x
    for at in (0.2, 0.7, 1.1, 1.5):
        w, slope = at**3 - at**2, 3 * at**2 - 2 * at
        assert reading(geometry, [at, 0, 0], [0, 1, 0, 0, 0, 0], motion.ravel()) == pytest.approx(w, abs=1e-12)
        assert reading(geometry, [at, 0, 0], [0, 0, 0, 0, 0, 1], motion.ravel()) == pytest.approx(slope, abs=1e-12)
        assert reading(geometry, [at, 0.1, 0], [1, 0, 0, 0, 0, 0], motion.ravel()) == pytest.approx(
            -0.1 * slope, abs=1e-12
        )


@pytest.mark.parametrize("cloud", [False, True])
def test_a_rigid_body_motion_is_read_exactly(cloud):
    """u + theta x r at a point beside a skew beam, and inside a cloud of nodes that only translate."""
    rng = np.random.default_rng(2)
    points = rng.standard_normal((12, 3)) if cloud else np.outer([0, 0.4, 1.0], [2, -1, 0.5])
    u, theta, point = rng.standard_normal(3), rng.standard_normal(3), np.array([0.9, -0.3, 0.2])
    everywhere = np.column_stack([u + np.cross(theta, points), np.tile(theta, (len(points), 1))])
    geometry = line(points, rotates=not cloud)
    if cloud:
        geometry = Geometry(geometry.node_ids, points, geometry.node, geometry.direction, np.zeros((0, 2), int))
        everywhere = everywhere[:, :3]
    there = u + np.cross(theta, point)
    for axis in range(3):
        found = reading(geometry, point, np.eye(6)[axis], everywhere.ravel())
        assert found == pytest.approx(there[axis], abs=1e-10)


def test_a_line_that_does_not_rotate_is_linear():
    geometry = line(np.array([[0.0, 0, 0], [4, 0, 0]]), rotates=False)
    dofs, weights = at_point(geometry, np.array([1.0, 0, 0])).along(np.eye(6)[1])
    assert dofs.tolist() == [1, 4] and weights.tolist() == [0.75, 0.25]


STRUCTURE = """\
mouse: 1
title: cantilever
model:
  structure:
    nodes: {1: [0, 0, 0], 2: [0.5, 0, 0], 3: [1.0, 0, 0]}
    materials: {steel: {E: 2.1e11, G: 8.1e10, density: 7850}}
    sections: {bar: {A: 3.2e-4, Iy: 1.9e-9, Iz: 2.3e-8, J: 5.0e-9}}
    elements: [{id: 1-2, type: beam, nodes: 1-3, material: steel, section: bar}]
    supports: {1: [TX, TY, TZ, RX, RY, RZ]}
parameters:
  - {name: E, elements: 1-2, property: E, sd: 5 %}
test:
  sensors:
    - {name: a1, node: 2, direction: TY}
    - {name: a2, at: [0.75, 0, 0], direction: -TY}
    - {name: a3, node: 3, direction: [0, 3, 4]}
    - {name: pair, weights: {2TZ: 0.5, 3TZ: 0.5}}
  modes:
    dofs: [a1, a2, 3-TY, a3, pair]
    frequency: [22.0]
    frequency_sd: 1 %
    shapes: [[0.3], [-0.6], [-1.0], [0.6], [null]]
    shape_sd: 0.02
"""


def deck(tmp_path, text: str):
    path = tmp_path / "deck.yaml"
    path.write_text(text)
    return path


def test_what_a_deck_says_of_its_sensors(tmp_path):
    """Half-way along an element: (w2 + w3)/2 + L (slope2 - slope3)/8."""
    test = read_deck(deck(tmp_path, STRUCTURE)).test
    labels = [f"{node}{d}" for node in (2, 3) for d in ("TX", "TY", "TZ", "RX", "RY", "RZ")]
    rows = [dict(zip(labels, row, strict=True)) for row in test.sensing.toarray()]
    said = [{name: round(float(w), 12) for name, w in row.items() if w} for row in rows]
    assert said == [
        {"2TY": 1.0},
        {"2TY": -0.5, "2RZ": -0.0625, "3TY": -0.5, "3RZ": 0.0625},
        {"3TY": -1.0},
        {"3TY": 0.6, "3TZ": 0.8},
        {"2TZ": 0.5, "3TZ": 0.5},
    ]
    assert test.sensors == ("a1", "a2", "3-TY", "a3", "pair")
    assert [labels[dof] for dof in test.dofs] == ["2TY", "2TY", "3TY", "3TZ", "2TZ"]


MATRICES = """\
mouse: 1
model:
  stiffness: {dense: [[4, -1, 0], [-1, 3, -1], [0, -1, 2]]}
  mass: {identity: 3}
  labels: [2TY, 2RZ, 3TY]
test:
  sensors: [{name: "7", weights: {2TY: 0.25, 3TY: -1.5}}, {name: rotation, weights: {2RZ: 1}}]
  modes: {dofs: [rotation, 3-TY, "7", 1], frequency: [0.2], frequency_sd: 1 %, shapes: [[1], [-2], [3], [4]], shape_sd: 0.1}
"""


def test_a_number_in_quotes_is_the_number_where_nothing_is_called_so(tmp_path):
    quoted, plain = (read_deck(deck(tmp_path, MATRICES.replace(', 1],', f", {one}],"))).test for one in ('"1"', "1"))
    assert (quoted.sensing != plain.sensing).nnz == 0


def test_sensors_survive_writing(tmp_path):
    problem = read_deck(deck(tmp_path, MATRICES))
    assert problem.test.sensing.toarray().tolist() == [[0, 1, 0], [0, 0, -1], [0.25, 0, -1.5], [1, 0, 0]]
    write_deck(problem, tmp_path / "again.yaml")
    again = read_deck(tmp_path / "again.yaml").test
    assert again.sensors == problem.test.sensors == ("rotation", "3-TY", "7", "1")
    assert (again.sensing != problem.test.sensing).nnz == 0


def test_all_sensors_measure_when_dofs_says_nothing(tmp_path):
    text = STRUCTURE.replace("    dofs: [a1, a2, 3-TY, a3, pair]\n", "").replace(", [0.6], [null]]", ", [0.6]]")
    assert read_deck(deck(tmp_path, text)).test.sensors == ("a1", "a2", "a3", "pair")


@pytest.mark.parametrize(
    ("code", "old", "new", "place", "words"),
    [
        ("MD328", "[0.75, 0, 0]", "[0, 0, 0]", "{name: a2", "nearest degree of freedom in its direction is 2TY"),
        ("MD329", "node: 2, direction: TY", "node: 9, direction: TY", "{name: a1", "node 9, which the model does not have"),
        ("MD329", "3-TY", "7TY", "7TY", "numbers near to it: 3, 2, 1"),
        ("MD329", "3-TY", f"{10**30}TY", f"{10**30}TY", "numbers near to it: 3, 2, 1"),
        ("MD225", "3-TY", "3TV", "3TV", "no label of the model and no sensor"),
        ("MD225", "2TZ: 0.5", "2TV: 0.5", "{name: pair", "sensor pair names '2TV'"),
        ("MD324", "3-TY", "2TY", "2TY", "measured twice"),
        ("MD226", "name: a2", "name: a1", "{name: a1, at", "two sensors are called 'a1'"),
        ("MD217", "node: 2, direction: TY", "node: 2", "{name: a1", "give node and direction"),
        ("MD217", "node: 2, direction", "node: 2, at: [0, 0, 0], direction", "{name: a1", "one of the forms"),
        ("MD213", "direction: -TY", "direction: Y", "Y}", "TX, TY, TZ, RX, RY or RZ"),
        ("MD213", "[0, 3, 4]", "[0, 0, 0]", "[0, 0, 0]}", "[x, y, z]"),
        ("MD216", "[0.75, 0, 0]", "[0.75, 0]", "[0.75, 0]", "expected 3"),
    ],
)  # fmt: skip
def test_faulty_sensors_are_told_with_their_place(tmp_path, code, old, new, place, words):
    text = STRUCTURE.replace(old, new, 1)
    with pytest.raises(DeckError) as caught:
        read_deck(deck(tmp_path, text))
    found = [d for d in caught.value.diagnostics if d.code == code]
    assert found, str(caught.value)
    lines = text.splitlines()
    assert lines[found[0].span.line - 1][found[0].span.column - 1 :].startswith(place)
    assert words in frame(found[0])


def test_a_sensor_far_away_is_warned_of(tmp_path):
    problem = read_deck(deck(tmp_path, STRUCTURE.replace("[0.75, 0, 0]", "[750, 0, 0]")))
    assert [d.code for d in problem.warnings] == ["MD335"]


def test_a_matrix_model_has_no_nodes(tmp_path):
    text = """\
mouse: 1
model: {stiffness: {dense: [[2, -1], [-1, 1]]}, mass: {identity: 2}, labels: [base, tip]}
test:
  sensors: [{name: a1, node: 2, direction: TY}, {name: back, weights: {tip: -1}}]
  modes: {dofs: [base, back], frequency: [0.1], frequency_sd: 1 %, shapes: [[0.5], [-1]], shape_sd: 0.02}
"""
    test = read_deck(deck(tmp_path, text.replace("{name: a1, node: 2, direction: TY}, ", ""))).test
    assert test.sensing.toarray().tolist() == [[1, 0], [0, -1]] and test.sensors == ("base", "back")
    with pytest.raises(DeckError, match="MD329"):
        read_deck(deck(tmp_path, text.replace("dofs: [base, back]", "dofs: [base, a1]")))


BODY = """\
mouse: 1
title: A machine on four springs, sensors on its corners
model:
  structure:
    nodes: {1: [0, 0, 0.6], 2: [-0.9, -0.5, 0], 3: [0.9, -0.5, 0], 4: [0.9, 0.5, 0], 5: [-0.9, 0.5, 0], 6: [0.9, 0.5, 1.1]}
    elements:
      - {type: mass, nodes: [1], mass: 1850, Jx: 420, Jy: 780, Jz: 810}
      - {type: spring, nodes: [[2], [3], [4], [5]], TX: 4.2e5, TY: 4.2e5, TZ: 9.5e5}
    rigid_links: [{independent: 1, dependent: [2, 3, 4, 5, 6]}]
test:
  sensors:
    - {name: skew, node: 6, direction: [1, 0, 1]}
    - {name: inside, at: [0.45, 0.25, 0.85], direction: TX}
    - {name: twist, weights: {6TX: 1, 4TX: -1}}
  modes:
    dofs: [4TX, 4-TZ, 6TZ, skew, inside, twist]
    frequency: [3.5]
    frequency_sd: 0.3 %
    shapes: [[0.1], [-0.2], [0.2], [0.5], [0.3], [0.4]]
    shape_sd: 0.02
"""


def test_sensors_on_a_rigid_body_read_its_motion(tmp_path):
    """u + theta x r at nodes that follow a rigid link; two on one vertical line read the same TZ and are two data."""
    problem = read_deck(deck(tmp_path, BODY))
    rng = np.random.default_rng(4)
    u, theta = rng.standard_normal(3), rng.standard_normal(3)
    four, six, inside = (u + np.cross(theta, r) for r in ([0.9, 0.5, -0.6], [0.9, 0.5, 0.5], [0.45, 0.25, 0.25]))
    expected = [four[0], -four[2], six[2], (six[0] + six[2]) / np.sqrt(2), inside[0], six[0] - four[0]]
    assert problem.test.sensing @ np.concatenate([u, theta]) == pytest.approx(expected, abs=1e-12)
    write_deck(problem, tmp_path / "again.yaml")
    again = read_deck(tmp_path / "again.yaml").test
    assert again.sensing.toarray() == pytest.approx(problem.test.sensing.toarray(), abs=1e-9)
    with pytest.raises(DeckError, match="MD324"):
        read_deck(
            deck(tmp_path, BODY.replace("6TZ, skew", "6-TZ, 6TZ, skew").replace("[0.2], [0.5]", "[0.2], [0.2], [0.5]"))
        )

"""Structures in YAML decks: what they mean, against closed forms; what is wrong with them, and where."""

from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq

from mouse_cli._errors import DeckError
from mouse_cli.formats import read_deck, write_deck, yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.formats.yaml_deck.mesh_properties import SHAPES
from mouse_cli.terms.assembly import assembly
from mouse_cli.updating import forecast, run

DECKS = Path(__file__).resolve().parents[2] / "decks"

DECK = """\
mouse: 1
model:
  structure:
    nodes: {1: [0, 0], 2: [1, 0], 3: [2, 0]}
    materials: {steel: {E: 2.0e+11, nu: 0.3, density: 7800}}
    sections: {bar: {rectangle: [0.01, 0.02]}}
    elements:
      - {id: 1-2, type: beam, nodes: 1-3, material: steel, section: bar}
      - {id: 9, type: spring, nodes: [3], TY: 5.0e+3}
      - {id: 10, type: mass, nodes: [3], mass: 0.5}
    supports: {1: [TX, TY, RZ]}
    plane: XY
parameters:
  - {name: E, material: steel, property: E, sd: 3 %}
  - {name: tip, elements: 10, property: mass, sd: 10 %}
test:
  modes: {frequency: [5], frequency_sd: 1 %}
"""


def problem(text: str, folder: Path | None = None):
    path = str((folder or Path(".")) / "deck.yaml")
    return assemble(yaml_deck.read(text, path))


def findings(text: str):
    try:
        return problem(text).warnings
    except DeckError as error:
        return error.diagnostics


def clamped_bar(E: float, clamp: float, tip: float) -> list[float]:
    """Natural frequencies in Hz of the bar of decks/cantilever.yaml: elastic hinge, Euler-Bernoulli, point mass.

    w = a cos kx + b sin kx + d cosh kx + e sinh kx with w(0) = 0, EI w''(0) = clamp w'(0), w''(L) = 0 and
    EI w'''(L) = -tip omega^2 w(L), omega^2 = k^4 EI/mu.
    """
    length, width, depth, density = 1.2, 0.03, 0.008, 7850.0
    EI, mu = E * width * depth**3 / 12, density * width * depth

    def determinant(k: float) -> float:
        c, s, ch, sh, m = *(f(k * length) for f in (np.cos, np.sin, np.cosh, np.sinh)), tip * k / mu
        rows = [
            [1, 0, 1, 0],
            [-EI * k, -clamp, EI * k, -clamp],
            [-c, -s, ch, sh],
            [s + m * c, -c + m * s, sh + m * ch, ch + m * sh],
        ]
        return float(np.linalg.det(np.array([np.array(row) / np.linalg.norm(row) for row in rows])))

    grid = np.linspace(0.2, 12.0, 4000)
    values = [determinant(k) for k in grid]
    roots = [
        brentq(determinant, a, b) for a, b, u, v in zip(grid, grid[1:], values, values[1:], strict=False) if u * v < 0
    ]
    return [k**2 * np.sqrt(EI / mu) / (2 * np.pi) for k in roots]


@pytest.mark.parametrize(("E", "clamp", "tip"), [(2.06e11, 5500.0, 0.25), (2.1e11, 2.0e4, 0.25), (1.5e11, 900.0, 1.5)])
def test_cantilever_has_the_frequencies_of_the_exact_solution(E, clamp, tip):
    text = (DECKS / "cantilever.yaml").read_text()
    for old, new in (
        ("E: 2.1e+11", f"E: {E:.3e}"),
        ("RZ: 2.0e+4", f"RZ: {clamp:.3e}"),
        ("mass: 0.25}", f"mass: {tip}}}"),
    ):
        assert old in text
        text = text.replace(old, new)
    found, exact = forecast(problem(text), 3).frequencies_hz, np.array(clamped_bar(E, clamp, tip)[:3])
    # Cubic elements are too stiff (Rayleigh), by (k l)^4/1440 of the frequency: Cook et al., section 11.7.
    assert (found > exact * (1 - 1e-9)).all() and (found < exact * (1 + 1.2e-4)).all()


def test_cantilever_finds_its_clamp():
    result = run(read_deck(DECKS / "cantilever.yaml"))
    assert result.exit_code == 0
    truth = np.array([2.06e11, 5500.0, 0.25])
    assert (np.abs(result.revised.theta - truth) < 2 * result.sd_theta).all()
    assert result.sd_theta[1] < 0.03 * result.problem.prior.sd[1]


@pytest.mark.parametrize(
    ("shape", "dimensions", "expected"),
    [  # Timoshenko and Goodier, Theory of Elasticity, section 109: J = k a b^3
        ("rectangle", (1.0, 1.0), {"J": 0.1406, "A": 1, "Iy": 1 / 12}),
        ("rectangle", (2.0, 1.0), {"J": 0.229 * 2, "Iy": 2 / 12, "Iz": 8 / 12}),
        ("rectangle", (1.0, 10.0), {"J": 0.312 * 10}),
        ("circle", (2.0,), {"A": np.pi, "Iy": np.pi / 4, "J": np.pi / 2}),
        ("tube", (2.0, 1.0), {"A": np.pi, "J": np.pi / 2, "kappa_y": 6 / 7}),
        ("rectangular_tube", (3.0, 2.0, 0.01), {"A": 0.0996, "J": 4 * (2.99 * 1.99) ** 2 * 0.01 / 9.96}),
        (
            "i_section",
            (0.1, 0.2, 0.0056, 0.0085),
            {"A": 2.72e-3, "Iy": 1.85e-5, "Iz": 1.42e-6},
        ),  # IPE 200 without fillets
    ],
)
def test_cross_sections(shape, dimensions, expected):
    found = SHAPES[shape](*dimensions)
    for name, value in expected.items():
        assert found[name] == pytest.approx(value, rel=5e-3), name


def test_nominal_values_units_and_factors():
    text = DECK.replace("test:", "  - {name: bending, elements: 1-2, property: [Iy, Iz], sd: 5 %}\ntest:")
    found = problem(f"units: SI\n{text}")
    E, tip, bending = found.parameters
    assert (E.nominal, E.unit, E.sd) == (2.0e11, "Pa", pytest.approx(6e9))
    assert (tip.nominal, tip.unit) == (0.5, "kg")
    assert (bending.nominal, bending.unit, bending.sd) == (1.0, "", 0.05)  # Iy and Iz differ
    assert [b.factor for b in found.bindings] == [False, False, True, True]
    assert found.structure.labels == ("2TX", "2TY", "2RZ", "3TX", "3TY", "3RZ")


def test_a_parameter_moves_what_it_is_the_property_of():
    found = problem(DECK)
    whole = assembly(found)
    K, M = whole.matrices(np.array([2.0e11, 0.5]))
    K2, M2 = whole.matrices(np.array([4.0e11, 0.7]))
    spring = np.zeros((6, 6))
    spring[4, 4] = 5.0e3
    assert K2 - spring == pytest.approx(2 * (K - spring))
    assert np.diag(M2 - M) == pytest.approx([0, 0, 0, 0.2, 0.2, 0])


def test_springs_on_the_degrees_of_freedom_of_matrices():
    text = """\
mouse: 1
model:
  stiffness: {order: 2, entries: [[1,1,3.0],[1,2,-1.0],[2,2,1.0]]}
  mass: {identity: 2}
  labels: [base, tip]
  structure:
    elements:
      - {id: 1, type: spring, dofs: [tip], TX: 2.0}
      - {id: 2, type: spring, dofs: [1, 2], TX: 4.0}
      - {id: 3, type: mass, dofs: [tip], mass: 0.5}
parameters:
  - {name: ground, elements: 1, property: TX, sd: 1}
test:
  modes: {frequency: [1], frequency_sd: 1 %, dofs: [tip], shapes: [[1]], shape_sd: 0.1}
"""
    found = problem(f"units: SI\n{text}")
    K, M = assembly(found).matrices(np.array([3.0]))
    assert np.array_equal(K, [[7.0, -5.0], [-5.0, 8.0]]) and np.array_equal(M, np.diag([1.0, 1.5]))
    assert found.structure.labels == ("base", "tip") and found.test.dofs.tolist() == [1]
    again, _ = yaml_deck.write(found)
    assert np.array_equal(assembly(problem(again)).matrices(np.array([3.0]))[0], K)


def test_a_structure_attached_to_labelled_matrices():
    text = DECK.replace(
        "model:\n", "model:\n  stiffness: {diagonal: [7.0, 9.0]}\n  mass: {identity: 2}\n  labels: [3TY, 8TX]\n"
    )
    plain, found = problem(DECK), problem(text)
    theta = plain.prior.mean
    K, bare = assembly(found).matrices(theta)[0], assembly(plain).matrices(theta)[0]
    at = {label: i for i, label in enumerate(found.structure.labels)}
    own = [at[label] for label in plain.structure.labels]
    assert K[np.ix_(own, own)] - bare == pytest.approx(np.diag([0, 0, 0, 0, 7.0, 0]))
    assert K[at["8TX"], at["8TX"]] == 9.0


def test_nodes_and_elements_from_tables(tmp_path):
    (tmp_path / "nodes.csv").write_text("# of the rig\nid,x,y,z\n1,0,0,0\n2,1,0,0\n3,2,0,0\n")
    (tmp_path / "beams.csv").write_text("id,node1,node2,A\n1,1,2,2e-4\n2,2,3,3e-4\n")
    text = DECK.replace("{1: [0, 0], 2: [1, 0], 3: [2, 0]}", "{file: nodes.csv}")
    text = text.replace("id: 1-2, type: beam, nodes: 1-3", "type: beam, file: beams.csv")
    found = problem(text, tmp_path)
    assert found.mesh.node_ids.tolist() == [1, 2, 3] and found.mesh.elements[0].nodes.tolist() == [[0, 1], [1, 2]]
    assert found.mesh.elements[0].properties["A"].tolist() == [2e-4, 3e-4]
    (tmp_path / "nodes.csv").write_text("1,0,0,0\n2,1,zero,0\n")
    with pytest.raises(DeckError) as error:
        problem(text, tmp_path)
    assert any(d.code == "MD419" and d.span.line == 2 and "zero" in d.message for d in error.value.diagnostics)


def test_damping_matrices_are_kept():
    text = """\
mouse: 1
model:
  stiffness: {diagonal: [1.0, 4.0]}
  mass: {identity: 2}
  damping: {diagonal: [0.1, 0.2]}
  structural_damping: {order: 2, entries: [[1, 2, 0.01]]}
"""
    found = problem(text).structure
    assert np.array_equal(found.C, np.diag([0.1, 0.2])) and found.D[1, 0] == 0.01
    again = problem(yaml_deck.write(problem(text))[0]).structure
    assert np.array_equal(again.C, found.C) and np.array_equal(again.D, found.D)


FAULTS = [  # code, what is replaced, by what, text under the caret (None: not told), word of the message
    ("MD401", "nodes: 1-3,", "nodes: [1, 2, 4],", "[1, 2, 4]", "node 4"),
    ("MD401", "{1: [TX, TY, RZ]}", "{7: [TX]}", "7", "node 7"),
    ("MD402", "material: steel, section", "material: stel, section", "stel", "stel"),
    ("MD403", "elements: 10,", "elements: 11,", "11", "element 11"),
    ("MD404", "3: [2, 0]", "2: [2, 0]", "2", "node 2"),
    ("MD404", "id: 9,", "id: 2,", None, "element 2"),
    ("MD405", "material: steel, section: bar", "material: steel", None, "no A"),
    ("MD210", "TY: 5.0e+3", "TU: 5.0e+3", "TU", "'TU'"),
    ("MD407", "id: 1-2", "id: 1-5", "1-5", "5 numbers"),
    ("MD408", "[0.01, 0.02]", "[0.01, -0.02]", "[0.01, -0.02]", "no such shape"),
    ("MD409", "id: 1-2", "id: 2-1", "2-1", "2-1"),
    ("MD410", "3: [2, 0]}", "3: [2, 0], 4: [5, 5]}", "4", "node 4"),
    ("MD411", "2: [1, 0]", "2: [0, 0]", None, "element 1"),
    ("MD413", "property: mass", "property: E", "E", "'E'"),
    ("MD413", "property: E", "property: EE", "EE", "EE"),
    ("MD414", "property: mass, sd: 10 %", "property: Jx, factor: true, sd: 1", "Jx", "which is 0"),
    ("MD415", "elements: 10, property: mass", "elements: 1-2, property: E", "tip", "two parameters"),
    (
        "MD416",
        "    plane: XY",
        "    rigid_links: [{independent: 2, dependent: 2}]\n    plane: XY",
        None,
        "follow itself",
    ),
    ("MD417", "    plane: XY", "    rigid_links: [{independent: 2, dependent: 1}]\n    plane: XY", None, "held twice"),
    ("MD420", "elements: 10, property: mass", "elements: 10", None, "no property"),
    ("MD424", "{1: [TX, TY, RZ]}", "{1-3: all}", None, "free to move"),
    ("MD425", "density: 7800", "density: .nan", None, "finite"),
    ("MD425", "E: 2.0e+11", "E: -2.0e+11", None, "positive"),
    ("MD214", "type: spring", "type: sprung", "sprung", "sprung"),
    ("MD223", "property: mass, sd: 10 %", "property: Jx, sd: 10 %", "10 %", "is 0"),
    ("MD213", "3: [2, 0]", "[3, 4]: [2, 0]", "[3, 4]", "a list of 2"),
    ("MD213", "3: [2, 0]", "99999999999: [2, 0]", "99999999999", "the number of a node"),
]


@pytest.mark.parametrize(("code", "old", "new", "caret", "word"), FAULTS, ids=lambda v: str(v)[:24])
def test_each_fault_has_its_code_and_place(code, old, new, caret, word):
    assert DECK.count(old) == 1
    found = [d for d in findings(DECK.replace(old, new)) if d.code == code]
    assert found, [d.headline for d in findings(DECK.replace(old, new))]
    span = found[0].span
    assert any(word in d.message for d in found), found[0].message
    assert span.line > 1 and found[0].help
    if caret:
        assert span.text[span.column - 1 : span.column - 1 + span.width] == caret


def test_parameters_keep_their_elements_beside_one_that_was_refused():
    """What another is bound to is said of the right names; the value that could not be read is one finding, not two."""
    more = DECK.replace("name: E, material", "name: [E], material")
    more = more.replace("test:", "  - {name: third, elements: 10, property: mass, sd: 1 %}\ntest:")
    name, twice = findings(more)
    assert (name.code, twice.code) == ("MD213", "MD415") and "tip and third" in twice.message
    (nominal,) = findings(DECK.replace("name: tip, ", "name: tip, nominal: heavy, "))
    assert nominal.code == "MD213" and "'heavy'" in nominal.message


def test_a_written_structure_reads_back_with_its_tables(tmp_path):
    """Nodes in no line and elements in no chain go to tables beside the deck."""
    generator = np.random.default_rng(3)
    places = generator.normal(size=(600, 3)).round(4)
    nodes = ", ".join(f"{i}: [{x}, {y}, {z}]" for i, (x, y, z) in enumerate(places.tolist(), 1))
    pairs = ", ".join(f"[{i}, {1 + (i * 7) % 600}]" for i in range(1, 601) if 1 + (i * 7) % 600 != i)
    beams = pairs.count("[")
    text = DECK.replace("{1: [0, 0], 2: [1, 0], 3: [2, 0]}", f"{{{nodes}}}").replace("nodes: 1-3", f"nodes: [{pairs}]")
    text = text.replace("id: 1-2", f"id: 1001-{1000 + beams}").replace("    plane: XY\n", "")
    text = text.replace("[TX, TY, RZ]", "all")
    first = problem(text)
    written = write_deck(first, tmp_path / "again.yaml")
    assert len(written) > 1
    again = read_deck(tmp_path / "again.yaml")
    assert np.array_equal(again.mesh.coordinates, first.mesh.coordinates)
    assert np.array_equal(again.mesh.elements[0].nodes, first.mesh.elements[0].nodes)
    theta = first.prior.mean
    assert (assembly(again).matrices(theta)[0] != assembly(first).matrices(theta)[0]).nnz == 0


def test_each_element_may_be_a_parameter():
    """`each: k` stands for one parameter for every k elements, in their order; the last takes what is left."""
    text = DECK.replace("material: steel, property: E, sd: 3 %", "elements: 1-2, property: E, each: 1, sd: 3 %")
    found = problem(f"units: SI\n{text}")
    assert [p.name for p in found.parameters] == ["E 1", "E 2", "tip"]
    assert [b.members.tolist() for b in found.bindings] == [[0], [1], [0]]
    written = DECK.replace("  - {name: E, material: steel", "  - {name: E 1, elements: 1").replace(
        "  - {name: tip", "  - {name: E 2, elements: 2, property: E, sd: 3 %}\n  - {name: tip"
    )
    one, other = run(found), run(problem(written))
    assert one.revised.theta == pytest.approx(other.revised.theta, rel=1e-12)
    assert [p.name for p in problem(text.replace("each: 1", "each: 5")).parameters] == ["E 1, 2", "tip"]


@pytest.mark.parametrize(("each", "code"), [("0", "MD420"), ("two", "MD213"), ("1.5", "MD213")])
def test_each_must_be_a_whole_number(each: str, code: str):
    text = DECK.replace("material: steel, property: E", f"elements: 1-2, property: E, each: {each}")
    assert [(d.code, d.span.line) for d in findings(text)] == [(code, 14)]


def test_a_beam_in_space_without_torsion_is_told():
    text = DECK.replace("    plane: XY\n", "").replace(
        "[0, 0], 2: [1, 0], 3: [2, 0]", "[0, 0, 0], 2: [1, 0, 0], 3: [2, 0, 0]"
    )
    text = text.replace("{rectangle: [0.01, 0.02]}", "{A: 2.0e-4, Iy: 1.0e-9, Iz: 1.0e-9}")
    told = [d for d in problem(text.replace("[TX, TY, RZ]", "all")).warnings if d.code == "MD426"]
    assert len(told) == 1 and "J = 0" in told[0].message and told[0].span.line == 8
    assert not [d for d in problem(DECK).warnings if d.code == "MD426"]

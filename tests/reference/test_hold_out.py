"""Data that a deck holds out: no fit sees them, they read back, and what cannot be held out is refused with its place."""

import numpy as np
import pytest

from mouse_cli._errors import DeckError
from mouse_cli.formats import read_deck, write_deck
from mouse_cli.updating import run

CHAIN = """\
mouse: 1
model: {stiffness: {dense: [[2, -1, 0], [-1, 2, -1], [0, -1, 1]]}, mass: {identity: 3}}
parameters: [{name: k, nominal: 1, sd: 10 %, stiffness: [[1, 1, 1]]}]
test:
  modes:
    frequency: [0.0708, 0.1985, 0.2868]
    frequency_sd: 1 %
    dofs: [1, 2, 3]
    shapes: [[0.33, 0.74, 0.59], [0.59, 0.33, -0.74], [0.74, -0.59, 0.33]]
    shape_sd: 0.01
"""
HELD = """\
  hold_out:
    modes: [3]
    sensors: [2]
    altered: [{title: tip mass, mass: {3: 0.5}, spring: {1: 0.2}, frequency: [0.06, 0.18], frequency_sd: 1 %}]
"""
BEAM = """\
mouse: 1
model:
  structure:
    nodes: {1: [0, 0], 2: [1, 0], 3: [2, 0]}
    materials: {steel: {E: 2.1e11, density: 7850}}
    sections: {bar: {circle: 0.02}}
    elements: [{type: beam, nodes: 1-3, material: steel, section: bar}]
    supports: {1: [TX, TY, RZ]}
    plane: XY
parameters: [{name: E, material: steel, property: E, sd: 5 %}]
test:
  sensors: [{name: tip, at: [1.9, 0, 0], direction: -TY}]
  modes: {frequency: [3.6, 22.5], frequency_sd: 1 %, dofs: [2TY, tip], shapes: [[0.3, 0.7], [-1, 0.9]], shape_sd: 0.01}
"""


def _read(tmp_path, text):
    path = tmp_path / "deck.yaml"
    path.write_text(text)
    return read_deck(path)


def test_fits_do_not_see_what_is_held_out(tmp_path):
    """The same answer, to the last bit, as from a deck that does not have the data at all."""
    held = _read(tmp_path, CHAIN + HELD)
    absent = CHAIN.replace(", 0.2868]", "]").replace("[1, 2, 3]", "[1, 3]")
    absent = absent.replace(
        "[0.33, 0.74, 0.59], [0.59, 0.33, -0.74], [0.74, -0.59, 0.33]", "[0.33, 0.74], [0.74, -0.59]"
    )
    one, other = run(held), run(_read(tmp_path, absent))
    assert one.revised.theta == other.revised.theta
    assert one.y.tolist() == other.y.tolist()


def test_run_says_what_it_foresees(tmp_path):
    """The third mode of a fixed-free chain of three unit springs and masses in closed form, omega = 2 sin(5 pi / 14)."""
    from mouse_cli.report import printout

    text = printout(run(_read(tmp_path, CHAIN + HELD)), "modern")
    assert "Held out, and used by no fit: mode 3; 1 sensor of 3; 2 frequencies of the configuration 'tip mass'." in text
    line = next(line for line in text.split("DATA HELD OUT")[1].split("\n") if line.split()[:1] == ["3"])
    _, measured, model, off, alike = map(float, line.split())
    assert measured == 0.2868
    assert model == pytest.approx(2 * np.sin(5 * np.pi / 14) / (2 * np.pi), rel=1e-3)
    assert off == pytest.approx(100 * (model / measured - 1), abs=1e-3)
    assert alike > 0.99


def test_division(tmp_path):
    problem = _read(tmp_path, CHAIN + HELD)
    held = problem.hold_out
    assert problem.test.number.tolist() == [1, 2]
    assert problem.test.dofs.tolist() == [0, 2]
    assert held.test.number.tolist() == [3]
    assert held.test.shapes.tolist() == [[0.59], [0.33]]
    assert held.readings.shapes.tolist() == [[0.59, 0.33]]
    assert held.altered[0].masses == {2: 0.5}
    assert held.altered[0].springs == {0: 0.2}
    assert held.altered[0].number.tolist() == [1, 2]
    assert held.altered[0].frequency_sd_hz.tolist() == pytest.approx([0.0006, 0.0018])


@pytest.mark.parametrize(
    "text",
    [
        CHAIN + HELD,
        CHAIN + "  hold_out: {sensors: [3, 1]}\n",
        BEAM + "  hold_out: {sensors: [tip], altered: [{title: 'a: b', mass: {3: 2}, spring: {2RZ: 5}, number: [2], "
        "frequency: [9], frequency_sd: [0.1]}]}\n",
    ],
)
def test_round_trip(tmp_path, text):
    problem = _read(tmp_path, text)
    path = tmp_path / "again.yaml"
    write_deck(problem, path)
    one, other = problem.hold_out, read_deck(path).hold_out
    np.testing.assert_array_equal(one.modes, other.modes)
    np.testing.assert_array_equal(one.sensors, other.sensors)
    np.testing.assert_array_equal(one.whole.shapes, other.whole.shapes)
    assert [(a.title, a.masses, a.springs) for a in one.altered] == [
        (a.title, a.masses, a.springs) for a in other.altered
    ]
    for a, b in zip(one.altered, other.altered, strict=True):
        np.testing.assert_array_equal(np.stack([a.number, a.frequency_hz, a.frequency_sd_hz]),
                                      np.stack([b.number, b.frequency_hz, b.frequency_sd_hz]))  # fmt: skip


def test_mass_at_a_node_moves_with_it(tmp_path):
    problem = _read(
        tmp_path, BEAM + "  hold_out: {altered: [{title: t, mass: {3: 2}, frequency: [3], frequency_sd: 0.1}]}\n"
    )
    masses = problem.hold_out.altered[0].masses
    assert {problem.structure.labels[dof]: kg for dof, kg in masses.items()} == {"3TX": 2.0, "3TY": 2.0}


def test_sensor_between_nodes_is_divided_off(tmp_path):
    problem = _read(tmp_path, BEAM + "  hold_out: {sensors: [2TY]}\n")
    assert problem.test.sensors == ("tip",)
    assert problem.test.sensing.shape == (1, problem.structure.n)
    assert problem.hold_out.readings.sensors == ("2TY",)


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ("{modes: [4]}", "MD430"),
        ("{sensors: [7]}", "MD430"),
        ("{modes: [1, 2, 3]}", "MD432"),
        ("{altered: [{title: t, mass: {9: 1}, frequency: [1], frequency_sd: 1}]}", "MD431"),
        ("{altered: [{title: t, spring: {TIP: 1}, frequency: [1], frequency_sd: 1}]}", "MD431"),
        ("{altered: [{title: t, frequency: [1, 2], number: [2, 1], frequency_sd: 1}]}", "MD431"),
        ("{altered: [{title: t, frequency: [-1], frequency_sd: 1}]}", "MD431"),
        ("{altered: [{title: t, frequency: [1, 2], number: [1], frequency_sd: 1}]}", "MD216"),
        ("{altered: [{title: t}]}", "MD211"),
        ("{mode: [1]}", "MD210"),
    ],
)
def test_refused_with_its_place(tmp_path, line, code):
    with pytest.raises(DeckError) as caught:
        _read(tmp_path, f"{CHAIN}  hold_out: {line}\n")
    found = [d for d in caught.value.diagnostics if d.code == code]
    assert found
    assert found[0].span.line == CHAIN.count("\n") + 1


def test_nothing_held_out_is_no_division(tmp_path):
    problem = _read(tmp_path, CHAIN + "  hold_out: {modes: []}\n")
    assert problem.hold_out is None
    assert problem.test.m == 3

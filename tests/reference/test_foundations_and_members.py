"""Softer members, flexible bases and rocking foundations beside OpenSees, and what is said of candidates without a site."""

import numpy as np
import pytest
from click.testing import CliRunner

from benchmarks.blind.case import generator
from benchmarks.blind.space import frames, opensees, rocked, storeys
from mouse_cli.cli.main import cli
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import WHOLE
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.diagnosis.mechanisms.taper import CANDIDATE as TAPER
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble

TEST = "test:\n  modes: {{number: [1, 2, 3], frequency: [{0}, {1}, {2}], frequency_sd: 0.2 %}}\n"
COLUMN = """\
mouse: 1
model:
  structure:
    nodes: {line: {from: 1, to: 9, start: [0, 0], end: [0, 4]}}
    elements:
      - {id: 1-8, type: beam, nodes: 1-9, E: 2.1e+11, nu: 0.3, density: 7850, A: 0.01, Iz: 1.0e-5, nonstructural_mass: 3}
      - {id: 9, type: mass, nodes: [9], mass: 3000}
    supports: {1: all}
    plane: XY
    %s
parameters:
  - {name: E, elements: 1-8, property: E, sd: 5 %%}
  %s
"""


def of(text: str):
    problem = assemble(yaml_deck.read(text, "deck.yaml"))
    return reduced(problem, problem.prior.mean)


def frequencies(model, key: str, says: str, values) -> np.ndarray:
    """The lowest eight in Hz, with candidate `key` at the site whose text is `says`."""
    recipes = registry()[key].recipes(model, registry()[key])
    recipe = next(each for each in recipes if each.site(each.grid[0]).text == says)
    at = Model(model, (recipe,)).point(np.append(model.z, recipe.coordinates(np.array(values, float))))
    return np.sqrt(at.eigenvalues[:8]) / (2 * np.pi)


@pytest.fixture(scope="module")
def frame():
    """A frame, its model, and what OpenSees needs of the very same structure."""
    pytest.importorskip("openseespy")
    rng = generator("test", "frame", 1)
    found = next(one for one in iter(lambda: frames.drawn(rng), None) if len(one.points) - len(one.feet) <= WHOLE // 6)
    inputs = found.inputs(rng) | {"E": frames.E, "density": frames.DENSITY}
    sound = opensees.modes(inputs, 8)[0]
    model = of("mouse: 1\n" + frames.deck(found) + TEST.format(*sound[:3]))
    assert np.sqrt(model.eigenvalues[:8]) / (2 * np.pi) == pytest.approx(sound, rel=2e-3)
    return found, model, inputs, sound


@pytest.mark.parametrize("left", [0.5, 0.1])
def test_softer_members_beside_opensees(frame, left):
    found, model, inputs, sound = frame
    for member in (0, len(found.feet), len(found.members) - 1):
        for mass, more in ((1.0, ", its stiffness alone"), (left, ", its mass alike")):
            true = opensees.modes(inputs | {"factors": {str(member): [left, mass]}}, 8)[0]
            said = frequencies(model, "member", f"element {member + 1}{more}", [1 - left])
            assert said / sound == pytest.approx(true / sound, abs=0.05 * np.abs(true / sound - 1).max() + 2e-4)


def test_feet_that_turn_about_two_axes_beside_opensees(frame):
    found, model, inputs, sound = frame
    stiff = frames.E * found.sections[0, 1] / 3.0 * np.array([2.0, 5.0])
    for feet in (found.feet[:1], found.feet):
        true = opensees.modes(inputs | {"springs": [[n, 4 + d, stiff[d]] for n in feet for d in (0, 1)]}, 8)[0]
        numbers = ", ".join(str(n + 1) for n in feet)
        says = f"the support of node {numbers}" if len(feet) == 1 else f"the supports of nodes {numbers}"
        options = [(f"{says}, RX and RY", stiff), (f"{says}, RY and RX", stiff[::-1])]
        recipes = registry()["support-rotation"].recipes(model, registry()["support-rotation"])
        texts = [each.site(each.grid[0]).text.removesuffix(", all alike") for each in recipes]
        text, values = next(option for option in options if option[0] in texts)
        said = frequencies(model, "support-rotation", text + (", all alike" if len(feet) > 1 else ""), values)
        assert said / sound == pytest.approx(true / sound, abs=0.05 * np.abs(true / sound - 1).max() + 2e-4)


@pytest.mark.parametrize("kind", ["storey", "spring"])
def test_storeys_on_a_foundation_that_rocks_beside_opensees(kind):
    pytest.importorskip("openseespy")
    building = storeys.drawn(generator("test", "storeys", 1))
    above, m = np.cumsum(building.heights), building.m
    inputs = {"heights": building.heights.tolist(), "k": building.k.tolist(), "m": m.tolist(), "width": building.width}
    sound = rocked.modes(inputs | {"turning": 0.0})[0]
    turning = 2.0 * (2 * np.pi * sound[0]) ** 2 * float(m @ above**2)
    true = rocked.modes(inputs | {"turning": turning})[0]
    deck = storeys._deck(building, above).replace("type: storey", f"type: {kind}")
    model = of("mouse: 1\n" + deck + TEST.format(*sound[:3]))
    said = frequencies(model, "rocking", "the base at node 0, RY", [turning, m.sum() * building.width**2 / 12])
    assert said[: len(true)] == pytest.approx(true[:8], rel=1e-6)
    assert true[0] < 0.85 * sound[0]


def test_supports_give_way_under_gravity_as_a_column_on_a_spring_does():
    """A stiff column of height h with a mass on a spring against turning: omega^2 = (k - m g h) / (m h^2)."""
    stiff = COLUMN.replace("Iz: 1.0e-5", "Iz: 1.0e-2").replace("A: 0.01", "A: 1.0e-4") % ("gravity: [0, -9.81, 0]", "")
    model = of(stiff + TEST.format(1, 200, 400))
    k, h = 3000 * 9.81 * 4 * 3.0, 4.0
    mass = 3000 * h**2 + (7850 * 1e-4 + 3) * h**3 / 3
    weight = 3000 * 9.81 * h + (7850 * 1e-4 + 3) * 9.81 * h**2 / 2
    exact = np.sqrt((k - weight) / mass) / (2 * np.pi)
    assert frequencies(model, "support-rotation", "the support of node 1, RZ", [k])[0] == pytest.approx(exact, rel=2e-3)


def test_the_mass_of_a_section_goes_with_its_stiffness():
    """Only what a section weighs: what it carries stays."""
    text = COLUMN % ("", "") + TEST.format(1, 20, 60)
    free = text.replace(
        "- {id: 9, type", "- {id: 10, type: beam, nodes: [9, 8], E: 1, nu: 0.3, A: 1, Iz: 1}\n      - {id: 9, type"
    )
    model = of(free)
    recipes = [
        each
        for each in registry()["member"].recipes(model, registry()["member"])
        if "mass" in each.site(each.grid[0]).text
    ]
    moved = [np.trace(each.change(np.array([1.0])).M) for each in recipes]
    assert moved and max(moved) <= 0


def test_a_taper_is_one_of_sections():
    bar = of(COLUMN % ("", "") + TEST.format(1, 20, 60))
    (slope, share), *_ = [recipe.unknowns for recipe in TAPER.recipes(bar, TAPER)]
    assert slope.lower < 0 < slope.upper and 0 < share.lower <= 1 / 3 and share.upper == 1


def test_sensors_weigh_what_sensors_weigh():
    heavy = COLUMN.replace("mass: 3000", "mass: 3.0e+6") % ("", "")
    test = TEST.format(1, 2, 3).replace(
        "sd: 0.2 %}}", "sd: 0.2 %, dofs: [5TX, 9TX], shapes: [[1, 1, 1], [1, -1, 1]], shape_sd: 0.01}}"
    )
    test = test.replace(
        "frequency_sd: 0.2 %", "frequency_sd: 0.2 %, dofs: [5TX, 9TX], shapes: [[1, 1, 1], [1, -1, 1]], shape_sd: 0.01"
    )
    key = registry()["sensor-mass"]
    declared = of(heavy.replace("mouse: 1\n", "mouse: 1\nunits: SI\n") + test)
    assert not key.recipes(declared, key) and "20 kg" in key.why(declared)
    assert key.recipes(of(heavy + test), key)


def test_mass_along_beams_beside_a_parameter_of_some():
    """A part of them can have more all the same, unless the parameter begins from nothing, which no factor makes more."""
    more, added = "- {{name: load, elements: 1-4, property: nonstructural_mass, {}}}", registry()["added-mass"]
    found = of(COLUMN % ("", more.format("sd: 10 %")) + TEST.format(1, 20, 60))
    covered = added.recipes(found, added)
    assert len(covered) == 3 and not any(recipe.site(recipe.grid[0]).kind == "structure" for recipe in covered)
    found = of(COLUMN % ("", more.format("nominal: 0, sd: 1")) + TEST.format(1, 20, 60))
    assert not added.recipes(found, added) and "nonstructural_mass" in added.why(found)


def test_candidates_without_a_site_are_refused_with_those_that_have_one(tmp_path):
    path = tmp_path / "free.yaml"
    path.write_text(
        (COLUMN % ("", "")).replace("    supports: {1: all}\n", "")
        + TEST.format(1, 20, 60).replace("[1, 2, 3]", "[4, 5, 6]")
    )
    done = CliRunner().invoke(cli, ["diagnose", str(path), "-q", "--candidates", "support-rotation,rocking"])
    assert done.exit_code == 2
    said = " ".join(done.output.split())
    assert "the model has no supports" in said and "crack" in said


def test_a_body_on_springs_between_nodes_that_are_apart_stands_on_its_supports():
    """Freed of them, the frame and the body may turn by one angle each, which strains nothing and is no motion of the whole."""
    text = """\
mouse: 1
model:
  structure:
    nodes: {1: [0, 0], 2: [2, 0], 3: [0, 1.3], 4: [1, 1.3], 5: [2, 1.3], 6: [1, 1.1], 7: [1, 0.5]}
    elements:
      - {id: 1-4, type: beam, nodes: [1, 3, 4, 5, 2], E: 2.1e+11, nu: 0.3, density: 7850, A: 0.01, Iz: 1.0e-5}
      - {id: 5, type: beam, nodes: [6, 7], E: 2.1e+11, nu: 0.3, density: 7850, A: 0.01, Iz: 1.0e-5}
      - {id: 6, type: spring, nodes: [4, 6], TX: 8.0e+7, TY: 6.0e+7, RZ: 5.0e+6}
    supports: {1: all, 2: all}
    plane: XY
parameters:
  - {name: E, elements: 1-5, property: E, sd: 2 %}
"""
    model = of(text + TEST.format(20, 60, 90))
    motions = {each.site(each.grid[0]).text for each in registry()["rocking"].recipes(model, registry()["rocking"])}
    assert "the foundation of all supports as one body, TX" in motions


PORTAL = """\
mouse: 1
model:
  structure:
    nodes: {1: [0, 0], 2: [0, 3], 3: [4, 3], 4: [4, 0]}
    elements:
      - {id: 1-3, type: beam, nodes: 1-4, E: 2.1e+11, density: 7850, A: 0.01, Iz: 1.0e-5, Iy: 1.0e-5, J: 1.0e-5}
      - {id: 4, type: mass, nodes: [2], mass: 3000}
"""
IN_PLANE = ("    supports: {1: all, 4: all}\n    plane: XY\n", "    supports: {1: all, 4: all, 2-3: [TZ, RX, RY]}\n")


def test_what_is_held_to_a_plane_rocks_as_what_is_modelled_in_it():
    """Supports that only keep a frame in its plane are no ground: its feet turn together, about the axis across the plane."""
    says, k = "the foundation of all supports as one body, RZ", 3e7
    found = []
    for supports in IN_PLANE:
        model = of(PORTAL + supports + TEST.format(3, 15, 40))
        recipes = registry()["rocking"].recipes(model, registry()["rocking"])
        assert {each.site(each.grid[0]).ids for each in recipes} == {(1, 4)}
        assert not any(axis in each.site(each.grid[0]).text for axis in ("RX", "RY", "TZ") for each in recipes)
        found.append(frequencies(model, "rocking", says, [k])[:4])
        recipe = next(each for each in recipes if each.site(each.grid[0]).text == says)
        deck = recipe.extend(model.problem, np.array([k]))
        extended = np.sqrt(reduced(deck, deck.prior.mean).eigenvalues[:4]) / (2 * np.pi)
        assert found[-1] == pytest.approx(extended, rel=1e-3)
    assert found[0] == pytest.approx(found[1], rel=1e-6)
    assert found[0][0] < 0.95 * np.sqrt(model.eigenvalues[0]) / (2 * np.pi)

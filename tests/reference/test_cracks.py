"""Cracks: the element `cracked_beam` and the mechanism `crack` are one physics, against Hermite elements with springs across."""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))
from benchmarks.blind import cracks
from benchmarks.blind.decks import as_text
from benchmarks.blind.test_data import CONFIGS, measured
from mouse_cli.diagnosis.diagnose import again
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.unseen import unmeasured_hz, unseen
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.diagnosis.search.descents import best
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble

L, N, H, DEPTH = 0.8, 40, 0.02, 0.45
CLAMPED, SIMPLE, CANTILEVER = "1: all, 41: all", "1: [TX, TY], 41: [TY]", "1: all"
BENDING = "directions: [TY, RZ]"
DECK = """\
mouse: 1
model:
  structure:
    nodes: {{line: {{from: 1, to: {last}, start: [0, 0, 0], end: {end}}}}}
    materials: {{steel: {{E: 2.1e11, nu: 0.3, density: 7850}}}}
    sections: {{bar: {{rectangle: [{height}, 0.02]}}}}
    elements:
{elements}
    supports: {{{supports}}}
    {plane}
parameters:
  - {{name: E, material: steel, property: E, sd: 3 %}}
test:
  modes: {{{test}}}
"""
SOUND = "      - {{id: 1-{0}, type: beam, nodes: 1-{1}, material: steel, section: bar{2}}}"


def model(elements: str = "", supports: str = SIMPLE, plane: str = "plane: XY", n: int = N, more: str = "", **given):
    """The bar along X, of 40 elements that are sound unless said otherwise."""
    values = {"elements": elements or SOUND.format(n, n + 1, more), "supports": supports, "plane": plane}
    values |= {"test": "number: [1, 2, 3, 4, 5], frequency: [1, 2, 3, 4, 5], frequency_sd: 1 %"}
    values |= {"last": n + 1, "end": f"[{L}, 0, 0]", "height": H} | given
    problem = assemble(yaml_deck.read(DECK.format(**values), "bar.yaml"))
    return reduced(problem, problem.prior.mean)


def cracked(found, place: float, plane: int = 0, depth: float = DEPTH, extend: bool = False) -> np.ndarray:
    """Hz of all modes with the mechanism, or of the deck that it writes."""
    made = registry()["crack"].recipes(found, registry()["crack"])
    planes = [found.bars.plane[line.members[0]] for line in found.bars.lines]
    recipe = made[planes.index(plane)]
    values = np.array([depth, place])
    if extend:
        deck = recipe.extend(found.problem, values)
        return np.sqrt(reduced(deck, deck.prior.mean).eigenvalues) / (2 * np.pi)
    return np.sqrt(Model(found, (recipe,)).point(np.append(found.z, recipe.coordinates(values))).eigenvalues) / (
        2 * np.pi
    )


def truth(place: float, supports: str, axial: bool, n: int = N, depth: float = DEPTH) -> np.ndarray:
    """Hz of Hermite elements with a node at the crack, across which its compliance stands."""
    return modes(place, supports, axial, n, depth)[0]


def modes(place: float, supports: str, axial: bool, n: int = N, depth: float = DEPTH) -> tuple[np.ndarray, np.ndarray]:
    """The same, and the motion TX, TY, RZ (nodes, 3, modes)."""
    held = {CLAMPED: [["TX", "TY", "RZ"]] * 2, SIMPLE: [["TX", "TY"], ["TY"]], CANTILEVER: [["TX", "TY", "RZ"], []]}
    inputs = {
        "L": L, "elements": n, "height": H, "A": 0.02 * H, "I": 0.02 * H**3 / 12, "E": 2.1e11, "density": 7850.0,
        "place": place, "depth": depth, "axial": axial, "held": held[supports], "heavy": 0,
    }  # fmt: skip
    return cracks.modes(inputs)


@pytest.mark.parametrize("supports", [CLAMPED, SIMPLE, CANTILEVER])
@pytest.mark.parametrize("axial", [True, False])
@pytest.mark.parametrize("place", [0.3125 * L, 0.3 * L, (0.3 + 1e-6) * L, (0.3 - 1e-6) * L])
def test_mechanism_at_and_near_nodes(supports, axial, place):
    """Without the kink in its inertia 3 % of what it does is lost at nodes; clamped ends resist the opening along the bar."""
    found = model(supports=supports, plane="plane: XY" if axial else BENDING)
    near = round(place / L * N) * L / N if abs(place / L * N - round(place / L * N)) < 1e-3 else place
    expected = truth(near, supports, axial)[:5]
    assert cracked(found, place)[:5] == pytest.approx(expected, rel=1e-4)
    assert cracked(found, place, extend=True)[:5] == pytest.approx(expected, rel=5e-4)


@pytest.mark.parametrize("place", [0.11 * L, 0.303 * L])
@pytest.mark.parametrize("n", [68, 100, 160])
def test_a_crack_in_few_coordinates_does_what_it_does_in_all(n, place):
    """More than 200 degrees of freedom: nine tenths of what a crack does are not in modes, however short the elements."""
    found = model(supports=CLAMPED.replace("41", str(n + 1)), n=n)
    assert found.r < 3 * n - 3
    sound, expected = np.sqrt(found.eigenvalues[:4]) / (2 * np.pi), truth(place, CLAMPED, True)[:4]
    assert cracked(found, place)[:4] - expected == pytest.approx(np.zeros(4), abs=0.02 * (sound - expected).max())


@pytest.mark.parametrize("supports", [CLAMPED, SIMPLE])
@pytest.mark.parametrize("axial", [True, False])
@pytest.mark.parametrize("n", [10, 60])
def test_element_and_mechanism_are_one_physics(supports, axial, n):
    """A crack at the middle of an element, long or as short as the height: the same frequencies."""
    at, supports = n // 2 - 1, supports.replace("41", str(n + 1))
    crack = f"{{id: {at}, type: cracked_beam, nodes: [{at}, {at + 1}], material: steel, section: bar, depth: {DEPTH}}}"
    elements = "\n".join(
        [
            f"      - {{id: 1-{at - 1}, type: beam, nodes: 1-{at}, material: steel, section: bar}}",
            f"      - {crack}",
            f"      - {{id: {at + 1}-{n}, type: beam, nodes: {at + 1}-{n + 1}, material: steel, section: bar}}",
        ]
    )
    plane = "plane: XY" if axial else BENDING
    by_element = np.sqrt(model(elements, supports, plane, n).eigenvalues) / (2 * np.pi)
    by_mechanism = cracked(model(supports=supports, plane=plane, n=n), (at - 0.5) * L / n)
    assert by_element[:5] == pytest.approx(by_mechanism[:5], rel=1e-8)
    if n == 10:
        return
    own = truth((at - 0.5) * L / n, supports.replace(str(n + 1), "41"), axial, n)
    assert by_element[:5] == pytest.approx(own[:5], rel=5e-5)


@pytest.mark.parametrize("plane", [0, 1])
def test_either_plane_of_a_bar_in_space(plane):
    """The crack opens under the bending of its own plane alone, in which the height is that of the section."""
    found = model(supports=CLAMPED.replace("41", "31"), plane="", height=0.03, n=30)
    sound = np.sqrt(found.eigenvalues) / (2 * np.pi)
    hz = cracked(found, 0.3 * L, plane)
    width, height = (0.02, 0.03) if plane == 0 else (0.03, 0.02)
    inputs = {
        "L": L, "elements": 30, "height": height, "A": 0.0006, "I": width * height**3 / 12, "E": 2.1e11, "density": 7850.0,
        "place": 0.3 * L, "depth": DEPTH, "axial": True, "held": [["TX", "TY", "RZ"]] * 2, "heavy": 0,
    }  # fmt: skip
    for expected in cracks.modes(inputs)[0][:3]:
        assert np.abs(hz / expected - 1).min() < 3e-4
    for still in cracks.modes(inputs | {"I": height * width**3 / 12, "height": width}, crack=False)[0][:3]:
        assert np.abs(sound / still - 1).min() < 1e-4 and np.abs(hz / still - 1).min() < 1e-4


def hinged(n: int, ends: str = "2: [RZ]"):
    """The clamped bar, the last of whose elements is hinged to its support."""
    rest = SOUND.format(n - 1, n, "")
    last = (
        f"      - {{id: {n}, type: beam, nodes: [{n}, {n + 1}], material: steel, section: bar, releases: {{{ends}}}}}"
    )
    return model(f"{rest}\n{last}", supports=f"1: all, {n + 1}: all", n=n)


@pytest.mark.parametrize("share", [0.25, 0.6])
def test_an_element_with_a_hinge_may_be_cracked(share):
    """Its moment is none at the hinge, on which side of the crack that ever is."""
    n, found = 6, hinged(6)
    place = (n - 1 + share) / n * L
    inputs = {
        "L": L, "elements": N, "height": H, "A": 0.02 * H, "I": 0.02 * H**3 / 12, "E": 2.1e11, "density": 7850.0,
        "place": place, "depth": DEPTH, "axial": True, "held": [["TX", "TY", "RZ"], ["TX", "TY"]], "heavy": 0,
    }  # fmt: skip
    expected = (cracks.modes(inputs)[0] / cracks.modes(inputs, crack=False)[0])[:2] - 1
    sound = np.sqrt(found.eigenvalues[:2]) / (2 * np.pi)
    assert cracked(found, place)[:2] / sound - 1 == pytest.approx(expected, rel=0.03)
    assert cracked(found, place, extend=True)[:2] / sound - 1 == pytest.approx(expected, rel=0.03)


def test_what_no_bending_reaches_is_not_cracked():
    assert set(hinged(7).bars.ids) - set(hinged(7, "1: [RZ], 2: [RZ]").bars.ids) == {7}


def test_halves_of_an_element_have_the_releases_of_its_ends():
    found = hinged(6, "1: [RZ], 2: [RY]").problem
    edit = Edit(found)
    node = edit.split(edit.element(6), 0.4)
    releases = {tuple(each.nodes[-1].tolist()): each.options.get("releases") for each in edit.sets}
    assert releases[5, node] == {1: ["RZ"]} and releases[node, 6] == {2: ["RY"]}
    assert edit.done().structure.n == found.structure.n + 3


def test_an_axial_mode_that_a_crack_makes_visible_is_none_of_its_own():
    """The bar has it as it is, where sensors across it see nothing; the test lists modes that bend, which is some evidence."""
    sound = np.sqrt(model().eigenvalues[:6]) / (2 * np.pi)
    bends = np.abs(sound / (np.sqrt(2.1e11 / 7850) / (4 * L)) - 1) > 1e-3
    assert not bends[:5].all(), "c/4L lies within the band of five modes that bend"
    hz, moved = modes(0.35 * L, SIMPLE, True)
    hz, moved = hz[:6][bends], moved[[4, 11, 18, 25, 32], 1, :6][:, bends]
    listed = lambda values: "[" + ", ".join(f"{v:.6g}" for v in values) + "]"
    test = f"number: [1, 2, 3, 4, 5], frequency: {listed(hz)}, frequency_sd: 0.1 %, shape_sd: 1 %, "
    rows = ", ".join(listed(row) for row in moved / np.abs(moved).max(axis=0))
    seen = model(test=test + f"dofs: [5TY, 12TY, 19TY, 26TY, 33TY], shapes: [{rows}]")
    recipe = registry()["crack"].recipes(seen, registry()["crack"])[0]
    one = fit(Model(seen, (recipe,)), recipe.coordinates(np.array([DEPTH, 0.35 * L])), most=0)
    assert unseen(one) > 1.0 and unmeasured_hz(one) == ()


def test_a_crack_is_found_where_few_coordinates_mistake_its_depth():
    """Off the axis it moves the bar along itself, which the lowest coordinates lack: they end at the largest depth there is, where
    all coordinates misfit more than without a crack.
    """
    *_, case = cracks.cases("development", 98211, 12)
    test = measured(case, case.make(case.inputs), CONFIGS["A"], ("A", "", 98211, 0))
    problem = assemble(yaml_deck.read(as_text("crack", case, test, CONFIGS["A"]), "crack.yaml"))
    reach = 270  # what a splice at the same place leaves, and what matters beside it
    one = best(Study(again(problem)), "crack", reach=reach)
    depth, place = one.recipes[0].values(one.c)
    assert one.misfit < 2 * one.dof
    assert abs(depth - case.inputs["depth"]) < 0.01 and abs(place - case.inputs["place"]) < 0.005 * case.span

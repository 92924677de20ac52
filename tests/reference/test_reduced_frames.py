"""Members and braces of frames that are reduced, beside OpenSees; tapers stop at joints; other diagonals are other sites."""

import numpy as np
import pytest

from benchmarks.blind.case import generator
from benchmarks.blind.space import frames, opensees
from benchmarks.trials import frame as plane
from benchmarks.trials import library
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import WHOLE
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.diagnosis.mechanisms.taper import CANDIDATE as TAPER
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.site import gap

TEST = "test:\n  modes: {{number: [1, 2, 3], frequency: [{0}, {1}, {2}], frequency_sd: 0.2 %}}\n"


def of(text: str):
    problem = assemble(yaml_deck.read(text, "deck.yaml"))
    return reduced(problem, problem.prior.mean)


@pytest.fixture(scope="module")
def frame():
    """A frame above the size that is kept whole, its model, what OpenSees needs of it, and its frequencies."""
    pytest.importorskip("openseespy")
    rng = generator("test", "reduced frame", 1)
    found = next(one for one in iter(lambda: frames.drawn(rng), None) if 6 * (len(one.points) - len(one.feet)) > WHOLE)
    inputs = found.inputs(rng) | {"E": frames.E, "density": frames.DENSITY}
    sound = opensees.modes(inputs, 8)[0]
    model = of("mouse: 1\n" + frames.deck(found) + TEST.format(*sound[:3]))
    assert model.r < WHOLE < len(model.V)
    return found, model, inputs, sound


def ratios(model, key: str, says: str, values) -> np.ndarray:
    """The lowest eight frequencies with candidate `key` at the site whose text is `says`, over those without it."""
    recipe = next(
        each for each in registry()[key].recipes(model, registry()[key]) if each.site(each.grid[0]).text == says
    )
    at = Model(model, (recipe,)).point(np.append(model.z, recipe.coordinates(np.array(values, float))))
    return np.sqrt(at.eigenvalues[:8] / model.eigenvalues[:8])


@pytest.mark.parametrize("left", [0.6, 0.1])
def test_softer_members_of_a_reduced_frame_beside_opensees(frame, left):
    """Of few coordinates none is what a single member does; without what they leave out it moves a third too little."""
    found, model, inputs, sound = frame
    for member in (0, len(found.feet) + 2, len(found.members) - 1):
        true = opensees.modes(inputs | {"factors": {str(member): [left, 1.0]}}, 8)[0] / sound
        said = ratios(model, "member", f"element {member + 1}, its stiffness alone", [1 - left])
        assert said == pytest.approx(true, abs=0.05 * np.abs(true - 1).max() + 2e-5)


@pytest.mark.parametrize(("begin", "section"), [("the columns between", 0), ("the beams at", 1)])
def test_softer_members_of_a_storey_beside_opensees(frame, begin, section):
    """With their mass, as by corrosion; none is in two storeys. Of the modes up to two beyond the measured ones."""
    found, model, inputs, sound = frame
    recipes = registry()["member"].recipes(model, registry()["member"])
    sites = [site for each in recipes if (site := each.site(each.grid[0])).text.startswith(begin)]
    alone = ", its stiffness alone"
    storeys = {site.ids: site.text.removesuffix(alone) for site in sites if site.text.endswith(alone)}
    numbers = [n for n, s in enumerate(found.section) if s == section]
    assert sorted(number - 1 for ids in storeys for number in ids) == numbers
    for ids, text in list(storeys.items())[:2]:
        factors = {str(number - 1): [0.6, 0.6] for number in ids}
        true = opensees.modes(inputs | {"factors": factors}, 8)[0] / sound
        said = ratios(model, "member", f"{text}, its mass alike", [0.4])
        assert said[:5] == pytest.approx(true[:5], abs=0.05 * np.abs(true - 1).max() + 2e-5)


def test_a_stiffer_row_of_a_reduced_frame_beside_opensees(frame):
    _, model, inputs, sound = frame
    recipes = registry()["stiffness-gain"].recipes(model, registry()["stiffness-gain"])
    site = next(s for s in (each.site(each.grid[0]) for each in recipes) if s.text.startswith("the row of"))
    factors = {str(number - 1): [2.5, 1.0] for number in site.ids}
    true = opensees.modes(inputs | {"factors": factors}, 8)[0] / sound
    assert ratios(model, "stiffness-gain", site.text, [1.5]) == pytest.approx(true, abs=0.05 * np.abs(true - 1).max())


def test_a_stiff_brace_of_a_reduced_frame_beside_opensees(frame):
    found, model, inputs, sound = frame
    for recipe in registry()["brace"].recipes(model, registry()["brace"])[:20:5]:
        site, k = recipe.site(recipe.grid[0]), 2e8
        one, other = (number - 1 for number in site.ids)
        EA = k * float(np.linalg.norm(found.points[other] - found.points[one]))
        true = opensees.modes(inputs | {"struts": [[one, other, EA]]}, 8)[0] / sound
        assert ratios(model, "brace", site.text, [k]) == pytest.approx(true, abs=0.03 * np.abs(true - 1).max() + 1e-4)


@pytest.mark.parametrize("share", [0.05, 0.2])
def test_masses_on_arms_of_a_reduced_frame_beside_opensees(frame, share):
    """Moments turn a node by a flexibility that few coordinates do not hold: without it frequencies were up to 15 % too high."""
    found, model, inputs, sound = frame
    kg, arm = share * float(found.kg.sum()), [1.2, -1.6, 0.0]
    recipes = registry()["eccentric-mass"].recipes(model, registry()["eccentric-mass"])
    for recipe in recipes[:: len(recipes) // 4]:
        site = recipe.site(recipe.grid[0])
        true = opensees.modes(inputs | {"masses": [[site.ids[0] - 1, arm, kg]]}, 8)[0] / sound
        said = ratios(model, "eccentric-mass", site.text, [kg, *arm])
        assert said == pytest.approx(true, abs=0.02 * np.abs(true - 1).max() + 2e-5)


def test_a_point_mass_off_its_node_of_a_reduced_frame_beside_opensees(frame):
    found, model, inputs, sound = frame
    arm = [1.5, 1.0, 0.0]
    recipes = registry()["item-offset"].recipes(model, registry()["item-offset"])
    for recipe in [each for each in recipes if len(each.site(each.grid[0]).ids) == 1][:3]:
        site = recipe.site(recipe.grid[0])
        node = int(np.flatnonzero((found.points == site.position).all(axis=1))[0])
        kg = [0.0 if i == node else m for i, m in enumerate(inputs["kg"])]
        moved = inputs | {"kg": kg, "masses": [[node, arm, inputs["kg"][node]]]}
        true = opensees.modes(moved, 8)[0] / sound
        said = ratios(model, "item-offset", site.text, arm)
        assert said == pytest.approx(true, abs=0.02 * np.abs(true - 1).max() + 2e-5)


def test_a_taper_stops_at_joints():
    """A column of eight bars with a beam on its fifth node: two members of four bars."""
    bar = "type: beam, E: 2.1e+11, nu: 0.3, density: 7850, A: 0.01, Iz: 1.0e-5"
    column = ", ".join(f"{n}: [0, {(n - 1) / 2}]" for n in range(1, 10))
    text = f"""\
mouse: 1
model:
  structure:
    nodes: {{{column}%s}}
    elements:
      - {{id: 1-8, nodes: 1-9, {bar}}}
%s
    supports: {{1: all%s}}
    plane: XY
""" + TEST.format(10, 20, 60).replace("%", "%%")
    tapers = lambda deck: [recipe.site(recipe.grid[0]).ids for recipe in TAPER.recipes(of(deck), TAPER)]
    beam = f"      - {{id: 9, nodes: [5, 10], {bar}}}"
    assert sorted(tapers(text % (", 10: [3, 2]", beam, ", 10: all"))) == [(1, 2, 3, 4), (5, 6, 7, 8)]
    assert tapers(text % ("", "", "")) == [tuple(range(1, 9))]


def test_diagonals_that_cross_are_two_sites():
    middle = (1.0, 1.0, 0.0)
    one, other = (Site("node", ids, middle) for ids in ((1, 4), (2, 3)))
    assert gap(one, one) == 0 and gap(one, other) == np.inf
    assert gap(Site("node", (1,), middle), Site("element", (7,), middle)) == 0


def test_shear_of_a_reduced_frame_of_thick_members():
    """No combination of the lowest modes of slender members slips in shear: frequencies fell by 40 % of what they should."""
    rngs = (np.random.default_rng(seed) for seed in range(100))
    blank = next(one for one in (plane.frame(rng, 2, thick=True) for rng in rngs) if len(one.nodes) > WHOLE / 3)
    thick = blank.truth.modes(3)[0]
    library.slender(blank)
    slender = blank.truth.modes(3)[0]
    model = of(f"mouse: 1\n{blank.model}{TEST.format(*thick)}")
    assert model.r < WHOLE < len(model.V)
    said = ratios(model, "timoshenko", "the whole structure", [2.6 / (5 / 6)])[:3]
    assert said == pytest.approx(thick / slender, abs=0.02 * np.abs(thick / slender - 1).max())

"""Crossed diagonals in a panel and semi-rigid connections of a frame, against closed forms; and where a joint of a deck is."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.linalg import eigh

from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.arrays import dense
from mouse_cli.terms.assembly import assembly

H, W, EIC, EIB, KG = 3.0, 5.0, 2e7, 3e7, 1e4  # m, N m^2, kg
PORTAL = f"""\
mouse: 1
model:
  structure:
    nodes: {{1: [0, 0], 2: [0, {H}], 3: [{W}, {H}], 4: [{W}, 0], 5: [0, {H / 2}], 6: [{W / 3}, {H}]}}
    elements:
      - {{id: 1-2, type: beam, nodes: [1, 5, 2], E: 1, G: 1, density: 1.0e-15, A: 1.0e+13, Iz: {EIC}, Iy: 1, J: 1}}
      - {{id: 3, type: beam, nodes: [4, 3], E: 1, G: 1, density: 1.0e-15, A: 1.0e+13, Iz: {EIC}, Iy: 1, J: 1}}
      - {{id: 4-5, type: beam, nodes: [2, 6, 3], E: 1, G: 1, density: 1.0e-15, A: 1.0e+13, Iz: {EIB}, Iy: 1, J: 1}}
      - {{id: 11-12, type: mass, nodes: [2, 3], mass: {KG}}}
    supports: {{1: all, 4: all}}
    plane: XY
test:
  modes: {{number: [1], frequency: [1], frequency_sd: 1 %}}
"""
BAYS = """\
mouse: 1
model:
  structure:
    nodes:
      - {1: [0, 0], 2: [0, 3], 3: [4, 0], 4: [4, 3], 5: [10, 0], 6: [10, 3], 7: [0, 5], 8: [4, 6], 9: [10, 5.5]}
      - {line: {from: 11, to: 13, start: [1, 3], end: [3, 3]}}
      - {line: {from: 21, to: 23, start: [5.5, 3], end: [8.5, 3]}}
    materials: {steel: {E: 2.1e+11, nu: 0.3, density: 7850}}
    sections: {bar: {rectangle: [0.2, 0.3]}}
    elements:
      - {id: 1-6, type: beam, nodes: [[1, 2], [3, 4], [5, 6], [2, 7], [4, 8], [6, 9]], material: steel, section: bar}
      - {id: 11-14, type: beam, nodes: [2, 11-13, 4], material: steel, section: bar}
      - {id: 21-24, type: beam, nodes: [4, 21-23, 6], material: steel, section: bar}
    supports: {1: all, 3: all, 5: all}
    plane: XY
test:
  modes: {number: [1, 2, 3], frequency: [4, 20, 30], frequency_sd: 1 %}
"""


def model(text: str):
    problem = assemble(yaml_deck.read(text, "deck.yaml"))
    return reduced(problem, problem.prior.mean)


def recipes(found, key: str, says: str = "") -> list:
    """Those of candidate `key` at sites that `says` so."""
    own = registry()[key].recipes(found, registry()[key])
    return [each for each in own if says in each.site(each.grid[0]).text]


def eigenvalues(found, recipe, values) -> np.ndarray:
    """Of the reduced model with the candidate."""
    x = np.append(found.z, recipe.coordinates(np.array(values, float)))
    return Model(found, (recipe,)).point(x).eigenvalues


def of_deck(found, recipe, values) -> np.ndarray:
    """The same of the deck that it writes, of all its degrees of freedom."""
    deck = recipe.extend(found.problem, np.array(values, float))
    return eigh(*(dense(part) for part in assembly(deck).matrices(deck.prior.mean)), eigvals_only=True)


def test_crossed_diagonals_of_a_panel_are_two_braces_against_its_sway():
    found, k = model(PORTAL), 3e6
    (recipe,) = recipes(found, "brace", "crossed")
    frame = 2 * 12 * EIC / H**3 * (6 * EIB / W + EIC / H) / (6 * EIB / W + 4 * EIC / H)
    expected = (frame + 2 * k * W**2 / (W**2 + H**2)) / (2 * KG)
    assert recipe.site(np.array([k])).ids == (1, 3, 2, 4)
    assert eigenvalues(found, recipe, [k])[0] == pytest.approx(expected, rel=1e-4)
    assert of_deck(found, recipe, [k])[0] == pytest.approx(expected, rel=1e-4)


def test_sites_of_one_brace_and_of_two_share_the_prior():
    for text, crossed in ((PORTAL, 1), (BAYS, 2)):
        own = recipes(model(text), "brace")
        assert sum("crossed" in each.site(each.grid[0]).text for each in own) == crossed
        assert sum(np.exp(each.log_prior) for each in own) == pytest.approx(1)


@pytest.mark.parametrize("k", [1e5, 1e6, 1e7, 1e8, 1e9])
def test_semi_rigid_joints_of_a_portal_by_slope_deflection(k):
    """A beam in antisymmetric bending with springs at its ends resists their turning by 1 / (W / (6 EI) + 1 / k)."""
    found = model(PORTAL)
    (recipe,) = recipes(found, "semi-rigid")
    restraint, column = 1 / (W / (6 * EIB) + 1 / k), EIC / H
    sway = 2 * 12 * EIC / H**3 * (restraint + column) / (restraint + 4 * column)
    assert eigenvalues(found, recipe, [k])[0] == pytest.approx(sway / (2 * KG), rel=1e-4)
    assert of_deck(found, recipe, [k])[0] == pytest.approx(sway / (2 * KG), rel=1e-4)
    assert len(recipe.extend(found.problem, np.array([k])).parameters) == len(found.problem.parameters) + 1


def test_semi_rigid_joints_of_beams_that_pass_a_column_are_two():
    """Left and right of a column each beam turns by itself, in the deck too."""
    found, k = model(BAYS), 3e6
    (recipe,) = recipes(found, "semi-rigid")
    assert "4 ends of bars at nodes 2, 4, 6" in recipe.site(np.array([k])).text
    assert of_deck(found, recipe, [k])[:4] == pytest.approx(eigenvalues(found, recipe, [k])[:4], rel=1e-3)


def test_a_joint_may_be_a_hinge():
    """At the lower end of its range it is one: the far end of the beam resists turning by 3 EI / W, the near column is free."""
    found = model(PORTAL)
    (recipe,) = recipes(found, "joint", "element 4 at node 2") or recipes(found, "joint", "element 2 at node 2")
    restraint, column = 3 * EIB / W, EIC / H
    sway = EIC / H**3 * (3 + 12 * (restraint + column) / (restraint + 4 * column))
    lower = np.exp(recipe.bounds[0, 0])
    assert eigenvalues(found, recipe, [lower])[0] == pytest.approx(sway / (2 * KG), rel=5e-3)


def test_a_frame_that_stands_on_nothing_has_no_columns():
    assert recipes(model(BAYS.replace("    supports: {1: all, 3: all, 5: all}\n", "")), "semi-rigid") == []


LEGS = np.array([[0, 0, 0], [4.0, 0, 0], [4.0, 3.0, 0], [4.0, 3.0, 2.0]])  # m
TUBE = {"E": 2.1e11, "G": 8e10, "A": 4e-3, "Iy": 6e-6, "Iz": 6e-6, "J": 1.2e-5}
RUN = f"""\
mouse: 1
model:
  structure:
    nodes: {{{", ".join(f"{n}: {at.tolist()}" for n, at in enumerate(LEGS, 1))}}}
    elements:
      - {{id: 1-3, type: beam, nodes: 1-4, density: 10, {", ".join(f"{name}: {v}" for name, v in TUBE.items())}}}
      - {{id: 11, type: mass, nodes: 4, mass: {KG}}}
    supports: {{1: all}}
test:
  modes: {{number: [1], frequency: [1], frequency_sd: 1 %}}
"""


@pytest.mark.parametrize("k", [1e5, 1e6, 1e8])
def test_elbows_of_a_pipe_in_space_by_unit_loads(k):
    """Moments M of forces at the tip turn each bar about the axes across it, by M / k at either side of a corner."""
    crossed = lambda r: np.array([[0, r[2], -r[1]], [-r[2], 0, r[0]], [r[1], -r[0], 0]]).T  # r x P
    flexibility = np.zeros((3, 3))
    points, weights = np.polynomial.legendre.leggauss(3)
    for start, end in pairwise(LEGS):
        length = np.linalg.norm(end - start)
        along = np.outer(end - start, end - start) / length**2
        flexibility += length * along / (TUBE["E"] * TUBE["A"])
        bent = (np.eye(3) - along) / (TUBE["E"] * TUBE["Iz"]) + along / (TUBE["G"] * TUBE["J"])
        for x, w in zip(points, weights, strict=True):
            r = crossed(LEGS[-1] - start - (1 + x) / 2 * (end - start))
            flexibility += w / 2 * length * r.T @ bent @ r
        for corner in (start, end):
            if 0 < np.abs(LEGS - corner).sum(axis=1).argmin() < 3:
                r = crossed(LEGS[-1] - corner)
                flexibility += r.T @ (np.eye(3) - along) @ r / k
    found = model(RUN)
    (recipe,) = recipes(found, "semi-rigid", "corners of two bars")
    assert "8 ends of bars at nodes 2, 3" in recipe.site(np.array([k])).text
    expected = 1 / (KG * np.sort(np.linalg.eigvalsh(flexibility))[::-1])
    assert eigenvalues(found, recipe, [k])[:3] == pytest.approx(expected, rel=2e-4)
    deck = recipe.extend(found.problem, np.array([k]))
    assert reduced(deck, deck.prior.mean).eigenvalues[:3] == pytest.approx(expected, rel=2e-4)
    assert len(deck.parameters) == len(found.problem.parameters) + 1


@pytest.mark.parametrize("text", [PORTAL, BAYS])
def test_a_frame_held_in_its_plane_by_supports_is_one_of_that_plane(text):
    """Nodes that are held across the plane alone stand on no ground: same places of braces, panels, connections and joints."""
    numbers = {int(n) for n in assemble(yaml_deck.read(text, "deck.yaml")).mesh.node_ids}
    feet = {1, 4} if text is PORTAL else {1, 3, 5}
    held = "".join(f", {n}: [TZ, RX, RY]" for n in sorted(numbers - feet))
    supports = f"{{{', '.join(f'{n}: all' for n in sorted(feet))}"
    inside = text.replace(f"{supports}}}", f"{supports}{held}}}").replace("    plane: XY\n", "")
    assert "plane" not in inside and held in inside
    for key in ("brace", "semi-rigid", "joint"):
        places = [[each.site(each.grid[0]).text for each in recipes(model(own), key)] for own in (text, inside)]
        assert sorted(places[0]) == sorted(places[1]) and places[0]


def test_rigid_floors_that_only_sway_have_panels_between_them_alone():
    """Three columns and two floors that supports keep level: storeys are braced between neighbouring floors, and quickly found."""
    nodes = {3 * level + i + 1: [5.0 * i, 3.0 * level] for level in range(3) for i in range(3)}
    columns = [[n, n + 3] for n in range(1, 7)]
    links = [{"independent": 3 * level + 1, "dependent": [3 * level + 2, 3 * level + 3]} for level in (1, 2)]
    text = f"""\
mouse: 1
model:
  structure:
    nodes: {nodes}
    elements:
      - {{id: 1-6, type: beam, nodes: {columns}, E: 2.1e+11, A: 0.01, Iz: 1.0e-4, Iy: 1.0e-4, J: 1.0e-4, density: 7850}}
    rigid_links: {str(links).replace("'", "")}
    supports: {{1-3: all, 4: [TY, RZ], 7: [TY, RZ]}}
    plane: XY
test:
  modes: {{number: [1, 2], frequency: [4, 20], frequency_sd: 1 %}}
"""
    found = [each.site(each.grid[0]) for each in recipes(model(text), "brace", "crossed")]
    assert {frozenset(site.ids) for site in found} >= {frozenset((1, 5, 2, 4)), frozenset((4, 8, 5, 7))}
    rise = lambda site: max(nodes[n][1] for n in site.ids) - min(nodes[n][1] for n in site.ids)
    assert all(rise(site) <= 3.0 for site in found)

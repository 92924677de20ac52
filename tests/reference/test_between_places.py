"""Springs between two places and masses off their nodes, against closed forms; and the first look at pairs of places."""

from dataclasses import replace
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.linalg import eigh

from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.localise.force import scores
from mouse_cli.diagnosis.localise.ties import ties
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.diagnosis.search.starts import leading
from mouse_cli.diagnosis.sites import pairs as looked
from mouse_cli.diagnosis.sites.ends import ends
from mouse_cli.diagnosis.sites.knees import knees
from mouse_cli.diagnosis.sites.pairs import MOST, pairs
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.arrays import dense
from mouse_cli.model.site import Site
from mouse_cli.terms.assembly import assembly

H, W, EI, KG = 3.0, 4.0, 2.0, 5.0
PORTAL = f"""\
mouse: 1
model:
  structure:
    nodes: {{1: [0, 0], 2: [0, {H}], 3: [{W}, {H}], 4: [{W}, 0]}}
    elements:
      - {{id: 1, type: beam, nodes: [1, 2], E: 1, G: 1, density: 1.0e-13, A: 1.0e+6, Iz: {EI}, Iy: 1, J: 1}}
      - {{id: 2, type: beam, nodes: [3, 4], E: 1, G: 1, density: 1.0e-13, A: 1.0e+6, Iz: {EI}, Iy: 1, J: 1}}
      - {{id: 3, type: beam, nodes: [2, 3], E: 1, G: 1, density: 1.0e-13, A: 1.0e+6, Iz: 1.0e+6, Iy: 1, J: 1}}
      - {{id: 4, type: mass, nodes: [2], mass: {KG}}}
    supports: {{1: all, 4: all}}
    plane: XY
test:
  modes: {{number: [1], frequency: [1], frequency_sd: 1 %}}
"""
TIP = f"""\
mouse: 1
model:
  structure:
    nodes: {{line: {{from: 1, to: 5, start: [0, 0], end: [{H}, 0]}}}}
    elements:
      - {{id: 1-4, type: beam, nodes: 1-5, E: 1, G: 1, density: 1.0e-13, A: 1.0e+6, Iz: {EI}, Iy: 1, J: 1}}
      - {{id: 9, type: mass, nodes: [5], mass: %s}}
    supports: {{1: all}}
    plane: XY
test:
  modes: {{number: [1], frequency: [1], frequency_sd: 1 %%}}
"""


def model(text: str):
    problem = assemble(yaml_deck.read(text, "deck.yaml"))
    return reduced(problem, problem.prior.mean)


def recipe_of(found, key: str, says: str = ""):
    """Candidate `key` at the site that `says` so."""
    own = (each for each in registry()[key].recipes(found, registry()[key]))
    return next(each for each in own if says in each.site(each.grid[0]).text)


def lowest(found, key: str, values, says: str = "") -> float:
    """The lowest eigenvalue with candidate `key` at the site that `says` so."""
    recipe = recipe_of(found, key, says)
    x = np.append(found.z, recipe.coordinates(np.array(values, float)))
    return float(Model(found, (recipe,)).point(x).eigenvalues[0])


@pytest.mark.parametrize("says", ["nodes 1 and 3", "nodes 2 and 4"])
def test_a_brace_adds_the_square_of_its_slope_to_the_stiffness_against_sway(says):
    k, cosine = 0.7, W / np.hypot(W, H)
    expected = (24 * EI / H**3 + k * cosine**2) / KG
    assert lowest(model(PORTAL), "brace", [k], says) == pytest.approx(expected, rel=1e-4)


TOWERS = f"""\
mouse: 1
model:
  structure:
    nodes: {{1: [0, 0], 2: [0, {H}], 3: [0, {2 * H}], 4: [0, {3 * H}], 11: [{W}, 0], 12: [{W}, {H}], 13: [{W}, {2 * H}]}}
    elements:
      - {{type: beam, nodes: 1-4, E: 1, G: 1, density: 1.0e-9, A: 1.0e+4, Iz: {EI}, Iy: 1, J: 1}}
      - {{type: beam, nodes: 11-13, E: 1, G: 1, density: 1.0e-9, A: 1.0e+4, Iz: {EI}, Iy: 1, J: 1}}
      - {{type: mass, nodes: [3, 12], mass: {KG}}}
    supports: {{1: all, 11: all}}
    plane: XY
test:
  modes: {{number: [1, 2], frequency: [1, 2], frequency_sd: 1 %}}
"""


def test_a_link_joins_two_towers_at_floors_between_their_ends():
    """Two masses on cantilevers, 3 EI / h^3 each, and a link: no member ends at either floor."""
    k, one, other = 0.7, 3 * EI / (2 * H) ** 3, 3 * EI / H**3
    K = np.diag([one, other]) + k * W**2 / (W**2 + H**2) * np.array([[1, -1], [-1, 1]])
    expected = eigh(K, KG * np.eye(2), eigvals_only=True)[0]
    assert lowest(model(TOWERS), "brace", [k], "nodes 3 and 12") == pytest.approx(expected, rel=1e-3)


def test_a_share_of_a_mass_on_a_spring_is_taken_out_of_what_is_fixed():
    """Liquid that sloshes at the tip of a light cantilever, 3 EI / l^3: two masses on two springs."""
    share, hz, tip = 0.3, 0.02, 3 * EI / H**3
    k = share * KG * (2 * np.pi * hz) ** 2
    expected = eigh([[tip + k, -k], [-k, k]], np.diag([(1 - share) * KG, share * KG]), eigvals_only=True)[0]
    assert lowest(model(TIP % KG), "sprung-mass", [share, hz], "TY") == pytest.approx(expected, rel=1e-4)


def test_liquid_sloshes_along_both_axes_of_a_tank():
    """Along and across a light cantilever, EA / l and 3 EI / l^3: two masses on two springs in each."""
    share, hz = 0.3, 0.02
    k, masses = share * KG * (2 * np.pi * hz) ** 2, np.diag([(1 - share) * KG, share * KG])
    found = model((TIP % KG).replace("A: 1.0e+6", "A: 0.01"))
    recipe = recipe_of(found, "sprung-mass", "TX and TY alike")
    at = Model(found, (recipe,)).point(np.append(found.z, recipe.coordinates(np.array([share, hz]))))
    expected = [eigh([[tip + k, -k], [-k, k]], masses, eigvals_only=True) for tip in (0.01 / H, 3 * EI / H**3)]
    assert at.eigenvalues[:4] == pytest.approx(np.sort(np.concatenate(expected)), rel=1e-3)
    sites = [each.site(each.grid[0]).text for each in registry()["sprung-mass"].recipes(found, registry()["sprung-mass"])]
    assert sites == ["mass 9, TX", "mass 9, TY", "mass 9, TX and TY alike"]


def test_of_a_mass_that_is_hardly_a_body_all_may_be_on_a_spring():
    """A share of it would be too light to be sought, so that the search begins with the whole."""
    light = 1.2e-3 * KG
    text = (TIP % KG).replace("supports:", f"  - {{id: 10, type: mass, nodes: [3], mass: {light}}}\n    supports:")
    recipe = recipe_of(model(text), "sprung-mass", "mass 10, TY")
    share = recipe.unknowns[0]
    assert share.lower > 0.8 and len(recipe.grid) and (recipe.grid[:, 0] >= share.lower).all()


def test_mass_of_a_floor_sways_with_it():
    m = 0.3
    expected = 24 * EI / H**3 / (KG + m * W)
    assert lowest(model(PORTAL), "floor-mass", [m], "the floor at Y = 3 m") == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize(("key", "own"), [("eccentric-mass", 1e-9), ("item-offset", KG)])
@pytest.mark.parametrize("arm", [(0.8, 0.0), (-0.5, 0.0), (0.0, 0.6)])
def test_mass_beyond_the_tip_of_a_cantilever(key, own, arm):
    """Flexibility of the end of the arm: of the tip, its turning and the arm; across the arm it only turns."""
    along, across = arm
    deflection = np.array([H**3 / 3 + along * H**2 + along**2 * H, -across * (H**2 / 2 + along * H)]) / EI
    F = np.array([[deflection[0], deflection[1]], [deflection[1], across**2 * H / EI]])
    expected = 1 / (KG * np.linalg.eigvalsh(F)[-1])
    values = [*((KG,) if key == "eccentric-mass" else ()), *arm]
    assert lowest(model(TIP % own), key, values, "5" if key == "eccentric-mass" else "9") == pytest.approx(
        expected, rel=1e-3
    )


@pytest.mark.parametrize(("key", "own"), [("eccentric-mass", 1e-9), ("item-offset", KG)])
def test_in_a_model_of_bending_alone_an_arm_across_is_not_felt(key, own):
    """The end of an arm moves as the node that the deck gets for it: nothing moves along the beam."""
    along, heavy = 0.8, key == "eccentric-mass"
    found = model((TIP % own).replace("plane: XY", "directions: [TY, RZ]"))
    values = np.array([*((KG,) if heavy else ()), along])
    expected = EI / (H**3 / 3 + along * H**2 + along**2 * H) / KG
    recipe = recipe_of(found, key, "5" if heavy else "9")
    assert [each.name for each in recipe.unknowns][-1:] == ["arm along X"] and len(recipe.unknowns) == len(values)
    x = np.append(found.z, recipe.coordinates(values))
    assert Model(found, (recipe,)).point(x).eigenvalues[0] == pytest.approx(expected, rel=1e-3)
    deck = recipe.extend(found.problem, values)
    assert reduced(deck, deck.prior.mean).eigenvalues[0] == pytest.approx(expected, rel=1e-3)


def test_what_may_expand_has_no_force_and_what_is_held_has_all():
    bar = "type: beam, E: 3, G: 1, density: 1, A: 2, Iz: 1, Iy: 1, J: 1"
    text = f"""\
mouse: 1
model:
  structure:
    nodes: {{1: [0, 0], 2: [2, 0], 3: [5, 0], 4: [2, 1]}}
    elements:
      - {{id: 1-2, nodes: 1-3, {bar}}}
      - {{id: 3, nodes: [2, 4], {bar}}}
    supports: {{1: all, 3: all}}
    plane: XY
test:
  modes: {{number: [1], frequency: [1], frequency_sd: 1 %}}
"""
    found = model(text)
    recipe = registry()["thermal"].recipes(found, registry()["thermal"])[0]
    strain = float(recipe.values(recipe.bounds[:, 1])[0])
    deck = recipe.extend(found.problem, np.array([strain]))
    tension = np.concatenate([each.properties["preload"] for each in deck.mesh.elements])
    assert tension == pytest.approx([-6 * strain, -6 * strain, 0.0], abs=1e-12)


@pytest.mark.parametrize(
    "link", ["", "    rigid_links: [{independent: 1, dependent: 3}]\n"], ids=["bars alone", "held by a link"]
)
def test_what_nothing_holds_expands_freely(link):
    """A free square of bars, warmer by some degrees, is larger and without any force; so is one with a rigid diagonal."""
    bar = "type: beam, E: 3, G: 1, density: 1, A: 2, Iz: 1, Iy: 1, J: 1"
    text = f"""\
mouse: 1
model:
  structure:
    nodes: {{1: [0, 0], 2: [2, 0], 3: [2, 2], 4: [0, 2]}}
    elements:
      - {{id: 1-3, nodes: 1-4, {bar}}}
      - {{id: 4, nodes: [4, 1], {bar}}}
    plane: XY
{link}test:
  modes: {{number: [4], frequency: [1], frequency_sd: 1 %}}
"""
    assert registry()["thermal"].recipes(model(text), registry()["thermal"]) == []


TOWER = (2, 2, 4)  # columns by columns, floors


def tower() -> str:
    """A tower of four columns."""
    place = {at: n for n, at in enumerate(np.ndindex(TOWER[2], TOWER[1], TOWER[0]), 1)}
    nodes = ", ".join(f"{n}: [{4 * i}, {5 * j}, {3 * k}]" for (k, j, i), n in place.items())
    bars = [
        (n, place[other])
        for (k, j, i), n in place.items()
        for other in ((k + 1, j, i), (k, j + 1, i), (k, j, i + 1))
        if other in place and (k > 0 or other[0] > 0)
    ]
    beams = "\n".join(
        f"      - {{id: {e}, type: beam, nodes: [{a}, {b}], material: steel, section: bar}}"
        for e, (a, b) in enumerate(bars, 1)
    )
    heavy = [n for (k, _, _), n in place.items() if k]
    return f"""\
mouse: 1
model:
  structure:
    nodes: {{{nodes}}}
    materials: {{steel: {{E: 2.1e+11, nu: 0.3, density: 7850}}}}
    sections: {{bar: {{rectangle: [0.2, 0.2]}}}}
    elements:
{beams}
      - {{id: 101-{100 + len(heavy)}, type: mass, nodes: {heavy}, mass: 2000}}
    supports: {{1: all, 2: all, 3: all, 4: all}}
parameters:
  - {{name: E, material: steel, property: E, sd: 5 %}}
test:
  modes:
    number: [1, 2, 3, 4, 5, 6]
    frequency: [1, 2, 3, 4, 5, 6]
    frequency_sd: 0.2 %
    dofs: [{", ".join(f"{n}T{d}" for n in heavy for d in "XY")}]
    shapes:
{chr(10).join("      - [1, 1, 1, 1, 1, 1]" for _ in range(2 * len(heavy)))}
    shape_sd: 0.01
"""


def braced(one: int, other: int, k: float):
    """The tower, measured with a spring between two nodes."""
    problem = assemble(yaml_deck.read(tower(), "tower.yaml"))
    K, M = (dense(part) for part in assembly(problem).matrices(problem.prior.mean))
    mesh, label = problem.mesh, {name: i for i, name in enumerate(problem.structure.labels)}
    e = mesh.coordinates[other - 1] - mesh.coordinates[one - 1]
    e = e / np.linalg.norm(e)
    b = np.zeros(len(K))
    for node, sign in ((one, -1), (other, 1)):
        for d, part in zip("XYZ", e, strict=True):
            if f"{node}T{d}" in label:
                b[label[f"{node}T{d}"]] = sign * part
    lam, X = eigh(K + k * np.outer(b, b), M, subset_by_index=[0, 5])
    hz, shapes = np.sqrt(lam) / (2 * np.pi), problem.test.read(X)
    size = np.abs(shapes).max(axis=0)
    test = replace(
        problem.test, frequency_hz=hz, frequency_sd_hz=0.002 * hz, shapes=shapes / size,
        shape_sd=np.full(shapes.shape, 0.01),
    )  # fmt: skip
    problem = replace(problem, test=test)
    return reduced(problem, problem.prior.mean)


@pytest.mark.parametrize(("one", "other", "k"), [(5, 10, 3e6), (6, 12, 1e6), (3, 8, 2e7), (9, 12, 2e6)])
def test_the_first_look_keeps_the_true_pair_of_many(one, other, k):
    found = braced(one, other, k)
    assert len(pairs(found)) > MOST
    kept = [(a + 1, b + 1) for a, b, _ in ties(found)]
    assert len(kept) == MOST
    assert (one, other) in kept


def test_a_brace_makes_the_shapes_as_no_other_force_does():
    """But for the diagonal that crosses it."""
    found = braced(6, 12, 1e6)
    tried = scores(replace(found, ties=ties(found)))
    channel, number = tried.find(int(np.argmin(tried.matches.cost)))
    assert channel.name == "tie"
    assert channel.site(number).ids in {(6, 12), (8, 10)}


def test_a_beam_has_no_braces():
    assert not len(pairs(model(TIP % 1.0)))


def bays(pieces: int) -> str:
    """Six columns, bays of 3 and 8 m, two storeys; so many elements a member."""
    xyz = np.array([[x, 0.0, z] for z in (0.0, 3.0, 6.0) for x in (0.0, 3.0, 11.0)])
    members = [(i, i + 3) for i in range(6)] + [(3, 4), (4, 5), (6, 7), (7, 8)]
    nodes, elements = list(xyz.tolist()), []
    for a, b in members:
        inner = [len(nodes) + i for i in range(pieces - 1)]
        nodes += [(xyz[a] + (xyz[b] - xyz[a]) * (i + 1) / pieces).tolist() for i in range(pieces - 1)]
        row = [a, *inner, b]
        elements += [[p + 1, q + 1] for p, q in pairwise(row)]
    bar = "E: 2.1e+11, nu: 0.3, density: 7850, A: 0.01, Iy: 1.0e-5, Iz: 1.0e-5, J: 1.0e-5"
    listed = "\n".join(f"      - {{id: {n}, type: beam, nodes: {own}, {bar}}}" for n, own in enumerate(elements, 1))
    named = ", ".join(f"{n}: {at}" for n, at in enumerate(nodes, 1))
    return f"""mouse: 1
model:
  structure:
    nodes: {{{named}}}
    elements:
{listed}
    supports: {{1: all, 2: all, 3: all}}
    plane: XZ
test:
  modes: {{number: [1], frequency: [1], frequency_sd: 1 %}}
"""


@pytest.mark.parametrize(("limit", "value"), [("_LOOKED", 36), ("_ENDS", 9)])
def test_knee_braces_push_no_other_pair_out(monkeypatch, limit, value):
    """They are closer than all others: each kind has its own limit, and of too many nodes there are none."""
    usual = pairs(model(bays(3)))
    monkeypatch.setattr(looked, limit, value)
    few, nodes = pairs(model(bays(3))), 9
    own = lambda found: [key for key in found.keys[:, :2].tolist() if max(key) < nodes]
    assert own(few) == own(usual) and len(own(usual)) == 18  # of 36 pairs of nine ends
    assert bool(len(few) - len(own(few))) == (limit == "_LOOKED")


@pytest.mark.parametrize("pieces", [1, 3])
def test_near_pairs_are_more_probable_beforehand(pieces):
    """All together one; each by the inverse of how many are no more members apart: uniform in the logarithm of that number.

    Six columns, bays of 3 and 8 m, two storeys: panels are two members across, whatever their bay and however fine the mesh.
    """
    chosen = pairs(model(bays(pieces)))
    keys = [tuple(sorted(key[:2])) for key in (chosen.keys + 1).tolist()]
    p = dict(zip(keys, np.exp(chosen.log_prior).tolist(), strict=True))
    panel = {key: p.pop(key) for key in [(1, 5), (2, 4), (2, 6), (3, 5), (4, 8), (5, 7), (5, 9), (6, 8)]}
    wide = {key: p.pop(key) for key in [(1, 9), (3, 7)]}
    knees = {key: p.pop(key) for key in [each for each in p if max(each) > 9]}
    assert set(p) == {(1, 8), (2, 7), (2, 9), (3, 8), (1, 6), (3, 4), (4, 9), (6, 7)}
    first = panel[1, 5]
    share = 0.25 if pieces > 1 else 0.0
    assert sum(knees.values()) == pytest.approx(share)
    assert list(panel.values()) == pytest.approx([first] * 8)
    assert list(p.values()) == pytest.approx([first * 8 / 16] * 8)
    assert list(wide.values()) == pytest.approx([first * 8 / 18] * 2)
    assert 8 * first * (1 + 1 / 2 + 2 / 18) == pytest.approx(1.0 - share)


def test_knee_braces_join_members_that_meet_in_a_corner():
    """One column of 3 m and one beam of 4 m, ten elements each: nodes within half of either, no leg three times the other."""
    nodes = {i: (0.0, 0.3 * i) for i in range(11)} | {10 + i: (0.4 * i, 3.0) for i in range(1, 11)}
    bar = "E: 2.1e+11, nu: 0.3, density: 7850, A: 0.01, Iy: 1.0e-5, Iz: 1.0e-5, J: 1.0e-5"
    text = f"""mouse: 1
model:
  structure:
    nodes: {{{", ".join(f"{n + 1}: [{x}, {y}]" for n, (x, y) in nodes.items())}}}
    elements:
      - {{id: 1-20, type: beam, nodes: 1-21, {bar}}}
    supports: {{1: all}}
    plane: XY
test:
  modes: {{number: [1], frequency: [1], frequency_sd: 1 %}}
"""
    mesh = model(text).problem.mesh
    expected = {
        (10 - i, 10 + j)
        for i in range(1, 6)
        for j in range(1, 6)
        if 1 / 3 <= (0.3 * i) / (0.4 * j) <= 3
    }
    assert knees(mesh, ends(mesh)) == expected


def test_two_places_that_predict_the_same_are_two():
    """Braces of neighbouring panels, and two nodes through the thickness of a plate: what cannot be told apart is listed."""
    flat = SimpleNamespace(structure=SimpleNamespace(geometry=SimpleNamespace(coordinates=np.eye(3) * 10)))

    def end(*sites: Site) -> SimpleNamespace:
        point, base = SimpleNamespace(residual=np.ones(4)), SimpleNamespace(problem=flat)
        return SimpleNamespace(sites=sites, misfit=4.0, point=point, recipes=(), model=SimpleNamespace(base=base, t=1))

    node = lambda x: Site("node", (int(1000 * x),), (x, 0.0, 0.0))
    brace = lambda *ids: Site("node", ids, (1.0, 0.0, 0.0))
    kept = lambda a, b: len(leading(leading([], (0, None, end(a))), (1, None, end(b))))
    assert kept(node(1.0), node(1.1)) == 1
    assert kept(node(1.0), node(3.0)) == 2
    assert kept(brace(1, 5), brace(2, 4)) == 2


def test_mass_of_the_columns_of_a_storey_sways_with_their_tops():
    """Of columns clamped at both ends 13/35 of what lies on them, by the cubic that they bend in, as a mass at their tops."""
    m = 0.01 * KG / H
    expected = 24 * EI / H**3 / (KG + 2 * 13 / 35 * m * H)
    assert lowest(model(PORTAL), "floor-mass", [m], "the columns between Y = 0 and 3") == pytest.approx(expected, rel=1e-4)

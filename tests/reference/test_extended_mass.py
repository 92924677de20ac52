"""A body at the end of a shaft, and a heavy corner: masses with rotary inertia, in beams of Hermite elements assembled here."""

import numpy as np
import pytest
from scipy.linalg import eigh

from mouse_cli.diagnosis.diagnose import diagnose
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import NAMED

# N m2, kg/m, m; node of the second bearing; elements
EI, MASS, LENGTH, SUPPORT, COARSE, FINE = 700.0, 6.0, 1.5, 8, 15, 4
COUNT, SENSORS = 5, (1, 2, 4, 5, 7, 9, 11, 13, 14, 15)


def truth(node: int, m: float, J: float) -> tuple[np.ndarray, np.ndarray]:
    """Hz (COUNT,) and deflections (16, COUNT) of a shaft on two bearings that overhangs, with a body at a node of the deck."""
    n, l = COARSE * FINE, LENGTH / (COARSE * FINE)
    unit = np.outer([1, l, 1, l], [1, l, 1, l])
    k = EI / l**3 * unit * np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])
    own = MASS * l / 420 * unit * np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]])
    K, M = np.zeros((2, 2 * n + 2, 2 * n + 2))
    for e in range(n):
        at = slice(2 * e, 2 * e + 4)
        K[at, at] += k
        M[at, at] += own
    M[2 * node * FINE, 2 * node * FINE] += m
    M[2 * node * FINE + 1, 2 * node * FINE + 1] += J
    free = np.array([i for i in range(2 * n + 2) if i not in (0, 2 * SUPPORT * FINE)])
    lam, X = eigh(K[np.ix_(free, free)], M[np.ix_(free, free)], subset_by_index=[0, COUNT - 1])
    shapes = np.zeros((2 * n + 2, COUNT))
    shapes[free] = X
    return np.sqrt(lam) / (2 * np.pi), shapes[:: 2 * FINE]


def deck(hz: np.ndarray, shapes: np.ndarray, more: str = "") -> str:
    """Without the body, unless `more` elements have it; 0.1 % and 0.5 % of noise."""
    rng = np.random.default_rng(5)
    shapes = shapes[list(SENSORS)] / np.abs(shapes).max(axis=0)
    shapes = shapes + 5e-3 * rng.standard_normal(shapes.shape)
    rows = ", ".join(f"[{', '.join(f'{v:.6f}' for v in row)}]" for row in shapes)
    return f"""mouse: 1
title: a shaft that overhangs
model:
  structure:
    nodes: {{line: {{from: 1, to: {COARSE + 1}, start: [0, 0], end: [{LENGTH}, 0]}}}}
    elements:
      - {{id: 1-{COARSE}, type: beam, nodes: 1-{COARSE + 1}, E: {EI}, A: {MASS}, density: 1, Iz: 1}}
{more}    directions: [TY, RZ]
    supports: {{1: [TY], {SUPPORT + 1}: [TY]}}
parameters:
  - {{name: E, elements: 1-{COARSE}, property: E, sd: 2 %}}
  - {{name: density, elements: 1-{COARSE}, property: density, sd: 1 %}}
test:
  modes:
    frequency: [{", ".join(f"{v:.8g}" for v in hz * (1 + 1e-3 * rng.standard_normal(COUNT)))}]
    frequency_sd: 0.1 %
    dofs: [{", ".join(f"{i + 1}TY" for i in SENSORS)}]
    shapes: [{rows}]
    shape_sd: 0.5 %
"""


@pytest.mark.parametrize(("m", "J", "known"), [(2.0, 0.02, False), (2.0, 0.02, True)])
def test_a_hub(m, J, known):
    """A hub that the deck leaves out, and one that it has as a point: mass and inertia in the first, inertia in the second."""
    point = f"      - {{id: 90, type: mass, nodes: [{COARSE + 1}], mass: {m}}}\n" if known else ""
    found = diagnose(assemble(yaml_deck.read(deck(*truth(COARSE, m, J), point), "shaft.yaml")))
    (cause,) = found.best.causes
    assert (found.kind, cause.physics) == (NAMED, "extended-mass")
    assert cause.site.text.startswith(f"node {COARSE + 1}")
    sizes = {size.name: size for size in cause.sizes}
    assert set(sizes) == ({"rotary inertia"} if known else {"rotary inertia", "mass"})
    for name, value in (("rotary inertia", J), ("mass", m)):
        if name in sizes:
            assert abs(sizes[name].value - value) < 4 * sizes[name].sd and sizes[name].sd < 0.1 * value


def test_a_mass_without_rotary_inertia_is_a_mass():
    """Its place is a node, where a body need not pay for a place along the shaft: what data do not feel is no part of the name."""
    found = diagnose(assemble(yaml_deck.read(deck(*truth(COARSE, 2.0, 0.0)), "shaft.yaml")))
    assert (found.kind, [cause.physics for cause in found.best.causes]) == (NAMED, ["mass"])


def test_masses_begin_where_the_deck_has_some():
    """A pallet that weighs twice: a mass at its node had a fit too narrow for places that are spread along the line alone."""
    point = f"      - {{id: 90, type: mass, nodes: [{COARSE - 3}], mass: 2.0}}\n"
    problem = assemble(yaml_deck.read(deck(*truth(COARSE, 2.0, 0.02), point), "shaft.yaml"))
    model, key = reduced(problem, problem.prior.mean), registry()["mass"]
    places = np.concatenate([recipe.grid[:, -1] for recipe in key.recipes(model, key) if len(recipe.unknowns) > 1])
    assert np.abs(places - (COARSE - 4) * LENGTH / COARSE).min() < 1e-9


def test_a_first_look_has_the_bodies_of_the_search():
    """A floor of beams held at its edges, where nodes turn about one axis as it sways: in all coordinates about the other too."""
    across, along = range(1, 10), range(7)
    number = lambda i, j: i + 9 * j
    nodes = ", ".join(f"{{{number(i, j)}: [{i}, {j}, 0]}}" for j in along for i in across)
    bars = [[number(i, j), number(i + 1, j)] for j in along for i in across if i < 9]
    bars += [[number(i, j), number(i, j + 1)] for j in along for i in across if j < 6]
    held = "; ".join(f"{number(i, j)}: [TZ]" for j in along for i in across if i in (1, 9) or j in (0, 6))
    text = f"""mouse: 1
title: a floor
model:
  structure:
    nodes: [{nodes}]
    sections: {{bar: {{A: 4e-3, Iy: 2e-5, Iz: 2e-6, J: 1e-6}}}}
    elements: [{{id: 1-{len(bars)}, type: beam, nodes: {bars}, E: 2.1e11, nu: 0.3, density: 7850, section: bar}}]
    supports: {{{held.replace(";", ",")}}}
    directions: [TZ, RX, RY]
parameters: [{{name: E, elements: 1-{len(bars)}, property: E, sd: 3 %}}]
test: {{modes: {{frequency: [13.9, 27.9, 48.1], frequency_sd: 1 %}}}}
"""
    problem = assemble(yaml_deck.read(text, "floor.yaml"))
    study = Study(reduced(problem, problem.prior.mean))
    assert study.coarse.model.r < study.model.r
    unknowns = lambda of: [[u.name for u in recipe.unknowns] for recipe in of.recipes("extended-mass")]
    assert unknowns(study.coarse) == unknowns(study)

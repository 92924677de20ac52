"""A truss bridge that has lost a diagonal: modes by OpenSees, and what a search in few coordinates sees of it."""

from itertools import pairwise

import numpy as np
import pytest

from mouse_cli.diagnosis.diagnose import again
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble

PANELS, WIDTH, HEIGHT, MODES = 4, 4.0, 3.5, 6
E, DENSITY, KG = 2.1e11, 7850.0, 400.0
SECTION = {"chord": (6.1e-3, 3.8e-5), "diagonal": (2.7e-3, 6.0e-6)}  # A, I
POINTS = [(i * WIDTH, 0.0) for i in range(PANELS + 1)] + [((i + 0.5) * WIDTH, HEIGHT) for i in range(PANELS)]
LOWER, UPPER = pairwise(range(PANELS + 1)), pairwise(range(PANELS + 1, 2 * PANELS + 1))
CHORDS = [(*pair, "chord") for pair in (*LOWER, *UPPER)]
BARS = CHORDS + [(a, b, "diagonal") for i in range(PANELS) for a, b in ((i, PANELS + 1 + i), (PANELS + 1 + i, i + 1))]


def chains(pieces: int) -> tuple[list[tuple[float, ...]], list[list[int]]]:
    """Points of the bars in so many pieces each, and the nodes (from 0) of each bar."""
    points, found = list(POINTS), []
    for a, b, _ in BARS:
        inner = range(len(points), len(points) + pieces - 1)
        points += [
            tuple(np.add(POINTS[a], share * np.subtract(POINTS[b], POINTS[a])))
            for share in np.arange(1, pieces) / pieces
        ]
        found.append([a, *inner, b])
    return points, found


def by_opensees(missing: int, pieces: int = 6) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies (Hz) and shapes (modes, 2 joints) without one bar."""
    ops = pytest.importorskip("openseespy.opensees")
    points, bars = chains(pieces)
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("Linear", 1)
    element = 0
    there = {*range(len(POINTS)), *(n for i, bar in enumerate(bars) if i != missing for n in bar)}
    for n in sorted(there):
        ops.node(n + 1, *map(float, points[n]))
    for n in range(1, PANELS):
        ops.mass(n + 1, KG, KG, 0.0)
    for i, bar in enumerate(bars):
        A, inertia = SECTION[BARS[i][2]]
        for a, b in pairwise(bar) if i != missing else ():
            element += 1
            ops.element("elasticBeamColumn", element, a + 1, b + 1, A, E, inertia, 1, "-mass", DENSITY * A, "-cMass")
    ops.fix(1, 1, 1, 0)
    ops.fix(PANELS + 1, 0, 1, 0)
    rates = np.array(ops.eigen("-genBandArpack", MODES))
    shapes = [[ops.nodeEigenvector(n + 1, m + 1, d) for n in range(len(POINTS)) for d in (1, 2)] for m in range(MODES)]
    ops.wipe()
    return np.sqrt(rates) / (2 * np.pi), np.array(shapes)


def deck(hz: np.ndarray, shapes: np.ndarray) -> str:
    """The sound truss, two elements a bar, and the test at its joints."""
    points, bars = chains(2)
    nodes = [f"      - {{{n}: [{x:.9g}, 0, {z:.9g}]}}" for n, (x, z) in enumerate(points, 1)]
    sections = ", ".join(f"{name}: {{A: {A}, Iy: {inertia}}}" for name, (A, inertia) in SECTION.items())
    elements = [
        f"      - {{type: beam, nodes: [{a + 1}, {m + 1}, {b + 1}], material: steel, section: {name}}}"
        for (a, m, b), (*_, name) in zip(bars, BARS, strict=True)
    ]
    held = {0, 1, 2 * PANELS + 1}
    free = [n for n in range(2 * len(POINTS)) if n not in held]
    sensors = ", ".join(f"{n // 2 + 1}{('TX', 'TZ')[n % 2]}" for n in free)
    size = np.abs(shapes).max(axis=1)
    read = [f"      - [{', '.join(f'{v:.6g}' for v in shapes[:, n] / size)}]" for n in free]
    return "\n".join([
        "mouse: 1", "model:", "  structure:", "    plane: XZ", "    nodes:", *nodes,
        f"    materials: {{steel: {{E: {E:.6e}, nu: 0.3, density: {DENSITY}}}}}", f"    sections: {{{sections}}}",
        "    elements:", *elements,
        *(f"      - {{type: mass, nodes: [{n + 1}], mass: {KG}}}" for n in range(1, PANELS)),
        f"    supports: {{1: [TX, TZ], {PANELS + 1}: [TZ]}}",
        "parameters:", "  - {name: E, material: steel, property: E, sd: 5 %, transform: log}",
        "test:", "  modes:", f"    number: {list(range(1, MODES + 1))}", f"    dofs: [{sensors}]",
        f"    frequency: [{', '.join(f'{f:.7g}' for f in hz)}]", "    frequency_sd: 0.2 %", "    shapes:", *read,
        "    shape_sd: 0.01", "",
    ])  # fmt: skip


def test_a_first_look_in_few_coordinates_sees_that_a_diagonal_is_missing():
    missing = len(CHORDS) + 3
    problem = assemble(yaml_deck.read(deck(*by_opensees(missing)), "deck.yaml"))
    study = Study(reduced(problem, problem.prior.mean))
    assert study.coarse.model.r < study.model.r
    looks = study.coarse.looks("member", np.zeros(study.k), ())
    best, number, x = looks[0]
    site = study.recipes("member")[number].site(np.exp(x[study.k :]))
    assert set(site.ids) == {2 * missing + 1, 2 * missing + 2}
    whole = study.with_cause((), "member", number).point(x)
    assert best == pytest.approx(study.predicted(whole), rel=0.2)
    others = [
        cost
        for name in study.known
        if name != "member"
        for cost, *_ in study.coarse.looks(name, np.zeros(study.k), ())[:1]
    ]
    assert best < 0.5 * min(others)


def test_without_the_diagonal_the_deck_predicts_its_local_modes_too():
    """Two elements a bar are 0.4 to 1 % too high in modes of single bars, 2 to 5 sd; a hundredth of a diagonal left would be 10."""
    missing = len(CHORDS) + 3
    problem = assemble(yaml_deck.read(deck(*by_opensees(missing)), "deck.yaml"))
    study = Study(again(problem))
    ids = {2 * missing + 1, 2 * missing + 2}
    recipes = study.recipes("member")
    found = [
        i
        for i, each in enumerate(recipes)
        if {*each.site(each.grid[0]).ids} == ids and each.change(each.grid[-1]).M is not None
    ]
    (number,) = found
    one = fit(study.with_cause((), "member", number), recipes[number].coordinates(recipes[number].grid[-1]))
    assert one.misfit < 0.3 * one.dof
    assert np.abs(one.point.residual[:MODES]).max() < 0.5
    assert one.point.x[0] == pytest.approx(0.0, abs=0.05)


def test_a_first_look_in_few_coordinates_bends_a_short_member_that_is_softer():
    """Two booms and a latch of a fortieth of their length between them, nine tenths of it lost: as in all coordinates."""
    at = np.concatenate([np.linspace(0, 3, 16), np.linspace(3.15, 6.15, 16)])
    nodes = ", ".join(f"{{{n}: [{x:.6g}, 0]}}" for n, x in enumerate(at, 1))
    beams = [f"{{id: {n}, type: beam, nodes: [{n}, {n + 1}], material: steel, section: {'latch' if n == 16 else 'boom'}}}"
             for n in range(1, 32)]  # fmt: skip
    text = f"""\
mouse: 1
model:
  structure:
    plane: XY
    nodes: [{nodes}]
    materials: {{steel: {{E: 2e11, density: 7850}}}}
    sections: {{boom: {{A: 0.002, Iz: 1e-6}}, latch: {{A: 0.002, Iz: 1.1e-6}}}}
    elements: [{", ".join(beams)}]
    supports: {{1: all}}
parameters:
  - {{name: E, material: steel, property: E, sd: 5 %}}
test:
  modes: {{number: [1, 2, 3, 4], frequency: [3, 19, 53, 104], frequency_sd: 1 %}}
"""
    problem = assemble(yaml_deck.read(text, "booms.yaml"))
    study = Study(reduced(problem, problem.prior.mean))
    assert study.coarse.model.r < study.model.r
    found = []
    for each in (study, study.coarse):
        (recipe,) = [one for one in each.recipes("member") if one.site(one.grid[0]).text == "element 16, its stiffness alone"]
        x = np.concatenate([np.zeros(each.k), recipe.coordinates(np.array([0.9]))])
        found.append(each.kind(each.model, (recipe,)).point(x).eigenvalues[:4])
    assert found[1] == pytest.approx(found[0], rel=2e-3)

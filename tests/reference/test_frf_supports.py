"""Functions of a beam whose support turns, against finite elements written here: what they read, and what is named by them."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from mouse_cli.diagnosis import diagnose
from mouse_cli.diagnosis.likelihoods.frf.damping import damping
from mouse_cli.diagnosis.likelihoods.frf.data import FrfData, lines
from mouse_cli.diagnosis.likelihoods.frf.identified import with_modes
from mouse_cli.diagnosis.likelihoods.frf.lossy import STRUCTURAL, lossy
from mouse_cli.diagnosis.likelihoods.frf.model import FrfModel
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.dynamics.sensing import read
from mouse_cli.formats import read_deck
from mouse_cli.model.arrays import dense
from mouse_cli.model.diagnosis import NAMED
from mouse_cli.terms.assembly import assembly

ELEMENTS, LENGTH, EI, MASS, ETA = 12, 2.4, 2.1e11 * 1.6e-7, 7850 * 1.2e-3, 0.01  # m, N m2, kg/m, loss factor
SPRING = 6 * EI / LENGTH  # N m/rad, at the left end
READ, FORCE = range(2, 12, 2), 5  # nodes from 0
LOSS = 0.1  # a frequency to 1e-3, as decks with a mechanism keep them, is then a function to 2 % at resonance
DECK = f"""mouse: 1
title: beam on a clamp and a bearing
model:
  structure:
    nodes: {{line: {{from: 1, to: {ELEMENTS + 1}, start: [0, 0], end: [{LENGTH}, 0]}}}}
    elements:
      - {{id: 1-{ELEMENTS}, type: beam, nodes: 1-{ELEMENTS + 1}, E: 2.1e11, nu: 0.3, density: 7850, A: 1.2e-3, Iz: 1.6e-7}}
    supports: {{1: all, {ELEMENTS + 1}: [TX, TY]}}
    plane: XY
parameters:
  - {{name: E, elements: 1-{ELEMENTS}, property: E, sd: 3 %}}
modal_damping: {{ratio: 0.5 %, sd: 100 %}}
test:
  frf: [{{file: measured.npz}}]
"""


def receptance(omega: np.ndarray, each: int = 1) -> np.ndarray:
    """H (f, o): deflections of a beam of Hermite elements, `each` for one of the deck; its left end turns on a spring."""
    count = ELEMENTS * each
    l = LENGTH / count
    k = EI / l**3 * np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])
    m = MASS * l / 420 * np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]])
    unit = np.outer([1, l, 1, l], [1, l, 1, l])
    K, M = np.zeros((2, 2 * count + 2, 2 * count + 2))
    for e in range(count):
        at = slice(2 * e, 2 * e + 4)
        K[at, at] += k * unit
        M[at, at] += m * unit
    K[1, 1] += SPRING
    free = np.setdiff1d(np.arange(len(K)), [0, 2 * count])
    K, M = K[np.ix_(free, free)] * (1 + 1j * ETA), M[np.ix_(free, free)]
    load, rows = (free == 2 * FORCE * each).astype(float), np.searchsorted(free, 2 * each * np.array(READ))
    return np.array([np.linalg.solve(K - w * w * M, load)[rows] for w in omega])


@pytest.fixture
def deck(tmp_path):
    """A deck of accelerances with 1 % noise, whose model holds the left end, and whose mesh is too coarse for them."""
    rng, hz = np.random.default_rng(4), np.linspace(10, 800, 1200)
    omega = 2 * np.pi * hz
    H = -receptance(omega, 4) * (omega**2)[:, None]
    variance = (0.01 * np.abs(H)) ** 2 + 0.002**2 * (np.abs(H) ** 2).mean(axis=0)
    H = H + np.sqrt(variance / 2) * (rng.standard_normal(H.shape) + 1j * rng.standard_normal(H.shape))
    names = {"output_names": [f"{n + 1}TY" for n in READ], "input_names": [f"{FORCE + 1}TY"], "kind": "accelerance"}
    np.savez(
        tmp_path / "measured.npz", frequency_hz=hz, H=H[:, :, None], variance=variance[:, :, None],
        **{key: np.array(value) for key, value in names.items()},
    )  # fmt: skip
    (tmp_path / "deck.yaml").write_text(DECK)
    return tmp_path / "deck.yaml"


def test_functions_of_a_freed_structure_are_read_where_the_deck_says(deck):
    """Sensors and force keep their places when a support adds degrees of freedom, and each reads its motion once."""
    problem, _ = with_modes(read_deck(deck))
    base = reduced(problem, problem.prior.mean)
    data = FrfData(tuple(lines(test, problem.theory) for test in problem.frf))
    candidate = registry()["support-rotation"]
    recipe = next(each for each in candidate.recipes(base, candidate) if "node 1," in each.site(each.grid[0]).text)
    own = damping(base)
    model = FrfModel(replace(base, data=data), own, (recipe,))
    x = np.zeros(model.k + model.t)
    x[model.of_deck : model.lossy] = (np.log([ETA, 1e-12, 1e-12, 1e-12]) - own.mean) / own.sd
    x[model.k :] = recipe.coordinates(np.array([SPRING]))
    block = data.blocks[0]
    exact = -receptance(block.omega) * (block.omega**2)[:, None]
    found = model.point(x).parts[0].H[:, :, 0]
    assert (np.abs(found - exact).max(axis=0) < 1e-5 * np.abs(exact).max(axis=0)).all()


@pytest.mark.proof
def test_a_support_that_turns_is_named_by_functions(deck):
    found = diagnose(read_deck(deck))
    assert (found.kind, found.best.group) == (NAMED, "support")
    cause = found.best.causes[0]
    assert cause.site.ids == (1,)
    assert abs(cause.sizes[0].value - SPRING) < 3 * cause.sizes[0].sd


PORTAL = """mouse: 1
title: portal on three feet, its nodes in any order
model:
  structure:
    nodes: {{{nodes}}}
    materials: {{steel: {{E: 2.1e+11, nu: 0.3, density: 7850, loss_factor: 0.05}}}}
    sections: {{bar: {{rectangle: [0.04, 0.05]}}}}
    elements:
{elements}
    supports: {{{supports}}}
    plane: XY
parameters:
  - {{name: E, material: steel, property: E, sd: 3 %}}
test:
  modes:
    number: [1, 2, 3]
    frequency: [10, 20, 30]
    frequency_sd: 0.5 %
    dofs: [{dofs}]
    shapes: {shapes}
    shape_sd: 0.03
  frf: [{{file: measured.npz}}]
"""


def portal(folder, order: np.ndarray) -> str:
    """A deck of a beam on three columns whose node i (from 0) is called order[i]; the feet are nodes 2, 3 and 4."""
    places = [(0, 2), (1.3, 2), (0, 0), (1.3, 0), (3, 0), (3, 2), (0, 1), (1.3, 1), (3, 1), (2.2, 2)]
    bars = [(2, 6), (6, 0), (3, 7), (7, 1), (4, 8), (8, 5), (0, 1), (1, 9), (9, 5)]
    called = [int(number) for number in order]
    sensors = [f"{called[node]}{d}" for node, d in ((0, "TX"), (6, "TX"), (9, "TY"), (8, "TX"))]
    np.savez(
        folder / "measured.npz", frequency_hz=np.linspace(2, 30, 40), H=np.ones((40, 4, 2), complex),
        variance=np.ones((40, 4, 2)), output_names=np.array(sensors),
        input_names=np.array([f"{called[1]}TX", f"{called[9]}TY"]), kind=np.array("receptance"),
    )  # fmt: skip
    path = folder / "portal.yaml"
    path.write_text(
        PORTAL.format(
            nodes=", ".join(f"{n}: [{x}, {y}]" for n, (x, y) in sorted(zip(called, places, strict=True))),
            elements="\n".join(
                f"      - {{id: {e + 1}, type: beam, nodes: [{called[a]}, {called[b]}], material: steel, section: bar}}"
                for e, (a, b) in enumerate(bars)
            ),
            supports=", ".join(f"{called[node]}: all" for node in (2, 3, 4)),
            dofs=", ".join(sensors),
            shapes="[" + ", ".join(f"[{1 + i}, {(-1) ** i}, {2 - i}]" for i in range(4)) + "]",
        )
    )
    return path


@pytest.fixture(scope="module", params=[0, 1, 2])
def freed(request, tmp_path_factory):
    """The reduced model of such a deck, its nodes numbered at random."""
    order = np.random.default_rng(request.param).permutation(np.arange(1, 11) * 3)
    problem = read_deck(portal(tmp_path_factory.mktemp("portal"), order))
    return reduced(problem, problem.prior.mean)


# what a plane portal of beams alone, feet clamped, has no place for: lumped masses, offsets, tapers, sets, shells, free directions
NOWHERE = (
    "eccentric-bearing", "item-offset", "items", "mass-loss", "material", "mount-rotation", "offset", "sprung-mass",
    "support-restraint", "taper", "sensor-turned", "slab", "thinner", "torsion", "void",
)  # fmt: skip


@pytest.mark.parametrize("key", sorted(registry().keys() - set(NOWHERE)))
def test_functions_with_a_mechanism_are_those_of_the_deck_that_has_it(freed, key):
    """By solving (1 + i eta) K - omega^2 M of that deck; a sensor that errs reads so in functions too, wherever supports are."""
    problem, candidate = freed.problem, registry()[key]
    blocks = tuple(lines(test, problem.theory) for test in problem.frf)
    recipes = candidate.recipes(freed, candidate)
    assert recipes
    for recipe in recipes[:: max(1, len(recipes) // 3)]:
        inside = recipe.bounds[:, 0] + 0.45 * np.ptp(recipe.bounds, axis=1)
        values = recipe.values(inside)
        model = FrfModel(replace(freed, data=FrfData(blocks)), damping(freed), (recipe,))
        x = np.zeros(model.k + model.t)
        x[model.of_deck : model.lossy] = (np.log([LOSS, 1e-12, 1e-12, 1e-12]) - model.damping.mean) / model.damping.sd
        x[model.k :] = recipe.coordinates(values)
        at = model.point(x)
        if at is None:
            continue  # it would buckle
        deck = recipe.extend(problem, values)
        K, M = (dense(part) for part in assembly(deck).matrices(deck.prior.mean))
        for block, part, test in zip(blocks, at.parts, deck.frf, strict=True):
            force, motion = np.asarray(read(test.inputs, np.eye(len(K)))).T, partial(read, test.outputs)
            solve = lambda w, K=K, M=M, f=force, r=motion: r(np.linalg.solve(K * (1 + LOSS * 1j) - w * w * M, f))
            exact = np.array([solve(w) for w in block.omega])
            assert np.abs(part.H - exact).max() < 0.03 * np.abs(exact).max(), (recipe.site(values), values)


def test_a_lossy_joint_is_told_from_a_support_by_its_place_whatever_its_loss(freed):
    """A loss factor of 0.001 is no place 1 mm from a foot."""
    candidate = registry()["joint"]
    for recipe in candidate.recipes(freed, candidate):
        values = recipe.values(recipe.bounds.mean(axis=1))
        own = lossy(recipe, STRUCTURAL, 100.0)
        there = np.append(values, 1e-3)
        assert own.group(own.coordinates(there)) == recipe.group(recipe.coordinates(values)) == "local-stiffness"

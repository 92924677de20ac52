"""One wrong entry of a test: a frequency that was misread, a shape that is no mode's, on a pinned beam in closed form."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.linalg import eigh

import mouse_cli
from mouse_cli.diagnosis.cautions import _errors, _exchanged, _twice
from mouse_cli.diagnosis.likelihoods.modal.accuracy import Doubt
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.mixed import mixed
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.repeated import exchanged, repeated
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.model.diagnosis import NOTHING, UNKNOWN

LENGTH, EI, MASS = 6.0, 2.1e11 * 3.0e-6, 7850 * 2.0e-3
SENSORS = [3, 5, 8, 10, 12, 14, 17, 19]


def deck(folder, frequency: dict[int, float], shape: dict[int, np.ndarray]) -> str:
    """The beam of 20 bars, six modes with 0.2 % and 1 %; entries of modes, from 1, are replaced: factors of f, and shapes."""
    rng = np.random.default_rng(8)
    n, x = np.arange(1, 7), (np.array(SENSORS) - 1) / 20
    f = n**2 * np.pi / (2 * LENGTH**2) * np.sqrt(EI / MASS) * (1 + 0.002 * rng.standard_normal(6))
    shapes = np.sin(np.pi * np.outer(x, n)) + 0.01 * rng.standard_normal((8, 6))
    for mode, factor in frequency.items():
        f[mode - 1] *= factor
    for mode, other in shape.items():
        shapes[:, mode - 1] = other
    path = folder / "deck.yaml"
    path.write_text(f"""\
mouse: 1
title: A pinned beam
model:
  structure:
    nodes: [{{line: {{from: 1, to: 21, start: [0, 0], end: [{LENGTH}, 0]}}}}]
    materials: {{steel: {{E: 2.1e+11, density: 7850}}}}
    sections: {{bar: {{A: 2.0e-3, Iz: 3.0e-6}}}}
    elements: [{{id: 1-20, type: beam, nodes: 1-21, material: steel, section: bar}}]
    supports: {{1: [TX, TY], 21: [TY], 2-20: [TX]}}
    plane: XY
parameters: [{{name: E, material: steel, property: E, sd: 3 %}}]
test:
  modes:
    dofs: [{", ".join(f"{node}TY" for node in SENSORS)}]
    frequency: {f.round(4).tolist()}
    frequency_sd: 0.2 %
    shapes: {shapes.round(4).tolist()}
    shape_sd: 0.01
""")
    return path


@pytest.mark.proof
def test_right_entries_are_not_suspected(tmp_path):
    assert mouse_cli.diagnose(mouse_cli.read_deck(deck(tmp_path, {}, {}))).kind == NOTHING


def test_a_frequency_that_was_misread_is_no_physics(tmp_path):
    found = mouse_cli.diagnose(mouse_cli.read_deck(deck(tmp_path, {4: 1.03}, {})))
    assert found.kind == UNKNOWN and found.misstated == "frequency"
    assert any("the frequency of mode 4 does not agree" in caution for caution in found.cautions)


def shape(n: int) -> np.ndarray:
    """The beam's own mode n at the sensors, with its noise."""
    own = np.sin(np.pi * n * (np.array(SENSORS) - 1) / 20)
    return own + 0.01 * np.random.default_rng(n).standard_normal(len(own))


@pytest.mark.parametrize(
    ("frequency", "shapes", "columns", "twice"),
    [
        ({}, {}, [], []),
        ({}, {3: shape(4), 4: shape(3)}, [(2, 3)], []),
        ({4: 9 / 16 * 1.006}, {4: shape(3)}, [], [(2, 3)]),
    ],
    ids=["right", "exchanged", "twice"],
)
def test_columns_that_stand_in_the_place_of_others_are_told(tmp_path, frequency, shapes, columns, twice):
    """Exchanged shapes were fields of axial force and of a spring, 45 % off what was left out; one mode twice an oscillator."""
    problem = mouse_cli.read_deck(deck(tmp_path, frequency, shapes))
    one = fit(Model(reduced(problem, problem.prior.mean)), np.zeros(0))
    assert (exchanged(one), repeated(one, twice=True)) == (columns, twice)
    ranking = SimpleNamespace(baseline=one)
    assert [said.split(" are each")[0] for said in _exchanged(ranking)] == ["The shapes of modes 3 and 4"] * len(columns)
    assert [said.split(" have one")[0] for said in _twice(ranking)] == ["Modes 3 and 4"] * len(twice)


@pytest.mark.parametrize(("third", "twice"), [(0.0, [(0, 1)]), (1.0, [])])
def test_two_modes_of_one_shape_that_the_model_has_are_no_mode_twice(third, twice):
    """Where it has them, but is compared by another one: a mode of the right wing was identified twice, as the left one has it."""
    other, shape = np.array([1.0, -1, 1, -1, 1]), np.array([1.0, 2, 3, 2, 1])
    seen = np.column_stack([shape, other, third * shape + (1 - third) * other])
    point = SimpleNamespace(eigenvalues=1 + 0.01 * np.arange(3), modes=np.array([0, 1]), seen=seen, measured=lambda own: own[:, :2])
    test = SimpleNamespace(shapes=np.column_stack([shape, shape]), frequency_hz=np.array([5.0, 5.01]), m=2)
    assert repeated(SimpleNamespace(data=SimpleNamespace(test=test), point=point), twice=True) == twice


def test_a_shape_of_noise_is_no_physics(tmp_path):
    noise = np.random.default_rng(3).uniform(-1, 1, len(SENSORS))
    found = mouse_cli.diagnose(mouse_cli.read_deck(deck(tmp_path, {}, {3: noise})))
    assert found.kind == UNKNOWN and found.misstated == "mode"
    assert any("mode 3 is none that the structure can have" in caution for caution in found.cautions)


@pytest.mark.proof
def test_a_frequency_that_physics_may_have_moved_alone_is_said_to_be_one_or_the_other(tmp_path):
    """A spring in the middle lifts the first of these modes, and hardly any other: so does an entry that is wrong."""
    found = mouse_cli.diagnose(mouse_cli.read_deck(deck(tmp_path, {1: 1.1}, {})))
    assert found.kind != NOTHING and found.misstated is None and 0.02 < dict(found.groups)["none"] < 0.9
    (said,) = [caution for caution in found.cautions if "the frequency of mode 1 does not agree" in caution]
    assert said.startswith("The test may have an error (probability 0.")


def swinging(folder, scatter: float, seed: int = 1) -> str:
    """A chain of six masses that carries four light ones, tuned alike, which no sensor is on; scatter: of their springs."""
    rng = np.random.default_rng(seed)
    k, m, tuned = 1e5, 1.0, 0.02 * (2 * np.pi * 33.0) ** 2
    light = np.append(np.full(6, m), np.full(4, 0.02))

    def stiffness(springs: np.ndarray) -> np.ndarray:
        K = np.zeros((10, 10))
        for i in range(6):
            ends = [i] if i == 0 else [i - 1, i]
            K[np.ix_(ends, ends)] += k * (1.0 if i == 0 else np.array([[1, -1], [-1, 1]]))
        for i, spring in enumerate(springs):
            ends = [i + 1, 6 + i]
            K[np.ix_(ends, ends)] += spring * np.array([[1, -1], [-1, 1]])
        return K

    values, shapes = eigh(stiffness(tuned * np.exp(scatter * rng.standard_normal(4))), np.diag(light))
    chosen = [0, 1, 3]
    seen = shapes[:6, chosen] / np.abs(shapes[:6, chosen]).max(axis=0) + 0.01 * rng.standard_normal((6, 3))
    hz = np.sqrt(values[chosen]) / (2 * np.pi) * (1 + 0.001 * rng.standard_normal(3))
    path = folder / "swinging.yaml"
    path.write_text(f"""\
mouse: 1
title: A chain that carries light masses
model:
  structure:
    nodes: {{line: {{from: 0, to: 10, start: [0, 0, 0], end: [10, 0, 0]}}}}
    elements:
      - {{id: 1-6, type: spring, nodes: 0-6, TX: {k}}}
      - {{id: 11-14, type: spring, nodes: [[2, 7], [3, 8], [4, 9], [5, 10]], TX: {tuned}}}
      - {{id: 21-30, type: mass, nodes: 1-10, mass: {light.tolist()}}}
    supports: {{0: all}}
    directions: [TX]
parameters: [{{name: k, elements: 1-6, property: TX, factor: true, sd: 3 %}}]
test:
  modes:
    number: [1, 2, 4]
    dofs: [1TX, 2TX, 3TX, 4TX, 5TX, 6TX]
    frequency: {hz.round(4).tolist()}
    frequency_sd: 0.1 %
    shapes: {seen.round(4).tolist()}
    shape_sd: 1 %
""")
    return path


def fitted(path):
    problem = mouse_cli.read_deck(path)
    return fit(Model(reduced(problem, problem.prior.mean)), np.zeros(0))


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_mode_that_scatter_mixes_may_be_the_structures(tmp_path, seed):
    one = fitted(swinging(tmp_path, 0.02, seed))
    assert one.misfit > 100  # far more than noise
    assert 2 in mixed(one, (0, 1, 2))


def test_such_a_mode_is_not_said_to_be_false(tmp_path):
    one, noise = fitted(swinging(tmp_path, 0.02)), np.random.default_rng(3).uniform(-1, 1, len(SENSORS))
    other = fitted(deck(tmp_path, {}, {3: noise}))
    for each, said in ((one, "may be one of them all the same"), (other, "none that the structure can have")):
        doubted = SimpleNamespace(baseline=each, doubts=(Doubt("mode", 0.999, 0.5, (2,)),), noise_scale=1.0)
        (sentence,) = _errors(doubted, SimpleNamespace(kind=NOTHING))
        assert said in sentence
        (sentence,) = _errors(doubted, SimpleNamespace(kind=UNKNOWN))
        assert said in sentence and ("Unless what is missing" in sentence) == (each is other)


def test_scatter_does_not_make_any_shape(tmp_path):
    noise = np.random.default_rng(3).uniform(-1, 1, len(SENSORS))
    one = fitted(deck(tmp_path, {}, {3: noise}))
    assert set(mixed(one, tuple(range(6)))) == {0, 1, 3, 4, 5}

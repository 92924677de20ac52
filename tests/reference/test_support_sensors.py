"""Sensors on the nodes of supports: 0 of a model, the motion of a support that is flexible; truths by cubic elements of numpy."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh

from mouse_cli import DeckError
from mouse_cli.diagnosis import diagnose
from mouse_cli.diagnosis.likelihoods.frf.damping import damping
from mouse_cli.diagnosis.likelihoods.frf.data import FrfData, lines
from mouse_cli.diagnosis.likelihoods.frf.model import FrfModel
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.formats import read_deck
from mouse_cli.formats.yaml_deck import writer
from mouse_cli.model.diagnosis import NAMED, NOTHING

ELEMENTS, LENGTH, EI, MASS, ETA = 8, 1.2, 1200.0, 3.9, 0.01  # m, N m2, kg/m
SPRING = 2.0e6  # N/m, of the support
NODES = [1, 3, 5, 7, 9]  # that have sensors, the first one at the clamp
MODES, NOISE = 4, 0.01
HEAD = f"""mouse: 1
title: cantilever with a sensor at its clamp
model:
  structure:
    nodes: {{line: {{from: 1, to: {ELEMENTS + 1}, start: [0, 0, 0], end: [{LENGTH}, 0, 0]}}}}
    materials: {{steel: {{E: 2.0e+11, nu: 0.3, density: {MASS / 5e-4}, loss_factor: {ETA}}}}}
    sections: {{bar: {{A: 5.0e-4, Iz: {EI / 2.0e11}}}}}
    elements: [{{id: 1-{ELEMENTS}, type: beam, nodes: 1-{ELEMENTS + 1}, material: steel, section: bar}}]
    supports: {{1: all}}
    directions: [TY, RZ]
parameters:
  - {{name: E, material: steel, property: E, sd: 3 %, transform: log}}
test:
"""


def matrices(spring: float | None) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """K, M of what can move, and which of TY1, RZ1, TY2, ... that is; spring: of the support in TY, None: it is rigid."""
    a, n = LENGTH / ELEMENTS, 2 * ELEMENTS + 2
    k = (
        EI
        / a**3
        * np.array(
            [[12, 6 * a, -12, 6 * a], [0, 4 * a * a, -6 * a, 2 * a * a], [0, 0, 12, -6 * a], [0, 0, 0, 4 * a * a]]
        )
    )
    m = (
        MASS
        * a
        / 420
        * np.array(
            [[156, 22 * a, 54, -13 * a], [0, 4 * a * a, 13 * a, -3 * a * a], [0, 0, 156, -22 * a], [0, 0, 0, 4 * a * a]]
        )
    )
    K, M = np.zeros((n, n)), np.zeros((n, n))
    for at in range(0, n - 2, 2):
        for whole, own in ((K, k), (M, m)):
            whole[at : at + 4, at : at + 4] += own + np.triu(own, 1).T
    K[0, 0] += spring or 0.0
    free = np.setdiff1d(np.arange(n), [1] if spring else [0, 1])
    return K[np.ix_(free, free)], M[np.ix_(free, free)], free


def modal(spring: float | None) -> str:
    """Four measured modes."""
    K, M, free = matrices(spring)
    values, vectors = eigh(K, M)
    whole, rng = np.zeros((2 * ELEMENTS + 2, MODES)), np.random.default_rng(3)
    whole[free] = vectors[:, :MODES]
    shapes = whole[[2 * (node - 1) for node in NODES]]
    shapes = shapes / np.abs(shapes).max(axis=0) + NOISE * rng.standard_normal(shapes.shape)
    hz = np.sqrt(values[:MODES]) / (2 * np.pi) * (1 + 0.001 * rng.standard_normal(MODES))
    return f"""  modes:
    dofs: [{", ".join(f"{node}TY" for node in NODES)}]
    frequency: {hz.tolist()}
    frequency_sd: 0.1 %
    shapes: {shapes.tolist()}
    shape_sd: {NOISE}
"""


def deck(folder, test: str):
    (folder / "deck.yaml").write_text(HEAD + test)
    return read_deck(str(folder / "deck.yaml"))


def test_a_sound_clamp_is_quiet(tmp_path):
    problem = deck(tmp_path, modal(None))
    assert problem.test.sensors[0] == "1TY" and not problem.test.sensing[[0]].nnz
    assert diagnose(problem).kind == NOTHING


def test_a_soft_clamp_is_named_and_its_deck_reads_its_motion(tmp_path):
    found = diagnose(deck(tmp_path, modal(SPRING)))
    assert found.kind == NAMED and found.best.causes[0].physics == "support-translation"
    size = found.best.causes[0].sizes[0]
    assert abs(size.value - SPRING) < 4 * size.sd < SPRING
    assert found.extended.test.sensing[[0]].nnz == 1 and not found.extended.test.held
    assert not found.extended_result.rejected


def test_such_a_deck_is_written_and_read_again(tmp_path):
    problem = deck(tmp_path, modal(None))
    (tmp_path / "again.yaml").write_text(writer.write(problem)[0])
    again = read_deck(str(tmp_path / "again.yaml")).test
    assert (again.sensors, again.held) == (problem.test.sensors, problem.test.held)


@pytest.fixture(scope="module")
def functions(tmp_path_factory):
    """Accelerances of a beam on a soft clamp, by inverting K (1 + i eta) - omega^2 M: the deck that has it rigid, and them."""
    folder, hz = tmp_path_factory.mktemp("held"), np.arange(5.0, 300.0, 2.0)
    K, M, free = matrices(SPRING)
    at = [free.tolist().index(2 * (node - 1)) for node in NODES]
    H = np.array([-(w**2) * np.linalg.inv(K * (1 + 1j * ETA) - w * w * M)[at, at[-1]] for w in 2 * np.pi * hz])
    names = np.array([f"{node}TY" for node in NODES])
    np.savez(
        folder / "h.npz",
        frequency_hz=hz,
        H=H[:, :, None],
        variance=np.full((*H.shape, 1), 1e-8),
        output_names=names,
        input_names=names[-1:],
        kind=np.array("accelerance"),
    )
    return deck(folder, "  frf: [{file: h.npz}]\n" + modal(SPRING)), H


def test_functions_at_a_soft_clamp_are_those_of_its_motion(functions):
    problem, H = functions
    base = reduced(problem, problem.prior.mean)
    block = lines(problem.frf[0], problem.theory)
    candidate = registry()["support-translation"]
    recipe = candidate.recipes(base, candidate)[0]
    own = damping(base)
    model = FrfModel(replace(base, data=FrfData((block,))), own, (recipe,))
    x = np.zeros(model.k + model.t)
    x[model.of_deck : model.lossy] = (np.log([ETA, 1e-12, 1e-12, 1e-12]) - own.mean) / own.sd
    x[model.k :] = recipe.coordinates(np.array([SPRING]))
    exact = H[np.isin(problem.frf[0].omega, block.omega)]
    found = model.point(x).parts[0].H[:, :, 0]
    assert (np.abs(found - exact).max(axis=0) < 1e-4 * np.abs(exact).max(axis=0)).all()
    rigid = FrfModel(replace(base, data=FrfData((block,))), own).point(np.zeros(model.k)).parts[0].H[:, 0, 0]
    assert not rigid.any()


def test_a_force_that_a_support_takes_is_refused(tmp_path):
    names = np.array(["1TY"])
    np.savez(
        tmp_path / "h.npz",
        frequency_hz=np.arange(1.0, 9.0),
        H=np.ones((8, 1, 1), complex),
        output_names=names,
        input_names=names,
        kind=np.array("accelerance"),
    )
    with pytest.raises(DeckError) as caught:
        deck(tmp_path, "  frf: [{file: h.npz}]\n")
    assert [each.code for each in caught.value.diagnostics] == ["MD328"]


def test_a_recording_at_a_clamp_is_read(tmp_path):
    table = np.random.default_rng(1).standard_normal((64, 3))
    np.savetxt(tmp_path / "r.csv", table, delimiter=",", header="f,a,b", comments="")
    text = "  recordings: [{file: r.csv, sample_rate: 100, inputs: {9TY: f}, outputs: {1TY: a, 5TY: b}}]\n"
    channels = deck(tmp_path, text).recordings[0].channels
    assert [(each.weights, len(each.held)) for each in channels[1:]] == [({0: 0.0}, 1), ({6: 1.0}, 0)]


@pytest.mark.parametrize(("weights", "shown"), [("{1TY: .nan, 5TY: 1}", "1, nan"), ("{1TY: .inf}", "inf")])
def test_a_weight_that_is_no_number_is_refused_where_a_support_holds_too(tmp_path, weights, shown):
    np.savetxt(tmp_path / "r.csv", np.arange(128.0).reshape(64, 2), delimiter=",", header="f,a", comments="")
    sensors = f"  sensors: [{{name: mean, weights: {weights}}}]\n"
    with pytest.raises(DeckError, match=rf"MD328.*its weights are {shown}\b"):
        deck(tmp_path, f"{sensors}  recordings: [{{file: r.csv, sample_rate: 100, outputs: {{mean: a}}}}]\n")

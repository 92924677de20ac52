"""Storeys whose masses are beside their columns, measured along one axis: each shape is there twice, which no chain can have."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import eigh

from mouse_cli.cli.main import _run
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.repeated import repeated
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.formats import read_deck
from mouse_cli.model.modal_test import restricted
from mouse_cli.updating.prior_model import begin, related

N, COUNT, SENSORS = 11, 6, (1, 3, 5, 7, 8, 9, 10, 11)


def modes(k: np.ndarray, m: np.ndarray, arm: float, stiff: float) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies in Hz and shapes along X of floors that sway and turn; arm: of their masses over the radius of gyration."""
    chain = np.diag(k + np.append(k[1:], 0.0)) - np.diag(k[1:], 1) - np.diag(k[1:], -1)
    stiffness, mass = np.kron(np.diag([1.0, stiff]), chain), np.kron([[1.0, arm], [arm, 1 + arm**2]], np.diag(m))
    values, shapes = eigh(stiffness, mass)
    return np.sqrt(values[:COUNT]) / (2 * np.pi), shapes[:N, :COUNT]


def storeys(folder: Path, seed: int, arm: float = 0.7, stiff: float = 2.5) -> str:
    """A deck of the chain alone, with the modes of the floors."""
    rng = np.random.default_rng(seed)
    k, m = 4.5e5 * np.exp(0.2 * rng.standard_normal(N)), 0.8 * np.exp(0.15 * rng.standard_normal(N))
    hz, shapes = modes(k, m, arm, stiff)
    seen = shapes[np.array(SENSORS) - 1] / np.abs(shapes).max(axis=0)
    seen += 0.03 * rng.standard_normal(seen.shape)
    path = folder / "storeys.yaml"
    path.write_text(f"""mouse: 1
title: storeys
model:
  structure:
    nodes: {{line: {{from: 0, to: {N}, start: [0, 0, 0], end: [0, {N}, 0]}}}}
    elements:
      - {{id: 1-{N}, type: spring, nodes: 0-{N}, TX: {k.round(1).tolist()}}}
      - {{id: 101-{100 + N}, type: mass, nodes: 1-{N}, mass: {m.round(5).tolist()}}}
    supports: {{0: all}}
    directions: [TX]
parameters:
  - {{name: k, elements: 1-{N}, property: TX, factor: true, sd: 7 %, transform: log}}
test:
  modes:
    frequency: {hz.round(6).tolist()}
    frequency_sd: 0.5 %
    dofs: [{", ".join(f"{node}TX" for node in SENSORS)}]
    shapes: {seen.round(5).tolist()}
    shape_sd: 3 %
""")
    return str(path)


def answered(deck: str, folder: Path) -> tuple[int, dict]:
    out = folder / "answer.json"
    code = _run(["diagnose", deck, "--candidates", "mass", "-q", "--report", str(out), "--json"])
    return code, json.loads(out.read_text())


@pytest.mark.parametrize("seed", [3, 12, 26])
def test_what_is_left_of_the_test_is_paired_with_the_model(tmp_path, seed):
    """With one mode left out the others were paired otherwise, and the update refused one of them: the diagnosis ended there."""
    problem = read_deck(storeys(tmp_path, seed))
    kept = related(problem)
    assert 2 <= kept.sum() < COUNT
    begin(replace(problem, test=restricted(problem.test, kept)))


def test_modes_that_share_a_shape_are_of_a_motion_that_the_model_lacks(tmp_path):
    """An error of the test, a false mode, was said to have a probability of more than 0.99."""
    code, found = answered(storeys(tmp_path, 3), tmp_path)
    assert (code, found["verdict"]["kind"]) == (1, "unknown")
    (said,) = [text for text in found["cautions"] if "share a shape" in text]
    assert said.startswith("Modes 1 with 2") and "floors that turn" in said
    assert not any("false mode of the identification, of another part" in text for text in found["cautions"])
    assert "error of the test" not in " ".join(found["verdict"]["sentences"])


def test_modes_of_shapes_of_their_own_share_none(tmp_path):
    """Without an arm, and stiff against turning, floors only sway: every mode is one of the model's."""
    deck = read_deck(storeys(tmp_path, 3, arm=0.0, stiff=1e3))
    assert repeated(fit(Model(reduced(deck, deck.prior.mean)), np.zeros(0))) == []


def test_pairs_are_of_one_shape_at_frequencies_apart(tmp_path):
    """Of six modes four are two shapes; of a double mode any two shapes are measured."""
    deck = read_deck(storeys(tmp_path, 3))
    model = reduced(deck, deck.prior.mean)
    assert repeated(fit(Model(model), np.zeros(0))) == [(0, 1), (2, 4)]
    hz = deck.test.frequency_hz.copy()
    hz[1] = 1.01 * hz[0]
    double = fit(Model(model.with_test(replace(deck.test, frequency_hz=hz))), np.zeros(0))
    assert repeated(double) == [(2, 4)]

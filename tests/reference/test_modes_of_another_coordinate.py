"""Storeys whose masses are beside their columns, measured along one axis: each shape is there twice, which no chain can have."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh

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


@pytest.mark.parametrize("seed", [3, 12, 26])
def test_what_is_left_of_the_test_is_paired_with_the_model(tmp_path, seed, arm=0.7, stiff=2.5):
    """With one mode left out the others were paired otherwise, and the update refused one of them: the diagnosis ended there."""
    rng = np.random.default_rng(seed)
    k, m = 4.5e5 * np.exp(0.2 * rng.standard_normal(N)), 0.8 * np.exp(0.15 * rng.standard_normal(N))
    hz, shapes = modes(k, m, arm, stiff)
    seen = shapes[np.array(SENSORS) - 1] / np.abs(shapes).max(axis=0)
    seen += 0.03 * rng.standard_normal(seen.shape)
    path = tmp_path / "storeys.yaml"
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
    problem = read_deck(str(path))
    kept = related(problem)
    assert 2 <= kept.sum() < COUNT
    begin(replace(problem, test=restricted(problem.test, kept)))

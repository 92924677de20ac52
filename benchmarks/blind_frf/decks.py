"""A case as a deck with a file of functions, and an answer that the tool never reads."""

import hashlib
from pathlib import Path

import numpy as np

from benchmarks.blind_frf.cases import DENSITY, ELEMENTS, Case, E, measured


def write(folder: Path, case: Case, words: tuple) -> tuple[Path, dict]:
    """The deck of one test of `case`, and its answer; `words` seed the noise."""
    name = hashlib.sha256(repr((case.name, *words)).encode()).hexdigest()[:10]
    test = measured(case, words)
    node = lambda x: int(np.rint(x / case.nominal.length * ELEMENTS)) + 1
    np.savez(
        folder / f"{name}.npz",
        frequency_hz=test.frequency_hz,
        H=test.H[:, :, None],
        variance=test.variance[:, :, None],
        output_names=np.array([f"{node(x)}TY" for x in case.sensors]),
        input_names=np.array([f"{node(case.force)}TY"]),
        kind=np.array("receptance"),
    )
    path = folder / f"{name}.yaml"
    path.write_text(_deck(name, case))
    known = {
        "name": case.name,
        "truth": case.truth,
        "group": case.group,
        "law": case.law,
        "place": None if np.isnan(case.x) else case.x,
        "span": case.nominal.length,
    }
    return path, known


def _deck(name: str, case: Case) -> str:
    beam, n = case.nominal, ELEMENTS
    supports = f"{{1: [TX, TY], {n + 1}: [TY]}}" if beam.ends[0] == "pinned" else "{1: all}"
    return f"""\
mouse: 1
title: {name}
model:
  structure:
    nodes: {{line: {{from: 1, to: {n + 1}, start: [0, 0, 0], end: [{beam.length}, 0, 0]}}}}
    materials: {{steel: {{E: {E}, nu: 0.3, density: {DENSITY}, loss_factor: {beam.eta}}}}}
    sections: {{bar: {{rectangle: [{case.height}, {case.height}]}}}}
    elements:
      - {{id: 1-{n}, type: beam, nodes: 1-{n + 1}, material: steel, section: bar}}
    supports: {supports}
    plane: XY
parameters:
  - {{name: E, elements: 1-{n}, property: E, sd: 5 %, transform: log}}
  - {{name: density, elements: 1-{n}, property: density, sd: 2 %, transform: log}}
test:
  frf: [{{file: {name}.npz}}]
"""

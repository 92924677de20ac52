"""Stay cables whose tension is another than modelled: frequencies and shapes of a pinned beam under tension in closed form."""

import json

import numpy as np
import pytest

from mouse_cli.cli.main import _run
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.formats import read_deck

L, EI, MU, T = 62.0, 1.05e6, 74.0, 2.95e6
SENSORS = (2, 4, 7, 9, 12, 15, 18, 20)


def cable(folder, share: float) -> str:
    """A deck of the cable as it was designed, with the modes of one that has that share of the tension."""
    rng, n, x = np.random.default_rng(4), np.arange(1, 7), (np.array(SENSORS) - 1) / 20
    wave = n * np.pi / L
    hz = np.sqrt((share * T * wave**2 + EI * wave**4) / MU) / (2 * np.pi) * (1 + 0.001 * rng.standard_normal(6))
    shapes = np.sin(np.pi * np.outer(x, n)) + 0.01 * rng.standard_normal((len(SENSORS), 6))
    path = folder / "cable.yaml"
    path.write_text(f"""\
mouse: 1
title: A stay cable
units: SI
model:
  structure:
    nodes: [{{line: {{from: 1, to: 21, start: [0, 0], end: [{L}, 0]}}}}]
    elements: [{{id: 1-20, type: beam, nodes: 1-21, E: 2.0e+11, A: 9.4e-3, Iz: {EI / 2e11}, density: {MU / 9.4e-3}, preload: {T}}}]
    supports: {{1: [TX, TY], 21: [TX, TY]}}
    plane: XY
parameters: [{{name: E, elements: 1-20, property: E, sd: 10 %}}]
test:
  modes:
    dofs: [{", ".join(f"{node}TY" for node in SENSORS)}]
    frequency: {hz.round(5).tolist()}
    frequency_sd: 0.1 %
    shapes: {shapes.round(4).tolist()}
    shape_sd: 1 %
""")
    return str(path)


@pytest.mark.parametrize(("candidate", "share"), [("compression", 0.84), ("tension", 1.2)])
def test_the_tension_of_a_cable_is_a_rival_of_its_mass(tmp_path, candidate, share):
    """T over mu is all that modes tell: either may be wrong. EI / L^2 is a ten-thousandth of the tension."""
    out = tmp_path / "answer.json"
    _run(["diagnose", cable(tmp_path, share), "--candidates", f"{candidate},added-mass,lighter", "-q", "--report", str(out)])
    found = json.loads(out.read_text())
    (own,) = (each for each in found["candidates"] if each["physics"] == candidate)
    (force,) = own["parameters"]
    assert own["probability"] > 0.05 and abs(force["value"] - abs(1 - share) * T) < 3 * force["sd"]


def test_a_beam_without_tension_is_looked_at_as_ever(tmp_path):
    deck = read_deck(cable(tmp_path, 1.0))
    path = tmp_path / "cable.yaml"
    path.write_text(path.read_text().replace(f"preload: {T}", "preload: -1.0e+2"))
    pulled, plain = (registry()["tension"].recipes(reduced(each, each.prior.mean), None)[0] for each in (deck, read_deck(path)))
    assert plain.unknowns[0].upper == pytest.approx(30 * EI / L**2)
    assert pulled.unknowns[0].upper == pytest.approx(30 * (EI / L**2 + T / np.pi**2))

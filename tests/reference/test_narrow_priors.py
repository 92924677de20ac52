"""A girder whose modulus is further from its value in the deck than the prior allows; frequencies by the closed form."""

import numpy as np
import pytest

from mouse_cli.diagnosis import diagnose
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import NOTHING, Choices

L, E, I, A, RHO, N = 30.0, 2.1e11, 1.6e-3, 3e-2, 7850.0, 16
NODES = range(3, 17, 2)


def deck(share: float, sd: str) -> str:
    """Pinned girder with E times `share`: f_n = n^2 pi / (2 L^2) sqrt(EI / (rho A)), sin(n pi x / L)."""
    rng, n = np.random.default_rng(4), np.arange(1, 7)
    hz = n**2 * np.pi / (2 * L**2) * np.sqrt(share * E * I / (RHO * A)) * (1 + 0.002 * rng.standard_normal(6))
    x = (np.array(NODES) - 1) / N
    shapes = np.sin(np.pi * x[:, None] * n) + 0.01 * rng.standard_normal((len(x), 6))
    rows = "\n".join(f"      - [{', '.join(f'{v:.5f}' for v in row)}]" for row in shapes)
    return f"""\
mouse: 1
model:
  structure:
    nodes: {{line: {{from: 1, to: {N + 1}, start: [0, 0], end: [{L}, 0]}}}}
    elements:
      - {{id: 1-{N}, type: beam, nodes: 1-{N + 1}, E: {E}, G: 8.0e+10, density: {RHO}, A: {A}, Iy: 1.0e-4, Iz: {I}, J: 1.0e-5}}
    supports: {{1: [TX, TY], {N + 1}: [TY]}}
    plane: XY
parameters:
  - {{name: E, elements: 1-{N}, property: E, sd: {sd}}}
test:
  modes:
    frequency: [{", ".join(f"{f:.6g}" for f in hz)}]
    frequency_sd: 0.2 %
    dofs: [{", ".join(f"{node}TY" for node in NODES)}]
    shapes:
{rows}
    shape_sd: 0.01
"""


def answer(share: float, sd: str):
    problem = assemble(yaml_deck.read(deck(share, sd), "deck.yaml"))
    return diagnose(problem, choices=Choices(("added-mass", "ground-spring"), causes=1))


def test_a_parameter_beyond_its_prior_is_said_beside_what_would_explain_it():
    found = answer(0.88, "2 %")
    assert found.kind != NOTHING
    (said,) = [each for each in found.cautions if "prior may be too narrow" in each]
    value, shift = float(said.split("'E' at ")[1].split()[0]), float(said.split("(")[2].split()[0])
    assert value == pytest.approx(0.88 * E, rel=0.01) and shift == pytest.approx(-6, abs=0.5)


@pytest.mark.proof
def test_a_prior_that_holds_the_value_leaves_nothing_to_say():
    found = answer(0.88, "10 %")
    assert (found.kind, found.cautions) == (NOTHING, ())

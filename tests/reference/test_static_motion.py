"""What a large model keeps of static motion is the same whatever parameters it was asked at first."""

import numpy as np
import pytest

from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.reduced import WHOLE
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble

DECK = """\
mouse: 1
model:
  structure:
    nodes:
POINTS
      40: [9.5, 1.0, 0.4]
    elements:
      - {id: 1-38, nodes: 1-39, type: beam, E: 2.1e+11, G: 8.0e+10, density: 7850, A: 4.0e-3, Iy: 1.6e-6, Iz: 2.6e-6, J: 3.0e-6}
      - {id: 39, nodes: [39, 40], type: beam, E: 2.1e+11, G: 8.0e+10, density: 7850, A: 4.0e-3, Iy: 1.6e-6, Iz: 2.6e-6, J: 3.0e-6}
    supports: {1: all}
parameters:
  - {name: line, elements: 1-38, property: E, sd: 20 %, transform: log}
  - {name: twist, elements: 1-38, property: G, sd: 20 %, transform: log}
  - {name: arm, elements: 39, property: E, sd: 20 %, transform: log}
test:
  modes: {frequency: [0.4, 0.6, 2.6], frequency_sd: 0.2 %}
""".replace("POINTS", "\n".join(f"      {i + 1}: [{i / 4}, 0, 0]" for i in range(39)))


def changes(candidate: str, first: tuple[float, ...]) -> list[np.ndarray]:
    """What a candidate adds to K at each of its sites, softer line and stiffer arm, of a model that was asked at `first`."""
    problem = assemble(yaml_deck.read(DECK, "deck.yaml"))
    model = reduced(problem, problem.prior.mean)
    assert model.r < WHOLE < len(model.V)
    model.at(problem.prior.mean * first).recipes(registry()[candidate])
    found = model.at(problem.prior.mean * (0.7, 0.8, 1.4)).recipes(registry()[candidate])
    return [each.change(values).K for each in found for values in each.grid]


@pytest.mark.parametrize("candidate", ["member", "stiffness-gain", "joint", "turned-section"])
def test_what_is_kept_is_the_same_whoever_asks_first(candidate):
    one, other = (changes(candidate, first) for first in ((0.7, 0.8, 1.4), (1.5, 1.3, 0.6)))
    there = [(a, b) for a, b in zip(one, other, strict=True) if a is not None]
    assert there and all(np.array_equal(a, b) for a, b in there)

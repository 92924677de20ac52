"""What a coarse mesh does to frequencies is allowed for in models of any size; truth in closed form, and by Hermite elements."""

from dataclasses import replace

import numpy as np
import pytest

from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.numerics import numerics
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble

E, A, RHO, I, SPAN = 2.1e11, 4e-3, 7850.0, 2.0e-6, 2.0
HALVED = 2.596e-4 - 3.939e-3  # ln f over the closed form, by four and by two Hermite elements in a span, solved apart


@pytest.mark.parametrize("spans", [4, 90])
def test_a_beam_over_many_supports_with_two_elements_in_each_span(spans):
    """Its lowest mode is that of a single span on two supports, alternately up and down: f = pi / 2 sqrt(EI / rho A) / l^2."""
    last = 2 * spans + 1
    supports = ", ".join(f"{node}: [TX, TY]" for node in range(1, last + 1, 2))
    exact = np.pi / 2 * np.sqrt(E * I / (RHO * A)) / SPAN**2
    text = f"""\
mouse: 1
model:
  structure:
    nodes: {{line: {{from: 1, to: {last}, start: [0, 0], end: [{spans * SPAN}, 0]}}}}
    elements:
      - {{id: 1-{last - 1}, type: beam, nodes: 1-{last}, E: {E}, A: {A}, density: {RHO}, Iz: {I}}}
    supports: {{{supports}}}
    plane: XY
parameters:
  - {{name: E, elements: 1-{last - 1}, property: E, sd: 2 %}}
test:
  modes: {{frequency: [{exact}], frequency_sd: 0.1 %}}
"""
    problem = assemble(yaml_deck.read(text, "beam.yaml"))
    found = numerics(problem, problem.prior.mean, np.array([0]), np.array([1e-3]))
    assert found.moved[0] == pytest.approx(HALVED, rel=0.01)
    assert "a finer mesh would be better" in found.remarks[0]
    corrected = numerics(problem, problem.prior.mean, np.array([0]), np.array([1e-3]), corrects=True).finer
    model = replace(reduced(problem, problem.prior.mean), finer=corrected)
    rates, _ = model.refined(model.eigenvalues, np.eye(model.r))
    assert 0.5 * np.log(rates[0]) - np.log(2 * np.pi * exact) == pytest.approx(0.0, abs=0.1 * abs(HALVED))

"""Supports that resist turning where the model pins them, by the closed form of a beam and beside OpenSees.

A beam on two pins whose first resists turning by k: c (cot x - coth x) = 2 x, c = k L / EI, x^4 = omega^2 m L^4 / EI (from
w = A sin + B cos + C sinh + D cosh, w(0) = w(1) = w''(1) = 0 and EI w''(0) = k w'(0); c without end is the clamped and
pinned beam).
"""

import numpy as np
import pytest
from scipy.optimize import brentq

import mouse_cli
from benchmarks.blind.case import generator
from benchmarks.blind.space import frames, opensees
from mouse_cli.diagnosis.effects.restraints import turns
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import WHOLE
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble

E, A, I, RHO, L, ELEMENTS = 2.1e11, 6e-4, 4.5e-8, 7850.0, 2.0, 20
C, SENSORS, MODES = 3.0, (3, 6, 9, 12, 15, 18), 5


def closed_form() -> tuple[np.ndarray, np.ndarray]:
    """Frequencies in Hz (m,) and shapes (s, m) at SENSORS."""
    ends = [((n + 1) * np.pi + 1e-6, (n + 1.25) * np.pi + 1e-3) for n in range(MODES)]
    x = np.array([brentq(lambda x: C * (1 / np.tan(x) - 1 / np.tanh(x)) - 2 * x, *each) for each in ends])
    at = (np.array(SENSORS) - 1)[:, None] / ELEMENTS * x
    shapes = -np.sin(at) / np.tan(x) + np.cos(at) + np.sinh(at) / np.tanh(x) - np.cosh(at)
    return x**2 * np.sqrt(E * I / (RHO * A * L**4)) / (2 * np.pi), shapes / np.abs(shapes).max(axis=0)


def beam() -> str:
    hz, shapes = closed_form()
    rng = np.random.default_rng(7)
    hz = hz * (1 + 0.001 * rng.standard_normal(MODES))
    shapes = shapes + 0.01 * rng.standard_normal(shapes.shape)
    rows = "\n".join(f"      - [{', '.join(f'{x:.5f}' for x in row)}]" for row in shapes)
    return f"""\
mouse: 1
model:
  structure:
    nodes: {{line: {{from: 1, to: {ELEMENTS + 1}, start: [0, 0], end: [{L}, 0]}}}}
    materials: {{steel: {{E: {E}, nu: 0.3, density: {RHO}}}}}
    sections: {{bar: {{A: {A}, Iz: {I}, Iy: {I}, J: {2 * I}}}}}
    elements:
      - {{id: 1-{ELEMENTS}, type: beam, nodes: 1-{ELEMENTS + 1}, material: steel, section: bar}}
    supports: {{1: [TX, TY], {ELEMENTS + 1}: [TX, TY]}}
    plane: XY
parameters:
  - {{name: E, material: steel, property: E, sd: 3 %, transform: log}}
test:
  modes:
    frequency: [{", ".join(f"{x:.6g}" for x in hz)}]
    frequency_sd: 0.1 %
    dofs: [{", ".join(f"{node}TY" for node in SENSORS)}]
    shapes:
{rows}
    shape_sd: 0.01
"""


def test_a_pin_that_resists_turning_is_named_with_its_stiffness(tmp_path):
    """In one group with a spring close to the pin: the two make the same couple."""
    path = tmp_path / "beam.yaml"
    path.write_text(beam())
    found = mouse_cli.diagnose(mouse_cli.read_deck(str(path)))
    assert (found.kind, found.best.physics, found.best.group) == ("named", "support-restraint", "ground-spring")
    (cause,) = found.best.causes
    (size,) = cause.sizes
    assert cause.site.ids == (1,)
    assert size.value == pytest.approx(C * E * I / L, abs=3 * size.sd) and size.sd < 0.15 * size.value


def test_a_direction_that_a_deck_leaves_out_makes_no_supports():
    """All nodes are held along the beam: those between the pins stand on nothing that may resist their turns."""
    text = beam().replace("supports: {1", f"supports: {{2-{ELEMENTS}: [TX], 1")
    problem = assemble(yaml_deck.read(text, "beam.yaml"))
    found = turns(reduced(problem, problem.prior.mean))
    assert sorted(node for node, _ in found.free) == [0, ELEMENTS]


def test_resisting_feet_of_a_reduced_frame_beside_opensees():
    """Each about both axes by its own stiffness, one alone and all alike."""
    pytest.importorskip("openseespy")
    rng = generator("test", "pinned frame", 1)
    found = next(one for one in iter(lambda: frames.drawn(rng), None) if 6 * (len(one.points) - len(one.feet)) > WHOLE)
    inputs = found.inputs(rng) | {"E": frames.E, "density": frames.DENSITY}
    EI_L = frames.E * found.sections[0, 1] / float(found.lengths[0])
    turned = lambda k: [[foot, 4 + d, k.get((foot, d), 1e-3)] for foot in found.feet for d in (0, 1)]
    sound = opensees.modes(inputs | {"springs": turned({})}, 8)[0]
    text = "mouse: 1\n" + frames.deck(found).replace(": all", ": [TX, TY, TZ, RZ]")
    hz = ", ".join(f"{f:g}" for f in sound[:3])
    test = f"test:\n  modes: {{number: [1, 2, 3], frequency: [{hz}], frequency_sd: 0.2 %}}\n"
    problem = assemble(yaml_deck.read(text + test, "deck.yaml"))
    model = reduced(problem, problem.prior.mean)
    assert model.r < WHOLE < len(model.V)
    recipes = registry()["support-restraint"].recipes(model, registry()["support-restraint"])
    feet = found.feet[:1], found.feet
    for own in feet:
        k = {(foot, d): EI_L * (2.0, 8.0)[d] for foot in own for d in (0, 1)}
        true = opensees.modes(inputs | {"springs": turned(k)}, 8)[0] / sound
        recipe = next(
            each
            for each in recipes
            if each.site(each.grid[0]).ids == tuple(foot + 1 for foot in own) and len(each.unknowns) == 2
        )
        values = [EI_L * (2.0 if u.name.endswith("RX") else 8.0) for u in recipe.unknowns]
        at = Model(model, (recipe,)).point(np.append(model.z, recipe.coordinates(np.array(values))))
        said = np.sqrt(at.eigenvalues[:8] / model.eigenvalues[:8])
        assert said == pytest.approx(true, abs=0.03 * np.abs(true - 1).max() + 1e-4)

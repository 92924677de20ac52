"""One wrong entry of a test: a frequency that was misread, a shape that is no mode's, on a pinned beam in closed form."""

import numpy as np
import pytest

import mouse_cli
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

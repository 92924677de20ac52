"""A mount whose stiffness depends on frequency: exact modes by fixed-point iteration on Hermite elements that are written here."""

import numpy as np
import pytest
from proofs import proofs
from scipy.linalg import eigh

from mouse_cli.diagnosis import diagnose
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import LAW, NAMED, UNKNOWN, Choices
from mouse_cli.report.verdict_sentences import sentences

LENGTH, EI, LINE_MASS, FINE, COARSE, MODES = 2.0, 2000.0, 3.0, 120, 30, 6
SENSORS = range(3, 31, 2)
K0 = 30 * EI / LENGTH**3
STATIC = 3 * EI  # over the cube of the distance from the clamp: the stiffness of a cantilever where a mount is


def truth(law, at: float) -> tuple[np.ndarray, np.ndarray]:
    """Hz (m,) and deflections (121, m) of a cantilever with a spring law(hz) to the ground at a share of its length."""
    l = LENGTH / FINE
    unit = np.outer([1, l, 1, l], [1, l, 1, l])
    k = EI / l**3 * unit * np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])
    m = LINE_MASS * l / 420 * unit
    m = m * np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]])
    K, M = np.zeros((2, 2 * FINE + 2, 2 * FINE + 2))
    for e in range(FINE):
        own = slice(2 * e, 2 * e + 4)
        K[own, own] += k
        M[own, own] += m
    spring = np.zeros(2 * FINE + 2)
    spring[2 * round(at * FINE)] = 1.0
    hz, shapes = np.zeros(MODES), np.zeros((2 * FINE + 2, MODES))
    for i in range(MODES):
        d = law(10.0)
        for _ in range(200):
            added = K + d * np.outer(spring, spring)
            lam, X = eigh(added[2:, 2:], M[2:, 2:], subset_by_index=[0, MODES])
            hz[i], shapes[2:, i] = np.sqrt(lam[i]) / (2 * np.pi), X[:, i]
            last, d = d, law(hz[i])
            if abs(d - last) < 1e-10 * d:
                break
    return hz, shapes[::2]


def diagnosed(hz: np.ndarray, shapes: np.ndarray, names: tuple[str, ...]):
    """What mouse says of a cantilever without its mount."""
    rng = np.random.default_rng(1)
    rows = shapes[[s * FINE // COARSE for s in SENSORS]]
    rows = rows / np.abs(rows).max(axis=0) + 0.01 * rng.standard_normal(rows.shape)
    hz = hz * (1 + 1e-3 * rng.standard_normal(MODES))
    told = "\n".join(f"      - [{', '.join(f'{value:.4f}' for value in row)}]" for row in rows)
    deck = f"""mouse: 1
model:
  structure:
    nodes: {{line: {{from: 0, to: {COARSE}, start: [0, 0], end: [{LENGTH}, 0]}}}}
    elements:
      - {{id: 1-{COARSE}, type: beam, nodes: 0-{COARSE}, E: 2.0e11, nu: 0.3, density: {LINE_MASS / 4e-4}, A: 4.0e-4, Iz: 1.0e-8}}
    supports: {{0: all}}
    plane: XY
parameters:
  - {{name: E, elements: 1-{COARSE}, property: E, sd: 3 %}}
test:
  modes:
    frequency: [{", ".join(f"{value:.6f}" for value in hz)}]
    frequency_sd: 0.1 %
    dofs: [{", ".join(f"{s}TY" for s in SENSORS)}]
    shapes:
{told}
    shape_sd: 1 %
"""
    return diagnose(assemble(yaml_deck.read(deck, "mount.yaml")), choices=Choices(names, causes=2))


NAMES = ("ground-spring", "oscillator", "mass", "foundation")
LAWS = {
    "stiffer with frequency": lambda hz: K0 * hz / 20,
    "an elastomer that stiffens towards a plateau": lambda hz: K0 * (1 + 3 * (hz / 40) ** 2 / (1 + (hz / 40) ** 2)),
    "softer with frequency": lambda hz: K0 * 10 / (1 + hz / 20),
}


@pytest.mark.parametrize("name", proofs(LAWS, "softer with frequency"))
def test_a_mount_that_depends_on_frequency_is_a_law_at_its_place(name):
    """Neither a spring with an oscillator at the same place, which can do nearly the same, nor a field along the structure."""
    law, at = LAWS[name], 0.6
    hz, shapes = truth(law, at)
    found = diagnosed(hz, shapes, NAMES)
    assert (found.kind, found.field.property, len(found.field.values)) == (UNKNOWN, LAW, MODES)
    assert found.field.log_evidence_over_named > 3
    assert all(abs(each.site.position[0] / LENGTH - at) < 0.02 for each in found.field.values)
    value, sd = np.array([(each.value, each.sd) for each in found.field.values]).T
    true = law(hz) / (STATIC / (at * LENGTH) ** 3)
    assert (np.abs(value - true)[:3] < 3 * np.hypot(sd, 0.02 * true)[:3]).all()  # higher modes hardly feel it
    assert "by a law that is in no library" in " ".join(sentences(found))
    assert found.extended is None


def test_a_constant_mount_keeps_its_name():
    """A spring says with one value what a law says with six."""
    found = diagnosed(*truth(lambda hz: K0, 0.6), NAMES)
    assert (found.kind, found.best.physics) == (NAMED, "ground-spring")
    assert dict(found.groups).get("law", 0.0) < 0.05


@pytest.mark.proof
def test_a_mass_keeps_its_name():
    """Its law, -m lambda, is one value too."""
    mass = 0.05 * LINE_MASS * LENGTH
    hz, shapes = truth(lambda hz: -mass * (2 * np.pi * hz) ** 2, 0.6)
    found = diagnosed(hz, shapes, NAMES)
    assert (found.kind, found.best.physics) == (NAMED, "mass")

"""Where a mechanism acts, told by what the deck holds out: a mass on an arm of a mast, truth by OpenSees."""

import numpy as np
import pytest

import mouse_cli
from mouse_cli.model.diagnosis import Choices

E, NU, RHO, A, I, STEP, LAST = 2.1e11, 0.3, 7850.0, 8e-3, 4e-4, 4.0, 13
GUYS = {6: 2.2e5, 11: 1.5e5}  # N/m along X and along Y, by node
NODE, ARM, MASS, TOP = 11, (0.0, 1.5, 0.0), 90.0, 150.0
FITTED, KEPT, PIECES = 7, 9, 4
SENSORS = [f"{node}T{d}" for node, d in zip(range(2, LAST + 1), "XYYXXYXYYXXY", strict=True)]


def truth() -> tuple[np.ndarray, np.ndarray]:
    """Frequencies (KEPT,) in Hz and shapes (s, KEPT) at SENSORS."""
    import openseespy.opensees as ops

    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    ops.geomTransf("Linear", 1, 1.0, 0.0, 0.0)
    G, count = E / (2 * (1 + NU)), PIECES * (LAST - 1)
    number = lambda node: PIECES * (node - 1) + 1
    for n in range(count + 1):
        ops.node(n + 1, 0.0, 0.0, STEP * n / PIECES)
    for n in range(count):
        ops.element("elasticBeamColumn", n + 1, n + 1, n + 2, A, E, G, 2 * I, I, I, 1, "-mass", RHO * A, "-cMass")
    ops.fix(1, *[1] * 6)
    for n, (node, k) in enumerate(GUYS.items()):
        for d in (1, 2):
            ground, key = 500 + 2 * n + d, 900 + 2 * n + d
            ops.node(ground, 0.0, 0.0, STEP * (node - 1))
            ops.fix(ground, *[1] * 6)
            ops.uniaxialMaterial("Elastic", key, k)
            ops.element("zeroLength", key, ground, number(node), "-mat", key, "-dir", d)
    ops.mass(number(LAST), TOP, TOP, TOP, 0.0, 0.0, 0.0)
    ops.node(400, *(np.array([0.0, 0.0, STEP * (NODE - 1)]) + ARM).tolist())
    ops.mass(400, MASS, MASS, MASS, 0.0, 0.0, 0.0)
    ops.rigidLink("beam", number(NODE), 400)
    ops.constraints("Transformation")
    rates = np.array(ops.eigen("-genBandArpack", KEPT))
    read = lambda dof, m: ops.nodeEigenvector(number(int(dof[:-2])), m + 1, "XYZ".index(dof[-1]) + 1)
    shapes = np.array([[read(dof, m) for m in range(KEPT)] for dof in SENSORS])
    ops.wipe()
    return np.sqrt(rates) / (2 * np.pi), shapes / np.abs(shapes).max(axis=0)


def deck() -> str:
    hz, shapes = truth()
    rng = np.random.default_rng(20)
    hz = hz * (1 + 0.002 * rng.standard_normal(KEPT))
    shapes = shapes + 0.02 * rng.standard_normal(shapes.shape)
    rows = "\n".join(f"      - [{', '.join(f'{x:.5f}' for x in row)}]" for row in shapes)
    guys = "\n".join(
        f"      - {{id: {30 + 2 * n + d}, type: spring, nodes: [{node}], T{'XY'[d]}: {k}}}"
        for n, (node, k) in enumerate(GUYS.items())
        for d in (0, 1)
    )
    return f"""\
mouse: 1
model:
  structure:
    nodes: {{line: {{from: 1, to: {LAST}, start: [0, 0, 0], end: [0, 0, {STEP * (LAST - 1)}]}}}}
    materials: {{steel: {{E: {E}, nu: {NU}, density: {RHO}}}}}
    sections: {{tube: {{A: {A}, Iy: {I}, Iz: {I}, J: {2 * I}}}}}
    elements:
      - {{id: 1-{LAST - 1}, type: beam, nodes: 1-{LAST}, material: steel, section: tube}}
      - {{id: 41, type: mass, nodes: [{LAST}], mass: {TOP}}}
{guys}
    supports: {{1: all}}
parameters:
  - {{name: E, material: steel, property: E, sd: 5 %, transform: log}}
test:
  modes:
    number: {list(range(1, KEPT + 1))}
    frequency: [{", ".join(f"{x:.7g}" for x in hz)}]
    frequency_sd: 0.2 %
    dofs: [{", ".join(SENSORS)}]
    shapes:
{rows}
    shape_sd: 2 %
  hold_out:
    modes: {list(range(FITTED + 1, KEPT + 1))}
"""


@pytest.mark.proof
def test_a_mass_on_an_arm_is_at_the_node_that_predicts_what_is_held_out(tmp_path):
    """From the next node an arm of 4 m along the mast reaches as far: what was fitted hardly tells them apart, modes 8 and 9 do."""
    pytest.importorskip("openseespy")
    path = tmp_path / "mast.yaml"
    path.write_text(deck())
    problem = mouse_cli.read_deck(str(path))
    found = mouse_cli.diagnose(problem, choices=Choices(candidates=("eccentric-mass", "mass", "oscillator")))
    (cause,) = found.best.causes
    assert (found.kind, found.best.physics, cause.site.ids) == ("named", "eccentric-mass", (NODE,))
    sizes = {size.name: size for size in cause.sizes}
    assert sizes["mass"].value == pytest.approx(MASS, abs=3 * sizes["mass"].sd)
    assert abs(sizes["arm along Y"].value) == pytest.approx(ARM[1], abs=3 * sizes["arm along Y"].sd)

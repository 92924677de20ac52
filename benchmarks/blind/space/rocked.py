"""Storey buildings on a foundation that rocks, by OpenSees: columns guided by floors that all turn with the foundation."""

import numpy as np

_E = 3e10


def make(inputs: dict) -> dict[str, np.ndarray]:
    """Frequencies, shapes (n, n) of the floors along x, frequencies with the added mass."""
    node, kg = inputs["added"]
    m = inputs["m"].copy()
    m[node - 1] += kg
    frequency, shapes = modes(inputs)
    return {"frequency": frequency, "shapes": shapes, "altered": modes(inputs | {"m": m})[0]}


def modes(inputs: dict) -> tuple[np.ndarray, np.ndarray]:
    """Of n floors; turning: N m/rad of the foundation, 0: rigid. Floors have the inertia of slabs of a width."""
    import openseespy.opensees as ops

    heights, n = inputs["heights"], len(inputs["m"])
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("Linear", 1)
    for i, z in enumerate(np.concatenate([[0.0], np.cumsum(heights)]).tolist()):
        ops.node(i + 1, 0.0, z)
    ops.fix(1, 1, 1, int(not inputs["turning"]))
    for i, (h, k, m) in enumerate(zip(heights, inputs["k"], inputs["m"], strict=True), 1):
        ops.element("elasticBeamColumn", i, i, i + 1, 1.0, _E, k * h**3 / (12 * _E), 1)
        ops.mass(i + 1, m, 0.0, m * inputs["width"] ** 2 / 12)
        ops.fix(i + 1, 0, 1, int(not inputs["turning"]))
        if inputs["turning"]:
            ops.equalDOF(1, i + 1, 3)
    if inputs["turning"]:
        ops.node(n + 2, 0.0, 0.0)
        ops.fix(n + 2, 1, 1, 1)
        ops.uniaxialMaterial("Elastic", 1, float(inputs["turning"]))
        ops.element("zeroLength", n + 1, n + 2, 1, "-mat", 1, "-dir", 3)
    rates = np.array(ops.eigen("-fullGenLapack", n))
    shapes = np.array([[ops.nodeEigenvector(i + 2, j + 1, 1) for i in range(n)] for j in range(n)])
    ops.wipe()
    return np.sqrt(rates) / (2 * np.pi), shapes

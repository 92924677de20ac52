"""Modes of space frames by OpenSees: elastic beams with consistent mass, several to a member."""

from itertools import pairwise

import numpy as np

PIECES = 3  # elements of a member


def make(inputs: dict) -> dict[str, np.ndarray]:
    """Frequencies, shapes (count, 3 k) at the k free nodes of the deck, frequencies with the added mass."""
    node, kg = inputs["added"]
    frequency, shapes = modes(inputs, inputs["count"])
    altered = inputs | {"masses": [*inputs["masses"], [node, [0.0, 0.0, 0.0], kg]]}
    return {"frequency": frequency, "shapes": shapes, "altered": modes(altered, inputs["count"])[0]}


def modes(inputs: dict, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies (count,) in Hz and shapes (count, 3 k), x, y and z at the k nodes that are no feet.

    factors: {member: [of A, Iy, Iz and J, of its mass]}; springs: [[node, direction 1 to 6, N/m], ...] to the ground,
    by which feet are freed;
    struts: [[node, node, EA], ...] without mass; masses: [[node, arm, kg], ...] on rigid arms.
    """
    import openseespy.opensees as ops

    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    points = np.array(inputs["points"])
    for n, xyz in enumerate(points.tolist(), 1):
        ops.node(n, *xyz)
        if kg := inputs["kg"][n - 1]:
            ops.mass(n, kg, kg, kg, 0.0, 0.0, 0.0)
    _members(ops, inputs, points)
    last = _attached(ops, inputs, points)
    freed = {(node, direction) for node, direction, _ in inputs["springs"]}
    for node in inputs["feet"]:
        ops.fix(node + 1, *(int((node, d) not in freed) for d in range(1, 7)))
    for i, (node, direction, k) in enumerate(inputs["springs"]):
        ground = last + 1 + i
        ops.node(ground, *points[node].tolist())
        ops.fix(ground, *[1] * 6)
        ops.uniaxialMaterial("Elastic", 1 + i, float(k))
        ops.element("zeroLength", 10**6 + i, ground, node + 1, "-mat", 1 + i, "-dir", direction)
    rates = np.array(ops.eigen("-genBandArpack", count))
    free = [n for n in range(len(points)) if n not in set(inputs["feet"])]
    shapes = [[ops.nodeEigenvector(n + 1, m + 1, d) for n in free for d in (1, 2, 3)] for m in range(count)]
    ops.wipe()
    return np.sqrt(rates) / (2 * np.pi), np.array(shapes)


def _members(ops, inputs: dict, points: np.ndarray) -> None:
    """Members of PIECES elements each; node numbers after those of the deck."""
    E, density = inputs["E"], inputs["density"]
    G = E / (2 * (1 + inputs["nu"]))
    ops.geomTransf("Linear", 1, 1.0, 0.0, 0.0)  # upright members
    ops.geomTransf("Linear", 2, 0.0, 0.0, 1.0)  # others
    node, element = len(points), 0
    for number, ((a, b), s) in enumerate(zip(inputs["members"], inputs["section"], strict=True)):
        stiff, heavy = inputs["factors"].get(str(number), (1.0, 1.0))
        A, I, J = inputs["sections"][s]
        along = points[b] - points[a]
        turned = 1 if abs(along[2]) > 0.9 * np.linalg.norm(along) else 2
        inner = list(range(node + 1, node + PIECES))
        node += PIECES - 1
        for n, share in zip(inner, np.arange(1, PIECES) / PIECES, strict=True):
            ops.node(n, *(points[a] + share * along).tolist())
        chain = [a + 1, *inner, b + 1]
        for i, j in pairwise(chain):
            element += 1
            values = [stiff * A, E, G, stiff * J, stiff * I, stiff * I]
            ops.element("elasticBeamColumn", element, i, j, *values, turned, "-mass", heavy * density * A, "-cMass")


def _attached(ops, inputs: dict, points: np.ndarray) -> int:
    """Struts, and masses on rigid arms; the last number of a node."""
    last = len(points) + (PIECES - 1) * len(inputs["members"])
    for i, (a, b, EA) in enumerate(inputs["struts"]):
        ops.uniaxialMaterial("Elastic", 5 * 10**5 + i, float(EA))
        ops.element("Truss", 5 * 10**5 + i, a + 1, b + 1, 1.0, 5 * 10**5 + i)
    for node, arm, kg in inputs["masses"]:
        last += 1
        ops.node(last, *(points[node] + arm).tolist())
        ops.mass(last, kg, kg, kg, 0.0, 0.0, 0.0)
        ops.rigidLink("beam", node + 1, last)
    return last

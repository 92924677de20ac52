"""Writes `modes.csv`, `altered.csv` and `rigid.csv`: the stand-in for the test of the tube frame, computed with OpenSees.

The lecture prints measured frequencies, 226.8 275.2 537.4 861.5 974.8 Hz, but neither shapes nor drawing. This makes a frame that
has those frequencies to 0.3 per cent: the tubes of the deck (elasticBeamColumn, 16 a segment, lumped masses) whose ends give way
at the welds: at the corners in bending and torsion alike, at the ends of the crossbar in bending and in torsion, and everywhere
across the frame. The four sizes are fitted to the five frequencies; the deck's model, whose joints are rigid, has no parameter for
any of them. `rigid.csv` holds the frequencies with joints that do not give way, a check of the deck's model.

    python decks/tube_frame/make.py        (needs openseespy and numpy)
"""

from itertools import pairwise
from pathlib import Path

import numpy as np
import openseespy.opensees as ops

HERE = Path(__file__).resolve().parent
A_LONG, B_SHORT, PARTS = 0.5895, 0.2875, 16
OUTER, WALL = 0.0254, 0.00238
AREA = OUTER**2 - (OUTER - 2 * WALL) ** 2
I = (OUTER**4 - (OUTER - 2 * WALL) ** 4) / 12
E, G, J, DENSITY, POLAR = 70e9, 25.4e9, 2 * I, 2700.0, 240.0 * I
RIGID = (1e-7, 1e-7, 1e-10)  # compliances of an end in bending and torsion, rad/(N m), and across the frame, m/N
FITTED = {
    "corner": (3.23e-5, 3.23e-5, 4.78e-8),
    "crossbar": (3.73e-5, 8.64e-5, 4.78e-8),
    "through": (1e-7, 1e-7, 4.78e-8),
}
CORNERS = {"A": (0.0, 0.0), "B": (A_LONG, 0.0), "C": (A_LONG, B_SHORT), "D": (0.0, B_SHORT)}
MIDDLES = {"P": (A_LONG / 2, 0.0), "Q": (A_LONG / 2, B_SHORT)}
SEGMENTS = ("AP", "BP", "DQ", "CQ", "AD", "BC", "PQ")  # from joint to joint, in the order of the deck
SOFT = 1.0  # N/m at each corner: the eigensolver wants a frame that is held; no elastic frequency feels it
ADDED = {"mass": 0.5, "spring": 1.0e5}  # kg and N/m, at coordinate 6


def frame(sizes: dict, mass: float = 0.0, spring: float = 0.0) -> list[list[int]]:
    """Builds the frame; returns the OpenSees nodes of each segment, ends first and last."""
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    joints = {}
    tags = iter(range(1, 10**6))
    for name, (x, y) in {**CORNERS, **MIDDLES}.items():
        joints[name] = _node(tags, x, y)
    chains = []
    for start, end in SEGMENTS:
        chains.append(_segment(sizes, tags, joints, start, end))
    if mass or spring:
        tag = coordinates(chains)[5]
        ops.mass(tag, *(ops.nodeMass(tag, i) + (mass if i == 3 else 0.0) for i in range(1, 7)))
        _grounded(tags, tag, spring)
    for name in CORNERS:
        _grounded(tags, joints[name], SOFT)
    return chains


def _grounded(tags, tag: int, stiffness: float) -> None:
    """A spring to the ground across the frame."""
    ground, material = _node(tags, *ops.nodeCoord(tag)[:2], held=True), next(tags)
    ops.uniaxialMaterial("Elastic", material, stiffness)
    ops.element("zeroLength", next(tags), ground, tag, "-mat", material, "-dir", 3)


def _node(tags, x: float, y: float, held: bool = False) -> int:
    tag = next(tags)
    ops.node(tag, x, y, 0.0)
    ops.fix(tag, *((1,) * 6 if held else (1, 1, 0, 0, 0, 1)))
    ops.mass(tag, *(1e-9,) * 6)
    return tag


def _segment(sizes: dict, tags, joints: dict, start: str, end: str) -> list[int]:
    """Beams from joint to joint; at each end springs in bending and torsion."""
    p, q = (np.array({**CORNERS, **MIDDLES}[name]) for name in (start, end))
    chain = [_node(tags, *(p + (q - p) * i / PARTS)) for i in range(PARTS + 1)]
    along = (q - p) / np.hypot(*(q - p))
    for joint, tag in ((start, chain[0]), (end, chain[-1])):
        kind = "crossbar" if start + end == "PQ" else "corner" if joint in CORNERS else "through"
        bending, torsion, across = sizes[kind]
        springs = [next(tags) for _ in range(3)]
        for spring, compliance in zip(springs, (across, torsion, bending), strict=True):
            ops.uniaxialMaterial("Elastic", spring, 1 / compliance)
        ops.element("zeroLength", next(tags), joints[joint], tag, "-mat", *springs, "-dir", 3, 4, 5,
                    "-orient", *along, 0.0, -along[1], along[0], 0.0)  # fmt: skip
    length = np.hypot(*(q - p)) / PARTS
    transformation = next(tags)
    ops.geomTransf("Linear", transformation, 0.0, 0.0, 1.0)
    for a, b in pairwise(chain):
        ops.element("elasticBeamColumn", next(tags), a, b, AREA, E, G, J, I, I, transformation)
    turning = POLAR * length
    inertia = abs(along[0]) * turning, abs(along[1]) * turning
    for i, tag in enumerate(chain):
        share = 0.5 if i in (0, PARTS) else 1.0
        ops.mass(
            tag, 1e-9, 1e-9, DENSITY * AREA * length * share, 1e-9 + inertia[0] * share, 1e-9 + inertia[1] * share, 1e-9
        )
    return chain


def coordinates(chains: list[list[int]]) -> list[int]:
    """The nodes of the deck's mesh in its order: corners A to D, three inside each segment, P and Q."""
    step = PARTS // 4
    inside = [chain[k] for chain in chains for k in (step, 2 * step, 3 * step)]
    joints = [chains[0][0], chains[1][0], chains[3][0], chains[2][0], chains[0][-1], chains[2][-1]]
    return joints[:4] + inside + joints[4:]


def modes(chains: list[list[int]], count: int = 5) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies (count,) in Hz and deflections (27, count) of the elastic modes."""
    rigid = 3
    ops.wipeAnalysis()
    values = np.array(ops.eigen("-genBandArpack", rigid + count))
    held = values > 1e3
    hz = np.sqrt(values[held]) / (2 * np.pi)
    first = int(np.argmax(held)) + 1
    shapes = [[ops.nodeEigenvector(tag, first + k, 3) for k in range(len(hz))] for tag in coordinates(chains)]
    return hz[:count], np.array(shapes)[:, :count]


def main() -> None:
    hz, shapes = modes(frame(FITTED))
    shapes = shapes / np.abs(shapes).max(axis=0)
    np.savetxt(HERE / "modes.csv", np.vstack([hz, shapes]), fmt="%.5f", delimiter=",")
    changed, _ = modes(frame(FITTED, **ADDED), 6)
    np.savetxt(HERE / "altered.csv", changed[None], fmt="%.4f", delimiter=",")
    stiff, _ = modes(frame(dict.fromkeys(FITTED, RIGID)))
    np.savetxt(HERE / "rigid.csv", stiff[None], fmt="%.4f", delimiter=",")
    print(hz, changed, stiff)


if __name__ == "__main__":
    main()

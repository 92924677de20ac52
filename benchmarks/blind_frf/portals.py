"""Plane frames with a flexible support, tested by functions: truths by OpenSees (`pip install openseespy`).

H = S (K (1 + i eta) - w^2 M)^-1 B by all modes of the matrices of OpenSees, whose elements are half as long as those of the deck.
"""

import hashlib
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np

from benchmarks.blind.case import generator, log_uniform, near

E, NU, DENSITY = 2.1e11, 0.3, 7850.0
SECTIONS = ((38.8e-4, 1673e-8), (28.5e-4, 1943e-8))  # A, I of columns and beams, about
PIECES, LINES, NOISE, FLOOR, MODES = 4, 600, 0.01, 0.002, 6
CAUSES = {"turns": 3, "slides": 1, "settles": 2}  # direction of OpenSees, from 1


@dataclass(frozen=True)
class Portal:
    """points (n, 2), bars (b, 2) between them, column (b,): whether it is one; feet: nodes on the ground; sections (2, 2)."""

    points: np.ndarray
    bars: np.ndarray
    column: np.ndarray
    feet: list[int]
    sections: np.ndarray

    def lengths(self) -> np.ndarray:
        """Of the bars."""
        return np.linalg.norm(np.diff(self.points[self.bars], axis=1)[:, 0], axis=1)


def drawn(rng: np.random.Generator) -> Portal:
    """One or two bays, one or two storeys, of members of PIECES elements."""
    xs = np.concatenate([[0.0], np.cumsum(np.round(rng.uniform(3, 6, int(rng.integers(1, 3))), 1))])
    ys = np.concatenate([[0.0], np.cumsum(np.round(rng.uniform(2.5, 4, int(rng.integers(1, 3))), 1))])
    place = {(i, j): n for n, (j, i) in enumerate(np.ndindex(len(ys), len(xs)))}
    points = [(xs[i], ys[j]) for i, j in place]
    ends = [((i, j), (i, j + 1)) for i, j in place if j + 1 < len(ys)]
    ends += [((i, j), (i + 1, j)) for i, j in place if j and i + 1 < len(xs)]
    bars, column = [], []
    for a, b in ends:
        inner = list(range(len(points), len(points) + PIECES - 1))
        start, end = np.array(points[place[a]]), np.array(points[place[b]])
        points += [tuple(start + share * (end - start)) for share in np.arange(1, PIECES) / PIECES]
        chain = [place[a], *inner, place[b]]
        bars += list(pairwise(chain))
        column += [a[0] == b[0]] * PIECES
    sections = np.array(SECTIONS) * rng.uniform(0.7, 1.4, (2, 1))
    feet = [n for (_, j), n in place.items() if j == 0]
    return Portal(np.array(points), np.array(bars), np.array(column), feet, sections)


def matrices(portal: Portal, stiff: np.ndarray, density: float, springs: list[tuple[int, int, float]]):
    """K, M and the equations (n, 3) of the nodes, -1 where they are held; stiff: E of columns and beams.

    springs: (foot, direction 1 to 3, stiffness), by which feet are freed.
    """
    import openseespy.opensees as ops

    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("Linear", 1)
    for n, xy in enumerate(portal.points.tolist()):
        ops.node(n + 1, *xy)
    last = len(portal.points)
    for number, (a, b) in enumerate(portal.bars.tolist()):
        which = int(not portal.column[number])
        A, I = portal.sections[which].tolist()
        last += 1
        ops.node(last, *portal.points[[a, b]].mean(axis=0).tolist())
        for part, (i, j) in enumerate(((a + 1, last), (last, b + 1))):
            own = (A, float(stiff[which]), I, 1, "-mass", density * A, "-cMass")
            ops.element("elasticBeamColumn", 2 * number + part + 1, i, j, *own)
    for foot in portal.feet:
        ops.fix(foot + 1, *(int((foot, d) not in {(n, way) for n, way, _ in springs}) for d in (1, 2, 3)))
    for i, (foot, direction, k) in enumerate(springs):
        ops.node(last + 1 + i, *portal.points[foot].tolist())
        ops.fix(last + 1 + i, 1, 1, 1)
        ops.uniaxialMaterial("Elastic", 1 + i, k)
        ops.element("zeroLength", 10**5 + i, last + 1 + i, foot + 1, "-mat", 1 + i, "-dir", direction)
    ops.constraints("Plain"), ops.numberer("Plain"), ops.system("FullGeneral"), ops.algorithm("Linear")
    found = []
    for factors in ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0)):
        ops.integrator("GimmeMCK", *factors)
        ops.analysis("Transient")
        ops.analyze(1, 0.0)
        found.append(np.array(ops.printA("-ret")).reshape(ops.systemSize(), -1))
    equations = np.array([ops.nodeDOFs(n + 1) for n in range(len(portal.points))])
    ops.wipe()
    return (*found, equations)


def write(folder: Path, seed: int, number: int) -> tuple[Path, dict]:
    """The deck of one frame with its functions, and its answer; the cause moves a frequency by 1 % at least."""
    rng = generator("portal", seed, number)
    portal, cause = drawn(rng), list(CAUSES)[number % len(CAUSES)]
    stiff, density, eta = (
        np.array([near(rng, E, 0.03) for _ in range(2)]),
        near(rng, DENSITY, 0.015),
        rng.uniform(0.005, 0.015),
    )
    sound = _eigenvalues(*matrices(portal, stiff, density, [])[:2])
    A, I = portal.sections[0]
    unit = {"turns": E * I / 3, "slides": 12 * E * I / 27, "settles": E * A / 3}[cause]
    while True:
        foot = int(rng.choice(portal.feet))
        K, M, equations = matrices(portal, stiff, density, [(foot, CAUSES[cause], unit * log_uniform(rng, 0.1, 10))])
        if np.abs(np.sqrt(_eigenvalues(K, M)[:MODES] / sound[:MODES]) - 1).max() > 0.01:
            break
    name = hashlib.sha256(repr(("portal", seed, number)).encode()).hexdigest()[:10]
    _measure(folder / f"{name}.npz", rng, portal, (K, M, equations, eta), 1.05 * np.sqrt(sound[MODES - 1]))
    path = folder / f"{name}.yaml"
    path.write_text(_deck(name, portal))
    at, span = portal.points[foot].tolist(), float(np.ptp(portal.points, axis=0).max())
    truth = f"a foot that {cause}"
    return path, {"name": f"portal-{number}", "truth": truth, "group": "support", "law": "", "place": at, "span": span}


def _eigenvalues(K: np.ndarray, M: np.ndarray) -> np.ndarray:
    from scipy.linalg import eigh

    return eigh(K, M, eigvals_only=True)


def _measure(path: Path, rng: np.random.Generator, portal: Portal, truth: tuple, top: float) -> None:
    """Functions of six to ten sensors for a force that is level, by all modes."""
    from scipy.linalg import eigh

    K, M, equations, eta = truth
    free = np.setdiff1d(np.arange(len(portal.points)), portal.feet)
    read = [(int(n), int(rng.integers(2))) for n in rng.choice(free, int(rng.integers(6, 11)), replace=False)]
    force = int(rng.choice(free[: len(free) // 2]))
    frequency = np.linspace(0.03 * top, top, LINES) / (2 * np.pi)
    lam, X = eigh(K, M)
    rows = [equations[n, d] for n, d in read]
    H = (1 / (lam * (1 + 1j * eta) - (2 * np.pi * frequency[:, None]) ** 2)) @ (X[rows] * X[equations[force, 0]]).T
    variance = (NOISE * np.abs(H)) ** 2 + FLOOR**2 * (np.abs(H) ** 2).mean(axis=0)
    noise = (rng.standard_normal(H.shape) + 1j * rng.standard_normal(H.shape)) * np.sqrt(variance / 2)
    names = np.array([f"{n + 1}T{'XY'[d]}" for n, d in read])
    np.savez(
        path, frequency_hz=frequency, H=(H + noise)[:, :, None], variance=variance[:, :, None], output_names=names,
        input_names=np.array([f"{force + 1}TX"]), kind=np.array("receptance"),
    )  # fmt: skip


def _deck(name: str, portal: Portal) -> str:
    kinds = ("beam", "column")
    nodes = ", ".join(f"{n}: [{x:.9g}, {y:.9g}]" for n, (x, y) in enumerate(portal.points.tolist(), 1))
    bars = "\n".join(
        f"      - {{id: {n}, type: beam, nodes: [{a + 1}, {b + 1}], material: {kinds[c]}, section: {kinds[c]}}}"
        for n, ((a, b), c) in enumerate(zip(portal.bars.tolist(), portal.column.tolist(), strict=True), 1)
    )
    sections = ", ".join(
        f"{kinds[1 - i]}: {{A: {A:.8g}, Iz: {I:.8g}}}" for i, (A, I) in enumerate(portal.sections.tolist())
    )
    materials = ", ".join(f"{kind}: {{E: {E:.3e}, nu: {NU}, density: {DENSITY}}}" for kind in kinds)
    return f"""\
mouse: 1
title: {name}
model:
  structure:
    nodes: {{{nodes}}}
    materials: {{{materials}}}
    sections: {{{sections}}}
    elements:
{bars}
    supports: {{{", ".join(f"{n + 1}: all" for n in portal.feet)}}}
    plane: XY
parameters:
  - {{name: E columns, material: column, property: E, sd: 5 %, transform: log}}
  - {{name: E beams, material: beam, property: E, sd: 5 %, transform: log}}
  - {{name: density, elements: 1-{len(portal.bars)}, property: density, sd: 2 %, transform: log}}
modal_damping: {{ratio: 1 %, sd: 100 %}}
test:
  frf: [{{file: {name}.npz}}]
"""

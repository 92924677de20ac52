"""Physics that the library has no name for, put into a truth; `also` declares beforehand which names are as true."""

from itertools import pairwise

import numpy as np

from benchmarks.trials.case import Blank, Mechanism
from benchmarks.trials.library import log_uniform, somewhere

Box = tuple[tuple[float, ...], tuple[float, ...]]
# names (physics, group) that are as true where they are declared, at the site of the mechanism
BED, SOFT, FOOT = ("foundation", "foundation"), ("stiffness-loss", "local-stiffness"), ("support-rotation", "support")
BRACE = ("brace", "brace")
LOCAL = ("stiffness", "force")  # properties of nameless fields that describe what acts at places


def stretch(blank: Blank, start: float, stop: float) -> tuple[Box, ...]:
    """Part of a beam, by its length."""
    return (((start * blank.span, 0.0), (stop * blank.span, 0.0)),)


def around(*points: tuple[float, ...]) -> tuple[Box, ...]:
    """Places as boxes of no size."""
    return tuple((tuple(p), tuple(p)) for p in points)


def half_bed(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """An elastic bed under half of a beam."""
    right = bool(rng.integers(2))
    at = blank.truth.along / blank.span
    k = blank.line_mass * blank.first**2 * log_uniform(rng, 0.15, 1.5)
    blank.truth.bed[(at > 0.5) if right else (at < 0.5)] += k
    middle = (0.75 if right else 0.25) * blank.span
    region = stretch(blank, 0.5, 1.0) if right else stretch(blank, 0.0, 0.5)
    return Mechanism("bed under half", "", "", (middle, 0.0), 0.25 * blank.span, k, (BED,), ("bed",), region)


def _wave(blank: Blank, rng: np.random.Generator) -> tuple[np.ndarray, tuple[Box, ...], float]:
    """Factors along a beam, and where they are within a tenth of a wave of the largest change."""
    size, waves, phase = rng.uniform(0.10, 0.25), rng.uniform(1.0, 3.0), rng.uniform(0, 2 * np.pi)
    angle = 2 * np.pi * waves * blank.truth.along / blank.span + phase
    x = np.linspace(0, 1, 401)
    strong = np.abs(np.sin(2 * np.pi * waves * x + phase)) > 0.8
    edges = np.flatnonzero(np.diff(np.concatenate([[0], strong.astype(int), [0]])))
    boxes = [stretch(blank, x[a], x[b - 1])[0] for a, b in zip(edges[::2], edges[1::2], strict=True)]
    return 1 + size * np.sin(angle), tuple(boxes), size


def wavy_stiffness(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """EI that goes up and down along a beam."""
    factor, boxes, size = _wave(blank, rng)
    blank.truth.EI *= factor
    return Mechanism("wavy stiffness", size=size, properties=("stiffness",), regions=boxes)


def wavy_mass(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """Mass per length that goes up and down along a beam."""
    factor, boxes, size = _wave(blank, rng)
    blank.truth.m *= factor
    return Mechanism("wavy mass", size=size, properties=("mass",), regions=boxes)


def rocking(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """Soil under a chain of storeys that turns: every storey feels u_i - u_(i-1) - phi, k phi^2 / 2 in the soil."""
    truth = blank.truth
    phi, n = truth.new_dof(), len(blank.places)
    truth.springs = [(b | {phi: -1.0}, k) for b, k in truth.springs]
    k = blank.stiffness * n**2 * log_uniform(rng, 0.3, 3.0)
    truth.spring({phi: 1.0}, k)
    return Mechanism("rocking soil", size=k, properties=LOCAL)


def outrigger(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A place of a member is tied against turning by an arm."""
    _, node, at = somewhere(blank, rng)
    k = blank.EI / blank.lines[0].length * log_uniform(rng, 0.5, 8.0)
    blank.truth.spring({3 * node + 2: 1.0}, k)
    return Mechanism("outrigger", size=k, properties=LOCAL, regions=around(at))


def distant(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A spring between two distant places, which feels their difference."""
    for _ in range(100):
        (a, _, p), (b, _, q) = somewhere(blank, rng), somewhere(blank, rng)
        if np.hypot(*np.subtract(p, q)) > 0.3 * blank.span and (not blank.lines or a % 3 == b % 3):
            break
    k = blank.weight * blank.first**2 * log_uniform(rng, 0.2, 3.0) * (1.0 if blank.lines else 0.1)
    blank.truth.spring({a: 1.0, b: -1.0}, k)
    about = {"properties": LOCAL, "regions": around(p, q)}
    if blank.family in ("chain", "storeys"):  # whose springs act along one direction, as a brace of the library does
        at = tuple(np.mean([p, q], axis=0).tolist())
        return Mechanism("spring between distant places", "", "", at, blank.near(), k, (BRACE,), **about)
    return Mechanism("spring between distant places", size=k, **about)


def eccentric(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """Storeys that twist, as their masses are off the axis: u_i + e theta_i moves, and springs turn too."""
    truth, n = blank.truth, len(blank.places)
    radius, arm = rng.uniform(0.35, 0.5), rng.uniform(0.05, 0.2)  # of inertia, and of the mass, in widths
    stiff = (radius * rng.uniform(1.2, 1.8)) ** 2
    turns = [truth.new_dof() for _ in range(n)]
    for b, k in list(truth.springs):
        truth.spring({turns[dof]: c for dof, c in b.items()}, k * stiff)
    for i in range(n):
        kg = truth.base[1][i, i]
        truth.base[1][i, i] = 0.0
        truth.weight({i: 1.0, turns[i]: arm}, kg)
        truth.weight({turns[i]: 1.0}, kg * radius**2)
    return Mechanism("eccentric masses", size=arm, also=(("offset", "offset"),), properties=("mass",))


def graded_axial(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """Axial force that varies linearly from a pull at one end to a push at the other, as of a gradient of temperature."""
    end = rng.choice([-1, 1]) * np.pi**2 * blank.EI / blank.span**2 * rng.uniform(0.3, 0.9)
    blank.truth.axial += end * (1 - 2 * blank.truth.along / blank.span)
    ends = stretch(blank, 0.0, 0.2) + stretch(blank, 0.8, 1.0)
    return Mechanism("gradient of axial force", size=float(end), properties=LOCAL, regions=ends)


def soft_foot(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """EI of a member that falls smoothly towards its foot over a third of it."""
    foot = int(rng.choice([line.nodes[0] for line in blank.lines if line.nodes[0] in blank.feet]))
    line = next(line for line in blank.lines if line.nodes[0] == foot)
    depth, width = rng.uniform(0.3, 0.6), rng.uniform(0.2, 0.4)
    xi = blank.truth.along[line.elements] / (width * line.length)
    blank.truth.EI[line.elements] *= 1 - depth * np.clip(1 - xi, 0, 1) ** 2
    at, reach = line.point(width / 4), max(blank.near(), 0.5 * width * line.length)
    region = ((line.point(0.0), line.point(width / 2)),)
    return Mechanism("stiffness falls to a foot", "", "", at, reach, depth, (SOFT,), ("stiffness",), region)


def slipping(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """Layers that slip: the deck has a stretch of a beam bonded; its fasteners give way in shear (Newmark, Siess, Viest 1951).

    Both layers keep the curvature; the couple of their axial forces, EI (factor - 1) of the bonded section, is put on by an axial
    displacement s of its own that follows the turn through springs per length: EI_c (s')^2 + k (s - theta)^2.
    """
    start, stop, factor = LAYER
    truth, line = blank.truth, blank.lines[0]
    count = len(line.elements)
    own = line.elements[round(start * count) : round(stop * count)]
    couple = truth.EI[own].mean() * (1 - 1 / factor)
    truth.EI[own] /= factor
    length, step = (stop - start) * blank.span, blank.span / count
    k = couple / length**2 * log_uniform(rng, 3.0, 60.0)  # N per metre of beam
    slips = [truth.new_dof() for _ in range(len(own) + 1)]
    for i, slip in enumerate(slips):
        node = int(line.nodes[round(start * count) + i])
        share = 0.5 if i in (0, len(own)) else 1.0
        truth.spring({slip: 1.0, 3 * node + 2: -1.0}, k * step * share)
    for left, right in pairwise(slips):
        truth.spring({left: -1.0, right: 1.0}, couple / step)
    at = line.point((start + stop) / 2)
    region = stretch(blank, start, stop)
    return Mechanism("slipping layers", "", "", at, length / 2, float(k), (SOFT,), ("stiffness",), region)


LAYER = (0.3, 0.7, 2.0)  # from, to, EI over that of one layer


def amplitude(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A clamp that turns more the more it is loaded: each mode, tested at an amplitude of its own, has its own spring."""
    nodes = [node for node in blank.feet if 3 * node + 2 in blank.truth.held]
    node = int(rng.choice(nodes))
    k = blank.EI / (blank.lines[0].length * log_uniform(rng, 0.03, 0.15))
    softened = k * np.exp(rng.uniform(np.log(0.3), 0.0, 8))
    blank.truth.held.discard(3 * node + 2)
    blank.tuned.append(({3 * node + 2: 1.0}, softened))
    at = blank.places[node]
    return Mechanism("support softened by amplitude", "", "", at, blank.near(), k, (FOOT,), LOCAL, around(at))

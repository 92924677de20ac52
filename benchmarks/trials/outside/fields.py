"""What varies along a structure: stiffness, mass, bed, axial force, the bond of layers."""

from itertools import pairwise

import numpy as np

from benchmarks.trials.case import Blank, Mechanism
from benchmarks.trials.library import log_uniform
from benchmarks.trials.outside.places import ADDED, BED, LOCAL, MASS, SOFT, STIFF, Box, stretch

LAYER = (0.3, 0.7, 2.0)  # from, to, EI over that of one layer


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


def warm(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """E that falls linearly along a beam, warm at one end; its mass does not."""
    slope = float(rng.choice([-1, 1])) * rng.uniform(0.08, 0.25)
    factor = 1 + slope * (2 * blank.truth.along / blank.span - 1)
    blank.truth.EI *= factor
    ends = stretch(blank, 0.0, 0.2) + stretch(blank, 0.8, 1.0)
    return Mechanism("gradient of stiffness", size=slope, properties=("stiffness",), regions=ends)


def corroded(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A long stretch of a beam that has lost depth, most in its middle: EI goes with its cube, mass with itself."""
    depth, width = rng.uniform(0.06, 0.18), rng.uniform(0.3, 0.6)
    middle = rng.uniform(width / 2, 1 - width / 2)
    lost = depth * np.clip(1 - (2 * (blank.truth.along / blank.span - middle) / width) ** 2, 0, 1)
    blank.truth.EI *= (1 - lost) ** 3
    blank.truth.m *= 1 - lost
    reach, at = max(blank.near(), 0.5 * width * blank.span), (float(middle * blank.span), 0.0)
    region = stretch(blank, middle - width / 4, middle + width / 4)
    return Mechanism("corrosion", "", "", at, reach, depth, (SOFT,), ("stiffness", "mass"), region)


def sleeve(blank: Blank, rng: np.random.Generator) -> list[Mechanism]:
    """A tube over part of a beam: it stiffens and weighs, which are two names."""
    width, stiffer = rng.uniform(0.1, 0.3), rng.uniform(1.3, 2.5)
    middle = rng.uniform(width / 2 + 0.05, 0.95 - width / 2)
    own = np.abs(blank.truth.along / blank.span - middle) < width / 2
    blank.truth.EI[own] *= stiffer
    blank.truth.m[own] *= 1 + 0.4 * (stiffer - 1)
    reach, at = max(blank.near(), 0.5 * width * blank.span), (float(middle * blank.span), 0.0)
    region = stretch(blank, middle - width / 2, middle + width / 2)
    about = {"properties": ("stiffness", "mass"), "regions": region}
    stiff = Mechanism("sleeve that stiffens", "", "", at, reach, stiffer, (STIFF,), **about)
    return [stiff, Mechanism("sleeve that weighs", "", "", at, reach, stiffer, (MASS, ADDED), **about)]


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

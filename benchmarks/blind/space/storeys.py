"""Storey buildings, of which the deck knows lateral stiffness and masses alone; in truth their foundation may rock."""

from dataclasses import dataclass

import numpy as np

from benchmarks.blind.case import ALTERED, DENSITY_SPREAD, Case, generator, near
from benchmarks.blind.space.rocked import make
from benchmarks.blind.test_data import Config

SPREAD, STOREY_SD = 0.07, 0.10  # of the stiffness of a storey: in truth, and stated


@dataclass(frozen=True)
class Building:
    """heights (n,) of the storeys; k (n,) in N/m; m (n,) in kg; width of the floors."""

    heights: np.ndarray
    k: np.ndarray
    m: np.ndarray
    width: float


def drawn(rng: np.random.Generator) -> Building:
    """Four to ten storeys, the lower ones stiffer."""
    n = int(rng.integers(4, 11))
    heights = np.round(rng.uniform(2.8, 4.0) * np.r_[rng.uniform(1.0, 1.4), np.ones(n - 1)], 2)
    m = np.round(rng.uniform(2e4, 2e5) * rng.uniform(0.85, 1.15, n), 0)
    first = 2 * np.pi * rng.uniform(8, 14) / n  # rad/s, about
    k = m.mean() * (first * n * 2 / np.pi) ** 2 * np.linspace(rng.uniform(1.0, 1.6), 0.8, n) * rng.uniform(0.9, 1.1, n)
    return Building(heights, np.round(k, -3), m, round(float(rng.uniform(6, 15)), 1))


def case(
    family: str, number: int, building: Building, rng: np.random.Generator, share: float, truth: str, groups: tuple
) -> Case:
    """A case; share: of the flexibility of the building in its first mode, about, that is the foundation's."""
    n, k = len(building.m), building.k * np.exp(SPREAD * rng.standard_normal(len(building.m)))
    above = np.cumsum(building.heights)
    drift = np.cumsum(np.cumsum((building.m * above)[::-1])[::-1] / k)  # under inertia forces that grow with height
    moment = float(building.m @ above**2)
    turning = (
        moment * (1 - share) / share * float(building.m @ above**2) / float(building.m * above @ drift)
        if share
        else 0.0
    )
    sizes = {"stiffness of the foundation": turning} if share else {}
    added, masses = float(ALTERED * building.m.sum()), building.m * near(rng, 1.0, DENSITY_SPREAD)
    measured = int(rng.integers(4, 6))
    inputs = {
        "rocked": 1, "heights": building.heights.tolist(), "k": k.tolist(), "m": masses.tolist(),
        "width": building.width, "turning": turning, "added": [n, added],
    }  # fmt: skip
    return Case(
        name=f"space-{family}-{number}",
        kind="storeys",
        truth=truth,
        groups=groups,
        inputs=inputs,
        make=make,
        model=_deck(building, above),
        sites=tuple(f"{i}TX" for i in range(1, n + 1)),
        numbers=tuple(range(1, min(n, measured + 2) + 1)),
        altered=f"{{{n}: {added:.8g}}}",
        span=float(above[-1]),
        sizes=sizes,
        config=_quality(rng, measured),
    )


def _quality(rng: np.random.Generator, measured: int) -> Config:
    low = generator("storeys", int(rng.integers(2**31)))
    return Config(30, round(float(low.uniform(1e-3, 5e-3)), 4), round(float(low.uniform(0.01, 0.03)), 3), measured)


def _deck(building: Building, above: np.ndarray) -> str:
    n = len(building.m)
    nodes = ", ".join(f"{i}: [0, 0, {z:.9g}]" for i, z in enumerate([0.0, *above.tolist()]))
    return f"""\
model:
  structure:
    nodes: {{{nodes}}}
    elements:
      - {{id: 1-{n}, type: storey, nodes: 0-{n}, TX: {building.k.tolist()}}}
      - {{id: 101-{100 + n}, type: mass, nodes: 1-{n}, mass: {building.m.tolist()}}}
    supports: {{0: all}}
    directions: [TX]

parameters:
  - {{name: storey, elements: 1-{n}, property: TX, each: 1, sd: {100 * STOREY_SD:g} %, transform: log}}
  - {{name: masses, elements: 101-{100 + n}, property: mass, factor: true, sd: 2 %, transform: log}}
"""

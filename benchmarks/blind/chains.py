"""Chains of masses and springs by CalculiX; the stiffness of every spring is a parameter of the deck."""

from collections.abc import Iterator

import numpy as np

from benchmarks.blind.calculix import mass, solve, spring
from benchmarks.blind.case import ALTERED, Case, generator, log_uniform, near

SPRING_SD = 0.10  # of each spring, before the test
TRUTHS = {
    "control": (),
    "ground spring": ("ground-spring",),
    "mass": ("mass",),
    "absorber": ("oscillator",),
    "link": (),
}


def make(inputs: dict) -> dict[str, np.ndarray]:
    """Frequencies, shapes at the masses, frequencies with the added mass. links: [[a, b, N/m], ...], 0 the ground."""
    altered = inputs | {"masses": [*inputs["masses"], [inputs["count"], inputs["added"]]]}
    frequency, shapes = _solved(inputs)
    return {"frequency": frequency, "shapes": shapes, "altered": _solved(altered)[0]}


def _solved(inputs: dict) -> tuple[np.ndarray, np.ndarray]:
    """Modes of masses 1 to count, and `hung` further ones.

    ARPACK in ccx fails where nearly all modes are asked for, so that idle masses stand beside, far above in frequency.
    """
    count, inside = inputs["count"], inputs["count"] + inputs["hung"]
    total, kg = 6 * inside, inputs["masses"][0][1]
    lines = ["*NODE, NSET=NALL", *(f"{n}, {n}., 0., 0." for n in range(1, total + 1))]
    element = 0
    for node, kg in inputs["masses"]:
        lines += mass(element := element + 1, node, kg)
    for a, b, k in inputs["links"]:
        lines += spring(element := element + 1, tuple(n for n in (a, b) if n), k, direction=1)
    for node in range(inside + 1, total + 1):
        lines += mass(element := element + 1, node, kg)
        lines += spring(element := element + 1, (node,), 1e4 * inputs["links"][0][2], direction=1)
    lines += ["*BOUNDARY", "NALL, 2, 3", "*STEP", "*FREQUENCY", str(inside), "*NODE PRINT, NSET=NALL", "U", "*END STEP"]
    found = solve("\n".join(lines) + "\n")
    return found.frequency[:inside], found.shapes[:inside, :count, 0]


def cases(split: str, seed: int, count: int) -> Iterator[Case]:
    """`count` chains of each cause."""
    for truth in TRUTHS:
        for k in range(count):
            yield _case(truth, k, generator(split, seed, "chain", truth, k))


def _case(truth: str, k: int, rng: np.random.Generator) -> Case:
    n, tied = int(rng.integers(7, 13)), bool(rng.integers(2))  # tied: to the ground at both ends
    k0, m0 = log_uniform(rng, 1e4, 1e6), log_uniform(rng, 0.5, 20)
    nominal = [round(near(rng, k0, 0.3), 1) for _ in range(n + tied)]
    weights = [round(near(rng, m0, 0.3), 4) for _ in range(n)]
    true = [float(x * np.exp(0.7 * SPRING_SD * rng.standard_normal())) for x in nominal]
    links = [[i, i + 1 if i < n else 0, x] for i, x in enumerate(true)]
    masses = [[i + 1, m] for i, m in enumerate(weights)]
    j = int(rng.integers(1, n + 1))
    hung = _cause(truth, rng, j, n, k0, m0, links, masses)
    added = ALTERED * sum(weights)
    return Case(
        name=f"chain-{truth}-{k}",
        kind="chain",
        truth=truth,
        groups=TRUTHS[truth],
        inputs={"chain": n, "count": n, "hung": hung, "links": links, "masses": masses, "added": added},
        make=make,
        model=_model(nominal, weights, tied),
        sites=tuple(f"{i}TX" for i in range(1, n + 1)),
        numbers=tuple(range(1, n + 1)),
        altered=f"{{{n}: {added:.8g}}}",
        places=((float(j), 0.0, 0.0),) if TRUTHS[truth] else (),
        span=float(n),
        outside=truth == "link",
        draws=4 if truth == "control" else 1,
    )


def _cause(
    truth: str, rng: np.random.Generator, j: int, n: int, k0: float, m0: float, links: list, masses: list
) -> int:
    """Puts the cause at mass j into `links` and `masses`; the number of further masses."""
    if truth == "ground spring":
        links.append([j, 0, k0 * log_uniform(rng, 0.1, 1.0)])
    elif truth == "mass":
        masses.append([j, m0 * log_uniform(rng, 0.08, 0.6)])
    elif truth == "link":
        links.append([j, (j + n // 2 - 1) % n + 1, k0 * log_uniform(rng, 0.2, 1.0)])
    elif truth == "absorber":
        kg = m0 * log_uniform(rng, 0.08, 0.5)
        masses.append([n + 1, kg])
        links.append([j, n + 1, kg * k0 / m0 * rng.uniform(0.15, 1.2) ** 2])
        return 1
    return 0


def _model(nominal: list[float], weights: list[float], tied: bool) -> str:
    n = len(weights)
    last = f", {n + 1}: all" if tied else ""
    return f"""\
model:
  structure:
    nodes: {{line: {{from: 0, to: {n + tied}, start: [0, 0, 0], end: [{n + tied}, 0, 0]}}}}
    elements:
      - {{id: 1-{len(nominal)}, type: spring, nodes: 0-{len(nominal)}, TX: {nominal}}}
      - {{id: 101-{100 + n}, type: mass, nodes: 1-{n}, mass: {weights}}}
    supports: {{0: all{last}}}
    directions: [TX]

parameters:
  - {{name: spring, elements: 1-{len(nominal)}, property: TX, each: 1, sd: {100 * SPRING_SD:g} %, transform: log}}
"""

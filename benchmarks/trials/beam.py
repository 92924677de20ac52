"""Straight beams: decks of 30 elements after Euler and Bernoulli; truths of 120 or 240."""

from functools import partial
from itertools import pairwise

import numpy as np

from benchmarks.trials.bars import Bars
from benchmarks.trials.case import Blank, Line, Prior, drawn

ELEMENTS = 30
MATERIALS = ((2.1e11, 7850.0), (7.0e10, 2700.0), (1.1e11, 4430.0))
BOUNDARIES = ("cantilever", "clamped", "pinned", "free")
FIRST = {"cantilever": 1.8751, "clamped": 4.7300, "pinned": np.pi, "free": 4.7300}  # beta L
KAPPA = 5 / 6
FREE = {  # nodes of the deck that move
    "cantilever": range(2, ELEMENTS + 2),
    "clamped": range(2, ELEMENTS + 1),
    "pinned": range(2, ELEMENTS + 1),
    "free": range(1, ELEMENTS + 2),
}


def beam(
    rng: np.random.Generator, boundary: str = "", masses: int = 0, thick: bool = False, layer: tuple = ()
) -> Blank:
    """A beam. masses: of how many point masses the deck knows; layer: (from, to, factor), a stretch that is stiffer in both."""
    boundary = boundary or str(rng.choice(BOUNDARIES[:3]))
    E, density, L, b, h = _numbers(rng, thick)
    EI, line = E * b * h**3 / 12, density * b * h
    fine = 8 if thick else 4
    truth = _body(L, fine, thick, (E, density, b, h))
    at = truth.along / L
    if layer:
        truth.EI[(at > layer[0]) & (at < layer[1])] *= layer[2]
    lines, priors = _parameters(rng, truth, at)
    free = FREE[boundary]
    kg = [float(f"{line * L * rng.uniform(0.03, 0.08):.4g}") for _ in range(masses)]
    where = [int(n) for n in np.linspace(3, free[-1] - 1, masses).round()] if masses else []
    for n, one in zip(where, kg, strict=True):
        truth.weight({3 * fine * n + 1: 1.0}, one)
    _support(truth, boundary, fine * ELEMENTS)
    return Blank(
        "beam",
        truth,
        _deck(L, (E, density, b, h), boundary, list(zip(where, kg, strict=True)), layer, lines),
        sensors=[(f"{n}TY", 3 * fine * (n - 1) + 1) for n in free],
        nodes={str(n): (L * (n - 1) / ELEMENTS, 0.0, 0.0) for n in range(1, ELEMENTS + 2)},
        elements={str(n): (L * (n - 0.5) / ELEMENTS, 0.0, 0.0) for n in range(1, ELEMENTS + 1)},
        span=L,
        weight=line * L,
        first=float(FIRST[boundary] ** 2 * np.sqrt(EI / line) / L**2),
        stiffness=EI / L**3,
        EI=EI,
        line_mass=line,
        rigid=2 * (boundary == "free"),
        lines=[Line(np.arange(len(truth.points)), np.arange(len(truth.ends)), truth.points)],
        feet={"cantilever": [0], "free": []}.get(boundary, [0, fine * ELEMENTS]),
        masses=[(fine * n, one) for n, one in zip(where, kg, strict=True)],
        places={i: (float(x), 0.0) for i, x in enumerate(truth.points[:, 0])},
        parameters=drawn(rng, priors),
        priors=priors,
        kind=boundary,
    )


def _numbers(rng: np.random.Generator, thick: bool) -> tuple[float, float, float, float, float]:
    """E, density, length, width and depth."""
    E, density = MATERIALS[rng.integers(3)]
    L = round(rng.uniform(0.5, 3.0), 2)
    h = round(L / (rng.uniform(12, 22) if thick else rng.uniform(120, 250)), 6)
    return E, density, L, round(h * rng.uniform(0.5, 3.0), 6), h


def _body(L: float, fine: int, thick: bool, numbers: tuple[float, float, float, float]) -> Bars:
    """The beam as its deck has it, after Timoshenko where it is thick; `fine` elements to one of the deck."""
    E, density, b, h = numbers
    points = np.column_stack([np.linspace(0, L, fine * ELEMENTS + 1), np.zeros(fine * ELEMENTS + 1)])
    index = np.arange(len(points))
    truth = Bars(points, np.column_stack([index[:-1], index[1:]]), points[:-1, 0])
    truth.EI[:], truth.EA[:], truth.m[:] = E * b * h**3 / 12, E * b * h, density * b * h
    if thick:
        truth.GA[:], truth.rotary[:] = KAPPA * E / 2.6 * b * h, density * b * h**3 / 12
    return truth


def _parameters(rng: np.random.Generator, truth: Bars, at: np.ndarray) -> tuple[list[str], dict[str, Prior]]:
    """Entries of the deck, and their priors."""
    entry = "  - {{name: {}, {}, property: {}, sd: {:g} %, transform: log}}"
    priors = {"density": Prior(0.02, partial(truth.scale, ("m", "rotary"), at > 0))}
    lines = [entry.format("density", "material: metal", "density", 2)]
    if rng.integers(2):
        priors["E"] = Prior(0.05, partial(truth.scale, ("EI", "GA"), at > 0))
        return [*lines, entry.format("E", "material: metal", "E", 5)], priors
    half = ELEMENTS // 2
    for name, ids, own in (("E left", f"1-{half}", at < 0.5), ("E right", f"{half + 1}-{ELEMENTS}", at >= 0.5)):
        priors[name] = Prior(0.04, partial(truth.scale, ("EI", "GA"), own))
        lines.append(entry.format(name, f"elements: {ids}", "E", 4))
    return lines, priors


def _support(truth: Bars, boundary: str, last: int) -> None:
    truth.held |= {3 * i for i in range(last + 1)}
    if boundary != "free":
        truth.held.add(1)
    if boundary in ("cantilever", "clamped"):
        truth.held.add(2)
    if boundary in ("clamped", "pinned"):
        truth.held.add(3 * last + 1)
    if boundary == "clamped":
        truth.held.add(3 * last + 2)


def _deck(L: float, numbers: tuple, boundary: str, masses: list, layer: tuple, parameters: list[str]) -> str:
    E, density, b, h = numbers
    last = ELEMENTS + 1
    elements = [f"      - {{id: 1-{ELEMENTS}, type: beam, nodes: 1-{last}, material: metal, section: bar}}"]
    sections = f"{{bar: {{rectangle: [{h:.9g}, {b:.9g}]}}}}"
    if layer:
        cuts = [1, round(layer[0] * ELEMENTS) + 1, round(layer[1] * ELEMENTS) + 1, last]
        elements = []
        for (first, stop), section in zip(pairwise(cuts), ("bar", "joined", "bar"), strict=True):
            text = f"id: {first}-{stop - 1}, type: beam, nodes: {first}-{stop}, material: metal, section: {section}"
            elements += [f"      - {{{text}}}"] if stop > first else []
        I, A = b * h**3 / 12, b * h
        sections = f"{{bar: {{rectangle: [{h:.9g}, {b:.9g}]}}, joined: {{A: {A:.9g}, Iz: {layer[2] * I:.9g}, "
        sections += f"Iy: {layer[2] * I:.9g}, J: {I:.9g}}}}}"
    elements += [
        f"      - {{id: {100 + i}, type: mass, nodes: [{n + 1}], mass: {kg:.4g}}}"
        for i, (n, kg) in enumerate(masses, 1)
    ]
    held = {"cantilever": ["1: all"], "free": [], "clamped": ["1: all", f"{last}: all"]}.get(
        boundary, ["1: [TX, TY]", f"{last}: [TX, TY]"]
    )
    inner = f"{1 if boundary == 'free' else 2}-{last if boundary in ('free', 'cantilever') else last - 1}: [TX]"
    return "\n".join(
        [
            *("model:", "  structure:"),
            f"    nodes: {{line: {{from: 1, to: {last}, start: [0, 0], end: [{L:.9g}, 0]}}}}",
            f"    materials: {{metal: {{E: {E:.6e}, nu: 0.3, density: {density}}}}}",
            f"    sections: {sections}",
            *("    elements:", *elements),
            f"    supports: {{{', '.join([*held, inner])}}}",
            *("    plane: XY", "", "parameters:", *parameters, ""),
        ]
    )

"""Plane frames of one or two storeys and one or two bays: decks of ten elements in a member, truths of thirty."""

from functools import partial
from itertools import pairwise

import numpy as np

from benchmarks.trials.bars import Bars
from benchmarks.trials.case import Blank, Line, Prior, drawn

PIECES, FINE = 10, 3


def frame(rng: np.random.Generator, bays: int = 0, thick: bool = False) -> Blank:
    """A frame clamped at its feet, all members of one square section."""
    bays, storeys = bays or int(rng.integers(1, 3)), int(rng.integers(1, 3))
    H, W = round(rng.uniform(0.6, 1.5), 2), round(rng.uniform(0.7, 1.8), 2)
    d = round(min(H, W) / (rng.uniform(9, 14) if thick else rng.uniform(90, 140)), 6)
    E, density = (2.1e11, 7850.0) if rng.integers(2) else (7.0e10, 2700.0)
    members = [(x * W, i * H, x * W, (i + 1) * H) for i in range(storeys) for x in range(bays + 1)]
    posts = len(members)
    members += [(x * W, (i + 1) * H, (x + 1) * W, (i + 1) * H) for i in range(storeys) for x in range(bays)]
    points, lines = _mesh(members, PIECES * FINE)
    truth = _bars(points, lines)
    A, I = d * d, d**4 / 12
    truth.EI[:], truth.EA[:], truth.m[:] = E * I, E * A, density * A
    if thick:
        truth.GA[:], truth.rotary[:] = 5 / 6 * E / 2.6 * A, density * I
    priors = _priors(truth, lines[:posts])
    coarse, order = _mesh(members, PIECES)
    feet = [i for i, (_, y) in enumerate(points) if y < 1e-9]
    truth.held = {3 * i + k for i in feet for k in range(3)}
    return Blank(
        family="frame",
        truth=truth,
        model=_deck(coarse, order, posts, (d, E, density)),
        sensors=_sensors(points, coarse, order, posts),
        nodes={str(n): (float(x), float(y), 0.0) for n, (x, y) in enumerate(coarse, 1)},
        elements=_middles(order),
        span=float(max(bays * W, storeys * H)),
        weight=density * A * sum(line.length for line in lines),
        first=float(np.sqrt(12 * (bays + 1) * E * I / H**3 / (density * A * (bays * W + H)))),
        stiffness=E * I / H**3,
        EI=E * I,
        line_mass=density * A,
        lines=lines,
        feet=feet,
        corners=[(n, end) for n, line in enumerate(lines) for end in (0, 1) if line.point(end)[1] > 0],
        places={i: (float(x), float(y)) for i, (x, y) in enumerate(points)},
        parameters=drawn(rng, priors),
        priors=priors,
    )


def _priors(truth: Bars, posts: list[Line]) -> dict[str, Prior]:
    """Parameters of the deck."""
    upright = np.zeros(len(truth.length), dtype=bool)
    upright[np.concatenate([line.elements for line in posts])] = True
    stiff = ("EI", "EA", "GA")
    return {
        "E columns": Prior(0.05, partial(truth.scale, stiff, upright)),
        "E beams": Prior(0.05, partial(truth.scale, stiff, ~upright)),
        "density": Prior(0.02, partial(truth.scale, ("m", "rotary"), upright | ~upright)),
    }


def _sensors(points: np.ndarray, coarse: np.ndarray, order: list[Line], posts: int) -> list[tuple[str, int]]:
    """Across the members: x on posts, y on beams."""
    place = {tuple(np.round(p, 7)): i for i, p in enumerate(points)}
    return [
        (f"{n}T{'XY'[k]}", 3 * place[tuple(np.round(coarse[n - 1], 7))] + k)
        for number, line in enumerate(order)
        for n in (line.nodes[1:-1] + 1 if number >= posts else line.nodes[1:] + 1)
        for k in (int(number >= posts),)
    ]


def _mesh(members: list[tuple[float, ...]], pieces: int) -> tuple[np.ndarray, list[Line]]:
    """Points of all members, those that meet once, and the lines along them."""
    number: dict[tuple[float, float], int] = {}
    lines = []
    for n, (x1, y1, x2, y2) in enumerate(members):
        own = np.round(np.column_stack([np.linspace(x1, x2, pieces + 1), np.linspace(y1, y2, pieces + 1)]), 9)
        nodes = np.array([number.setdefault((float(x), float(y)), len(number)) for x, y in own])
        lines.append(Line(nodes, np.arange(n * pieces, (n + 1) * pieces), own))
    return np.array(list(number)), lines


def _bars(points: np.ndarray, lines: list[Line]) -> Bars:
    ends = np.concatenate([np.column_stack([line.nodes[:-1], line.nodes[1:]]) for line in lines])
    along = np.concatenate([np.linspace(0, line.length, len(line.nodes))[:-1] for line in lines])
    return Bars(points, ends, along)


def _middles(order: list[Line]) -> dict[str, tuple[float, ...]]:
    """Middles of the elements of the deck."""
    found = {}
    for line in order:
        for element, (p, q) in zip(line.elements, pairwise(line.points), strict=True):
            x, y = (p + q) / 2
            found[str(element + 1)] = (float(x), float(y), 0.0)
    return found


def _deck(points: np.ndarray, lines: list[Line], posts: int, numbers: tuple[float, float, float]) -> str:
    d, E, density = numbers
    elements = [
        f"      - {{id: {line.elements[0] + 1}-{line.elements[-1] + 1}, type: beam, nodes: {(line.nodes + 1).tolist()}, "
        "material: metal, section: bar}"
        for line in lines
    ]
    last, all_posts = lines[-1].elements[-1] + 1, lines[posts - 1].elements[-1] + 1
    feet = ", ".join(f"{n}: all" for n, (_, y) in enumerate(points, 1) if y < 1e-9)
    return "\n".join(
        [
            *("model:", "  structure:", "    nodes:"),
            *(f"      - {{{n}: [{x:.9g}, {y:.9g}]}}" for n, (x, y) in enumerate(points, 1)),
            f"    materials: {{metal: {{E: {E:.6e}, nu: 0.3, density: {density}}}}}",
            f"    sections: {{bar: {{rectangle: [{d}, {d}]}}}}",
            *("    elements:", *elements),
            f"    supports: {{{feet}}}",
            *("    plane: XY", "", "parameters:"),
            f"  - {{name: E columns, elements: 1-{all_posts}, property: E, sd: 5 %, transform: log}}",
            f"  - {{name: E beams, elements: {all_posts + 1}-{last}, property: E, sd: 5 %, transform: log}}",
            *("  - {name: density, material: metal, property: density, sd: 2 %, transform: log}", ""),
        ]
    )

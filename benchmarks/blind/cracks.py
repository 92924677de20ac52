"""Bars with one edge crack, at nodes of the deck and between them: truths are Hermite elements with springs across the crack.

A node of the truth stands at the crack; its two sides are joined by the compliance of Tada, Paris and Irwin, integrated here. Half
of the decks have bending alone. `python -m benchmarks.blind.crack_sizes` asks whether intervals hold the depths.
"""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from benchmarks.blind.case import ALTERED, DENSITY_SPREAD, E_SPREAD, Case, generator, near

KEPT = 7  # modes: 5 are fitted, 2 held out
FINE = 4  # elements of the truth in one of the deck; even, for two stand on either side of a crack
NU = 0.3
SUPPORTS = {  # of the first and the last node, and where cracks open under the lowest modes, as shares of the length
    "simple": (("TX", "TY"), ("TY",), (0.1, 0.9)),
    "cantilever": (("TX", "TY", "RZ"), (), (0.02, 0.75)),
    "free": ((), (), (0.15, 0.85)),
    "clamped": (("TX", "TY", "RZ"), ("TX", "TY", "RZ"), (0.02, 0.98)),
}
DIRECTIONS = ("TX", "TY", "RZ")


def compliance(depth: float, height: float, EI: float) -> np.ndarray:
    """Of a crack (3, 3): along the bar and across it in m/N, and of the angle in rad/(N m), by the handbook's intensity factors."""
    from scipy.integrate import quad

    t = lambda s: np.pi * s / 2
    root = lambda s: np.sqrt(np.tan(t(s)) / t(s)) / np.cos(t(s))
    bent = lambda s: root(s) * (0.923 + 0.199 * (1 - np.sin(t(s))) ** 4)
    drawn = lambda s: root(s) * (0.752 + 2.02 * s + 0.37 * (1 - np.sin(t(s))) ** 3)
    shorn = lambda s: (1.122 - 0.561 * s + 0.085 * s**2 + 0.180 * s**3) / np.sqrt(1 - s)
    F = lambda one, other: quad(lambda s: np.pi * s * one(s) * other(s), 0, depth)[0]
    scale = (1 - NU**2) * height / EI
    along, across = height**2 / 6 * F(drawn, drawn), height**2 / 6 * F(shorn, shorn)
    turning, both = 6 * F(bent, bent), height * F(bent, drawn)
    return scale * np.array([[along, 0, both], [0, across, 0], [both, 0, turning]])


def modes(inputs: dict, crack: bool = True, mass: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies in Hz (f,), rigid motion first, and motion TX, TY, RZ (nodes of the deck, 3, f)."""
    from scipy.linalg import eigh

    x, nodes, at = _mesh(inputs)
    K, M = np.zeros((2, 3 * len(x) + 3, 3 * len(x) + 3))
    for e, l in enumerate(np.diff(x)):
        first = len(x) if crack and e == at else e  # beyond the crack its node is another one
        own = np.concatenate([3 * first + np.arange(3), 3 * (e + 1) + np.arange(3)])
        k, m = _element(inputs, float(l))
        K[np.ix_(own, own)] += k
        M[np.ix_(own, own)] += m
    if crack:
        sides = np.concatenate([3 * at + np.arange(3), 3 * len(x) + np.arange(3)])
        K[np.ix_(sides, sides)] += np.kron([[1, -1], [-1, 1]], _joint(inputs))
    heavy = nodes[inputs["heavy"]]
    M[[3 * heavy, 3 * heavy + 1], [3 * heavy, 3 * heavy + 1]] += mass
    held = [3 * n + DIRECTIONS.index(d) for n, own in zip((0, nodes[-1]), inputs["held"], strict=True) for d in own]
    held += [] if inputs["axial"] else [3 * n for n in range(len(x) + 1)]
    held += [] if crack else [3 * len(x) + d for d in range(3)]
    free = np.setdiff1d(np.arange(len(K)), held)
    shift = inputs["E"] * inputs["I"] / (inputs["density"] * inputs["A"] * inputs["L"] ** 4)
    K, M = K[np.ix_(free, free)], M[np.ix_(free, free)]
    compliant, X = eigh(M, K + shift * M, subset_by_index=[len(free) - 20, len(free) - 1])  # the lowest to all digits
    shapes = np.zeros((3 * len(x) + 3, 20))
    shapes[free] = X[:, ::-1] / np.sqrt(compliant[::-1])
    return np.sqrt(np.maximum(1 / compliant[::-1] - shift, 0)) / (2 * np.pi), shapes[: 3 * len(x)].reshape(
        len(x), 3, 20
    )[nodes]


def _mesh(inputs: dict) -> tuple[np.ndarray, list[int], int]:
    """Stations x (n,), the numbers of those that are nodes of the deck, and of that at the crack."""
    deck, place = np.linspace(0, inputs["L"], inputs["elements"] + 1), inputs["place"]
    pieces = [np.linspace(a, b, FINE + 1) for a, b in pairwise(deck)]
    if np.abs(deck - place).min() > 1e-9:
        i = int(np.searchsorted(deck, place)) - 1
        pieces[i] = np.array([deck[i], (deck[i] + place) / 2, place, (place + deck[i + 1]) / 2, deck[i + 1]])
    x = np.concatenate([[0.0], *(piece[1:] for piece in pieces)])
    return x, [FINE * n for n in range(len(deck))], int(np.abs(x - place).argmin())


def _joint(inputs: dict) -> np.ndarray:
    """Stiffness (3, 3) across the crack; in bending alone it opens about the axis."""
    C = compliance(inputs["depth"], inputs["height"], inputs["E"] * inputs["I"])
    return np.linalg.inv(C) if inputs["axial"] else np.diag([0.0, *(1 / np.diag(C)[1:])])


def _element(inputs: dict, l: float) -> tuple[np.ndarray, np.ndarray]:
    """K and consistent M (6, 6) on TX, TY, RZ of both ends."""
    EI, EA, line = inputs["E"] * inputs["I"], inputs["E"] * inputs["A"], inputs["density"] * inputs["A"]
    K, M = np.zeros((2, 6, 6))
    bent, drawn, unit = np.ix_([1, 2, 4, 5], [1, 2, 4, 5]), np.ix_([0, 3], [0, 3]), np.outer([1, l, 1, l], [1, l, 1, l])
    K[bent] = EI / l**3 * unit * np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])
    M[bent] = (
        line * l / 420 * unit * np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]])
    )
    K[drawn], M[drawn] = EA / l * np.array([[1, -1], [-1, 1]]), line * l / 6 * np.array([[2, 1], [1, 2]])
    return K, M


def make(inputs: dict) -> dict[str, np.ndarray]:
    """Frequencies (7,) of the modes that bend, shapes (7, nodes) in TY, frequencies with a mass at the middle node."""
    frequency, shapes = modes(inputs)
    bends, altered = _bending(inputs, frequency, shapes), modes(inputs, mass=inputs["added"])
    return {
        "frequency": frequency[bends],
        "shapes": shapes[:, 1, bends].T,
        "altered": altered[0][_bending(inputs, *altered)],
    }


def _bending(inputs: dict, frequency: np.ndarray, shapes: np.ndarray) -> np.ndarray:
    """Numbers (from 0) of the elastic modes that bend: they move more across the bar than along it."""
    rigid = 0 if any(inputs["held"]) else 2 + inputs["axial"]
    across, along = np.abs(shapes[:, 1]).max(axis=0), np.abs(shapes[:, 0]).max(axis=0)
    return np.flatnonzero((across > along) & (np.arange(len(frequency)) >= rigid))[:KEPT]


def cases(split: str, seed: int, count: int) -> Iterator[Case]:
    """`count` cracks, of 0.1 to 0.6 of the height: every second deck in bending alone, every second pair of cracks at nodes."""
    for k in range(count):
        yield _case(k, generator(split, seed, "crack", k))


def _case(k: int, rng: np.random.Generator) -> Case:
    axial, at_node = bool(k % 2), bool(k // 2 % 2)
    first, last, (low, high) = SUPPORTS[tuple(SUPPORTS)[int(rng.integers(len(SUPPORTS)))]]
    L, elements = round(float(rng.uniform(0.4, 2.0)), 3), int(rng.integers(20, 41))
    h, place = round(L / float(rng.uniform(25, 50)), 5), float(rng.uniform(low, high)) * L
    share = 0.0 if at_node else float(rng.uniform(0.05, 0.95))
    place = (float(np.clip(place * elements // L, 1, elements - 2)) + share) * L / elements
    E, density = near(rng, 2.1e11, E_SPREAD), near(rng, 7850.0, DENSITY_SPREAD)
    inputs = {
        "L": L, "elements": elements, "height": h, "A": h * h, "I": h**4 / 12, "E": E, "density": density,
        "place": place, "depth": float(rng.uniform(0.1, 0.6)), "axial": axial, "held": [list(first), list(last)],
        "heavy": elements // 2, "added": ALTERED * 7850.0 * h * h * L,
    }  # fmt: skip
    return Case(
        name=f"crack-{'full' if axial else 'bending'}-{'node' if at_node else 'element'}-{k}",
        kind="crack",
        truth=f"{'full' if axial else 'bending'}, {'at a node' if at_node else 'in an element'}",
        groups=("local-stiffness",),
        inputs=inputs,
        make=make,
        model=_model(inputs),
        sites=tuple(f"{n}TY" for n in range(1, elements + 2)),
        numbers=tuple(int(n) + 1 for n in _bending(inputs, *modes(inputs, crack=False))),
        altered=f"{{{elements // 2 + 1}: {inputs['added']:.8g}}}",
        places=((place, 0.0, 0.0),),
        span=L,
        choices=tuple(
            n for n in range(elements + 1) if not (("TY" in first and n == 0) or ("TY" in last and n == elements))
        ),
        sizes={"depth over height": inputs["depth"]},
    )


def _model(inputs: dict) -> str:
    n, h = inputs["elements"], inputs["height"]
    kept = [[d for d in own if inputs["axial"] or d != "TX"] for own in inputs["held"]]
    held = [f"{node}: [{', '.join(own)}]" for node, own in zip((1, n + 1), kept, strict=True) if own]
    supports = f"\n    supports: {{{', '.join(held)}}}" if held else ""
    return f"""\
model:
  structure:
    nodes: {{line: {{from: 1, to: {n + 1}, start: [0, 0], end: [{inputs["L"]:.9g}, 0]}}}}
    materials: {{steel: {{E: 2.1e+11, nu: {NU}, density: 7850}}}}
    sections: {{bar: {{rectangle: [{h:.9g}, {h:.9g}]}}}}
    elements:
      - {{id: 1-{n}, type: beam, nodes: 1-{n + 1}, material: steel, section: bar}}{supports}
    {"plane: XY" if inputs["axial"] else "directions: [TY, RZ]"}

parameters:
  - {{name: E, material: steel, property: E, sd: 5 %, transform: log}}
  - {{name: density, material: steel, property: density, sd: 2 %, transform: log}}
"""

"""Straight beams, cantilevers and free ones: truths are solids in plane stress, decks are 30 elements after Euler and Bernoulli."""

from collections.abc import Callable, Iterator
from dataclasses import asdict

import numpy as np

from benchmarks.blind.case import ALTERED, DENSITY_SPREAD, E_SPREAD, Case, generator, log_uniform, near
from benchmarks.blind.solids import STATIONS, WIDTH, Solid, modes

ELEMENTS = 30
MATERIALS = (("steel", 2.1e11, 7850.0), ("aluminium", 7.0e10, 2700.0), ("titanium", 1.1e11, 4430.0))
KEPT = 8  # modes: 5 are measured at most, the rest is held out
ROOTS = {
    True: (4.730041, 7.853205, *((2 * n + 1) * np.pi / 2 for n in range(3, 12))),
    False: (1.875104, 4.694091, 7.854757, *((2 * n - 1) * np.pi / 2 for n in range(4, 12))),
}  # beta L of free beams and of cantilevers
SLENDER = 200.0  # L/h
THICK = 80.0  # L/h below which axial modes come early: the deck then has bending alone
VISIBLE = 150.0  # L/h below which shear moves mode 5 by more than 0.15 %


def make(inputs: dict) -> dict[str, np.ndarray]:
    """Frequencies (8,), shapes (8, 61) along the axis, and frequencies with the added tip mass."""
    solid = Solid(
        **{name: tuple(v) if isinstance(v, list) and name != "masses" else v for name, v in inputs["solid"].items()}
    )
    frequency, shapes = modes(solid)
    heavier = Solid(**(vars(solid) | {"masses": [*solid.masses, (solid.L, inputs["added"])]}))
    return {"frequency": frequency[:KEPT], "shapes": shapes[:KEPT], "altered": modes(heavier)[0][:KEPT]}


def cases(split: str, seed: int, count: int) -> Iterator[Case]:
    """`count` structures of each cause of one term, fewer of the others, as in the prototype."""
    for truth, draw in CAUSES.items():
        for k in range(max(1, count * SHARE.get(truth, 4) // 4)):
            yield _case(truth, draw, k, generator(split, seed, "beam", truth, k))


def _case(truth: str, draw: Callable, k: int, rng: np.random.Generator) -> Case:
    free = bool(k % 2) and truth != "root"
    material, E, density = MATERIALS[rng.integers(len(MATERIALS))]
    L = round(rng.uniform(0.4, 2.0), 3)
    h = L / (rng.uniform(*SLENDERNESS[truth]) if truth in SLENDERNESS else SLENDER)
    solid = Solid(L, h, near(rng, E, E_SPREAD), near(rng, density, DENSITY_SPREAD), free)
    cause = draw(solid, rng, k)
    mass = ALTERED * density * WIDTH * h * h * L
    fault = cause.pop("sensor_fault", {})
    groups = GROUPS[truth]
    shear = "shear" not in groups and L / h < VISIBLE
    held = L / h < THICK and "slit" not in cause  # an edge crack couples bending with axial motion
    return Case(
        name=f"beam-{truth}-{k}",
        kind="beam",
        truth=truth,
        groups=groups,
        inputs={"solid": asdict(solid) | cause, "added": mass},
        make=make,
        model=_model(L, h, free, held, material, E, density),
        sites=tuple(_site(i, L) for i in range(STATIONS)),
        numbers=_numbers(L / h, free, held),
        altered=f"{{{ELEMENTS + 1}: {mass:.8g}}}",
        places=tuple((x, 0.0, 0.0) for x in _places(cause)),
        span=L,
        outside=truth in ("half foundation", "wavy"),
        tolerated=("shear",) if shear else (),
        sensor_fault=fault,
        draws=4 if truth == "control" else 1,
        choices=tuple(range(0 if free else 3, STATIONS)),
    )


def _site(i: int, L: float) -> str | dict:
    """Station i: a node of the deck, or the middle of an element."""
    return f"{i // 2 + 1}TY" if i % 2 == 0 else {"at": [round(L * i / (STATIONS - 1), 9), 0, 0], "direction": "TY"}


def _numbers(slenderness: float, free: bool, held: bool) -> tuple[int, ...]:
    """System mode numbers of bending modes in the deck, which counts rigid-body modes, and axial ones unless they are held."""
    if held:
        return tuple(range(2 * free + 1, 2 * free + 1 + KEPT))
    radius = 1 / (slenderness * 12**0.5)  # of gyration, by L
    axial = np.pi * (np.arange(1, 20) if free else np.arange(0.5, 20)) / radius  # in the units of (beta L)^2
    bending = np.square(ROOTS[free])[:KEPT]
    bending = bending / np.sqrt(1 + 4.1 * bending * radius**2)  # shear and rotary inertia, as Timoshenko found first
    return tuple(int(3 * free + n + 1 + (axial < b).sum()) for n, b in enumerate(bending))


def _model(L: float, h: float, free: bool, held: bool, material: str, E: float, density: float) -> str:
    places = ([] if free else ["1: all"]) + ([f"{1 if free else 2}-{ELEMENTS + 1}: [TX]"] if held else [])
    support = f"\n    supports: {{{', '.join(places)}}}" if places else ""
    return f"""\
model:
  structure:
    nodes: {{line: {{from: 1, to: {ELEMENTS + 1}, start: [0, 0], end: [{L:.9g}, 0]}}}}
    materials: {{{material}: {{E: {E:.6e}, nu: 0.3, density: {density}}}}}
    sections: {{bar: {{rectangle: [{h:.9g}, {WIDTH * h:.9g}]}}}}
    elements:
      - {{id: 1-{ELEMENTS}, type: beam, nodes: 1-{ELEMENTS + 1}, material: {material}, section: bar}}{support}
    plane: XY

parameters:
  - {{name: E, material: {material}, property: E, sd: 5 %, transform: log}}
  - {{name: density, material: {material}, property: density, sd: 2 %, transform: log}}
"""


def _places(cause: dict) -> list[float]:
    """Where the local causes are."""
    places = [x for x, _ in cause.get("masses", [])]
    places += [cause["slit"][0]] if "slit" in cause else []
    places += [cause["oscillator"][0]] if "oscillator" in cause else []
    return places + ([sum(cause["segment"][:2]) / 2] if "segment" in cause else [])


def _reach(solid: Solid, rng: np.random.Generator, low: float, high: float) -> float:
    """A place: from `low` to `high` of a cantilever, from 0.1 to 0.9 of a free beam."""
    return float(solid.L * (rng.uniform(0.1, 0.9) if solid.free else rng.uniform(low, high)))


def _crack(solid: Solid, rng: np.random.Generator, k: int) -> dict:
    return {"slit": (_reach(solid, rng, 0.05, 0.75), int(rng.integers(6, 11)) / 16)}


def _shallow(solid: Solid, rng: np.random.Generator, k: int) -> dict:
    """As deep as a hinge explains: a deeper edge crack of a thick beam couples bending with axial motion."""
    return {"slit": (_reach(solid, rng, 0.05, 0.75), int(rng.integers(3, 7)) / 16)}


def _mass(solid: Solid, rng: np.random.Generator, k: int) -> dict:
    return {"masses": [(_reach(solid, rng, 0.2, 1.0), solid.line * solid.L * log_uniform(rng, 0.01, 0.12))]}


def _masses(solid: Solid, rng: np.random.Generator, k: int) -> dict:
    share = rng.uniform(0.03, 0.12, 2) * solid.line * solid.L
    places = (rng.uniform(0.15, 0.45) * solid.L, rng.uniform(0.65, 0.95) * solid.L)
    return {"masses": [(float(x), float(kg)) for x, kg in zip(places, share, strict=True)]}


def _oscillator(solid: Solid, rng: np.random.Generator, k: int) -> dict:
    kg = solid.line * solid.L * log_uniform(rng, 0.008, 0.06)
    first, last = (ROOTS[solid.free][n] ** 2 for n in (0, 4))
    rate = log_uniform(rng, 1.1 * first, 0.9 * last) * np.sqrt(solid.EI / solid.line) / solid.L**2
    return {"oscillator": (_reach(solid, rng, 0.3, 1.0), kg, float(kg * rate**2))}


def _segment(solid: Solid, rng: np.random.Generator, k: int) -> dict:
    width, loss = rng.uniform(0.06, 0.20), rng.uniform(0.12, 0.40)
    start = rng.uniform(0.1, 0.9 - width) if solid.free else rng.uniform(0.02, 0.7 - width)
    return {"segment": (float(start * solid.L), float((start + width) * solid.L), float(1 - loss))}


def _tension(solid: Solid, rng: np.random.Generator, k: int) -> dict:
    return {"tension": log_uniform(rng, 0.2, 3.0) * solid.EI / solid.L**2}


def _stiffness(solid: Solid, rng: np.random.Generator, least: float = 0.01) -> float:
    """Of a foundation, N/m2, that lifts mode 1 by `least` to 0.15 of its frequency."""
    return ((1 + log_uniform(rng, least, 0.15)) ** 2 - 1) * ROOTS[solid.free][0] ** 4 * solid.EI / solid.L**4


def _sensor(solid: Solid, rng: np.random.Generator, k: int) -> dict:
    kind = ("gain", "gain", "sign", "swap")[k // 2 % 4]
    gain = {"gain": (0.85, 1.15)[k // 2 % 2], "sign": -1.0, "swap": 1.0}[kind]
    return {"sensor_fault": {"kind": kind, "gain": gain, "pick": rng.uniform(0, 1, 2).tolist()}}


CAUSES: dict[str, Callable[[Solid, np.random.Generator, int], dict]] = {
    "control": lambda solid, rng, k: {},
    "thick": lambda solid, rng, k: {},
    "root": lambda solid, rng, k: {"root": log_uniform(rng, 0.004, 0.08)},
    "crack": _crack,
    "mass": _mass,
    "absorber": _oscillator,
    "tension": _tension,
    "soft": _segment,
    "foundation": lambda solid, rng, k: {"foundation": (0.0, solid.L, _stiffness(solid, rng))},
    "sensor": _sensor,
    "thick + crack": _shallow,
    "thick + deep crack": _crack,
    "two masses": _masses,
    "soft + mass": lambda solid, rng, k: _segment(solid, rng, k) | _mass(solid, rng, k),
    "half foundation": lambda solid, rng, k: {"foundation": (0.0, solid.L / 2, 3 * _stiffness(solid, rng, 0.05))},
    "wavy": lambda solid, rng, k: {
        "waves": (float(rng.uniform(0.06, 0.15)), float(rng.uniform(1.5, 4.0)), float(rng.uniform(0, 6.28)))
    },
}
GROUPS: dict[str, tuple[str, ...]] = {
    "control": (),
    "thick": ("shear",),
    "root": ("support",),
    "crack": ("local-stiffness",),
    "mass": ("mass",),
    "absorber": ("oscillator",),
    "tension": ("axial",),
    "soft": ("local-stiffness",),
    "foundation": ("foundation",),
    "sensor": ("sensor",),
    "thick + crack": ("shear", "local-stiffness"),
    "thick + deep crack": ("shear", "local-stiffness"),
    "two masses": ("mass", "mass"),
    "soft + mass": ("local-stiffness", "mass"),
    "half foundation": (),
    "wavy": (),
}
SHARE = {
    "thick + crack": 2,
    "thick + deep crack": 1,
    "two masses": 1,
    "soft + mass": 1,
    "half foundation": 1,
    "wavy": 1,
}  # quarters
SLENDERNESS = {
    "thick": (8.0, 25.0),
    "thick + crack": (8.0, 25.0),
    "thick + deep crack": (8.0, 25.0),
    "crack": (80.0, 200.0),
    "root": (80.0, 200.0),
}

"""Plane frames of one and two storeys: truths are beams of CalculiX (B32R), decks are elements after Euler and Bernoulli.

ccx makes a B32R a solid and holds its section rigid where beams meet at an angle or are clamped. Elements there are a 16th of the
depth long, so that the stiff piece is as short. Nodes are held out of the plane, by translations only: a node whose rotations
are held becomes rigid too, which makes the frame 7 % too high in frequency.
"""

from collections.abc import Iterator

import numpy as np

from benchmarks.blind.calculix import mass, material, solve, spring
from benchmarks.blind.case import ALTERED, DENSITY_SPREAD, E_SPREAD, Case, generator, log_uniform, near

PIECES = 10  # elements of the deck in a member
KEPT = 8
RIGID = 1e4  # rad/s times the first natural frequency: of the springs that hold masses
TRUTHS = {
    "control": (),
    "thick": ("shear",),
    "foot": ("support",),
    "corner": ("local-stiffness",),
    "soft": ("local-stiffness",),
    "mass": ("mass",),
    "absorber": ("oscillator",),
    "ground spring": ("ground-spring",),
    "gravity": ("gravity",),
}
G = 9.80665


def make(inputs: dict) -> dict[str, np.ndarray]:
    """Frequencies (8,), shapes (8, 2 k) in x and y at the k nodes of the deck, frequencies with the added mass."""
    frequency, shapes = modes(inputs)
    altered = inputs | {"masses": [*inputs["masses"], [*inputs["corner"], inputs["added"]]]}
    return {"frequency": frequency, "shapes": shapes, "altered": modes(altered)[0]}


def modes(inputs: dict) -> tuple[np.ndarray, np.ndarray]:
    """Modes in the plane. members: [[x, y, x, y], ...]; soft: [[member, from, to, factor], ...] by length; others by points."""
    nodes: dict[tuple[float, float], int] = {}
    elements = _mesh(inputs, nodes)
    at = lambda x, y: nodes[min(nodes, key=lambda p: (p[0] - x) ** 2 + (p[1] - y) ** 2)]
    lines, element = _body(inputs, nodes, elements), len(elements)
    node, hung = len(nodes), []
    rate = (RIGID * inputs["first"]) ** 2
    for x, y, kg in inputs["masses"]:
        node += 1
        hung.append(f"{node}, {x:.12g}, {y:.12g}, 0.")
        for direction in (1, 2):
            lines += spring(element := element + 1, (at(x, y), node), kg * rate, direction)
        lines += mass(element := element + 1, node, kg)
    for x, y, direction, kg, k in inputs["oscillators"]:
        node += 1
        hung.append(f"{node}, {x:.12g}, {y:.12g}, 0.")
        lines += spring(element := element + 1, (at(x, y), node), k, direction)
        lines += [*mass(element := element + 1, node, kg), "*BOUNDARY", f"{node}, {3 - direction}, {3 - direction}"]
    for x, y, k in inputs["ground"]:
        lines += spring(element := element + 1, (at(x, y),), k, 1)
    extra = ["*NODE, NSET=EXTRA", *hung, "*BOUNDARY", "EXTRA, 3, 3"] if hung else []
    watched = [at(x, y) for x, y in deck_nodes(inputs["members"])]
    found = solve("\n".join([*_ordered(lines, extra), *_steps(inputs, watched)]) + "\n")
    order = {n: i for i, n in enumerate(found.nodes.tolist())}
    u = found.shapes[:, [order[n] for n in watched], :2]
    size = abs(u).max(axis=(1, 2))
    plane = size > 1e-2 * np.median(size)  # others turn the members about their axes
    return found.frequency[plane][:KEPT], u[plane].reshape(plane.sum(), -1)[:KEPT]


def deck_nodes(members: list[list[float]]) -> list[tuple[float, float]]:
    """Points of the nodes of the deck, in the order of their numbers from 1."""
    points: dict[tuple[float, float], None] = {}
    for x1, y1, x2, y2 in members:
        for t in np.linspace(0, 1, PIECES + 1):
            points.setdefault((round(x1 + t * (x2 - x1), 9), round(y1 + t * (y2 - y1), 9)))
    return list(points)


def _mesh(inputs: dict, nodes: dict[tuple[float, float], int]) -> list[tuple[int, bool, list[int]]]:
    """(member, soft, three nodes) of each element; `nodes` is filled."""
    elements = []
    for number, (x1, y1, x2, y2) in enumerate(inputs["members"]):
        ends, length = np.array([[x1, y1], [x2, y2]]), np.hypot(x2 - x1, y2 - y1)
        graded = inputs["depth"] / length / np.array([16, 8, 4, 2, 1])
        soft = [s for s in inputs["soft"] if s[0] == number]
        wanted = [x for s in soft for x in s[1:3]] + [*graded, *(1 - graded), *np.linspace(0, 1, 2 * PIECES + 1)]
        t = np.unique(np.round(wanted, 9))
        t = t[np.append(True, np.diff(t) > 1e-7)]
        half = np.interp(np.arange(2 * len(t) - 1) / 2, np.arange(len(t)), t)
        points = np.round(ends[0] + half[:, None] * (ends[1] - ends[0]), 9)
        ids = [nodes.setdefault((float(x), float(y)), len(nodes) + 1) for x, y in points]
        for i in range(len(t) - 1):
            middle = (t[i] + t[i + 1]) / 2
            elements.append((number, any(s[1] < middle < s[2] for s in soft), ids[2 * i : 2 * i + 3]))
    return elements


def _body(inputs: dict, nodes: dict, elements: list) -> list[str]:
    """Nodes, elements, materials and supports."""
    lines = ["*NODE, NSET=NALL", *(f"{n}, {x:.12g}, {y:.12g}, 0." for (x, y), n in nodes.items())]
    d, factor = inputs["depth"], inputs["soft"][0][3] if inputs["soft"] else 1.0
    for soft in (False, True):
        for beam in (False, True):
            name = f"E{'SOFT' if soft else ''}{'BEAM' if beam else 'POST'}"
            members = [
                (e, ids)
                for e, (number, weak, ids) in enumerate(elements, 1)
                if weak == soft and (inputs["members"][number][1] == inputs["members"][number][3]) == beam
            ]
            if not members:
                continue
            lines += [f"*ELEMENT, TYPE=B32R, ELSET={name}", *(", ".join(map(str, (e, *ids))) for e, ids in members)]
            heavy = inputs["heavy"] if beam else 1.0
            lines += material(name, inputs["E"] * (factor if soft else 1), inputs["density"] * heavy)
            lines += [f"*BEAM SECTION, ELSET={name}, MATERIAL={name}, SECTION=RECT", f"{d}, {d}", "0., 0., 1."]
    feet = [n for (_, y), n in nodes.items() if abs(y) < 1e-9]
    return [*lines, "*BOUNDARY", "NALL, 3, 3", *(f"{n}, 1, 6" for n in feet)]


def _ordered(lines: list[str], extra: list[str]) -> list[str]:
    """Nodes of hung masses stand before the elements that use them."""
    first = next(i for i, line in enumerate(lines) if line.startswith("*ELEMENT"))
    return [*lines[:first], *(extra[: extra.index("*BOUNDARY")] if extra else []), *lines[first:], *extra[-2:]]


def _steps(inputs: dict, watched: list[int]) -> list[str]:
    """The eigenvalue step; before it, gravity when it is to act."""
    head = ["*NSET, NSET=SEEN", *map(str, watched)]
    step = ["*FREQUENCY", "24", "*NODE PRINT, NSET=SEEN", "U", "*END STEP"]
    if not inputs["gravity"]:
        return [*head, "*STEP", *step]
    loads = [f"{name}, GRAV, {G}, 0., -1., 0." for name in ("EPOST", "EBEAM")]
    return [*head, "*STEP, NLGEOM", "*STATIC", "*DLOAD", *loads, "*END STEP", "*STEP, PERTURBATION", *step]


def cases(split: str, seed: int, count: int) -> Iterator[Case]:
    """`count` frames of each cause."""
    for truth in TRUTHS:
        for k in range(count):
            yield _case(truth, k, generator(split, seed, "frame", truth, k))


def _case(truth: str, k: int, rng: np.random.Generator) -> Case:
    storeys = 1 + k % 2
    H, W = round(rng.uniform(0.6, 1.5), 2), round(rng.uniform(0.8, 2.0), 2)
    laden = truth == "gravity" or (truth == "control" and k % 4 > 1)  # such controls were tested where nothing weighs
    W = round(0.9 * H, 2) if laden else W
    levels = range(storeys)
    members = [[x, i * H, x, (i + 1) * H] for i in levels for x in (0.0, W)] + [
        [0.0, (i + 1) * H, W, (i + 1) * H] for i in levels
    ]
    members = [[round(x, 9) for x in member] for member in members]
    depth = round(min(H, W) / (rng.uniform(8, 14) if truth == "thick" else rng.uniform(100, 140)), 6)
    E, density = (2.1e11, 7850.0) if rng.integers(2) else (7.0e10, 2700.0)
    heavy = _heavy(rng, E, density, depth, H, W) if laden else 1.0
    weight = density * depth**2 * (2 * storeys * H + storeys * W * heavy)
    stiffness = E * depth**4 / 12
    first = np.sqrt(24 * stiffness / H**3 / weight)  # rad/s, about that of sway
    inputs = {
        "members": members, "depth": depth, "E": near(rng, E, E_SPREAD), "density": near(rng, density, DENSITY_SPREAD),
        "heavy": heavy, "first": float(first), "gravity": truth == "gravity", "soft": [], "masses": [], "oscillators": [],
        "ground": [], "corner": [W, storeys * H], "added": float(ALTERED * weight),
    }  # fmt: skip
    place = _cause(truth, rng, inputs, weight, stiffness / H**3)
    points = deck_nodes(members)
    corner = points.index((W, round(storeys * H, 9))) + 1
    return Case(
        name=f"frame-{truth}-{k}",
        kind="frame",
        truth=truth,
        groups=TRUTHS[truth],
        inputs=inputs,
        make=make,
        model=_model(members, points, depth, heavy, E, density),
        sites=tuple(f"{n}T{d}" for n in range(1, len(points) + 1) for d in "XY"),
        numbers=tuple(range(1, KEPT + 1)),
        altered=f"{{{corner}: {inputs['added']:.8g}}}",
        places=(tuple(place),) if place and truth != "foot" else (),
        span=float(max(W, storeys * H)),
        draws=4 if truth == "control" else 1,
        choices=_choices(members, points),
    )


def _heavy(rng: np.random.Generator, E: float, density: float, depth: float, H: float, W: float) -> float:
    """Times the density, what the beams carry: their weight loads a post to 1 to 5 % of its strength, which bends beams little."""
    critical = np.pi**2 * E * depth**4 / 12 / H**2
    return float(2 * critical * rng.uniform(0.01, 0.05) / (density * depth**2 * W * G))


def _choices(members: list, points: list) -> tuple[int, ...]:
    """Sensors sit across members: x on posts, y on beams."""
    where = []
    for n, (x, y) in enumerate(points):
        on_beam = any(m[1] == m[3] == y and m[0] < x < m[2] for m in members)
        if y > 0:
            where.append(2 * n + on_beam)
    return tuple(where)


def _cause(truth: str, rng: np.random.Generator, inputs: dict, weight: float, stiffness: float) -> list[float]:
    """Puts the cause into `inputs`; its place [x, y, z], or nothing."""
    number = int(rng.integers(len(inputs["members"])))
    x1, y1, x2, y2 = inputs["members"][number]
    length, upright = abs(x2 - x1) + abs(y2 - y1), x1 == x2
    t = float(rng.integers(4, 2 * PIECES - 3)) / (2 * PIECES)
    if truth in ("foot", "corner"):
        number = 0 if truth == "foot" else number
        x1, y1, x2, y2 = inputs["members"][number]
        piece = inputs["depth"] / (abs(x2 - x1) + abs(y2 - y1))
        low = 0.0 if truth == "foot" or (rng.integers(2) and y1 > 0) else 1 - piece  # a corner at a foot is a foot
        inputs["soft"].append([number, low, low + piece, log_uniform(rng, 0.01, 0.1)])
        t = low + piece / 2
    elif truth == "soft":
        width = rng.uniform(0.15, 0.35)
        t = float(rng.uniform(width / 2 + 0.03, 0.97 - width / 2))
        inputs["soft"].append([number, t - width / 2, t + width / 2, float(rng.uniform(0.5, 0.8))])
    place = [x1 + t * (x2 - x1), y1 + t * (y2 - y1)]
    if truth == "mass":
        inputs["masses"].append([*place, float(weight * log_uniform(rng, 0.01, 0.08))])
    elif truth == "absorber":
        kg = weight * log_uniform(rng, 0.01, 0.05)
        rate = inputs["first"] * log_uniform(rng, 1.3, 6)
        inputs["oscillators"].append([*place, 1 if upright else 2, kg, float(kg * rate**2)])
    elif truth == "ground spring":
        place = inputs["corner"] if y2 == y1 else [x2, y2 if rng.integers(2) else (y1 + y2) / 2]
        inputs["ground"].append([*place, float(stiffness * log_uniform(rng, 0.5, 10))])
    return [*place, 0.0] if truth in ("corner", "soft", "mass", "absorber", "ground spring") and length else []


def _model(members: list, points: list, depth: float, heavy: float, E: float, density: float) -> str:
    nodes = [f"      - {{{n}: [{x:.9g}, {y:.9g}]}}" for n, (x, y) in enumerate(points, 1)]
    elements = []
    for number, (x1, y1, x2, y2) in enumerate(members):
        ids = [
            points.index((round(x1 + t * (x2 - x1), 9), round(y1 + t * (y2 - y1), 9))) + 1
            for t in np.linspace(0, 1, PIECES + 1)
        ]
        more = f", nonstructural_mass: {(heavy - 1) * density * depth**2:.9g}" if heavy != 1 and y1 == y2 else ""
        first = number * PIECES + 1
        elements.append(
            f"      - {{id: {first}-{first + PIECES - 1}, type: beam, nodes: {ids}, material: metal, section: bar{more}}}"
        )
    feet = ", ".join(f"{n}: all" for n, (_, y) in enumerate(points, 1) if y == 0)
    return "\n".join(
        [
            "model:",
            "  structure:",
            *("    nodes:", *nodes),
            f"    materials: {{metal: {{E: {E:.6e}, nu: 0.3, density: {density}}}}}",
            f"    sections: {{bar: {{rectangle: [{depth}, {depth}]}}}}",
            *("    elements:", *elements),
            f"    supports: {{{feet}}}",
            "    plane: XY",
            "",
            "parameters:",
            "  - {name: E, material: metal, property: E, sd: 5 %, transform: log}",
            "  - {name: density, material: metal, property: density, sd: 2 %, transform: log}",
            "",
        ]
    )

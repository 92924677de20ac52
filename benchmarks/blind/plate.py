"""A plate clamped along one edge, solids of CalculiX: its K and M are imported; the truth is the same mesh and one thing more."""

import tempfile
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import numpy as np

from benchmarks.blind.calculix import mass, material, run, solve, spring
from benchmarks.blind.case import ALTERED, DENSITY_SPREAD, E_SPREAD, Case, generator, log_uniform, near

COLUMNS, ROWS = 6, 4  # elements
KEPT = 8
TRUTHS = {
    "control": (),
    "mass": ("mass",),
    "absorber": ("oscillator",),
    "ground spring": ("ground-spring",),
    "edge gives way": (),
}
NOMINAL = (7.0e10, 2700.0, 0.33)
FILES = ("sti", "mas", "dof")


def points(size: list[float]) -> dict[tuple[int, int, int], tuple[float, float, float]]:
    """Places of the nodes by half steps along the edges; numbers from 1 follow their order."""
    return {
        (i, j, k): (size[0] * i / (2 * COLUMNS), size[1] * j / (2 * ROWS), size[2] * k / 2)
        for k in range(3)
        for j in range(2 * ROWS + 1)
        for i in range(2 * COLUMNS + 1)
        if i % 2 + j % 2 + k % 2 < 2
    }


def upper(size: list[float]) -> list[int]:
    """Nodes of the upper face beside the clamped edge, corners of elements."""
    return [n for n, (i, j, k) in enumerate(points(size), 1) if k == 2 and i > 1 and i % 2 == j % 2 == 0]


def mesh(size: list[float], E: float, density: float, released: tuple[int, ...] = ()) -> list[str]:
    """Cards of the plate; `released`: rows of half steps along the edge that are not clamped."""
    number = {place: n for n, place in enumerate(points(size), 1)}
    lines = [
        "*NODE, NSET=NALL",
        *(f"{n}, " + ", ".join(f"{x:.12g}" for x in points(size)[p]) for p, n in number.items()),
    ]
    square, middles = [(0, 0), (2, 0), (2, 2), (0, 2)], [(1, 0), (2, 1), (1, 2), (0, 1)]
    order = (
        [(*c, k) for k in (0, 2) for c in square]
        + [(*c, k) for k in (0, 2) for c in middles]
        + [(*c, 1) for c in square]
    )
    lines.append("*ELEMENT, TYPE=C3D20R, ELSET=BODY")
    for e, (x, y) in enumerate(np.ndindex(COLUMNS, ROWS), 1):
        words = [str(e), *(str(number[2 * x + i, 2 * y + j, k]) for i, j, k in order)]
        lines += [", ".join(words[:15]) + ",", ", ".join(words[15:])]
    lines += [*material("BODY", E, density, NOMINAL[2]), "*SOLID SECTION, ELSET=BODY, MATERIAL=BODY"]
    held = [n for (i, j, _), n in number.items() if i == 0 and j not in released]
    return [*lines, "*BOUNDARY", *(f"{n}, 1, 3" for n in held)]


def make(inputs: dict) -> dict[str, np.ndarray]:
    """Frequencies (8,), deflections (8, k) of the upper nodes, frequencies with the added mass."""
    frequency, shapes = _solved(inputs, inputs["hung"])
    altered, _ = _solved(inputs, [*inputs["hung"], [inputs["corner"], inputs["added"], 0.0]])
    return {"frequency": frequency, "shapes": shapes, "altered": altered}


def _solved(inputs: dict, hung: list) -> tuple[np.ndarray, np.ndarray]:
    """Modes. hung: [[node, kg, N/m], ...], fast to the node without a spring; ground: [[node, N/m], ...]."""
    size = inputs["size"]
    lines, node, element = (
        mesh(size, inputs["E"], inputs["density"], tuple(inputs["released"])),
        len(points(size)),
        1000,
    )
    for at, kg, k in hung:
        if k:
            node += 1
            lines += ["*NODE", f"{node}, 0., 0., 0.", *spring(element := element + 1, (at, node), k, direction=3)]
            lines += ["*BOUNDARY", f"{node}, 1, 2"]
        lines += mass(element := element + 1, node if k else at, kg)
    for at, k in inputs["ground"]:
        lines += spring(element := element + 1, (at,), k, direction=3)
    seen = upper(size)
    lines += [
        "*NSET, NSET=SEEN",
        *map(str, seen),
        "*STEP",
        "*FREQUENCY",
        "16",
        "*NODE PRINT, NSET=SEEN",
        "U",
        "*END STEP",
    ]
    found = solve("\n".join(lines) + "\n")
    order = {n: i for i, n in enumerate(found.nodes.tolist())}
    u = found.shapes[:, [order[n] for n in seen]]
    across = abs(u[:, :, 2]).max(axis=1) > abs(u[:, :, :2]).max(axis=(1, 2))  # others move in the plane of the plate
    return found.frequency[across][:KEPT], u[across][:KEPT, :, 2]


@cache
def _matrices(size: tuple[float, ...]) -> dict[str, str]:
    """The files of K, M and their degrees of freedom, by suffix, and of the nodes."""
    lines = mesh(list(size), *NOMINAL[:2])
    with tempfile.TemporaryDirectory() as folder:
        path = run(
            Path(folder), "\n".join([*lines, "*STEP", "*FREQUENCY, SOLVER=MATRIXSTORAGE", "3", "*END STEP"]) + "\n"
        )
        texts = {suffix: path.with_suffix(f".{suffix}").read_text() for suffix in FILES}
    return texts | {"inp": "\n".join(lines) + "\n"}


def cases(split: str, seed: int, count: int) -> Iterator[Case]:
    """`count` plates of each cause, all of one size, which is another for each seed and split."""
    rng = generator(split, seed, "plate")
    a, share = rng.uniform(0.3, 0.6), rng.uniform(0.55, 0.85)
    size = tuple(round(float(x), 4) for x in (a, a * share, a / rng.uniform(60, 90)))
    name = f"plate-{split}-{seed}"
    for truth in TRUTHS:
        for k in range(count):
            yield _case(truth, k, generator(split, seed, "plate", truth, k), size, name)


def _case(truth: str, k: int, rng: np.random.Generator, size: tuple[float, ...], files: str) -> Case:
    nodes, places = upper(list(size)), list(points(list(size)).values())
    E, density, nu = NOMINAL
    weight = density * float(np.prod(size))
    first = 3.5 / size[0] ** 2 * np.sqrt(E * size[2] ** 2 / (12 * (1 - nu**2) * density))  # rad/s, about
    at = int(rng.choice([n for n in nodes if places[n - 1][0] > 0.3 * size[0]]))
    inputs = {
        "plate": True, "size": list(size), "E": near(rng, E, E_SPREAD), "density": near(rng, density, DENSITY_SPREAD),
        "hung": [], "ground": [], "released": [], "corner": nodes[-1], "added": ALTERED * weight,
    }  # fmt: skip
    if truth == "mass":
        inputs["hung"].append([at, weight * log_uniform(rng, 0.01, 0.12), 0.0])
    elif truth == "absorber":
        kg = weight * log_uniform(rng, 0.008, 0.06)
        inputs["hung"].append([at, kg, float(kg * (first * log_uniform(rng, 1.3, 6)) ** 2)])
    elif truth == "ground spring":
        inputs["ground"].append([at, float(weight * first**2 * log_uniform(rng, 0.03, 1.0))])
    elif truth == "edge gives way":
        start = int(rng.integers(2)) * ROWS
        inputs["released"] = list(range(start, start + int(rng.integers(3, 6))))
    return Case(
        name=f"plate-{truth}-{k}",
        kind="plate",
        truth=truth,
        groups=TRUTHS[truth],
        inputs=inputs,
        make=make,
        model=_model(files),
        sites=tuple(f"{n}TZ" for n in nodes),
        numbers=tuple(range(1, KEPT + 1)),
        altered=f"{{{nodes[-1]}: {inputs['added']:.8g}}}",
        places=(places[at - 1],) if TRUTHS[truth] else (),
        span=size[0],
        outside=truth == "edge gives way",
        draws=4 if truth == "control" else 1,
        files={f"{files}.{suffix}": text for suffix, text in _matrices(size).items()},
    )


def _model(files: str) -> str:
    return f"""\
model:
  stiffness: {{file: {files}.sti}}
  mass: {{file: {files}.mas}}
  dofs: {{file: {files}.dof}}
  nodes: {{file: {files}.inp}}

parameters:
  - {{name: E, nominal: 1, sd: 5 %, transform: log, stiffness: {{file: {files}.sti}}}}
  - {{name: density, nominal: 1, sd: 2 %, transform: log, mass: {{file: {files}.mas}}}}
"""

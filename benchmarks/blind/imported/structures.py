"""The structures: a stiffened panel of shells, a bracket of solids, a box of shells, each on feet; others beside this file."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from benchmarks.blind.imported.castings import housing, pipe
from benchmarks.blind.imported.frames import frame, tower
from benchmarks.blind.imported.parts import Mesh


def panel(rng: np.random.Generator) -> Mesh:
    """A skin with four stiffeners, held at patches of its corners."""
    mesh, a, b = Mesh(), rng.uniform(0.7, 0.9), rng.uniform(0.45, 0.6)
    n, m, height = 12, 10, rng.uniform(0.022, 0.03)
    mesh.quads("SKIN", (0, 0, 0), (a, 0, 0), (0, b, 0), (n, m), 0.003)
    for k in range(4):
        y = b * (2 * k + 2) / m
        mesh.quads(f"STIFFENER_{k + 1}", (0, y, 0), (a, 0, 0), (0, 0, height), (n, 1), 0.003)
    dx, dy = a / n, b / m
    for k, (x, y, sx, sy) in enumerate([(0, 0, 1, 1), (a, 0, -1, 1), (a, b, -1, -1), (0, b, 1, -1)], 1):
        mesh.supports[f"FOOT_{k}"] = mesh.near(*[(x + i * sx * dx, y + j * sy * dy, 0) for i in (0, 1) for j in (0, 1)])
    mesh.sensors = [(mesh.near((a * i / n, b * j / m, 0))[0], 3) for i in (0, 3, 6, 9, 12) for j in (1, 3, 5, 7, 9)]
    mesh.sensors += [(mesh.near((a * i / n, b * (2 * k + 2) / m, height))[0], 2) for k in range(4) for i in (3, 9)]
    return mesh


def bracket(rng: np.random.Generator) -> Mesh:
    """A plate on four feet that carries an upright wall with two gussets."""
    mesh, t = Mesh(), 0.012
    a, b, h = rng.uniform(0.26, 0.34), rng.uniform(0.18, 0.24), rng.uniform(0.2, 0.26)
    nx, ny, nz = 12, 8, 8
    dx, dy = a / nx, b / ny
    mesh.bricks("BASE", (0, 0, 0), (a, b, t), (nx, ny, 1))
    corners = [(0, 0), (a - 2 * dx, 0), (a - 2 * dx, b - 2 * dy), (0, b - 2 * dy)]
    for k, (x, y) in enumerate(corners, 1):
        mesh.bricks(f"PAD_{k}", (x, y, -0.02), (x + 2 * dx, y + 2 * dy, 0), (2, 2, 1), "STEEL")
        mesh.supports[f"FOOT_{k}"] = mesh.near(*[(x + i * dx, y + j * dy, -0.02) for i in range(3) for j in range(3)])
    mesh.bricks("WALL", (0, 3 * dy, t), (a, 4 * dy, t + h), (nx, 1, nz))
    for k, i in enumerate((2, 9), 1):
        mesh.bricks(f"GUSSET_{k}", (i * dx, 4 * dy, t), ((i + 1) * dx, 6 * dy, t + h / 2), (1, 2, nz // 2))
    top = [(a * i / nx, 3 * dy, t + h * j / nz) for i in (0, 4, 8, 12) for j in (2, 5, 8)]
    mesh.sensors = [(n, 2) for n in mesh.near(*top)] + [(n, 1) for n in mesh.near(*top[2::6])]
    mesh.sensors += [
        (n, 3) for n in mesh.near(*[(a * i / nx, b * j / ny, t) for i in (0, 4, 8, 12) for j in (0, 2, 6, 8)])
    ]
    return mesh


def box(rng: np.random.Generator) -> Mesh:
    """An open box of shells: floor, four walls and two ribs, on four bolted spots of its floor."""
    mesh, n, m, h = Mesh(), 10, 8, 3
    a, b, c = rng.uniform(0.45, 0.6), rng.uniform(0.35, 0.42), rng.uniform(0.12, 0.18)
    mesh.quads("FLOOR", (0, 0, 0), (a, 0, 0), (0, b, 0), (n, m), 0.004)
    sides = {"WALL_1": ((0, 0, 0), (a, 0, 0), n), "WALL_2": ((a, 0, 0), (0, b, 0), m),
             "WALL_3": ((0, b, 0), (a, 0, 0), n), "WALL_4": ((0, 0, 0), (0, b, 0), m)}  # fmt: skip
    for name, (origin, u, count) in sides.items():
        mesh.quads(name, origin, u, (0, 0, c), (count, h), 0.003)
    for k, i in enumerate((3, 7), 1):
        mesh.quads(f"RIB_{k}", (a * i / n, 0, 0), (0, b, 0), (0, 0, c / h), (m, 1), 0.003)
    for k, (i, j) in enumerate([(1, 1), (8, 1), (8, 6), (1, 6)], 1):
        own = [(a * (i + p) / n, b * (j + q) / m, 0) for p in (0, 1) for q in (0, 1)]
        mesh.supports[f"BOLT_{k}"] = mesh.near(*own)
    mesh.sensors = [
        (x, 3) for x in mesh.near(*[(a * i / n, b * j / m, 0) for i in (0, 3, 5, 7, 10) for j in (0, 2, 4, 6, 8)])
    ]
    mesh.sensors += [(x, 2) for y in (0, b) for x in mesh.near(*[(a * i / n, y, c) for i in (0, 3, 5, 7, 10)])]
    mesh.sensors += [(x, 1) for x0 in (0, a) for x in mesh.near(*[(x0, b * j / m, c) for j in (2, 4, 6)])]
    return mesh


@dataclass(frozen=True)
class Family:
    """A structure: parts may be softer, heavier or of the wrong material; missing; welds may be cracked; skins thinner."""

    build: Callable[[np.random.Generator], Mesh]
    parts: tuple[str, ...]
    missing: tuple[str, ...]
    welds: tuple[str, ...] = ()
    skins: tuple[str, ...] = ()

    def of(self, kind: str) -> tuple[str, ...]:
        """The sets that a kind of change may be of."""
        return {"missing": self.missing, "weld": self.welds, "thinner": self.skins}.get(kind, self.parts)


def _numbered(name: str, marks) -> tuple[str, ...]:
    return tuple(f"{name}_{mark}" for mark in marks)


_STIFFENERS, _WALLS, _RIBS = (
    _numbered("STIFFENER", range(1, 5)),
    _numbered("WALL", range(1, 5)),
    _numbered("RIB", (1, 2)),
)
_GUSSETS, _BRACES = _numbered("GUSSET", (1, 2)), _numbered("BRACE", range(1, 5))
_BULKHEADS = _numbered("BULKHEAD", (1, 2, 3))
_PANELS = _numbered("WALL", (f"{course}{side}" for course in (1, 2) for side in "ABCD"))
STRUCTURES = {
    "panel": Family(panel, _STIFFENERS, _STIFFENERS, (), ("SKIN",)),
    "bracket": Family(bracket, _GUSSETS + _numbered("PAD", range(1, 5)), _GUSSETS),
    "box": Family(box, _WALLS + _RIBS, _RIBS, (), _WALLS),
    "frame": Family(frame, _numbered("COLUMN", range(1, 7)) + _BRACES, _BRACES),
    "tower": Family(tower, _numbered("LEG", range(1, 5)) + _PANELS, _BRACES, (), _PANELS),
    "pipe": Family(pipe, _numbered("PIPE", range(1, 5)), (), _numbered("WELD", range(1, 5))),
    "housing": Family(housing, (*_BULKHEADS, "SIDE_A", "SIDE_B", "FRONT", "REAR", "HEAD"), (*_BULKHEADS, "RIB")),
}

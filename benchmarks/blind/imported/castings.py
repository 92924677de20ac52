"""Structures of solids: a pipe with a bolted flange and a saddle, and a housing like that of an engine, of any fineness."""

import numpy as np

from benchmarks.blind.imported.parts import Mesh


def pipe(rng: np.random.Generator) -> Mesh:
    """Four lengths of a pipe with a flange on six bolts at one end and a saddle; a row of elements at each weld."""
    mesh, n = Mesh(), 12
    r, t, length = rng.uniform(0.06, 0.08), 0.008, rng.uniform(0.9, 1.2)
    cuts = np.linspace(0.03, length, 5)
    at = lambda x, r, i: (x, r * np.cos(2 * np.pi * i / n), r * np.sin(2 * np.pi * i / n))

    def ring(name: str, x0: float, x1: float, count: int, inner: float, outer: float, layers: int = 1) -> None:
        xs, rs = np.linspace(x0, x1, count + 1), np.linspace(inner, outer, layers + 1)
        for k, j, i in np.ndindex(count, layers, n):
            square = [at(xs[k], rs[j + p], i + q) for p, q in ((0, 0), (1, 0), (1, 1), (0, 1))]
            far = [at(xs[k + 1], rs[j + p], i + q) for p, q in ((0, 0), (1, 0), (1, 1), (0, 1))]
            mesh.brick(name, square + far, "STEEL")

    ring("FLANGE", 0, 0.03, 2, r, r + t)
    ring("RIM", 0, 0.03, 2, r + t, r + 0.05, 2)
    for k in range(4):
        ring(f"WELD_{k + 1}", cuts[k], cuts[k] + 0.012, 1, r, r + t)
        ring(f"PIPE_{k + 1}", cuts[k] + 0.012, cuts[k + 1], 7, r, r + t)
    outer = r + 0.05
    for k in range(6):
        own = [at(0, radius, 2 * k + i) for i in (0, 1) for radius in (r + t + (0.05 - t) / 2, outer)]
        mesh.supports[f"BOLT_{k + 1}"] = mesh.near(*own)
    xs = np.linspace(cuts[2] + 0.012, cuts[3], 8)
    mesh.supports["SADDLE"] = mesh.near(*[at(x, r + t, i) for x in xs[3:5] for i in (8, 9, 10)])
    stations = [*np.linspace(cuts[0], cuts[3], 7), (cuts[3] + length) / 2, length]
    mesh.sensors = [(mesh.near(at(x, r + t, i))[0], d) for x in stations for i, d in ((0, 2), (3, 3), (6, 2), (9, 3))]
    return mesh


def housing(rng: np.random.Generator, fine: int = 1) -> Mesh:
    """A block with side walls, bulkheads, a head and a rib, on four mounts, of bricks; 1e5 unknowns at fine = 3."""
    mesh, counts = Mesh(), np.array([24, 12, 12]) * fine
    size = np.array([rng.uniform(0.42, 0.5), rng.uniform(0.22, 0.26), rng.uniform(0.24, 0.28)])
    square = ((0, 0), (1, 0), (1, 1), (0, 1))
    for i, j, k in np.ndindex(counts[0], counts[1], counts[2] + fine):
        low = np.array([i, j, k - fine])
        name = _part(*low.tolist(), counts, fine)
        if name:
            corners = [size / counts * (low + np.array([a, b, c])) for c in (0, 1) for a, b in square]
            mesh.brick(name, corners, "STEEL" if "MOUNT" in name else "ALU", "C3D8I" if fine == 1 else "C3D8")
    at = np.array(list(mesh.number))
    for which in range(4):
        own = (at[:, 0] > size[0] / 2) == bool(which & 1), (at[:, 1] > size[1] / 2) == bool(which & 2)
        mesh.supports[f"FOOT_{which + 1}"] = mesh.near(*at[(at[:, 2] < at[:, 2].min() + 1e-6) & own[0] & own[1]])
    spots = [0.0, 1 / 6, 1 / 3, 1 / 2, 2 / 3, 5 / 6, 1.0]
    top = [(s, q, 1.0) for s in spots for q in (0, 0.5, 1)]
    sides = [(s, y, q) for s in spots for y in (0, 1) for q in (0.35, 0.7)]
    ends = [(x, q, p) for x in (0, 1) for q in (0.25, 0.75) for p in (0.3, 0.7)]
    mesh.sensors = [(mesh.near(size * x)[0], d) for d, each in ((3, top), (2, sides), (1, ends)) for x in each]
    return mesh


def _part(x: int, y: int, z: int, counts: np.ndarray, thick: int) -> str | None:
    """The part of a housing that a cell belongs to, if any; a wall is `thick` cells."""
    half, length = counts[1] // 2, counts[0]
    if z < 0:
        corner = min(x, length - 1 - x) < 4 * thick and min(y, counts[1] - 1 - y) < 2 * thick
        return f"MOUNT_{1 + (x >= length // 2) + 2 * (y >= half)}" if corner else None
    if z >= counts[2] - thick:
        return "HEAD"
    if min(y, counts[1] - 1 - y) < thick:
        return "SIDE_A" if y < half else "SIDE_B"
    if min(x, length - 1 - x) < thick:
        return "FRONT" if x < half else "REAR"
    for k in (1, 2, 3):
        if 0 <= x - length * k // 4 < thick:
            return f"BULKHEAD_{k}"
    return "RIB" if 0 <= y - half < thick and z >= counts[2] - 4 * thick else None

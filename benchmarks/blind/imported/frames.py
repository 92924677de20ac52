"""Structures of beams: a braced frame of B31, and a tower with walls of shells on legs of beams."""

import numpy as np

from benchmarks.blind.imported.parts import Mesh

_PER_MEMBER = 4  # elements


def frame(rng: np.random.Generator) -> Mesh:
    """Two storeys of two bays by one, columns pinned at their feet, with girders and two braces in each direction."""
    mesh, side = Mesh(), 0.05
    x, y = np.cumsum([0, *rng.uniform(1.4, 2.0, 2)]), np.array([0, rng.uniform(1.2, 1.8)])
    z = np.cumsum([0, *rng.uniform(1.3, 1.7, 2)])
    for foot, (i, j) in enumerate(np.ndindex(3, 2), 1):
        mesh.beams(f"COLUMN_{foot}", [(x[i], y[j], z[0]), (x[i], y[j], z[1]), (x[i], y[j], z[2])], _PER_MEMBER, side)
        mesh.supports[f"FOOT_{foot}"] = mesh.near((x[i], y[j], z[0]))
    for k in (1, 2):
        for j in (0, 1):
            mesh.beams(f"GIRDER_{k}{'AB'[j]}", [(at, y[j], z[k]) for at in x], _PER_MEMBER, 0.8 * side)
        for i in range(3):
            mesh.beams(f"CROSS_{k}{'ABC'[i]}", [(x[i], y[0], z[k]), (x[i], y[1], z[k])], _PER_MEMBER, 0.8 * side)
    braces = [((x[0], y[0], z[0]), (x[1], y[0], z[1])), ((x[2], y[1], z[0]), (x[1], y[1], z[1])),
              ((x[0], y[0], z[1]), (x[0], y[1], z[2])), ((x[2], y[1], z[0]), (x[2], y[0], z[1]))]  # fmt: skip
    for k, ends in enumerate(braces, 1):
        mesh.beams(f"BRACE_{k}", list(ends), _PER_MEMBER, 0.4 * side)
    joints = mesh.near(*[(a, b, c) for a in x for b in y for c in z[1:]])
    mesh.sensors = [(n, d) for n in joints for d in (1, 2)]
    middles = [(a, b, (z[0] + z[1]) / 2) for a in x for b in y]
    mesh.sensors += [(n, d) for n in mesh.near(*middles) for d in (1, 2)]
    return mesh


def tower(rng: np.random.Generator) -> Mesh:
    """A square shaft of shells in two courses with a deck, on four legs of beams with braces."""
    mesh, a, h, n = Mesh(), rng.uniform(0.9, 1.2), rng.uniform(0.8, 1.1), 4
    up, side = rng.uniform(0.9, 1.2), 0.04
    corners = [(0, 0), (a, 0), (a, a), (0, a)]
    for k, (x, y) in enumerate(corners, 1):
        mesh.beams(f"LEG_{k}", [(x, y, -up), (x, y, 0)], _PER_MEMBER, side)
        mesh.supports[f"FOOT_{k}"] = mesh.near((x, y, -up))
        other = corners[k % 4]
        mesh.beams(f"BRACE_{k}", [(x, y, -up), (*other, 0)], _PER_MEMBER, 0.5 * side)
    for course in (1, 2):
        z = (course - 1) * h
        for k, (x, y) in enumerate(corners):
            to = corners[(k + 1) % 4]
            u = (to[0] - x, to[1] - y, 0)
            mesh.quads(f"WALL_{course}{'ABCD'[k]}", (x, y, z), u, (0, 0, h), (n, n), 0.004, "STEEL")
    mesh.quads("DECK", (0, 0, 2 * h), (a, 0, 0), (0, a, 0), (n, n), 0.005, "STEEL")
    mesh.sensors = [(i, d) for i in mesh.near(*[(x, y, z) for x, y in corners for z in (0, h, 2 * h)]) for d in (1, 2)]
    walls = [(a / 2, 0, 2), (a, a / 2, 1), (a / 2, a, 2), (0, a / 2, 1)]
    mesh.sensors += [(mesh.near((x, y, z))[0], d) for x, y, d in walls for z in (h / 2, h, 3 * h / 2)]
    mesh.sensors += [
        (i, 3) for i in mesh.near(*[(a * p, a * q, 2 * h) for p in (0.25, 0.5, 0.75) for q in (0.25, 0.75)])
    ]
    mesh.sensors += [(i, d) for i in mesh.near(*[(x, y, -up / 2) for x, y in corners]) for d in (1, 2)]
    return mesh

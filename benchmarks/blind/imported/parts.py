"""Meshes of shells and solids as cards, in named sets; and what is changed in them."""

from dataclasses import dataclass, field
from itertools import count as counted
from itertools import pairwise

import numpy as np

MATERIALS = {"ALU": (7.0e10, 0.33, 2700.0), "STEEL": (2.1e11, 0.3, 7850.0)}


@dataclass
class Mesh:
    """Nodes by place, supports by name, sensors (node, direction 1 to 3).

    sets: type, elements, material, and thickness of shells or side of the section of beams, by name.
    """

    number: dict[tuple[float, float, float], int] = field(default_factory=dict)
    sets: dict[str, tuple[str, list[tuple[int, ...]], str, float]] = field(default_factory=dict)
    supports: dict[str, list[int]] = field(default_factory=dict)
    sensors: list[tuple[int, int]] = field(default_factory=list)

    def node(self, x: float, y: float, z: float) -> int:
        """The node at a place, a new one where there is none."""
        return self.number.setdefault(
            (round(float(x), 7), round(float(y), 7), round(float(z), 7)), len(self.number) + 1
        )

    def quads(self, name: str, origin, u, v, counts, thickness: float, material: str = "ALU") -> None:
        """Shells (S4) over origin + s u + t v."""
        origin, u, v = map(np.array, (origin, u, v))
        at = lambda i, j: self.node(*(origin + u * i / counts[0] + v * j / counts[1]))
        own = [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for i, j in np.ndindex(*counts)]
        self.sets.setdefault(name, ("S4", [], material, thickness))[1].extend(own)

    def bricks(self, name: str, low, high, counts, material: str = "ALU") -> None:
        """Solids (C3D8I) over a box."""
        low, size = np.array(low), np.array(high) - np.array(low)
        square = ((0, 0), (1, 0), (1, 1), (0, 1))
        for i, j, k in np.ndindex(*counts):
            corners = [low + size * np.array([i + a, j + b, k + c]) / counts for c in (0, 1) for a, b in square]
            self.brick(name, corners, material)

    def brick(self, name: str, corners, material: str = "ALU", kind: str = "C3D8I") -> None:
        """One solid by its eight corners."""
        nodes = tuple(self.node(*corner) for corner in corners)
        self.sets.setdefault(name, (kind, [], material, 0.0))[1].append(nodes)

    def beams(self, name: str, along, per_span: int, side: float, material: str = "STEEL") -> None:
        """Beams (B31) of a square section along straight spans between places."""
        line = [np.array(a) + (np.array(b) - a) * i / per_span for a, b in pairwise(along) for i in range(per_span)]
        nodes = [self.node(*x) for x in [*line, along[-1]]]
        self.sets.setdefault(name, ("B31", [], material, side))[1].extend(pairwise(nodes))

    def near(self, *places) -> list[int]:
        """The nodes nearest to places."""
        at = np.array(list(self.number))
        return [list(self.number.values())[int(np.argmin(np.linalg.norm(at - np.array(p), axis=1)))] for p in places]


@dataclass(frozen=True)
class Concealed:
    """What is changed in the solver's input: kind, and the set, support or node that it is of; size: of the change.

    E, rho (by material): factors of the true structure, which the model does not know. shear: of what supports stand on, its
    stiffness in their plane, over that across it.
    """

    kind: str = "control"
    name: str = ""
    size: float = 0.0
    E: dict[str, float] = field(default_factory=dict)
    shear: float = 1.0

    def holds(self, support: str) -> bool:
        """Whether a support is as the model has it."""
        loose = {"loose": (self.name,), "two": self.name.split(" and "), "rubber": (support,)}.get(self.kind, ())
        return support not in loose


def cards(mesh: Mesh, change: Concealed, modes: int = 0) -> str:
    """The input file; modes: a step for so many, with the displacements of the sensors."""
    lines = ["*NODE, NSET=ALL", *(f"{n}, {x!r}, {y!r}, {z!r}" for (x, y, z), n in mesh.number.items())]
    count = 0
    for name, (kind, elements, _, _) in mesh.sets.items():
        if (change.kind, change.name) == ("missing", name):
            continue
        lines.append(f"*ELEMENT, TYPE={kind}, ELSET={name}")
        for nodes in elements:
            count += 1
            lines.append(f"{count}, {', '.join(map(str, nodes))}")
    known: set[str] = set()
    for name, (kind, _, material, thickness) in mesh.sets.items():
        if (change.kind, change.name) != ("missing", name):
            lines += _section(name, kind, material, thickness, change, known)
    for name, nodes in mesh.supports.items():
        lines += [f"*NSET, NSET={name}", *(f"{n}," for n in nodes)]
    if change.kind == "mass":
        lines += [
            "*ELEMENT, TYPE=MASS, ELSET=EXTRA",
            f"{count + 1}, {change.name}",
            "*MASS, ELSET=EXTRA",
            f"{change.size:.9e}",
        ]
    lines += _held(mesh, change, count + 2)
    return "\n".join(lines) + "\n" + (step(mesh, modes) if modes else "")


def step(mesh: Mesh, modes: int) -> str:
    """The step for so many modes, with the displacements of the sensors."""
    nodes = sorted({n for n, _ in mesh.sensors})
    lines = ["*NSET, NSET=SEEN", *(f"{n}," for n in nodes), "*STEP", "*FREQUENCY", str(modes)]
    return "\n".join([*lines, "*NODE PRINT, NSET=SEEN", "U", "*END STEP"]) + "\n"


def _section(name: str, kind: str, material: str, thickness: float, change: Concealed, known: set[str]) -> list[str]:
    """A section with a material of the true moduli, for each set by itself in a true structure; known: those written before."""
    own = change.kind in ("softer", "weld", "material", "heavier") and change.name == name
    of = material
    if own and change.kind == "material":
        of = "STEEL" if material == "ALU" else "ALU"
    E, nu, rho = MATERIALS[of]
    E *= change.E.get(of, 1.0) * (change.size if own and change.kind in ("softer", "weld") else 1.0)
    rho *= change.size if own and change.kind == "heavier" else 1.0
    called = f"{material}_{name}" if change.E else material
    lines = (
        [f"*MATERIAL, NAME={called}", "*ELASTIC", f"{E:.9e}, {nu}", "*DENSITY", f"{rho:.9e}"]
        if called not in known
        else []
    )
    known.add(called)
    thickness *= change.size if (change.kind, change.name) == ("thinner", name) else 1.0
    if kind == "B31":
        lines.append(f"*BEAM SECTION, ELSET={name}, MATERIAL={called}, SECTION=RECT")
        return [*lines, f"{thickness:.9e}, {thickness:.9e}", "0.48, 0.6, 0.64"]
    head = "SHELL" if kind == "S4" else "SOLID"
    lines.append(f"*{head} SECTION, ELSET={name}, MATERIAL={called}")
    return lines + ([f"{thickness:.9e}"] if kind == "S4" else [])


def _held(mesh: Mesh, change: Concealed, first: int) -> list[str]:
    lines, number = [], counted(first)
    for i, (name, nodes) in enumerate(mesh.supports.items()):
        if change.holds(name):
            lines += ["*BOUNDARY", f"{name}, 1, 3"]
            continue
        for d, k in zip((1, 2, 3), change.size * np.array([change.shear, change.shear, 1.0]), strict=True):
            if k:
                lines.append(f"*ELEMENT, TYPE=SPRING1, ELSET=LOOSE{i}_{d}")
                lines += [f"{next(number)}, {n}" for n in nodes]
                lines += [f"*SPRING, ELSET=LOOSE{i}_{d}", f"{d}", f"{k / len(nodes):.9e}"]
    return lines

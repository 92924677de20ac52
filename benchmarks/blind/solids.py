"""Straight beams as plane-stress solids (CPS8R): the mesh, and what is put on it, as cards of CalculiX.

Two traps of ccx 2.20 are avoided. Through-thickness constraints of plane-stress elements block the anticlastic strain, so that
the width is 1/20 of the depth, where they err by 0.02 %. A MASS on a node of a plane element aborts: masses stand on nodes of
their own, held to the beam by springs.
"""

from dataclasses import dataclass, field

import numpy as np

from benchmarks.blind.calculix import Modes, mass, material, solve, spring

STATIONS = 61  # points along the axis where shapes are known: nodes and middles of the 30 elements of a deck
WIDTH = 0.05  # of the depth
NU = 0.3
MODES = 20
STIFF = 1e5  # natural frequency of a mass on its spring, in sqrt(EI/m)/L^2: 200 times that of mode 8


@dataclass(frozen=True)
class Solid:
    """A beam along x from 0 to L, depth h in y; places are along x in m.

    slit: (x, share of the depth); segment: (from, to, factor of E); masses: (x, kg); oscillator: (x, kg, N/m);
    tension: N; foundation: (from, to, N/m2); root: factor of E of the block 4h x 5h that holds it; waves: (share, number, phase).
    """

    L: float
    h: float
    E: float
    density: float
    free: bool = False
    slit: tuple[float, float] | None = None
    segment: tuple[float, float, float] | None = None
    masses: list[tuple[float, float]] = field(default_factory=list)
    oscillator: tuple[float, float, float] | None = None
    tension: float = 0.0
    foundation: tuple[float, float, float] | None = None
    root: float | None = None
    waves: tuple[float, float, float] | None = None

    @property
    def b(self) -> float:
        """Width out of the plane."""
        return WIDTH * self.h

    @property
    def EI(self) -> float:
        """Bending stiffness in N m2."""
        return self.E * self.b * self.h**3 / 12

    @property
    def line(self) -> float:
        """Mass per length in kg/m."""
        return self.density * self.b * self.h


class Mesh:
    """Lattice of eight-node elements between `x` and `y` lines.

    points (n,): nodes in the order of their numbers; split: column and row of the tip of a slit, which is open upwards.
    """

    def __init__(self, solid: Solid):
        self.x, self.y = _columns(solid), _rows(solid)
        self.points: list[tuple[float, float]] = []
        self.numbers: dict[tuple[int, int, bool], int] = {}
        self.solid = solid
        self.split = None
        if solid.slit:
            depth = round(solid.slit[1] * (len(self.y) - 1))
            self.split = (int(np.argmin(abs(self.x - solid.slit[0]))), len(self.y) - 1 - depth)
        half = range(2 * len(self.x) - 1)
        self._x = np.interp(np.arange(len(half)) / 2, np.arange(len(self.x)), self.x)
        self._y = np.interp(np.arange(2 * len(self.y) - 1) / 2, np.arange(len(self.y)), self.y)
        self.elements = [self._element(i, j) for i, j in self._cells()]
        self.columns = np.array([(self.x[i] + self.x[i + 1]) / 2 for i, _ in self._cells()])

    def _cells(self) -> list[tuple[int, int]]:
        h = self.solid.h
        middle = (self.y[1:] + self.y[:-1]) / 2
        return [
            (i, j)
            for i in range(len(self.x) - 1)
            for j in range(len(self.y) - 1)
            if self.x[i + 1] < 1e-9 * h or abs(middle[j]) < h / 2
        ]

    def _element(self, i: int, j: int) -> list[int]:
        corners = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)]
        return [self.node(2 * i + a, 2 * j + c, i) for a, c in corners]

    def node(self, i: int, j: int, column: int) -> int:
        """Number of the lattice point (i, j) as an element of `column` sees it: twofold along a slit."""
        right = self.split is not None and i == 2 * self.split[0] and j > 2 * self.split[1] and column >= self.split[0]
        key = (i, j, right)
        if key not in self.numbers:
            x, y = self._x[i], self._y[j]
            if self.solid.waves:
                share, number, phase = self.solid.waves
                y *= 1 + share * np.sin(2 * np.pi * number * x / self.solid.L + phase)
            self.points.append((x, y))
            self.numbers[key] = len(self.points)
        return self.numbers[key]

    def axis(self, x: float) -> int:
        """Number of the node on the axis nearest to `x`; corners of elements only."""
        i = int(np.argmin(abs(self.x - x)))
        return self.node(2 * i, int(np.argmin(abs(self._y))), max(i - 1, 0))

    def end(self) -> list[int]:
        """Numbers of the nodes of the first line."""
        return [n for (i, _, _), n in self.numbers.items() if i == 0]


def stations(L: float) -> np.ndarray:
    """The points along the axis where shapes are known."""
    return np.linspace(0, L, STATIONS)


def modes(solid: Solid) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies (m,) and deflections (m, 61) of the bending modes, rigid-body and axial ones left out."""
    mesh = Mesh(solid)
    found = solve("\n".join([*_body(solid, mesh), *_attached(solid, mesh), *_steps(solid, mesh)]) + "\n")
    order = {n: k for k, n in enumerate(found.nodes.tolist())}
    shapes = found.shapes[:, [order[mesh.axis(x)] for x in stations(solid.L)]]
    return bending(Modes(found.frequency, found.nodes, shapes), 3 if solid.free else 0)


def bending(found: Modes, rigid: int) -> tuple[np.ndarray, np.ndarray]:
    """Those of the modes that move across the axis (y) rather than along it (x), the first `rigid` left out."""
    across = np.linalg.norm(found.shapes[:, :, 1], axis=1) > np.linalg.norm(found.shapes[:, :, 0], axis=1)
    across[:rigid] = False
    return found.frequency[across], found.shapes[across, :, 1]


def _columns(solid: Solid) -> np.ndarray:
    """x lines: 120 along the beam and those that the causes need, none of them too near to another."""
    L, h = solid.L, solid.h
    fixed = list(stations(L))
    wanted = list(np.linspace(0, L, 2 * STATIONS - 1))
    if solid.slit:
        fixed.append(solid.slit[0])
        wanted += [solid.slit[0] + side * h * s for side in (-1, 1) for s in (1 / 16, 1 / 8, 1 / 4, 1 / 2, 1)]
    if solid.segment:
        fixed += solid.segment[:2]
    fixed += [x for x, _ in solid.masses]
    fixed += [solid.oscillator[0]] if solid.oscillator else []
    if solid.root:
        wanted += [*np.linspace(-4 * h, 0, 9), h / 4, h / 2, h]
    lines = np.unique(np.round([x for x in fixed if 0 <= x <= L], 12))
    for x in wanted:
        if abs(lines - x).min() > min(h / 32, L / 1000) and x <= L:
            lines = np.append(lines, x)
    return np.unique(lines)


def _rows(solid: Solid) -> np.ndarray:
    """y lines: 16 rows with a slit, else 4; a block at the root is five times as high as the beam."""
    rows = np.linspace(-solid.h / 2, solid.h / 2, 17 if solid.slit else 5)
    if solid.root:
        outer = solid.h * np.array([0.75, 1.0, 1.5, 2.0, 2.5])
        rows = np.concatenate([-outer[::-1], rows, outer])
    return rows


def _body(solid: Solid, mesh: Mesh) -> list[str]:
    """Nodes, elements and materials."""
    watched = [mesh.axis(x) for x in stations(solid.L)]
    lines = ["*NODE, NSET=NALL", *(f"{n}, {x:.12g}, {y:.12g}, 0." for n, (x, y) in enumerate(mesh.points, 1))]
    parts = {"BODY": np.ones(len(mesh.columns), dtype=bool)}
    if solid.segment:
        parts["SOFT"] = (mesh.columns > solid.segment[0]) & (mesh.columns < solid.segment[1])
    if solid.root:
        parts["BLOCK"] = mesh.columns < 0
    for name in list(parts)[1:]:
        parts["BODY"] &= ~parts[name]
    for name, members in parts.items():
        lines.append(f"*ELEMENT, TYPE=CPS8R, ELSET={name}")
        lines += [", ".join(map(str, [e + 1, *mesh.elements[e]])) for e in np.flatnonzero(members)]
    moduli = {"BODY": 1.0, "SOFT": solid.segment and solid.segment[2], "BLOCK": solid.root}
    for name in parts:
        density = solid.density * (0.01 if name == "BLOCK" else 1)  # the block is to be a spring, not a mass
        lines += material(name, solid.E * moduli[name], density, NU)
        lines += [f"*SOLID SECTION, ELSET={name}, MATERIAL={name}", f"{solid.b:.12g}"]
    lines += ["*NSET, NSET=AXIS", *map(str, watched)]
    if not solid.free:
        # held all over: on one node alone, shear would dent the end, 0.9 % of mode 5 of a beam of L/h = 15
        lines += ["*BOUNDARY", *(f"{n}, 1, 2" for n in mesh.end())]
    return lines


def _attached(solid: Solid, mesh: Mesh) -> list[str]:
    """Masses, oscillator and foundation: springs in y, with masses on nodes of their own that move in y alone."""
    lines, node, element = [], len(mesh.points), len(mesh.elements)
    rigid = (STIFF * np.sqrt(solid.EI / solid.line) / solid.L**2) ** 2  # 1/s2
    hung = [(x, kg, kg * rigid) for x, kg in solid.masses] + ([solid.oscillator] if solid.oscillator else [])
    for x, kg, k in hung:
        node, element = node + 1, element + 2
        lines += ["*NODE, NSET=EXTRA", f"{node}, {x:.12g}, 0., 0."]
        lines += spring(element - 1, (mesh.axis(x), node), k) + mass(element, node, kg)
    if solid.foundation:
        start, stop, k = solid.foundation
        at = mesh.x[(mesh.x >= start - 1e-9) & (mesh.x <= stop + 1e-9)]
        widths = np.diff(at)
        for x, share in zip(at, (np.append(widths, 0) + np.append(0, widths)) / 2, strict=True):
            element += 1
            lines += spring(element, (mesh.axis(x),), k * share)
    return lines + (["*BOUNDARY", "EXTRA, 1, 1", "EXTRA, 3, 3"] if hung else [])


def _steps(solid: Solid, mesh: Mesh) -> list[str]:
    """The eigenvalue step; before it, tension by forces that keep their direction."""
    frequency = ["*FREQUENCY", str(MODES), "*NODE PRINT, NSET=AXIS", "U", "*END STEP"]
    if not solid.tension:
        return ["*STEP", *frequency]
    left, right = mesh.axis(0.0), mesh.axis(solid.L)
    forces = [f"{right}, 1, {solid.tension:.12g}"] + ([f"{left}, 1, {-solid.tension:.12g}"] if solid.free else [])
    hold = ["*BOUNDARY", f"{left}, 1, 2", f"{right}, 2, 2"] if solid.free else []
    hung = (
        ["EXTRA, 1, 1", "EXTRA, 3, 3"] if solid.masses or solid.oscillator else []
    )  # OP=NEW forgets all that was held
    release = ["*BOUNDARY, OP=NEW", *hung] if solid.free else []
    return [
        *("*STEP, NLGEOM", "*STATIC", *hold, "*CLOAD", *forces, "*END STEP"),
        *("*STEP, PERTURBATION", *frequency[:2], *release, *frequency[2:]),
    ]

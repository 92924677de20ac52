"""The bars of a model that bend: what each does, in either plane, when the model moves in its coordinates.

Bending of a bar of length l in a plane, in its natural strains e = [v_s'q, (2/l) v_a'q], v_s = [0, -1, 0, 1],
v_a = [1, l/2, -1, l/2] on q = [w1, slope1, w2, slope2]: K = E'F^-1 E with the flexibility F = diag(l/EI, l/(3EI) (1 + phi)).
A bending moment at 2 x/l - 1 = eta does work on [1, eta], so whatever is softer there adds c [1, eta]' [1, eta] to F. The third
strain is the elongation, with l/EA. Forces that a released end does not bear are none: K = E'N (N'F N)^-1 N'E, N those it bears.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mouse_cli.diagnosis.sites.lines import Line, joined_lines
from mouse_cli.diagnosis.sites.strains import borne, by_ends, natural, sparse_rows
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.mesh import ElementSet, Mesh
from mouse_cli.model.problem import Problem
from mouse_cli.terms.bound_properties import BoundProperties, nominal_properties
from mouse_cli.terms.constraints import Motion
from mouse_cli.terms.elements import Layout, Properties, registry
from mouse_cli.terms.elements import _beam as beam
from mouse_cli.terms.elements.beam import local

_BENDING, _STEP = ("E", "Iy", "Iz"), 1e-4  # properties that bending stiffness follows; step in them
_STIFF = 1e-9  # share of the largest bending stiffness below which a bar does not bend in that plane


@dataclass(frozen=True)
class Bars:
    """b bars: beam elements, each once for every plane that it can bend in.

    set, member (b,): which element of the mesh; ids (b,); nodes (b, 2): indices; plane (b,): 0 local x-y, 1 local x-z. length,
    EI, phi, line_mass, section_inertia (density times I), A (b,); ends (b, 4, r): w1, slope1, w2, slope2 for each coordinate of the
    model, axial, twist (b, 2, r): u1, u2 and the turns about the bar there; start, axis, across (b, 3): first end, unit vectors
    along the bar and in the direction of w.
    line (b,): bars with one number continue one another in one plane; before (b,): length of the line before the bar.
    bears (b, 3, 3): N N', where N'N = 1. residual (b, 3, 3): strains that unit forces in a bar make beyond the coordinates.
    """

    set: np.ndarray
    member: np.ndarray
    ids: np.ndarray
    nodes: np.ndarray
    plane: np.ndarray
    length: np.ndarray
    EI: np.ndarray
    phi: np.ndarray
    line_mass: np.ndarray
    section_inertia: np.ndarray
    A: np.ndarray
    E: np.ndarray
    nu: np.ndarray
    ends: np.ndarray
    axial: np.ndarray
    twist: np.ndarray
    start: np.ndarray
    axis: np.ndarray
    across: np.ndarray
    bears: np.ndarray
    line: np.ndarray
    before: np.ndarray
    residual: np.ndarray | None = None

    def __len__(self) -> int:
        return len(self.length)

    @cached_property
    def strain(self) -> np.ndarray:
        """E (b, 3, r): bending, symmetric and antisymmetric, and elongation."""
        return natural(self.ends, self.axial, self.length)

    @cached_property
    def flexibility(self) -> np.ndarray:
        """F (b, 3, 3)."""
        F = np.zeros((len(self), 3, 3))
        F[:, 0, 0], F[:, 1, 1] = self.length / self.EI, self.length / (3 * self.EI) * (1 + self.phi)
        F[:, 2, 2] = self.length / (self.E * self.A)
        return F

    @cached_property
    def span(self) -> float:
        """Length of the longest line, by which sizes are measured."""
        return float(np.bincount(self.line, self.length).max())

    @cached_property
    def stiffness(self) -> float:
        """Mean EI over the length."""
        return float(np.average(self.EI, weights=self.length))

    def lost(self, bars: np.ndarray, added: np.ndarray) -> np.ndarray:
        """Change (c, 3, 3) of the stiffness of `bars` (c,) when `added` comes to their flexibility."""
        return self.rigid(bars, added) - self.whole[bars]

    def rigid(self, bars: np.ndarray | slice = slice(None), added: np.ndarray | float = 0.0) -> np.ndarray:
        """N (N'F N)^-1 N' (..., c, 3, 3) of `bars`, `added` to their flexibility F."""
        F = self.flexibility[bars] + added
        if not self.released[bars].any():
            return np.linalg.inv(F)
        P = self.bears[bars]
        size = np.trace(F, axis1=-2, axis2=-1)[..., None, None]
        return P @ np.linalg.inv(P @ F @ P + size * (np.eye(3) - P)) @ P

    @cached_property
    def released(self) -> np.ndarray:
        """Bars (b,) of which an end does not bear some force."""
        return (self.bears != np.eye(3)).any(axis=(1, 2))

    @cached_property
    def whole(self) -> np.ndarray:
        """Stiffness (b, 3, 3) of the bars as they are."""
        return self.rigid()

    def strained(self, bars: np.ndarray, core: np.ndarray) -> np.ndarray:
        """Matrix (r, r) of stiffnesses `core` (c, 3, 3) on the natural strains of `bars` (c,)."""
        rows = self.strain[bars]
        return rows.reshape(-1, rows.shape[-1]).T @ (core @ rows).reshape(-1, rows.shape[-1])

    def added(self, blocks: np.ndarray, bars: np.ndarray | slice = slice(None)) -> np.ndarray:
        """Matrix (r, r) of the 4 x 4 `blocks` (c, 4, 4) on the ends of `bars`."""
        rows = self.ends[bars]
        return rows.reshape(-1, rows.shape[-1]).T @ (blocks @ rows).reshape(-1, rows.shape[-1])

    def deflection(self, bar: int, at: float | np.ndarray) -> np.ndarray:
        """w (..., r) at the shares `at` (...) of the length of one bar."""
        return np.asarray(at)[..., None] ** np.arange(4) @ self.cubic[bar]

    @cached_property
    def cubic(self) -> np.ndarray:
        """Deflections (b, 4, r) by powers of the share of the length."""
        return beam.CUBIC.T @ (self.ends * np.stack([self.length**0, self.length] * 2, axis=1)[:, :, None])

    @cached_property
    def twins(self) -> dict[tuple[int, int], list[int]]:
        """Bars by set and member: the planes of one element."""
        twins: dict[tuple[int, int], list[int]] = {}
        for i in range(len(self)):
            twins.setdefault((int(self.set[i]), int(self.member[i])), []).append(i)
        return twins

    def motion(self, bar: int, at: float) -> np.ndarray:
        """Displacement (3, r) in global axes of that place: along the bar, and across it in either plane."""
        along = (1 - at) * self.axial[bar, 0] + at * self.axial[bar, 1]
        u = self.axis[bar][:, None] * along
        for twin in self.twins[int(self.set[bar]), int(self.member[bar])]:
            u = u + self.across[twin][:, None] * self.deflection(twin, at)
        return u

    def point(self, bar: int, at: float) -> tuple[float, float, float]:
        """Coordinates of that place."""
        return tuple((self.start[bar] + at * self.length[bar] * self.axis[bar]).tolist())

    def site(self, bar: int, at: float) -> Site:
        """That place in words."""
        return Site("element", (int(self.ids[bar]),), self.point(bar, at), f"element {self.ids[bar]}, {at:.2f} of it")

    @cached_property
    def lines(self) -> tuple[Line, ...]:
        """The lines that bars form."""
        return tuple(Line(self, np.flatnonzero(self.line == i)) for i in range(self.line.max(initial=-1) + 1))

    @cached_property
    def runs(self) -> tuple[Line, ...]:
        """Lines of different elements: the same elements in their other plane are left out."""
        found = {}
        for line in self.lines:
            members = zip(self.set[line.members].tolist(), self.member[line.members].tolist(), strict=True)
            found.setdefault(tuple(sorted(members)), line)
        return tuple(found.values())


def bars(problem: Problem, motion: Motion, theta: np.ndarray, V: np.ndarray | None) -> Bars | None:
    """The bars of `problem` at theta (p,), for a model that moves by u = V q (V None: q are the degrees of freedom)."""
    mesh, parts, bindings = problem.mesh, [], problem.mesh.gathered.bindings(problem.bindings)
    for g, elements in enumerate(mesh.gathered.elements):
        if elements.type == "beam":
            layout = _layout(mesh, elements)
            p = _properties(elements, layout, tuple(b for b in bindings if b.set == g), theta)
            parts += _planes(mesh.gathered.origin(g), elements, layout, p, motion, V)
    if not parts:
        return None
    joined = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    given = np.lexsort((joined["member"], joined["plane"], joined["set"]))
    joined = {name: value[given] for name, value in joined.items()}
    bends = (joined["EI"] > _STIFF * joined["EI"].max()) & joined["bears"][:, :2, :2].any(axis=(1, 2))
    moves = np.abs(joined["ends"]).max(axis=(1, 2)) > 0
    joined = {name: value[bends & moves] for name, value in joined.items()}
    line, before, order = joined_lines(joined)
    joined = {name: value[order] for name, value in joined.items()}
    return Bars(**joined, line=line, before=before)


def stiffening(problem: Problem, found: Bars, theta: np.ndarray) -> np.ndarray:
    """d ln EI / d theta (b, p) of the bars."""
    follows = np.zeros((len(found), len(theta)))
    for j in sorted({b.parameter for b in problem.bindings if b.property in _BENDING}):
        step = _STEP * (theta[j] or 1.0)
        there = theta + step * (np.arange(len(theta)) == j)
        follows[:, j] = (_stiffness(problem, found, there) / found.EI - 1) / step
    return follows


def _stiffness(problem: Problem, found: Bars, theta: np.ndarray) -> np.ndarray:
    """EI (b,) of the bars at theta."""
    EI, gathered = np.empty(len(found)), problem.mesh.gathered
    group, first = (np.array(each)[found.set] for each in (gathered.group, gathered.first))
    for g in np.unique(group).tolist():
        elements = gathered.elements[g]
        own = tuple(b for b in gathered.bindings(problem.bindings) if b.set == g)
        p = _properties(elements, _layout(problem.mesh, elements), own, theta)
        for plane, name in enumerate(("Iz", "Iy")):
            at = (group == g) & (found.plane == plane)
            EI[at] = (p["E"] * p[name])[(found.member + first)[at]]
    return EI


def _layout(mesh: Mesh, elements: ElementSet) -> Layout:
    options = {key: option.default for key, option in registry()["beam"].options.items()}
    return Layout(mesh.coordinates[elements.nodes], options | elements.options)


def _properties(elements, layout: Layout, own: tuple, theta: np.ndarray) -> Properties:
    kind = registry()["beam"]
    found = {name: np.array(value, float) for name, value in nominal_properties(kind, elements, layout).items()}
    if own:
        bound = BoundProperties(kind, elements, layout, own)
        for name, value in bound.at(theta)[0].items():
            found[name][bound.members] = value
    return found


def _planes(origin, elements: ElementSet, layout: Layout, p: Properties, motion: Motion, V) -> list[dict]:
    """The elements in either plane; origin: their set and number in it (e,)."""
    at = beam.span(layout)
    u = displacements(motion, elements.nodes, V)
    releases = layout.options.get("releases")
    ends = beam.condensation(local(layout, p)["K"], releases)
    moved = np.einsum("eij,ejr->eir", at.motion if ends is None else ends @ at.motion, u)
    parts = []
    for plane, axis, across in ((0, "z", "y"), (1, "y", "z")):
        dofs, sense = beam.PLANES[plane]
        EI = p["E"] * p[f"I{axis}"]
        timoshenko = layout.options.get("theory") == "timoshenko"
        phi = 12 * EI / (p[f"kappa_{across}"] * p["G"] * p["A"] * at.length**2) if timoshenko else np.zeros(len(EI))
        parts.append(
            {
                **dict(zip(("set", "member"), origin, strict=True)),
                "ids": elements.ids,
                "nodes": elements.nodes,
                "plane": np.full(len(EI), plane),
                "length": at.length,
                "EI": EI,
                "phi": phi,
                "line_mass": p["density"] * p["A"] + p["nonstructural_mass"],
                "section_inertia": p["density"] * p[f"I{axis}"],
                "A": p["A"],
                "E": p["E"],
                "nu": p["nu"],
                "ends": moved[:, dofs] * sense[:, None],
                "axial": moved[:, [0, 6]],
                "twist": moved[:, [3, 9]],
                "start": layout.coordinates[:, 0],
                "axis": at.axes[:, 0],
                "across": at.axes[:, 1 + plane],
                "bears": borne(at.length, dofs, sense, beam.released(releases)),
            }
        )
    return parts


def displacements(motion: Motion, nodes: np.ndarray, V: np.ndarray | None) -> np.ndarray:
    """Motion (e, 12, r) of the nodes (e, 2) in each coordinate."""
    places = 6 * np.unique(nodes)[:, None] + np.arange(6)
    rows = motion.rows(places.ravel()) if V is None else sparse_rows(motion, places.ravel()) @ V
    where = np.searchsorted(np.unique(nodes), nodes)
    at = (6 * where[:, :, None] + np.arange(6)).reshape(len(nodes), 12)
    return rows[at]


def strained(problem: Problem, found: Bars, motion: np.ndarray) -> np.ndarray:
    """Natural strains (b, 3, a) of the bars in motions (n, a) of `problem`, which has the same elements."""
    return by_ends(problem, found) @ displacements(motion_of(problem), found.nodes, motion)


def motion_of(problem: Problem) -> Motion | None:
    """How the nodes of a mesh follow the degrees of freedom of `problem`; None where degrees of freedom serve as nodes."""
    from mouse_cli.terms.constraints import links

    at, mesh = problem.structure.geometry, problem.mesh
    if at is None:
        return None
    nodeless = at.node < 0
    order = np.where(nodeless, 6 * len(mesh.node_ids) + np.cumsum(nodeless) - 1, 6 * at.node + at.direction)
    return links(mesh, int(nodeless.sum())).motion(order)

"""The parts of a structure over which a field is spread: elements of a mesh, springs and masses of a model of matrices."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from mouse_cli.diagnosis.effects.losses import matrices_of
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.nameless._correlated import extent, leading, spacing
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.parameter import Parameter
from mouse_cli.model.problem import Problem

FEWEST = 3  # cells that make a field
_MOST = 4000  # elements of a mesh up to which a field is spread over it
_TRIFLE = 1e-9  # share of the largest energy below which a cell has none

Block = tuple[np.ndarray, np.ndarray]  # rows (c, r) of motion in the coordinates of the model, and their matrix (c, c)


@dataclass(frozen=True)
class Cells:
    """c cells: sites; at (c, d): where they are, distances in `unit`; blocks: K or M of each, of the nominal model, or per unit.

    into: `K` or `M`, the matrix that they change. extend(problem, values (c,), spread): the deck with the field in it;
    of a change of rank one also its sign. rigid: whether an affine field over them is a motion of the whole as one rigid body.
    beside: mass that changes with a stiffness, cell by cell; None: none does. positive: of what can only be added, as springs to
    the ground where the model has none, the extent of each (c,): the sum of values over these is positive; None: of either sign.
    """

    sites: tuple[Site, ...]
    at: np.ndarray
    unit: str
    blocks: tuple[Block, ...]
    into: str
    extend: Callable[..., Problem] | None = None
    rigid: bool = False
    beside: "Cells | None" = None
    positive: np.ndarray | None = None
    _fields: dict[float, tuple[float, np.ndarray]] = field(default_factory=dict, init=False, repr=False, compare=False)

    def __len__(self) -> int:
        return len(self.sites)

    def correlated(self, share: float) -> tuple[float, np.ndarray]:
        """Length over which a field is correlated, and its leading vectors P (c, w) for a spread of one.

        `share` of the extent, but no less than the distance to the next cell: neighbours would be as good as independent, and
        nothing smooth about the field.
        """
        if share not in self._fields:
            length = max(share * extent(self.at), spacing(self.at))
            self._fields[share] = length, leading(self.at, length)
        return self._fields[share]

    def summed(self, weights: np.ndarray) -> np.ndarray:
        """sum over cells of weights (c, w) times u' B u: (w, r, r)."""
        u = np.concatenate([rows for rows, _ in self.blocks])
        found = np.zeros((weights.shape[1], u.shape[1], u.shape[1]))
        loads = np.concatenate([matrix @ rows for rows, matrix in self.blocks])
        sizes = [len(rows) for rows, _ in self.blocks]
        for w, own in enumerate(weights.T):
            found[w] = u.T @ (np.repeat(own, sizes)[:, None] * loads)
        return found

    def some(self, kept: np.ndarray) -> "Cells":
        """The cells `kept`, by index."""
        chosen = lambda every: tuple(every[i] for i in kept.tolist())
        own = {"sites": chosen(self.sites), "at": self.at[kept], "blocks": chosen(self.blocks)}
        own["positive"] = None if self.positive is None else self.positive[kept]
        return replace(self, **own, beside=self.beside and self.beside.some(kept))


def of_elements(model: Reduced, into: str, properties: tuple[str, ...]) -> Cells | None:
    """Elements of a mesh with a matrix `into`, which `properties` of theirs are proportional to."""
    mesh = model.problem.mesh
    if mesh is None or model.motion is None or sum(len(s) for s in mesh.elements) > _MOST:
        return None
    sites, at, blocks, rows = [], [], [], {}
    for s, members in enumerate(mesh.elements):
        matrices = matrices_of(model, s).get(into)
        for i in range(len(members)) if matrices is not None and members.type != "foundation" else ():
            for n in members.nodes[i].tolist():
                rows[n] = model.node(n) if n not in rows else rows[n]
            u = np.concatenate([rows[n] for n in members.nodes[i].tolist()])
            position = mesh.coordinates[members.nodes[i]].mean(axis=0)
            number = int(members.ids[i])
            sites.append(Site("element", (number,), tuple(position.tolist()), f"{members.type} {number}"))
            at.append(position)
            blocks.append((u, matrices[i]))

    def extend(problem: Problem, values: np.ndarray, spread: float) -> Problem:
        edit = Edit(problem)
        for site, value in zip(cells.sites, values, strict=True):
            element = edit.element(site.ids[0])
            own = edit.sets[element[0]]
            bound = tuple(p for p in _proportional(own.type, properties) if p in own.properties)
            edit.bind(f"{into} of {site.text}", [element], bound, factor=max(1 + float(value), 1e-3))
        edit.parameters = [_known_to(parameter, spread) for parameter in edit.parameters]
        return edit.done()

    cells = with_energy(model, Cells(tuple(sites), np.array(at).reshape(-1, 3), "m", tuple(blocks), into, extend))
    return cells


def _proportional(kind: str, properties: tuple[str, ...]) -> tuple[str, ...]:
    """Properties of elements of one kind that a stiffness or a mass is proportional to, all of them together."""
    return DIRECTIONS if "E" in properties and kind in ("spring", "storey", "joint") else properties


def _known_to(parameter: Parameter, spread: float) -> Parameter:
    """A parameter of a field: known to the spread of the field beforehand."""
    return replace(parameter, sd=spread * abs(parameter.nominal))


def with_energy(model: Reduced, cells: Cells) -> Cells | None:
    """Those with a part in the lowest modes; None where there are too few."""
    kept = _moving(model, cells.blocks)
    return None if len(kept) < FEWEST else cells.some(kept)


def _moving(model: Reduced, blocks: tuple[Block, ...]) -> np.ndarray:
    """Which blocks have energy in the lowest modes, by index."""
    count = model.low_modes(2)
    energy = np.array([np.abs(np.einsum("cr,cd,dr->r", u[:, :count], B, u[:, :count])).max() for u, B in blocks])
    return np.flatnonzero(energy > _TRIFLE * energy.max(initial=0.0))


def of_rows(
    model: Reduced, sites: list[Site], at: np.ndarray, unit: str, rows: np.ndarray, sizes: np.ndarray, into: str, extend
) -> Cells | None:
    """Cells of one row of motion (c, r) each, of stiffness or mass `sizes` (c,), those that move in the lowest modes.

    extend(problem, kept, values, ...): the deck with `values` of the rows `kept`, by index; None where no deck can hold them.
    """
    blocks = tuple((row[None], np.array([[size]])) for row, size in zip(rows, sizes, strict=True))
    kept = _moving(model, blocks)
    put = extend and (lambda problem, values, *how: extend(problem, kept, values, *how))
    return None if len(kept) < FEWEST else Cells(tuple(sites), at, unit, blocks, into, put).some(kept)

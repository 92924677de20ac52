"""Frequency response functions of coupled structures, by Lagrange multipliers (LM-FBS), with the variance that measured parts
give them.

With P = B' G^+ B Y and Q = Y B' G^+ B, G = B Y B' + 1/z, errors dY of the parts appear to first order as dY_C = (I - Q) dY (I - P).
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli._errors import ERROR, Diagnostic, NumericalError
from mouse_cli.coupling.connections import dynamic_stiffness
from mouse_cli.coupling.interface import Solved, solve
from mouse_cli.coupling.lines import Common
from mouse_cli.coupling.parts import Measured, Modelled, Receptances
from mouse_cli.coupling.picks import Pick, add, diagonal
from mouse_cli.dynamics.solver import Notice
from mouse_cli.model.coupled import InterfaceState
from mouse_cli.model.coupling import Coupling, Point
from mouse_cli.model.frf_test import KINDS, FrfTest

_SINGULAR = 1e14  # condition number beyond which nothing is left of the digits
_ROOM = 6_000_000  # complex numbers held at once


@dataclass(frozen=True)
class _Sides:
    """One part's shares. places (l,), (r,): those that answer and those that drive; B (c, l), (c, r): conditions on them; out
    (o, l), into (r, i): which of them are asked for."""

    left: np.ndarray
    right: np.ndarray
    B_left: Pick
    B_right: Pick
    out: Pick
    into: Pick


class Whole:
    """The parts of a deck with the conditions between them, ready for lines."""

    def __init__(self, coupling: Coupling, common: Common, notice: Notice = lambda text: None):
        self.coupling, self.common = coupling, common
        self.rows = _conditions(coupling)
        self.sides = [_sides(coupling, self.rows, k) for k in range(len(coupling.substructures))]
        self.parts = [self._part(k, notice) for k in range(len(coupling.substructures))]

    def _part(self, k: int, notice: Notice) -> Modelled | Measured:
        part, sides = self.coupling.substructures[k], self.sides[k]
        if part.measured:
            return Measured(part, self.common.s, self.common.rows[k])
        return Modelled(part, self.common.s, np.union1d(sides.left, sides.right).astype(int), notice)

    @property
    def _uncertain(self) -> bool:
        return any(part.uncertain > 0 for part in self.parts)

    @property
    def error(self) -> float:
        """Relative error of the functions of models that are solved in bases."""
        return max((part.error for part in self.parts), default=0.0)

    def functions(self) -> tuple[np.ndarray, np.ndarray, InterfaceState]:
        """Receptances (f, o, i) of the whole, their variance (NaN where it is not known), and the interface. Raises
        NumericalError."""
        s, c = self.common.s, len(self.rows)
        o, i = len(self.coupling.responses), len(self.coupling.forces)
        wide = max(
            len(side.left) * len(side.right) + part.d * len(side.left)
            for part, side in zip(self.parts, self.sides, strict=True)
        )
        each = max(1, _ROOM // (c * (3 * c + o + i) + wide + o * i * (1 + max(part.uncertain for part in self.parts))))
        Y, variance = np.empty((len(s), o, i), complex), np.empty((len(s), o, i))
        condition, kept, noise = np.empty(len(s)), np.empty(len(s), int), np.empty(len(s))
        for first in range(0, len(s), each):
            at = slice(first, min(first + each, len(s)))
            Y[at], variance[at], (condition[at], kept[at], noise[at]) = self._chunk(at)
        return Y, variance, InterfaceState(condition, kept, noise, c, self.error)

    def _chunk(self, at: slice) -> tuple[np.ndarray, np.ndarray, tuple]:
        s = self.common.s[at]
        known = [part.at(s, at, side.left, side.right) for part, side in zip(self.parts, self.sides, strict=True)]
        Y = self._sum(known, "out", "into")
        if not self.rows:
            nothing = np.zeros(len(s))
            return Y, self._variance(known, None, None), (np.ones(len(s)), np.zeros(len(s), int), nothing)
        G, right = self._sum(known, "B_left", "B_right"), self._sum(known, "B_left", "into")
        left = self._sum(known, "out", "B_right")
        sizes = sum(diagonal(side.B_left, each.Y, side.B_right) for side, each in zip(self.sides, known, strict=True))
        carried = left if self._uncertain or any(each.variance is not None for each in known) else None
        try:
            found = solve(G, sizes, self._stiffness(s), right, carried, self.coupling.truncate)
        except np.linalg.LinAlgError:
            raise _singular(self.coupling, s) from None
        if not self.coupling.truncate and (found.condition > _SINGULAR).any():
            raise _singular(self.coupling, s[found.condition > _SINGULAR])
        Y -= np.matmul(left, found.forces)
        variance = self._variance(known, found.adjoint, found.forces)
        return Y, variance, (found.condition, found.kept, self._noise(known, found))

    def _sum(self, known: list[Receptances], left: str, right: str) -> np.ndarray:
        """Sum (f, a, b) over the parts of L Y R', with L and R of each as `left` and `right` name them; less those taken away."""
        shape = [len(getattr(self.sides[0], name).matrix) for name in (left, right)]
        total = np.zeros((len(known[0].Y), *shape), complex)
        for part, side, each in zip(self.coupling.substructures, self.sides, known, strict=True):
            add(total, getattr(side, left), each.Y, getattr(side, right), -1.0 if part.removed else 1.0)
        return total

    def _stiffness(self, s: np.ndarray) -> np.ndarray:
        """z (f, c): inf for interfaces."""
        z = np.full((len(s), len(self.rows)), np.inf, complex)
        first = len(self.coupling.interfaces)
        for k, one in enumerate(self.coupling.connections):
            z[:, first + k] = dynamic_stiffness(one, s)
        return z

    def _variance(self, known: list[Receptances], adjoint: np.ndarray | None, forces: np.ndarray | None) -> np.ndarray:
        """E|dY_C|^2 (f, o, i): independent errors of the parts, of measured functions or of properties of models, carried by
        (I - Q) and (I - P)."""
        shape = (len(known[0].Y), len(self.coupling.responses), len(self.coupling.forces))
        if any(each.unknown for each in known):
            return np.broadcast_to(np.nan, shape)
        total = np.zeros(shape)
        for part, side, each in zip(self.parts, self.sides, known, strict=True):
            if each.variance is None and not part.uncertain:
                continue
            L, R = np.broadcast_to(side.out.matrix, (shape[0], *side.out.matrix.shape)), side.into.matrix.T
            if adjoint is not None:
                L, R = L - np.matmul(adjoint, side.B_left.matrix), R - np.matmul(side.B_right.matrix.T, forces)
            R = np.broadcast_to(R, (shape[0], *R.shape[-2:]))
            total += _carried(L, each, R) if each.variance is not None else part.spread(L, side.left, R, side.right)
        return total

    def _noise(self, known: list[Receptances], found: Solved) -> np.ndarray:
        """Standard deviation of the scaled flexibility by its size (f,); 0 for models, NaN where it is not known."""
        total = np.zeros(len(found.size))
        for side, each in zip(self.sides, known, strict=True):
            if each.unknown:
                return np.full(len(total), np.nan)
            if each.variance is not None:
                left, right = (np.matmul(found.scale**2, pick.matrix**2) for pick in (side.B_left, side.B_right))
                total += np.einsum("fl,flr,fr->f", left, each.variance, right)
        return np.sqrt(total) / found.size


def _carried(L: np.ndarray, each: Receptances, R: np.ndarray) -> np.ndarray:
    """E|L dY R|^2 (f, o, i); functions that stand twice, by reciprocity, err together."""
    V = each.variance
    if each.tied is None:
        return np.matmul(np.matmul(np.abs(L) ** 2, V), np.abs(R) ** 2)
    total = np.zeros((len(L), L.shape[1], R.shape[2]))
    for number in np.unique(np.abs(each.tied)):
        places = np.argwhere(np.abs(each.tied) == number)
        share = sum(np.sign(each.tied[a, b]) * L[:, :, [a]] * R[:, [b], :] for a, b in places)
        total += np.abs(share) ** 2 * V[:, places[0, 0], places[0, 1], None, None]
    return total


def _conditions(coupling: Coupling) -> list[list[tuple[Point, float]]]:
    """Each row of B: points with +1 and -1; interfaces first, then connections."""
    rows = [[(a, 1.0), (b, -1.0)] for a, b in coupling.interfaces]
    return rows + [[(one.at, 1.0)] + ([(one.to, -1.0)] if one.to else []) for one in coupling.connections]


def _sides(coupling: Coupling, rows: list, k: int) -> _Sides:
    """The share of part k: only places that something asks for are measured or computed."""
    joined = [
        (row, point.place, sign) for row, pairs in enumerate(rows) for point, sign in pairs if point.substructure == k
    ]
    asked = [
        [(row, p.place, 1.0) for row, p in enumerate(points) if p.substructure == k]
        for points in (coupling.responses, coupling.forces)
    ]
    left, right = (np.unique([place for _, place, _ in joined + each]).astype(int) for each in asked)
    o, i = len(coupling.responses), len(coupling.forces)
    return _Sides(
        left, right, Pick(_table(joined, len(rows), left)), Pick(_table(joined, len(rows), right)),
        Pick(_table(asked[0], o, left)), Pick(_table(asked[1], i, right)),
    )  # fmt: skip


def _table(entries: list[tuple[int, int, float]], rows: int, places: np.ndarray) -> np.ndarray:
    found = np.zeros((rows, len(places)))
    for row, place, weight in entries:
        found[row, np.searchsorted(places, place)] += weight
    return found


def _singular(coupling: Coupling, s: np.ndarray) -> NumericalError:
    """The error for an interface that has no answer at lines s."""
    message = f"the flexibility of the interface is singular at {s[0].imag / (2 * np.pi):.6g} Hz"
    note = "two conditions are equal, or a part does not move where it is joined"
    return NumericalError(
        Diagnostic("MD714", ERROR, f"{message} in '{coupling.title.strip()}'", note=note, help="give truncate: 1e-9")
    )


def functions(coupling: Coupling, common: Common, notice: Notice = lambda text: None) -> tuple[FrfTest, InterfaceState]:
    """The functions of the whole in the kind asked for, and the interface."""
    Y, variance, interface = Whole(coupling, common, notice).functions()
    factor = (common.s ** KINDS[coupling.kind])[:, None, None]
    responses, forces = (tuple(coupling.name(p) for p in points) for points in (coupling.responses, coupling.forces))
    found = FrfTest(
        common.hz, Y * factor, coupling.kind, np.arange(len(responses)), np.arange(len(forces)), variance * np.abs(factor) ** 2,
        responses, forces, title=coupling.title, path=coupling.path, decay_rate=common.decay_rate,
    )  # fmt: skip
    return found, interface

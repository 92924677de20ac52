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
from mouse_cli.dynamics.solver import Notice
from mouse_cli.model.coupled import InterfaceState
from mouse_cli.model.coupling import Coupling, Point
from mouse_cli.model.frf_test import KINDS, FrfTest

_ROOM = 6_000_000  # complex numbers held at once


@dataclass(frozen=True)
class _Sides:
    """One part's shares. places (l,), (r,): those that answer and those that drive; B (c, l), (c, r): conditions on them; out
    (o, l), into (r, i): which of them are asked for."""

    left: np.ndarray
    right: np.ndarray
    B_left: np.ndarray
    B_right: np.ndarray
    out: np.ndarray
    into: np.ndarray


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
        each = max(1, _ROOM // (c * (3 * c + o + i) + wide + o * i + 1))
        Y, variance = np.empty((len(s), o, i), complex), np.empty((len(s), o, i))
        condition, kept, noise = np.empty(len(s)), np.empty(len(s), int), np.empty(len(s))
        for first in range(0, len(s), each):
            at = slice(first, min(first + each, len(s)))
            Y[at], variance[at], (condition[at], kept[at], noise[at]) = self._chunk(at)
        return Y, variance, InterfaceState(condition, kept, noise, c, self.error)

    def _chunk(self, at: slice) -> tuple[np.ndarray, np.ndarray, tuple]:
        s = self.common.s[at]
        known = [part.at(s, at, side.left, side.right) for part, side in zip(self.parts, self.sides, strict=True)]
        signs = [-1.0 if part.removed else 1.0 for part in self.coupling.substructures]
        Y = self._sum(signs, known, "out", "into")
        if not self.rows:
            return Y, self._variance(known, None, None), (np.ones(len(s)), np.zeros(len(s), int), np.zeros(len(s)))
        G, right = self._sum(signs, known, "B_left", "B_right"), self._sum(signs, known, "B_left", "into")
        left = self._sum(signs, known, "out", "B_right")
        uncertain = any(each.variance is not None for each in known)
        try:
            found = solve(
                G, self._sizes(known), self._stiffness(s), right, left if uncertain else None, self.coupling.truncate
            )
        except np.linalg.LinAlgError:
            raise _singular(self.coupling) from None
        Y -= np.matmul(left, found.forces)
        return (
            Y,
            self._variance(known, found.adjoint, found.forces),
            (found.condition, found.kept, self._noise(known, found)),
        )

    def _sum(self, signs: list[float], known: list[Receptances], left: str, right: str) -> np.ndarray:
        """Sum over the parts of L Y R, with L and R of each as `left` and `right` name them."""
        return sum(
            sign * _between(_rows(side, left), each.Y, _columns(side, right))
            for sign, side, each in zip(signs, self.sides, known, strict=True)
        )

    def _sizes(self, known: list[Receptances]) -> np.ndarray:
        """Sum of the magnitudes (f, c) of the receptances that meet in each condition."""
        return sum(_diagonal(side, np.abs(each.Y)) for side, each in zip(self.sides, known, strict=True))

    def _stiffness(self, s: np.ndarray) -> np.ndarray:
        """z (f, c): inf for interfaces."""
        z = np.full((len(s), len(self.rows)), np.inf, complex)
        first = len(self.coupling.interfaces)
        for k, one in enumerate(self.coupling.connections):
            z[:, first + k] = dynamic_stiffness(one, s)
        return z

    def _variance(self, known: list[Receptances], adjoint: np.ndarray | None, forces: np.ndarray | None) -> np.ndarray:
        """E|dY_C|^2 (f, o, i): independent errors of the functions of all parts, carried by (I - Q) and (I - P)."""
        total = 0.0
        for side, each in zip(self.sides, known, strict=True):
            if each.variance is None:
                continue
            L = np.broadcast_to(side.out, (len(each.Y), *side.out.shape))
            R = np.broadcast_to(side.into, (len(each.Y), *side.into.shape))
            if adjoint is not None:
                L, R = L - np.matmul(adjoint, side.B_left), R - np.matmul(side.B_right.T, forces)
            total = total + _carried(L, each, R)
        shape = (len(known[0].Y), len(self.coupling.responses), len(self.coupling.forces))
        return np.broadcast_to(np.asarray(total, float), shape)

    def _noise(self, known: list[Receptances], found: Solved) -> np.ndarray:
        """Standard deviation of the scaled flexibility by its size (f,); 0 for models, NaN where it is not known."""
        total = np.zeros(len(found.size))
        for side, each in zip(self.sides, known, strict=True):
            if each.variance is not None:
                spread = _between(side.B_left**2, each.variance, (side.B_right**2).T)
                total += np.einsum("fa,fab,fb->f", found.scale**2, spread, found.scale**2)
        return np.sqrt(total) / found.size


def _carried(L: np.ndarray, each: Receptances, R: np.ndarray) -> np.ndarray:
    """E|L dY R|^2 (f, o, i); functions that stand twice, by reciprocity, err together."""
    V = each.variance
    if each.tied is None:
        return np.matmul(np.matmul(np.abs(L) ** 2, V), np.abs(R) ** 2)
    total = np.zeros((len(L), L.shape[1], R.shape[2]))
    for number in np.unique(each.tied):
        share = sum(L[:, :, [a]] * R[:, [b], :] for a, b in np.argwhere(each.tied == number))
        a, b = np.argwhere(each.tied == number)[0]
        total += np.abs(share) ** 2 * V[:, a, b, None, None]
    return total


def _diagonal(side: _Sides, size: np.ndarray) -> np.ndarray:
    """Diagonal (f, c) of |B| size |B|', size (f, l, r)."""
    if not size.shape[1]:
        return np.zeros((len(size), len(side.B_left)))
    single = [(np.count_nonzero(B, axis=1) <= 1).all() for B in (side.B_left, side.B_right)]
    if all(single):
        here = size[:, np.abs(side.B_left).argmax(axis=1), np.abs(side.B_right).argmax(axis=1)]
        return here * np.abs(side.B_left.sum(axis=1) * side.B_right.sum(axis=1))
    return np.einsum("cl,flr,cr->fc", np.abs(side.B_left), size, np.abs(side.B_right), optimize=True)


def _between(left: np.ndarray, Y: np.ndarray, right: np.ndarray) -> np.ndarray:
    """left Y right (f, ., .) for left (., l) and right (r, .), by picking rows and columns where that is all there is to do."""
    return _picked(_picked(Y, left, 1), right.T, 2)


def _picked(Y: np.ndarray, matrix: np.ndarray, axis: int) -> np.ndarray:
    """`matrix` (a, l) times axis 1 or 2 of Y."""
    filled = matrix != 0
    if not filled.shape[1]:
        shape = list(Y.shape)
        shape[axis] = len(matrix)
        return np.zeros(shape, Y.dtype)
    if (filled.sum(axis=1) <= 1).all():
        found = np.take(Y, filled.argmax(axis=1), axis=axis)
        weight = matrix.sum(axis=1)
        if (weight == 1).all():
            return found
        return found * (weight[:, None] if axis == 1 else weight)
    return np.matmul(matrix, Y) if axis == 1 else np.matmul(Y, matrix.T)


def _rows(side: _Sides, name: str) -> np.ndarray:
    return getattr(side, name)


def _columns(side: _Sides, name: str) -> np.ndarray:
    return side.into if name == "into" else getattr(side, name).T


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
        left, right, _table(joined, len(rows), left), _table(joined, len(rows), right),
        _table(asked[0], o, left), _table(asked[1], i, right).T,
    )  # fmt: skip


def _table(entries: list[tuple[int, int, float]], rows: int, places: np.ndarray) -> np.ndarray:
    found = np.zeros((rows, len(places)))
    for row, place, weight in entries:
        found[row, np.searchsorted(places, place)] += weight
    return found


def _singular(coupling: Coupling) -> NumericalError:
    message = "the flexibility of the interface is singular"
    note = "two conditions say the same, or a part does not move where it is joined"
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

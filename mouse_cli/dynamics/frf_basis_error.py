"""How far functions in a basis are off: some lines are solved in full, preconditioned by the basis and by A = K - sigma M."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.dynamics.frf import Dynamics, FrfModel, product
from mouse_cli.model.arrays import is_sparse

_REFINEMENTS = 60  # steps towards a full solution
_ASTRAY = 1e3  # a step so large, relative, that no solution is in reach
_CHECKED = 2  # loads for which they are found
_SOLVED, _ROUNDED = 3e-8, 1e-6  # the last step of it, relative; the same where rounding keeps it from getting smaller
_SHARE = 0.05  # of all steps together, the last one: what is off is then known to that share


def errors(basis: "_Basis", model: FrfModel, checked: np.ndarray) -> tuple[float, float]:  # noqa: F821
    """Largest relative errors of FRFs and of motions at some lines, against full solutions; inf where one was not found."""
    few = np.unique(np.linspace(0, basis.loads.count - 1, _CHECKED).astype(int))
    lines = _Lines(model, np.repeat(checked, len(few)), len(checked))
    x = product(model.V.T, lines.side_by_side(model.at(checked).Y[:, :, few]))
    exact = _full(basis, lines, x, np.tile(basis.full[:, few], len(checked)))
    if exact is None:
        return np.inf, np.inf
    at = basis.loads.at
    alpha, reduced = (np.abs(basis.loads.values.T @ y[at]) for y in (exact, exact - x))
    size = lines.each(alpha).max(axis=(1, 2))
    far = np.linalg.norm(exact - x, axis=0) / np.linalg.norm(exact, axis=0)
    return float((lines.each(reduced).max(axis=(1, 2)) / size).max()), float(far.max())


@dataclass(frozen=True)
class _Lines:
    """Loads at several lines side by side, s of each: products and solutions for all together cost less than one by one."""

    model: FrfModel
    s: np.ndarray
    count: int

    def each(self, x: np.ndarray) -> np.ndarray:
        """(lines, n, c) of x (n, lines c)."""
        return np.moveaxis(x.reshape(len(x), self.count, -1), 1, 0)

    def side_by_side(self, x: np.ndarray) -> np.ndarray:
        """(n, lines c) of x (lines, n, c)."""
        return np.moveaxis(x, 0, 1).reshape(x.shape[1], -1)

    def solved(self, matrices: Dynamics, right: np.ndarray) -> np.ndarray:
        """Z(s)^-1 `right` (n, lines c) of dense matrices."""
        Z = matrices.at(self.s.reshape(self.count, -1)[:, :1, None])
        return self.side_by_side(np.linalg.solve(Z, self.each(right)))


def _full(basis: "_Basis", lines: _Lines, x: np.ndarray, loads: np.ndarray) -> np.ndarray | None:  # noqa: F821
    """Z(s)^-1 loads (n, c) from x (n, c) on: a correction by A^-1 outside of the basis, one within it, and so on.

    As its last correction lies in the basis, what remains is orthogonal to it, and counts in FRFs by its square, as in x.
    """
    model, s, c = lines.model, lines.s, loads.shape[1]
    if not is_sparse(basis.operator.M):
        return lines.solved(basis.dynamics.dense(), loads)
    before, start = np.inf, x
    for _ in range(_REFINEMENTS):
        rest = loads - basis.times(s, x)
        moved = basis.operator.columns(np.asfortranarray(np.concatenate([rest.real, rest.imag], axis=1)))
        better = x + moved[:, :c] + 1j * moved[:, c:]
        rest = loads - basis.times(s, better)
        better = better + product(model.V.T, lines.solved(model.matrices, product(model.V, rest)))
        size = np.linalg.norm(better, axis=0)
        change = float((np.linalg.norm(better - x, axis=0) / size).max())
        whole = float((np.linalg.norm(better - start, axis=0) / size).max())
        if change <= max(_SOLVED, _SHARE * whole) or (change > 0.5 * before and change <= _ROUNDED):
            return better
        if not change < _ASTRAY:
            return None
        x, before = better, change
    return None

"""Mode-shape derivatives of a large model from one adjoint space for all modes, property by property on its own rows alone."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mouse_cli.dynamics.contraction import Stack
from mouse_cli.dynamics.eigen import EigenSolution, clusters
from mouse_cli.dynamics.sensing import read
from mouse_cli.dynamics.shared_space import AdjointSpace, ChebyshevSpace, OrthonormalSpace
from mouse_cli.model.arrays import Matrix

CHEBYSHEV = 1e-7  # accuracies finer than this need orthonormal levels
_LEVELS = 4, 10  # most levels of either space
_SAMPLE = 48  # properties by which the error is estimated
_ROWS, _PROPERTIES = 8192, 256  # worked on at once
_CAUTION = 3.0  # times what the estimate says
_ITERATING = 1e-3  # accuracy that is enough to iterate with
# Shares of the bound of rounding that derivatives may show, by plain and by refined solutions
_ROUNDED, _REFINED = 1e-3, 2e-2
_MATCH = 1e-7  # theta of a space and of the mode that it shows agree so well, relative
_SMALL = 1e-3  # derivatives below this share of the largest one of a mode are judged by that share


class Unmatched(ArithmeticError):
    """Rounding has made a space show a mode twice, or not at all."""


@dataclass(frozen=True)
class Adjoint:
    """What is asked for: solution, its `modes` (m,) from 0, what sensors read, and the stacked derivatives of the matrices."""

    solution: EigenSolution
    modes: np.ndarray
    sensing: Matrix
    stack: Stack

    def partials(self, d_lambda: np.ndarray, d_shape: np.ndarray, accuracy: float | None) -> float | None:
        """Write derivatives of eigenvalues (m, p) and of what sensors read (m, s, p); the estimated relative error, if asked for.

        accuracy: relative error to be reached, as far as it can be; None: one level, enough to iterate with, and no estimate.
        """
        space, error, coefficients = self._solved(accuracy)
        operator = self.solution.space.operator
        error = error and max(error, (_REFINED if operator.refined else _ROUNDED) * operator.noise)
        for first, last in self.stack.chunks(_ROWS, _PROPERTIES):
            place = slice(first, last)
            forces, inertia = self.stack.forces(first, last, self._shapes, self._eigenvalues)
            self._response(space, coefficients, first, last, forces, d_shape[:, :, place])
            self._lengths(first, last, forces, inertia, d_lambda[:, place], d_shape[:, :, place])
        return error

    def _solved(self, accuracy: float | None) -> tuple[AdjointSpace, float | None, np.ndarray]:
        """The space, the estimated error and the coefficients of W_i in it; orthonormal where it has to be."""
        try:
            if accuracy is None:
                space = ChebyshevSpace(self.solution.space, self.sensing)
                space.extend()
                return space, None, self._coefficients(space, 1)
            if accuracy >= CHEBYSHEV:
                found = self._refined(ChebyshevSpace, accuracy, _LEVELS[0])
                if found[1] <= accuracy:
                    return found
        except Unmatched:
            pass
        return self._refined(OrthonormalSpace, accuracy or _ITERATING, _LEVELS[1])

    @cached_property
    def _shapes(self) -> np.ndarray:
        """Shapes (n, m); of a slender structure in extended precision: dK x is a small difference there."""
        precision = np.longdouble if self.solution.space.operator.refined else float
        return np.ascontiguousarray(self.solution.shapes[:, self.modes], precision)

    @cached_property
    def _eigenvalues(self) -> np.ndarray:
        return self.solution.eigenvalues[self.modes]

    @cached_property
    def _same(self) -> list[np.ndarray]:
        """The cluster of each mode."""
        family = clusters(self.solution.eigenvalues, self.solution.zero)
        return [np.flatnonzero(family == family[mode]) for mode in self.modes]

    def _refined(self, kind: type, accuracy: float, most: int) -> tuple[AdjointSpace, float, np.ndarray]:
        """A space with so many levels that the estimated error is at most `accuracy`; it, the estimate, the W_i.

        A level lowers the error by about the same factor: with changes d_K-1, d_K from the last two, the error is d_K^2 / d_K-1.
        """
        space = kind(self.solution.space, self.sensing)
        sample = np.unique(np.linspace(0, self.stack.p - 1, min(_SAMPLE, self.stack.p)).astype(int))
        shape = len(self.modes), self.sensing.shape[0], len(sample)
        before, change, error, level = np.zeros(shape), np.inf, np.inf, 0
        while True:
            now, coefficients = np.empty(shape), self._coefficients(space, level)
            for at, j in enumerate(sample):
                forces = self.stack.forces(j, j + 1, self._shapes, self._eigenvalues)[0]
                self._response(space, coefficients, j, j + 1, forces, now[:, :, at : at + 1])
            previous, change = change, _difference(now, before)
            if level > 1:
                error = _CAUTION * change * min(1.0, change / previous)
            if error <= accuracy or level == most:
                return space, error, coefficients
            space.extend()
            before, level = now, level + 1

    def _coefficients(self, space: AdjointSpace, level: int) -> np.ndarray:
        """W_i in terms of the basis (m, d, s): Ritz vectors weighed by 1 / (1 - mu_i theta_k), those of the mode's cluster not.

        Raises Unmatched where the space does not show each mode of a cluster once.
        """
        theta, X = space.ritz(level)
        loads = X.T @ space.loads[: len(X)]
        out = np.empty((len(self.modes), len(X), loads.shape[1]))
        own = (
            1 / (self.solution.eigenvalues - self.solution.shift)
            if space.krylov.known is None
            else space.krylov.known.theta
        )
        for i, same in enumerate(self._same):
            distance = 1 - theta / own[self.modes[i]]
            seen = (np.abs(theta[:, None] / own[same] - 1) < _MATCH).any(axis=1)
            if np.count_nonzero(seen) != len(same) and not isinstance(space, OrthonormalSpace):
                raise Unmatched
            distance[seen] = np.inf
            out[i] = X @ (loads / distance[:, None])
        if space.krylov.known is not None:
            self._cleaned(out, space, level)
        return out

    def _cleaned(self, W: np.ndarray, space: AdjointSpace, level: int) -> None:
        """Give the W_i (m, d, s) the shares of the known modes that they have to have, x_k (x_k'L) / (lambda_k - lambda_i)."""
        known, overlap = space.krylov.known, space.overlap(level)
        shares = known.coefficients.T @ space.loads[: len(known.coefficients)]
        for i, same in enumerate(self._same):
            distance = self.solution.eigenvalues - self._eigenvalues[i]
            distance[same] = np.inf
            W[i, : len(known.coefficients)] += known.coefficients @ (shares / distance[:, None] - overlap @ W[i])

    def _response(
        self, space: AdjointSpace, coefficients: np.ndarray, first: int, last: int, forces: np.ndarray, into: np.ndarray
    ) -> None:
        """-W_i' (dK_j - lambda_i dM_j) x_i of properties `first` to `last` `into` (m, s, last - first).

        First what the `forces` (t', m) do to the basis (last - first, m, d), for all sensors at once.
        """
        stack, (m, d, _) = self.stack, coefficients.shape
        begin, forces = stack.start[first], forces.astype(float, copy=False)
        in_basis = np.zeros((last - first, m, d))
        done = 0
        for part in space.rows(stack.rows[begin : stack.start[last]]):
            to = min(done + part.shape[1], d)
            if done == to:
                break
            for j in range(first, last):
                own = slice(stack.start[j] - begin, stack.start[j + 1] - begin)
                np.matmul(forces[own].T, part[own, : to - done], out=in_basis[j - first, :, done:to])
            done = to
        for i in range(m):
            into[i] = -(in_basis[:, i] @ coefficients[i]).T

    def _lengths(
        self,
        first: int,
        last: int,
        forces: np.ndarray,
        inertia: np.ndarray | None,
        d_lambda: np.ndarray,
        d_shape: np.ndarray,
    ) -> None:
        """Write d lambda_i = x_i'(dK - lambda_i dM) x_i, and add -1/2 sum_k x_k (x_k'dM x_i) over the cluster of i to `d_shape`."""
        stack = self.stack
        rows = stack.rows[stack.start[first] : stack.start[last]]
        own = self._shapes[rows]
        d_lambda[:] = stack.sums(first, last, own * forces).T
        if inertia is None or not d_shape.size:
            return
        length = stack.sums(first, last, own * inertia)
        for i, same in enumerate(self._same):
            X = self.solution.shapes[:, same]
            each = length[:, i : i + 1] if len(same) == 1 else stack.sums(first, last, X[rows] * inertia[:, i : i + 1])
            d_shape[i] -= 0.5 * read(self.sensing, X) @ each.T


def _difference(one: np.ndarray, other: np.ndarray) -> float:
    """Largest difference of two derivatives (s,) of a mode by a property, relative to its length."""
    size = np.linalg.norm(one, axis=1)
    size = np.maximum(size, _SMALL * size.max(axis=1, initial=0.0, keepdims=True))
    part = np.linalg.norm(one - other, axis=1)
    return float(np.max(np.divide(part, size, out=np.zeros_like(part), where=size > 0), initial=0.0))

"""A reduced model with causes and their losses: its frequency response functions at x, and their derivatives.

With the modes X of the structure and its causes, all elastic, Z_0 = g(s) diag(lambda) + s^2 + s alpha is diagonal, and losses of
causes are of low rank: Z = Z_0 + G' W(s) G. Then

    H = s^k S Z^-1 B',   Z^-1 = Z_0^-1 - Z_0^-1 G' (I + W G Z_0^-1 G')^-1 W G Z_0^-1,   dH = -S Z^-1 dZ Z^-1 B'

(Sherman, Morrison and Woodbury; lecture 21 for the derivative).
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.baseline.altered import Model
from mouse_cli.diagnosis.baseline.reduced import Reduced
from mouse_cli.diagnosis.frf.damping import Damping, of_low_rank
from mouse_cli.diagnosis.frf.lossy import SAME, VISCOUS
from mouse_cli.diagnosis.physics.change import Change, Recipe

_STEP = 1e-5  # of a range, for derivatives of what causes do


@dataclass(frozen=True)
class FrfPoint:
    """The model at x: eigenvalues (r,), modes X (size, r), residual (2 q,) and, for each block of lines, what `jacobian` needs."""

    x: np.ndarray
    eigenvalues: np.ndarray
    X: np.ndarray
    residual: np.ndarray
    parts: tuple["_Solved", ...]

    @property
    def chi2(self) -> float:
        """What is left of the data's misfit."""
        return float(self.residual @ self.residual)


@dataclass(frozen=True)
class _Solved:
    """left (f, o, r) = S Z^-1, right (f, r, i) = Z^-1 B', H (f, o, i) of one block."""

    left: np.ndarray
    right: np.ndarray
    H: np.ndarray


class FrfModel:
    """What `fit` needs of a model: unknowns z of the deck and of the damping, coordinates of the causes, point and jacobian."""

    def __init__(self, base: Reduced, damping: Damping, recipes: tuple[Recipe, ...] = ()):
        """base.data: FrfData."""
        self.base, self.damping, self.recipes = base, damping, recipes
        self.inner = Model(base, recipes)
        self.own = base.L.shape[1]
        self.k, self.t = self.own + len(damping.mean), self.inner.t
        self.bounds, self.width = self.inner.bounds, self.inner.width
        self.middle = base.data.middle
        self._ends = [(self._rows(block.test.outputs), self._rows(block.test.inputs)) for block in base.data.blocks]

    @property
    def start(self) -> np.ndarray:
        """Coordinates (k,) of the deck's parameters and of the damping, where a search begins."""
        return np.concatenate([self.base.z, np.zeros(self.k - self.own)])

    def _rows(self, sensing) -> np.ndarray:
        """What is read of, or forces on, each coordinate (s, size)."""
        V = self.base.V
        read = lambda motion: motion[sensing] if sensing.ndim == 1 else sensing @ motion
        found = np.zeros((sensing.shape[0], self.inner.size))
        found[:, : self.base.r] = read(V)
        for places, recipe in zip(self.inner.places, self.recipes, strict=True):
            if recipe.carried is not None:
                found[:, places[self.base.r :]] = read(recipe.carried.whole)
        return found

    def _elastic(self, x: np.ndarray) -> np.ndarray:
        """x without the unknowns of the damping."""
        return np.concatenate([x[: self.own], x[self.k :]])

    def point(self, x: np.ndarray) -> FrfPoint | None:
        """The model at x (k + t,); None where it is not physical."""
        r, elastic = self.base.r, self._elastic(x)
        K, M, _ = self.inner.added(elastic)
        K0, M0 = self.base.matrices(x[: self.own])
        K[:r, :r] += K0
        M[:r, :r] += M0
        try:
            C = np.linalg.inv(np.linalg.cholesky(M))
            eigenvalues, Q = np.linalg.eigh(C @ K @ C.T)
        except np.linalg.LinAlgError:
            return None
        if not np.isfinite(eigenvalues).all() or eigenvalues[0] < -1e-5 * abs(eigenvalues[-1]):
            return None
        X = C.T @ Q
        parts = tuple(self._solved(i, x, eigenvalues, X) for i in range(len(self._ends)))
        blocks = self.base.data.blocks
        residual = np.concatenate([b.stacked(b.H - part.H) for b, part in zip(blocks, parts, strict=True)])
        return FrfPoint(x, eigenvalues, X, residual, parts) if np.isfinite(residual).all() else None

    def _loss(self, s: np.ndarray, x: np.ndarray) -> tuple[np.ndarray, float]:
        """g (f,) and alpha of the structure."""
        eta, alpha, beta = self.damping.values(x[self.own : self.k])
        return 1 + 1j * eta + s * beta, alpha

    def _solved(self, i: int, x: np.ndarray, eigenvalues: np.ndarray, X: np.ndarray) -> _Solved:
        block, (S, B) = self.base.data.blocks[i], self._ends[i]
        s = block.s
        g, alpha = self._loss(s, x)
        flat = 1 / (g[:, None] * eigenvalues + (s**2 + s * alpha)[:, None])
        left, right = (S @ X)[None] * flat[:, None], (flat[:, :, None] * (B @ X).T[None])
        G, W = self._losses(x, self.inner.changes(x[self.k :]), s)
        if len(G):
            rows = G @ X
            carried = rows[None] * flat[:, None]  # G Z_0^-1 (f, c, r)
            core = np.linalg.solve(np.eye(len(G)) + W @ (carried @ rows.T), W)
            right = right - np.swapaxes(carried, 1, 2) @ (core @ (rows @ right))
            left = left - (left @ rows.T) @ core @ carried
        return _Solved(left, right, block.factor * ((S @ X) @ right))

    def _losses(self, x: np.ndarray, changes: list[Change], s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Rows G (c, size) and W (f, c, c): what the losses of causes add to the structure's own."""
        rows, cores = [], []
        g, stated = self._loss(s, x)[0], self.damping
        if len(stated.rows):
            wide = np.zeros((len(stated.rows), self.inner.size))
            wide[:, : self.base.r] = stated.rows
            rows.append(wide)
            cores.append((1j * stated.own + s[:, None] * stated.viscous)[:, :, None] * np.eye(len(wide)))
        for i, (recipe, change) in enumerate(zip(self.recipes, changes, strict=True)):
            if change.C is not None:
                size, U = of_low_rank(change.C)
                rows.append(self._wide(U.T, i)), cores.append(s[:, None, None] * np.diag(size))
            if recipe.law != SAME and change.K is not None:
                size, U = of_low_rank(self.inner._sum([(i, change)])[0])
                rows.append(U.T), cores.append((self._own(i, x, s) - g)[:, None, None] * np.diag(size))
        if any(r.law != SAME and c.softening is not None for r, c in zip(self.recipes, changes, strict=True)):
            G, W = self._softer(x, changes, s, g)
            rows.append(G), cores.append(W)
        if not rows:
            return np.zeros((0, self.inner.size)), np.zeros((len(s), 0, 0))
        return np.concatenate(rows), _diagonal(cores)

    def _wide(self, rows: np.ndarray, i: int) -> np.ndarray:
        """Rows (c, r + a) of cause i as rows (c, size)."""
        wide = np.zeros((len(rows), self.inner.size))
        wide[:, self.inner.places[i]] = rows
        return wide

    def _own(self, i: int, x: np.ndarray, s: np.ndarray) -> np.ndarray:
        """g (f,) of cause i."""
        recipe = self.recipes[i]
        if recipe.law == SAME:
            return self._loss(s, x)[0]
        loss = recipe.unknowns[-1].value(x[self.k :][self.inner.own[i]][-1])
        return 1 + loss * (s / self.middle if recipe.law == VISCOUS else np.full_like(s, 1j))

    def _softer(self, x: np.ndarray, changes: list[Change], s: np.ndarray, g: np.ndarray):
        """The same for bars that give way: complex flexibilities in series, less what they are without losses of their own."""
        parts = [(i, change.softening) for i, change in enumerate(changes) if change.softening is not None]
        bars, at = np.unique(np.concatenate([part.bars for _, part in parts]), return_inverse=True)
        total, start = np.zeros((len(s), len(bars), 3, 3), complex), 0
        for i, part in parts:
            own = at[start : start + len(part.bars)]
            for b, added in zip(own, part.added, strict=True):
                total[:, b] += added / self._own(i, x, s)[:, None, None]
            start += len(part.bars)
        F, scale = self.base.bars.flexibility[bars], g[:, None, None, None]
        core = np.linalg.inv(F / scale + total) - scale * np.linalg.inv(F)
        elastic = scale * self.inner._softer(changes)[1]
        W = (core - elastic) * self.inner._follow(bars, x[: self.own])
        G = np.zeros((3 * len(bars), self.inner.size))
        G[:, : self.base.r] = self.base.bars.strain[bars].reshape(-1, self.base.r)
        return G, _diagonal(list(np.swapaxes(W, 0, 1)))

    def jacobian(self, at: FrfPoint) -> np.ndarray:
        """d(prediction)/dx (2 q, k + t), whitened."""
        columns = [self._moved(i, at) for i in range(len(at.parts))]
        return np.concatenate([b.stacked(d) for b, d in zip(self.base.data.blocks, columns, strict=True)])

    def _moved(self, i: int, at: FrfPoint) -> np.ndarray:
        """dH/dx (f, o, i, k + t) of one block."""
        block, part = self.base.data.blocks[i], at.parts[i]
        s, x = block.s, at.x
        g, _ = self._loss(s, x)
        found = []
        left, right = part.left @ at.X.T, at.X @ part.right  # in the coordinates of the model
        for K, M in self._slopes(at):
            found.append(left @ (g[:, None, None] * (K @ right) + (s**2)[:, None, None] * (M @ right)))
        eta, alpha, beta = self.damping.values(x[self.own : self.k]) * self.damping.sd
        stiff = part.left @ (at.eigenvalues[:, None] * part.right)
        found[self.own : self.own] = [
            1j * eta * stiff,
            alpha * s[:, None, None] * (part.left @ part.right),
            beta * s[:, None, None] * stiff,
        ]
        total = np.stack(found, axis=-1)
        for j in self._felt(x):
            total[..., j] += self._of_losses(j, x, s, left, right)
        return -block.factor[..., None] * total

    def _slopes(self, at: FrfPoint):
        """dK/dx and dM/dx (size, size) by the deck's parameters, then by the coordinates of the causes, all elastic."""
        r, elastic = self.base.r, self._elastic(at.x)
        dK, dM = self.base.slopes(at.x[: self.own])
        bars, core = self.inner._softer(self.inner.changes(at.x[self.k :]))
        for j, (K, M) in enumerate(zip(dK, dM, strict=True)):
            wide = np.zeros((2, self.inner.size, self.inner.size))
            wide[0, :r, :r], wide[1, :r, :r] = K, M
            if len(bars):
                follow = self.base.stiffening[bars, j][:, None, None] * self.inner._follow(bars, at.x[: self.own])
                wide[0, :r, :r] += self.base.bars.strained(bars, core * follow)
            yield wide[0], wide[1]
        for i, change in self.inner._derivatives(elastic):
            K, M, _ = self.inner._sum([(i, change)])
            yield K, M

    def _felt(self, x: np.ndarray) -> range | tuple:
        """Unknowns that the losses of causes follow: all, where there are any."""
        rows, _ = self._losses(x, self.inner.changes(x[self.k :]), self.base.data.blocks[0].s[:1])
        return range(self.k + self.t) if len(rows) else ()

    def _of_losses(self, j: int, x: np.ndarray, s: np.ndarray, left: np.ndarray, right: np.ndarray) -> np.ndarray:
        """S Z^-1 d(G' W G)/dx_j Z^-1 B' (f, o, i), by central differences."""
        width = self.width[j - self.k] if j >= self.k else 1.0
        sides, length = [], 0.0
        for sign in (1, -1):
            there = x.copy()
            there[j] += sign * _STEP * width
            if j >= self.k:
                there[j] = np.clip(there[j], *self.bounds[j - self.k])
            G, W = self._losses(there, self.inner.changes(there[self.k :]), s)
            sides.append((left @ G.T) @ W @ (G @ right))
            length += sign * there[j]
        return (sides[0] - sides[1]) / length


def _diagonal(blocks: list[np.ndarray]) -> np.ndarray:
    """Blocks (f, c, c) along the diagonal."""
    size = sum(block.shape[1] for block in blocks)
    W, at = np.zeros((len(blocks[0]), size, size), complex), 0
    for block in blocks:
        W[:, at : at + block.shape[1], at : at + block.shape[1]] = block
        at += block.shape[1]
    return W

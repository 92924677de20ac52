"""A reduced model with causes added to it: what it predicts at any parameters and sizes, and by which derivatives."""

from collections.abc import Iterator
from itertools import pairwise
from weakref import WeakValueDictionary

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe
from mouse_cli.diagnosis.likelihoods.modal.carrying import Carrying
from mouse_cli.diagnosis.likelihoods.modal.growing import growing, grown
from mouse_cli.diagnosis.likelihoods.modal.point import Point
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.turning import measured, one_by_one, turned

_STEP = 1e-5  # of a range, for derivatives of matrices
_BUCKLED = 1e-6  # share of the lowest elastic eigenvalue of the model as it is that a negative one has beyond rounding
_ROUNDED = 1e-13  # share of the largest that is no more than rounding

Pushed = tuple[np.ndarray, np.ndarray, np.ndarray]  # (p, size, m) (dK - lambda dM) x, (p, m) x'dM x, (p, s, m) dS x
Parts = list[tuple[Change, float]]  # changes and their weights, whose sum is a derivative
Softer = tuple[np.ndarray, np.ndarray]  # bars (c,), and what their stiffness gains (c, 3, 3)
Stencil = tuple[int, Parts, list[Softer]]  # number of a recipe, and the derivative of what it does


class Model(Carrying):
    """A reduced model with causes: what it predicts at x, and by which derivatives."""

    def __init__(self, base: Reduced, recipes: tuple[Recipe, ...] = ()):
        self.base, self.recipes = base, recipes
        self.k = base.L.shape[1]
        counts = [len(recipe.unknowns) for recipe in recipes]
        self.t, cut = sum(counts), np.cumsum([0, *counts])
        self.own = [slice(a, b) for a, b in pairwise(cut)]
        self.bounds = np.concatenate([np.zeros((0, 2)), *(recipe.bounds for recipe in recipes)])
        self.width = self.bounds[:, 1] - self.bounds[:, 0]
        self._slopes: tuple[Point, np.ndarray] | None = None
        self._points: WeakValueDictionary[bytes, Point] = WeakValueDictionary()
        last, self.places = base.r, []
        for recipe in recipes:
            self.places.append(np.concatenate([np.arange(base.r), last + np.arange(recipe.own)]).astype(int))
            last += recipe.own
        self.size = last

    def changes(self, c: np.ndarray) -> list[Change]:
        """What each cause does at the coordinates c (t,)."""
        return [recipe.at(c[own]) for recipe, own in zip(self.recipes, self.own, strict=True)]

    def added(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """K, M (size, size) and sensing (s, size) that the causes add at x (k + t,)."""
        changes = self.changes(x[self.k :])
        K, M, S = self.summed([(i, grown(self, i, change, x)) for i, change in enumerate(changes)])
        self.crossed(K, M)
        if self.following is not None:
            step = self.base.step(x[: self.k])
            for into, slopes in zip((K, M), self.following, strict=True):
                into += np.tensordot(step, slopes, 1)
        bars, core = self.softer(changes)
        if len(bars):
            K += self.strained(bars, core * self.follow(bars, x[: self.k]))
        return K, M, S

    def summed(self, parts: list[tuple[int, Change]]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """K, M (size, size) and sensing (s, size) that `parts` make, by number of the recipe; without what softens bars."""
        K, M = np.zeros((2, self.size, self.size))
        S = np.zeros((self.base.sensing.shape[0], self.size))
        for i, change in parts:
            at, G = self.places[i], self.within[i]
            block = (slice(len(at)),) * 2 if at[-1] == len(at) - 1 else np.ix_(at, at)
            for into, matrix in ((K, change.K), (M, change.M)):
                if matrix is not None:
                    into[block if G is None else ...] += matrix if G is None else G.T @ matrix @ G
            if change.sensing is not None and G is not None:
                S += change.sensing @ G
            elif change.sensing is not None:
                S[:, at] += change.sensing
        return K, M, S

    def point(self, x: np.ndarray) -> Point | None:
        """The model at x (k + t,); None where it is not physical. Known while somebody has it: searches begin where points were
        compared.
        """
        at = self._points.get(x.tobytes())
        if at is None and (found := self.solved(x)) is not None and (at := self.paired(x, *found)) is not None:
            self._points[x.tobytes()] = at
        return at

    def solved(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
        """Eigenvalues (size,) and shapes X (size, size) at x (k + t,), and sensing (s, size) that the causes add; None likewise."""
        r = self.base.r
        K, M, S = self.added(x)
        K0, M0 = self.base.matrices(x[: self.k])
        K[:r, :r] += K0
        M[:r, :r] += M0
        eigenvalues, X = modes_of(K, M)
        return (eigenvalues, X, S) if self._stands(eigenvalues) else None

    def _stands(self, eigenvalues: np.ndarray) -> bool:
        """Whether it has masses, and has not buckled: an update goes on from no negative eigenvalue either."""
        least = _BUCKLED * self.base.least_elastic + _ROUNDED * abs(eigenvalues[-1])
        return bool(np.isfinite(eigenvalues).all() and eigenvalues[0] >= -least)

    def paired(self, x: np.ndarray, eigenvalues: np.ndarray, X: np.ndarray, S: np.ndarray) -> Point | None:
        """Those modes beside the test; None where it has modes that are none of theirs."""
        found = self._seen(eigenvalues, X, S)
        if found is None:
            return None
        eigenvalues, X, seen, modes = found
        turn = turned(self.base.data, eigenvalues, seen, modes)
        residual, a = self.base.data.residual(eigenvalues[modes], measured(seen, modes, turn))
        return Point(x, eigenvalues, X, seen, modes, residual if turn is None else turn.left(residual), a, turn)

    def _seen(
        self, eigenvalues: np.ndarray, X: np.ndarray, S: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray] | None:
        """Eigenvalues, shapes, what sensors see of them (s, size), for a finer mesh, and the measured modes; None likewise."""
        eigenvalues, X = self.base.refined(eigenvalues, X)
        seen = S @ X
        seen += self.base.sensing @ X[: self.base.r]
        modes = self.base.data.pair(eigenvalues, seen)
        physical = modes.max() < len(eigenvalues) and eigenvalues[modes].min() > 0
        return (eigenvalues, X, seen, modes) if physical else None

    def glimpsed(self, x: np.ndarray) -> np.ndarray | None:
        """The residual (q,) at x if close modes turned each by itself, at a fraction of the cost of `point`; None likewise."""
        found = self.solved(x)
        found = found and self._seen(*found)
        if found is None:
            return None
        eigenvalues, _, seen, modes = found
        return one_by_one(self.base.data, eigenvalues, seen, modes)

    def jacobian(self, at: Point) -> np.ndarray:
        """d(prediction)/dx (q, k + t), whitened; that of the last point is kept."""
        if self._slopes is None or self._slopes[0] is not at:
            self._slopes = at, self._jacobian(at)
        return self._slopes[1]

    def _jacobian(self, at: Point) -> np.ndarray:
        m = at.which
        u, lam = at.X[:, m], at.eigenvalues[m]
        shape = (self.k + self.t, self.size, len(m))
        pushed = np.zeros(shape), np.zeros(shape[::2]), np.zeros((shape[0], len(at.seen), shape[2]))
        self._by_deck(at, u, lam, pushed)
        self._by_causes(at, u, lam, pushed)
        return self._moved(at, *pushed)

    def curvature(self, at: Point) -> np.ndarray | float:
        """Second-order term of the Hessian (k + t, k + t) of half the misfit, -r d2h/dx2 by the second derivatives of K, which
        products of slopes leave out; its positive part, so that steps lead downwards. Where a change of rank one vanishes so do its
        slopes, and this is all that there is. 0: there is none.
        """
        r, m = self.base.r, at.which
        found = self.base.second_slopes(at.x[: self.k], at.X[:r, m])
        if found is None:
            return 0.0
        i, j, pushed = found
        forces, inertia, sensed = (np.zeros((len(i), *own, len(m))) for own in ((self.size,), (), (len(at.seen),)))
        forces[:, :r] = pushed
        H = np.zeros((len(at.x), len(at.x)))
        H[i, j] = H[j, i] = -at.residual @ self._moved(at, forces, inertia, sensed)
        values, vectors = np.linalg.eigh(H)
        return (vectors * np.maximum(values, 0.0)) @ vectors.T

    def _moved(self, at: Point, forces: np.ndarray, inertia: np.ndarray, sensed: np.ndarray) -> np.ndarray:
        """Change (q, p) of what is predicted by each of p changes; see `Pushed`."""
        X, m = at.X, at.which
        lam = at.eigenvalues[m]
        G = (np.swapaxes(forces, 1, 2).reshape(-1, self.size) @ X).reshape(len(forces), len(m), self.size)
        apart = lam[:, None] - at.eigenvalues
        apart[np.abs(apart) < 1e-9 * np.abs(lam)[:, None]] = np.inf
        d_lambda = G[:, np.arange(len(m)), m]
        d_seen = np.swapaxes((G / apart) @ at.seen.T, 1, 2) - 0.5 * inertia[:, None] * at.seen[:, m] + sensed
        return at.jacobian(self.base.data, d_lambda.T, np.moveaxis(d_seen, 0, -1))

    def _by_deck(self, at: Point, u: np.ndarray, lam: np.ndarray, pushed: Pushed) -> None:
        """Into the first k of `pushed` what the deck's parameters do to modes u (size, m) of eigenvalues lam (m,)."""
        r, k, z = self.base.r, self.k, at.x[: self.k]
        forces, inertia, _ = pushed
        stiff, moved = self.base.moved(z, u[:r])
        forces[:k, :r], inertia[:k] = stiff - moved * lam, np.einsum("prm,rm->pm", moved, u[:r])
        forces[:k] += self._following(at)
        if (followed := self.followed(z)) is not None:
            moved = followed[1] @ u
            forces[:k] += followed[0] @ u - moved * lam
            inertia[:k] += np.einsum("prm,rm->pm", moved, u)
        for i, by_K, by_M, change in growing(self, at.x):
            own = self.own_of(i, u)
            each = ((by[:, None, None], m) for by, m in ((by_K, change.K), (by_M, change.M)))
            stiff, moved = (np.zeros((k, *own.shape)) if m is None else by * (m @ own) for by, m in each)
            self.lift(i, stiff - moved * lam, forces[:k])
            inertia[:k] += np.einsum("prm,rm->pm", moved, own)

    def _by_causes(self, at: Point, u: np.ndarray, lam: np.ndarray, pushed: Pushed) -> None:
        """Likewise behind them what the coordinates of the causes do: matrices meet the shapes one by one, and are never summed."""
        forces, inertia, sensed = pushed
        shapes = [self.own_of(i, u) for i in range(len(self.recipes))]
        for j, (i, parts, softer) in enumerate(self.stencils(at.x), self.k):
            own = shapes[i]
            for change, weight in parts:
                if change.K is not None:
                    self.lift(i, weight * (change.K @ own), forces[j])
                if change.M is not None:
                    moved = weight * (change.M @ own)
                    self.lift(i, -lam * moved, forces[j])
                    inertia[j] += np.einsum("rm,rm->m", moved, own)
                if change.sensing is not None:
                    sensed[j] += weight * (change.sensing @ own)
            for bars, core in softer:
                rows = self.strain[bars].reshape(-1, self.size)
                forces[j] += rows.T @ (core @ (rows @ u).reshape(len(bars), 3, -1)).reshape(len(rows), -1)

    def _following(self, at: Point) -> np.ndarray | float:
        """Forces (k, size, m) on the same modes by what softens bars, as it follows their stiffness."""
        bars, core = self.softer(self.changes(at.x[self.k :]))
        if not len(bars):
            return 0.0
        rows = self.strain[bars]
        loads = (core * self.follow(bars, at.x[: self.k])) @ (rows @ at.X[:, at.which])
        b, follows = len(bars), self.base.stiffening[bars].T
        loads = follows[:, :, None, None] * loads  # (k, b, 3, m)
        return rows.reshape(3 * b, -1).T @ loads.reshape(len(follows), 3 * b, loads.shape[-1])

    def parts(self, at: Point) -> list[tuple["Model", Point]]:
        """The model and its point by themselves: there is one arrangement."""
        return [(self, at)]

    def loosened(self, at: Point, share: float) -> "Model | None":
        """The same, its data allowed that share of what the causes do at a point; None where there is no model without them."""
        bare = Model(self.base).point(self.base.bare(at.x[: self.k]))
        if bare is None:
            return None
        data = self.base.data
        off = share * 0.5 * np.log(at.eigenvalues[at.modes] / bare.eigenvalues[bare.modes])
        moved = share * (at.a * at.measured(at.seen) - bare.a * bare.measured(bare.seen))
        return Model(self.base.judged_by(data.loosened(off, moved)), self.recipes)

    def derivatives(self, x: np.ndarray) -> Iterator[tuple[int, Change, np.ndarray | float]]:
        """Recipe, d(change)/dc and dK (size, size) of what softens bars, for each coordinate of the causes."""
        for i, parts, softer in self.stencils(x):
            found = {}
            for name in ("K", "M", "sensing"):
                there = [(getattr(one, name), weight) for one, weight in parts]
                found[name] = None if there[0][0] is None else sum(weight * matrix for matrix, weight in there)
            yield i, Change(**found), sum(self.strained(bars, core) for bars, core in softer)

    def stencils(self, x: np.ndarray) -> Iterator[Stencil]:
        """d(change)/dc for each coordinate of the causes, by differences of the matrices within their pieces."""
        z, c = x[: self.k], x[self.k :]
        changes = self.changes(c)
        for i, (recipe, own) in enumerate(zip(self.recipes, self.own, strict=True)):
            for j, at in enumerate(c[own].tolist()):
                weights = recipe.rate(j, at, _STEP * self.width[own][j])
                each = ((self._with(recipe, c[own], j, value), weight) for value, weight in weights)
                parts = [(grown(self, i, change, x), weight) for change, weight in each]
                yield i, parts, self._softened(z, changes, i, parts)

    def slope(self, c: np.ndarray, j: int) -> list[tuple[float, float]]:
        """See `Recipe`: values of coordinate j of the causes, and weights of what is there."""
        i = next(i for i, own in enumerate(self.own) if own.start <= j < own.stop)
        return self.recipes[i].slope(j - self.own[i].start, c[j], _STEP * self.width[j])

    def _with(self, recipe: Recipe, c: np.ndarray, j: int, value: float) -> Change:
        if value == c[j]:
            return recipe.at(c)
        there = c.copy()
        there[j] = value
        return recipe.change(recipe.values(there))

    def _softened(self, z: np.ndarray, changes: list[Change], i: int, parts: Parts) -> list[Softer]:
        """Bars and what `parts` do to their stiffness, each times its weight, as cause number i beside the other ones."""
        if parts[0][0].softening is None:
            return []
        found = []
        for one, weight in parts:
            bars, core = self.softer([*changes[:i], one, *changes[i + 1 :]])
            if found and np.array_equal(bars, found[-1][0]):
                found[-1] = bars, found[-1][1] + weight * core
            else:
                found.append((bars, weight * core))
        return [(bars, core * self.follow(bars, z)) for bars, core in found]


def modes_of(K: np.ndarray, M: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Eigenvalues (size,) and mass-normalised shapes of symmetric K and M, which are overwritten; NaN where M is no mass.

    In coordinates of the modes M is diagonal wherever nothing but stiffness changes, and needs no factor: a quarter of the time.
    """
    from scipy.linalg.lapack import dsyevd, dsygvd

    n = len(K)
    if M.ravel()[1:].reshape(n - 1, n + 1)[:, :-1].any() or M.diagonal().min() <= 0:
        eigenvalues, X, fault = dsygvd(K.T, M.T, overwrite_a=1, overwrite_b=1)
    else:
        by = 1 / np.sqrt(M.diagonal())
        K *= by
        K *= by[:, None]
        eigenvalues, X, fault = dsyevd(K.T, lower=1, overwrite_a=1)  # small ones keep their digits from this end
        X *= by[:, None]
    return (np.full(n, np.nan) if fault else eigenvalues), X

"""A reduced model with causes added to it: what it predicts at any parameters and sizes, and by which derivatives."""

from collections.abc import Iterator
from functools import cached_property
from itertools import pairwise

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe
from mouse_cli.diagnosis.likelihoods.modal.growing import growing, grown
from mouse_cli.diagnosis.likelihoods.modal.point import Point
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.softened import Softened
from mouse_cli.diagnosis.likelihoods.modal.turning import measured, turned

_STEP = 1e-5  # of a range, for derivatives of matrices

Pushed = tuple[np.ndarray, np.ndarray, np.ndarray]  # (p, size, m) (dK - lambda dM) x, (p, m) x'dM x, (p, s, m) dS x
Parts = list[tuple[Change, float]]  # changes and their weights, whose sum is a derivative
Softer = tuple[np.ndarray, np.ndarray]  # bars (c,), and what their stiffness gains (c, 3, 3)
Stencil = tuple[int, Parts, list[Softer]]  # number of a recipe, and the derivative of what it does


class Model(Softened):
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
        self._crossed(K, M)
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
            at, G = self.places[i], self._carried(i)
            block = (slice(len(at)),) * 2 if at[-1] == len(at) - 1 else np.ix_(at, at)
            for into, matrix in ((K, change.K), (M, change.M)):
                if matrix is not None:
                    into[block if G is None else ...] += matrix if G is None else G.T @ matrix @ G
            if change.sensing is not None and G is not None:
                S += change.sensing @ G
            elif change.sensing is not None:
                S[:, at] += change.sensing
        return K, M, S

    def _crossed(self, K: np.ndarray, M: np.ndarray) -> None:
        """Adds what is between the own degrees of freedom of two causes that both carry the model along."""
        own = [j for j, recipe in enumerate(self.recipes) if recipe.carried is not None]
        for i, j in ((i, j) for i in own for j in own if i != j):
            one, other = self.recipes[i].carried, self.recipes[j].carried
            at = np.ix_(self.places[i][self.base.r :], self.places[j][self.base.r :])
            K[at] += one.whole.T @ other.K
            M[at] += one.whole.T @ other.M

    @cached_property
    def following(self) -> tuple[np.ndarray, np.ndarray] | None:
        """What the deck's parameters, along each of d directions, add to K and M (d, size, size) of the causes; None: nothing."""
        own = [(i, recipe.carried) for i, recipe in enumerate(self.recipes) if recipe.carried]
        if not own:
            return None
        K, M = np.zeros((2, self.base.directions.shape[1], self.size, self.size))
        for i, carried in own:
            at = self.places[i]
            for into, slopes in zip((K, M), carried.slopes, strict=True):
                into[:, at[:, None], at] += slopes
            for j, other in own:
                if i != j:
                    between = (slice(None), *np.ix_(self.places[j][self.base.r :], at[self.base.r :]))
                    for into, slopes in zip((K, M), carried.across(other.whole), strict=True):
                        into[between] += slopes
        return K, M

    def followed(self, z: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
        """Its derivatives by z (k, size, size)."""
        if self.following is None:
            return None
        rates = self.base.rates(z)
        return tuple(np.tensordot(rates, slopes, 1) for slopes in self.following)

    def _carried(self, i: int) -> np.ndarray | None:
        """Coordinates of cause i from those of all (., size), where other causes carry the model along."""
        r, at = self.base.r, self.places[i]
        others = [j for j, recipe in enumerate(self.recipes) if j != i and recipe.carried is not None]
        if not others or self.recipes[i].carried is not None:
            return None
        G = np.zeros((len(at), self.size))
        G[range(len(at)), at] = 1.0
        for j in others:
            G[:r, self.places[j][r:]] = self.recipes[j].carried.model
        return G

    def moved(self, X: np.ndarray) -> np.ndarray:
        """Shapes (r, m) of the structure, causes that carry it included, in coordinates of the base, from X (size or more, m)."""
        own = [(each.carried.model, at) for each, at in zip(self.recipes, self.places, strict=True) if each.carried]
        return X[: self.base.r] + sum(along @ X[at[self.base.r :]] for along, at in own)

    def point(self, x: np.ndarray) -> Point | None:
        """The model at x (k + t,); None where it is not physical."""
        found = self.solved(x)
        return None if found is None else self.paired(x, *found)

    def solved(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
        """Eigenvalues (size,) and shapes X (size, size) at x (k + t,), and sensing (s, size) that the causes add; None likewise."""
        r = self.base.r
        K, M, S = self.added(x)
        K0, M0 = self.base.matrices(x[: self.k])
        K[:r, :r] += K0
        M[:r, :r] += M0
        eigenvalues, X = modes_of(K, M)
        physical = np.isfinite(eigenvalues).all() and eigenvalues[0] >= -1e-5 * abs(eigenvalues[-1])
        return (eigenvalues, X, S) if physical else None

    def paired(self, x: np.ndarray, eigenvalues: np.ndarray, X: np.ndarray, S: np.ndarray) -> Point | None:
        """Those modes beside the test; None where it has modes that are none of theirs."""
        seen = S @ X
        seen += self.base.sensing @ X[: self.base.r]
        modes = self.base.data.pair(eigenvalues, seen)
        if modes.max() >= len(eigenvalues) or eigenvalues[modes].min() <= 0:
            return None
        turn = turned(self.base.data, eigenvalues, seen, modes)
        residual, a = self.base.data.residual(eigenvalues[modes], measured(seen, modes, turn))
        return Point(x, eigenvalues, X, seen, modes, residual if turn is None else turn.left(residual), a, turn)

    def jacobian(self, at: Point) -> np.ndarray:
        """d(prediction)/dx (q, k + t), whitened; that of the last point is kept."""
        if self._slopes is None or self._slopes[0] is not at:
            self._slopes = at, self._jacobian(at)
        return self._slopes[1]

    def _jacobian(self, at: Point) -> np.ndarray:
        X, m = at.X, at.which
        forces, inertia, sensed = (
            np.concatenate(pair) for pair in zip(self._by_deck(at), self._by_causes(at), strict=True)
        )
        G = (np.swapaxes(forces, 1, 2).reshape(-1, self.size) @ X).reshape(len(forces), len(m), self.size)
        apart = at.eigenvalues[m][:, None] - at.eigenvalues
        apart[np.abs(apart) < 1e-9 * np.abs(at.eigenvalues[m])[:, None]] = np.inf
        d_lambda = G[:, np.arange(len(m)), m]
        d_seen = np.swapaxes((G / apart) @ at.seen.T, 1, 2) - 0.5 * inertia[:, None] * at.seen[:, m] + sensed
        return at.jacobian(self.base.data, d_lambda.T, np.moveaxis(d_seen, 0, -1))

    def _by_deck(self, at: Point) -> Pushed:
        """What the deck's parameters do to the modes `which` of a point."""
        r, X, m = self.base.r, at.X, at.which
        stiff, moved = self.base.moved(at.x[: self.k], X[:r, m])
        forces, inertia = np.zeros((self.k, self.size, len(m))), np.einsum("prm,rm->pm", moved, X[:r, m])
        forces[:, :r] = stiff - moved * at.eigenvalues[m]
        forces += self._following(at)
        if (followed := self.followed(at.x[: self.k])) is not None:
            moved = followed[1] @ X[:, m]
            forces += followed[0] @ X[:, m] - moved * at.eigenvalues[m]
            inertia += np.einsum("prm,rm->pm", moved, X[:, m])
        for i, by_K, by_M, change in growing(self, at.x):
            u = self._own(i, X[:, m])
            stiff, moved = by_K[:, None, None] * (change.K @ u), by_M[:, None, None] * (change.M @ u)
            forces += self._lifted(i, stiff - moved * at.eigenvalues[m])
            inertia += np.einsum("prm,rm->pm", moved, u)
        return forces, inertia, np.zeros((self.k, len(at.seen), len(m)))

    def _own(self, i: int, X: np.ndarray) -> np.ndarray:
        """Shapes (., m) in the coordinates of cause i."""
        G = self._carried(i)
        return X[self.places[i]] if G is None else G @ X

    def _lifted(self, i: int, push: np.ndarray) -> np.ndarray:
        """Forces (..., size, m) by those in the coordinates of cause i."""
        G = self._carried(i)
        if G is not None:
            return G.T @ push
        found = np.zeros((*push.shape[:-2], self.size, push.shape[-1]))
        found[..., self.places[i], :] = push
        return found

    def _by_causes(self, at: Point) -> Pushed:
        """What the coordinates of the causes do to them: matrices meet the shapes one by one, and are never summed."""
        X, eigenvalues = at.X[:, at.which], at.eigenvalues[at.which]
        forces, inertia = np.zeros((self.t, *X.shape)), np.zeros((self.t, X.shape[1]))
        sensed = np.zeros((self.t, len(at.seen), X.shape[1]))
        for j, (i, parts, softer) in enumerate(self.stencils(at.x)):
            u = self._own(i, X)
            K, M, S = (_applied(parts, name, u) for name in ("K", "M", "sensing"))
            push = (0.0 if K is None else K) - (0.0 if M is None else M * eigenvalues)
            forces[j] = self._lifted(i, push) if np.ndim(push) else 0.0
            inertia[j] = 0.0 if M is None else np.einsum("rm,rm->m", M, u)
            sensed[j] = 0.0 if S is None else S
            for bars, core in softer:
                rows = self.strain[bars].reshape(-1, self.size)
                forces[j] += rows.T @ (core @ (rows @ X).reshape(len(bars), 3, -1)).reshape(len(rows), -1)
        return forces, inertia, sensed

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
            for j in range(own.start, own.stop):
                each = ((self._with(recipe, c[own], j - own.start, at), weight) for at, weight in self.slope(c, j))
                parts = [(grown(self, i, change, x), weight) for change, weight in each]
                yield i, parts, self._softened(z, changes, i, parts)

    def slope(self, c: np.ndarray, j: int) -> list[tuple[float, float]]:
        """See `Recipe`: values of coordinate j of the causes, and weights of what is there."""
        i = next(i for i, own in enumerate(self.own) if own.start <= j < own.stop)
        return self.recipes[i].slope(j - self.own[i].start, c[j], _STEP * self.width[j])

    def _with(self, recipe: Recipe, c: np.ndarray, j: int, value: float) -> Change:
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


def _applied(parts: Parts, name: str, u: np.ndarray) -> np.ndarray | None:
    """The sum of matrices `name` of `parts`, each times its weight, times u; None where they have none."""
    there = [(getattr(one, name), weight) for one, weight in parts]
    return None if there[0][0] is None else sum(weight * (matrix @ u) for matrix, weight in there)


def modes_of(K: np.ndarray, M: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Eigenvalues (size,) and mass-normalised shapes of symmetric K and M, which are overwritten; NaN where M is no mass."""
    from scipy.linalg.lapack import dsygvd

    eigenvalues, X, fault = dsygvd(K.T, M.T, overwrite_a=1, overwrite_b=1)
    return (np.full(len(K), np.nan) if fault else eigenvalues), X

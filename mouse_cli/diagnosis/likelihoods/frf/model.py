"""A reduced model with causes and their losses: its frequency response functions at x, and their derivatives.

With the modes X of the structure and its causes, all elastic, Z_0 = diag(lambda (1 + d (i eta + s beta)) + s d (alpha + 2 zeta
lambda^1/2)) + s^2, d of each mode, is diagonal, and other losses are of low rank: Z = Z_0 + G' W(s) G. Then

    H = s^k S Z^-1 B',   Z^-1 = Z_0^-1 - Z_0^-1 G' (I + W G Z_0^-1 G')^-1 W G Z_0^-1,   dH = s^k (dS Z^-1 - S Z^-1 dZ Z^-1) B'

(Sherman, Morrison and Woodbury; lecture 21 for the derivative). Modes that were measured beside the functions add their residual:
both belong to one structure, whose theory errs alike in both.
"""

from dataclasses import dataclass, replace
from itertools import chain

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.likelihoods.frf.damping import Damping
from mouse_cli.diagnosis.likelihoods.frf.gains import gains
from mouse_cli.diagnosis.likelihoods.frf.losses import Losses
from mouse_cli.diagnosis.likelihoods.modal.growing import growing
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.point import Left, Point
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.turning import Turn
from mouse_cli.dynamics.sensing import read
from mouse_cli.model.frf_test import FrfTest

_STEP = 1e-5  # of a range, for derivatives of losses


@dataclass(frozen=True)
class FrfPoint(Left):
    """The model at x: eigenvalues (size,), modes X (size, size), residual (2 q + m,), each block of functions, measured modes."""

    x: np.ndarray
    eigenvalues: np.ndarray
    X: np.ndarray
    residual: np.ndarray
    parts: tuple["Functions", ...]
    modal: Point | None = None

    @property
    def turns(self) -> tuple[Turn, ...]:
        """Those of the measured modes."""
        return self.modal.turns if self.modal else ()


@dataclass(frozen=True)
class Functions:
    """left (n, o, size) = S Z^-1 and right (n, size, i) = Z^-1 B' in modes, factor (n, o, i): at the nodes of the lines.

    H (f, o, i): as measured, gains and leakage in it.
    """

    left: np.ndarray
    right: np.ndarray
    H: np.ndarray
    factor: np.ndarray


class FrfModel:
    """What `fit` needs of a model. x: k unknowns N(0, 1), then t of the causes.

    The k are of the deck, of the damping, of the gains, and what theory errs in ln f of the lowest modes.
    """

    def __init__(self, base: Reduced, damping: Damping, recipes: tuple[Recipe, ...] = (), middle: float | None = None):
        """base.data: FrfData; middle: omega_0, rad/s, of viscous losses; None: the middle of the band."""
        self.base, self.damping, self.recipes = base, damping, recipes
        self.elastic, self.modes = Model(replace(base, data=base.data.modes), recipes), base.data.modes
        self.gains = gains(tuple(block.test for block in base.data.blocks))
        self.losses = Losses(self.elastic, damping, base.data.middle if middle is None else middle)
        self.of_deck, self.lossy = base.L.shape[1], base.L.shape[1] + len(damping.mean)
        self.theory, self.measured = base.data.theory, self.lossy + self.gains.count
        self.k, self.t = self.measured + len(self.theory), self.elastic.t
        self.bounds, self.width, self.own = self.elastic.bounds, self.elastic.width, self.elastic.own
        self._ends = [self._rows(block.test) for block in base.data.blocks]
        self._sensors = [_same(S[:, : base.r], base.sensing) for S, _ in self._ends]
        for (S, _), same in zip(self._ends, self._sensors, strict=True):
            S[same.any(axis=1), base.r :] = 0.0  # what a cause says of the sensors has its own motion in it

    @property
    def start(self) -> np.ndarray:
        """Coordinates (k,) where a search begins."""
        return np.concatenate([self.base.z, np.zeros(self.k - self.of_deck)])

    def split(self, x: np.ndarray) -> tuple[np.ndarray, ...]:
        """Coordinates of the deck's parameters, of the damping, of the gains, of what theory errs, and of the causes."""
        return tuple(np.split(x, [self.of_deck, self.lossy, self.measured, self.k]))

    def _rows(self, test: FrfTest) -> tuple[np.ndarray, np.ndarray]:
        """What responses read of each coordinate (o, size), and forces on it (i, size)."""
        ends = (test.outputs, test.output_names, test.held), (test.inputs, test.input_names, ())
        found = [np.zeros((sensing.shape[0], self.elastic.size)) for sensing, _, _ in ends]
        for rows, (sensing, names, held) in zip(found, ends, strict=True):
            rows[:, : self.base.r] = read(sensing, self.base.V)
            for places, recipe in zip(self.elastic.places, self.recipes, strict=True):
                if recipe.carried is not None:
                    rows[:, places[self.base.r :]] = recipe.carried.read(sensing, names, held)
        return found[0], found[1]

    @np.errstate(all="ignore")  # of a step that goes too far
    def point(self, x: np.ndarray) -> FrfPoint | None:
        """The model at x (k + t,); None where it is not physical, or no longer a number."""
        z, _, _, errs, c = self.split(x)
        own = np.concatenate([z, c])
        solved = self.elastic.solved(own)
        if solved is None:
            return None
        eigenvalues, X, sensing = solved
        modal = self.modes and self.elastic.paired(own, *solved)
        if self.modes and modal is None:
            return None
        eigenvalues = eigenvalues.copy()
        eigenvalues[: len(errs)] *= np.exp(2 * self.theory * errs)
        parts = tuple(self._functions(i, x, eigenvalues, X, sensing) for i in range(len(self._ends)))
        blocks = self.base.data.blocks
        residual = [b.stacked(b.H - part.H) for b, part in zip(blocks, parts, strict=True)]
        residual += [modal.residual - self._erring(modal) @ errs] if modal else []
        residual = np.concatenate(residual)
        return FrfPoint(x, eigenvalues, X, residual, parts, modal) if np.isfinite(residual @ residual) else None

    def curvature(self, at: FrfPoint) -> float:
        """0: of FRFs products of slopes are all of the Hessian that is known."""
        return 0.0

    def _erring(self, at: Point) -> np.ndarray:
        """d(prediction)/d(errs) (m, c) of the measured modes, whitened."""
        rows = self.theory * (at.modes[:, None] == np.arange(len(self.theory))) / self.modes.sd_log[:, None]
        rows = rows[self.modes.has_frequency]
        return np.pad(rows, ((0, len(at.residual) - len(rows)), (0, 0)))

    def _functions(
        self, i: int, x: np.ndarray, eigenvalues: np.ndarray, X: np.ndarray, sensing: np.ndarray
    ) -> Functions:
        """Functions of block i; sensing (s, size): what causes add to what the sensors of the test read."""
        block, (S, B), (z, own, u, _, c) = self.base.data.blocks[i], self._ends[i], self.split(x)
        s, S = block.nodes, S + self._sensors[i] @ sensing
        flat = 1 / (eigenvalues + (s**2)[:, None] + self.damping.of_modes(s, eigenvalues, own).sum(axis=0))
        left, right = (S @ X)[None] * flat[:, None], (flat[:, :, None] * (B @ X).T[None])
        G, W = self.losses.local(s, z, own, c)
        if len(G):
            rows = G @ X
            carried = rows[None] * flat[:, None]  # G Z_0^-1 (f, c, size)
            core = np.linalg.solve(np.eye(len(G)) + W @ (carried @ rows.T), W)
            right = right - np.swapaxes(carried, 1, 2) @ (core @ (rows @ right))
            left = left - (left @ rows.T) @ core @ carried
        factor = block.factor * self.gains.factor(i, u)
        return Functions(left, right, block.expected(factor * ((S @ X) @ right)), factor)

    def parts(self, at: FrfPoint) -> list:
        """None that pairs modes, see `Model.parts`."""
        return []

    def jacobian(self, at: FrfPoint) -> np.ndarray:
        """d(prediction)/dx (2 q, k + t), whitened."""
        rows = [b.stacked(self._moved(i, at)) for i, b in enumerate(self.base.data.blocks)]
        if at.modal:
            found = np.zeros((len(at.modal.residual), len(at.x)))
            found[:, np.r_[: self.of_deck, self.k : len(at.x)]] = self.elastic.jacobian(at.modal)
            found[:, self.measured : self.k] = self._erring(at.modal)
            rows.append(found)
        return np.concatenate(rows)

    def _moved(self, i: int, at: FrfPoint) -> np.ndarray:
        """dH/dx (f, o, i, k + t) of block i."""
        part, block = at.parts[i], self.base.data.blocks[i]
        s = block.nodes
        _, own, _, errs, _ = self.split(at.x)
        g = self.losses.of_structure(s, own)
        left, right = part.left @ at.X.T, at.X @ part.right  # in the coordinates of the model
        K, M, S = self._slopes(at)
        elastic = g[:, None, None, None] * _between(left, K, right) + (s**2)[:, None, None, None] * _between(
            left, M, right
        )
        elastic -= np.einsum("pos,fsi->foip", self._sensors[i] @ S, right)
        damping = self._damped(part, s, at.eigenvalues, own)
        found = np.concatenate([elastic[..., : self.of_deck], damping, elastic[..., self.of_deck :]], axis=-1)
        for j, slope in self._of_losses(i, at.x, left, right):
            found[..., j - (self.k - self.lossy) * (j >= self.k)] += slope
        c = len(errs)
        own = part.left[:, :, None, :c] * np.swapaxes(part.right[:, :c], 1, 2)[:, None]  # (f, o, i, c)
        own = g[:, None, None, None] * own * (2 * self.theory * at.eigenvalues[:c])
        factor = part.factor[..., None]
        return np.concatenate(
            [
                block.expected(-factor * found[..., : self.lossy]),
                self.gains.slopes(i, part.H),
                block.expected(-factor * own),
                block.expected(-factor * found[..., self.lossy :]),
            ],
            axis=-1,
        )

    def _damped(self, part: "Functions", s: np.ndarray, eigenvalues: np.ndarray, own: np.ndarray) -> np.ndarray:
        """S Z^-1 dZ Z^-1 B' (f, o, i, d) by the unknowns of the damping."""
        kinds = self.damping.of_modes(s, eigenvalues, own)
        found = [part.left @ (each[:, :, None] * part.right) for each in kinds]
        whole = kinds.sum(axis=0)
        for r in range(len(own) - len(kinds)):
            found.append(part.left[:, :, r : r + 1] * (whole[:, r, None] * part.right[:, r])[:, None])
        return np.stack(found, axis=-1) * self.damping.sd

    def _slopes(self, at: FrfPoint) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """dK, dM (p, size, size) and d(sensing) (p, s, size) by the deck's parameters, then by the causes, all elastic."""
        r, (z, *_, c) = self.base.r, self.split(at.x)
        count, size = self.of_deck + self.t, self.elastic.size
        K, M, S = (np.zeros((count, rows, size)) for rows in (size, size, len(self.base.sensing)))
        K[: self.of_deck, :r, :r], M[: self.of_deck, :r, :r] = self.base.slopes(z)
        if (followed := self.elastic.followed(z)) is not None:
            for into, slopes in zip((K, M), followed, strict=True):
                into[: self.of_deck] += slopes
        for i, *by, change in growing(self.elastic, np.concatenate([z, c])):
            for into, own, matrix in zip((K, M), by, self.elastic.summed([(i, change)]), strict=False):
                into[: self.of_deck] += own[:, None, None] * matrix
        bars, core = self.elastic.softer(self.elastic.changes(c))
        if len(bars):
            follow = self.base.stiffening[bars].T[:, :, None, None] * self.elastic.follow(bars, z)
            for j in np.flatnonzero(follow.any(axis=(1, 2, 3))):
                K[j] += self.elastic.strained(bars, core * follow[j])
        for j, (i, change, softer) in enumerate(self.elastic.derivatives(np.concatenate([z, c])), self.of_deck):
            K[j], M[j], S[j] = self.elastic.summed([(i, change)])
            K[j] += softer
        return K, M, S

    def _of_losses(self, i: int, x: np.ndarray, left: np.ndarray, right: np.ndarray):
        """j and S Z^-1 d(G' W G)/dx_j Z^-1 B' (f, o, i), by differences, of every x_j that the losses follow."""
        s, (z, own, _, _, c) = self.base.data.blocks[i].nodes, self.split(x)
        if not len(self.losses.local(s[:1], z, own, c)[0]):
            return
        for j in chain(self.losses.followed(self.of_deck, c), range(self.k, self.k + self.t)):
            slope = 0.0
            for place, weight in self._stencil(x, j):
                there = x.copy()
                there[j] = place
                z, own, _, _, c = self.split(there)
                G, W = self.losses.local(s, z, own, c)
                slope = slope + weight * ((left @ G.T) @ W @ (G @ right))
            yield j, slope

    def _stencil(self, x: np.ndarray, j: int) -> list[tuple[float, float]]:
        """Values of x_j, and weights of what is there, whose sum is the derivative."""
        if j >= self.k:
            return self.elastic.slope(x[self.k :], j - self.k)
        return [(x[j] + _STEP, 0.5 / _STEP), (x[j] - _STEP, -0.5 / _STEP)]


def _between(left: np.ndarray, matrices: np.ndarray, right: np.ndarray) -> np.ndarray:
    """left (f, o, n) matrices (p, n, n) right (f, n, i): (f, o, i, p); matrices of zeros cost nothing."""
    lines, n, i = right.shape
    found = np.zeros((lines, left.shape[1], i, len(matrices)), complex)
    there = np.flatnonzero(matrices.any(axis=(1, 2)))
    if len(there):
        motion = np.ascontiguousarray(np.moveaxis(right, 1, 0)).reshape(n, -1).view(float)  # (n, f i 2)
        forces = (matrices[there].reshape(-1, n) @ motion).view(complex).reshape(len(there), n, lines, i)
        forces = np.ascontiguousarray(np.transpose(forces, (2, 1, 3, 0))).reshape(lines, n, -1)
        found[..., there] = (left @ forces).reshape(lines, -1, i, len(there))
    return found


def _same(rows: np.ndarray, sensing: np.ndarray) -> np.ndarray:
    """(o, s): 1 where a row (o, r) reads what a sensor (s, r) of the modal test reads."""
    apart = np.linalg.norm(rows[:, None] - sensing[None], axis=2)
    return (apart < 1e-9 * np.linalg.norm(rows, axis=1)[:, None]).astype(float)

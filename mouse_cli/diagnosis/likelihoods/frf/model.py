"""A reduced model with causes and their losses: its frequency response functions at x, and their derivatives.

With the modes X of the structure and its causes, all elastic, Z_0 = diag(lambda (1 + d (i eta + s beta)) + s d (alpha + 2 zeta
lambda^1/2)) + s^2, d of each mode, is diagonal, and other losses are of low rank: Z = Z_0 + G' W(s) G, see `receptance`. Then

    H = s^k S Z^-1 B',   dH = s^k (dS Z^-1 - S Z^-1 dZ Z^-1) B'

(lecture 21). Modes that were measured beside the functions add their residual:
both belong to one structure, whose theory errs alike in both.
"""

from collections.abc import Iterator
from copy import copy
from dataclasses import dataclass
from itertools import chain

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.likelihoods.frf.damping import ALIKE, Damping
from mouse_cli.diagnosis.likelihoods.frf.gains import gains
from mouse_cli.diagnosis.likelihoods.frf.losses import Losses
from mouse_cli.diagnosis.likelihoods.frf.receptance import Receptance, times
from mouse_cli.diagnosis.likelihoods.modal.growing import growing
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.point import Left, Point
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.turning import Turn
from mouse_cli.dynamics.sensing import read
from mouse_cli.model.frf_test import FrfTest

_STEP = 1e-5  # of a range, for derivatives of losses

Solved = tuple[np.ndarray, np.ndarray, np.ndarray]  # eigenvalues, shapes, and what causes add to sensors, see `Model.solved`


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
    """Z^-1 in modes, and by what H is more than S Z^-1 B', factor (n, o, i): at the nodes of the lines.

    H (f, o, i): as measured, gains, delays and leakage in it.
    """

    receptance: Receptance
    H: np.ndarray
    factor: np.ndarray


class FrfModel:
    """What `fit` needs of a model. x: k unknowns N(0, 1), then t of the causes.

    The k are of the deck, of the damping, of the gains and delays of chains, and what theory errs in ln f of the lowest modes.
    """

    def __init__(self, base: Reduced, damping: Damping, recipes: tuple[Recipe, ...] = (), middle: float | None = None):
        """base.data: FrfData; middle: omega_0, rad/s, of viscous losses; None: the middle of the band."""
        self.base, self.damping, self.recipes = base, damping, recipes
        self.elastic, self.modes = Model(base.judged_by(base.data.modes), recipes), base.data.modes
        self.gains = gains(tuple(block.test for block in base.data.blocks), base.data.late)
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
        """Coordinates of the deck's parameters, of the damping, of the chains, of what theory errs, and of the causes."""
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
    def point(self, x: np.ndarray, solved: Solved | None = None) -> FrfPoint | None:
        """The model at x (k + t,); None where it is not physical, or no longer a number. solved: its elastic part, if known."""
        z, _, _, errs, c = self.split(x)
        own = np.concatenate([z, c])
        solved = solved or self.elastic.solved(own)
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
        residual = [b.whitened(b.H - part.H) for b, part in zip(blocks, parts, strict=True)]
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
        of_modes, of_lines = self.damping.of_modes(s, eigenvalues, own)
        flat = 1 / (eigenvalues[:, None] + s**2 + of_modes.T @ of_lines)
        G, W = self.losses.local(s, z, own, c)
        receptance = Receptance(S @ X, B @ X, G @ X, flat, W)
        factor = block.factor * self.gains.factor(i, u, s)
        return Functions(receptance, block.expected(factor * receptance.H), factor)

    def parts(self, at: FrfPoint) -> list:
        """None that pairs modes, see `Model.parts`."""
        return []

    def jacobian(self, at: FrfPoint) -> np.ndarray:
        """d(prediction)/dx (2 q, k + t), whitened."""
        columns = [b.whitened(self._moved(i, at)) for i, b in enumerate(self.base.data.blocks)]
        if at.modal:
            found = np.zeros((len(at.x), len(at.modal.residual)))
            found[np.r_[: self.of_deck, self.k : len(at.x)]] = self.elastic.jacobian(at.modal).T
            found[self.measured : self.k] = self._erring(at.modal).T
            columns.append(found)
        return np.concatenate(columns, axis=1).T

    def _moved(self, i: int, at: FrfPoint) -> np.ndarray:
        """dH/dx (k + t, f, o, i) of block i."""
        part, block = at.parts[i], self.base.data.blocks[i]
        receptance = copy(part.receptance)  # what slopes alone ask for is not kept
        found = np.empty((len(at.x), *part.factor.shape), complex)
        of_deck, damped, gains, errs, causes = np.split(found, [self.of_deck, self.lossy, self.measured, self.k])
        self._by_matrices(i, at, receptance, of_deck, causes)
        self._by_damping(i, at, receptance, damped, errs)
        gains[:] = 0.0
        gains[len(self.gains.sd) :] = -self.gains.by_delays(i, receptance.H, block.nodes)
        for j, slope in self._of_losses(i, at, receptance):
            found[j] += slope
        found *= -part.factor
        found = block.expected(np.moveaxis(found, 1, 0)).swapaxes(0, 1) if block.leakage else found
        found[self.lossy : self.lossy + len(self.gains.sd)] = np.moveaxis(self.gains.by_gains(i, part.H), -1, 0)
        return found

    def _by_matrices(self, i: int, at: FrfPoint, receptance: Receptance, of_deck: np.ndarray, causes: np.ndarray) -> None:
        """S Z^-1 dZ Z^-1 B' - dS Z^-1 B' into (., f, o, i) by the deck's parameters and by the causes, all elastic."""
        s, X = self.base.data.blocks[i].nodes, at.X
        K, M, S = self._slopes(at)
        motion, g = receptance.right, self.losses.of_structure(s, self.split(at.x)[1])
        pushed = np.zeros((len(motion), len(K), *motion.shape[1:]), complex)
        for matrices, unit in ((K, g), (M, s**2)):
            for j in np.flatnonzero(matrices.any(axis=(1, 2))):
                pushed[:, j] += unit[:, None] * times(X.T @ matrices[j] @ X, motion)
        found = receptance.read(pushed)
        for j in np.flatnonzero(S.any(axis=(1, 2))):
            found[:, j] -= times(self._sensors[i] @ S[j] @ X, motion)
        of_deck[:], causes[:] = np.split(np.moveaxis(found, 0, 2), [self.of_deck])

    def _by_damping(self, i: int, at: FrfPoint, receptance: Receptance, damped: np.ndarray, erring: np.ndarray) -> None:
        """S Z^-1 dZ Z^-1 B' into (., f, o, i) by the unknowns of the damping, and by what theory errs."""
        s, (_, own, _, _, _) = self.base.data.blocks[i].nodes, self.split(at.x)
        of_modes, of_lines = self.damping.of_modes(s, at.eigenvalues, own)
        sd, kinds, c = self.damping.sd, len(of_modes), len(erring)
        uneven = len(sd) - kinds if sd[kinds:].any() else 0
        apart, alike = map(list, ALIKE)
        read = receptance.read(of_modes[apart].T[:, :, None, None] * receptance.right[:, None])  # (o, a, f, i)
        damped[:kinds] = (sd[:kinds, None] * of_lines)[:, :, None, None] * np.moveaxis(read, 0, 2)[alike]
        each = receptance.left(max(uneven, c))[..., None] * receptance.right[: max(uneven, c)]
        each = np.moveaxis(each, 0, 2)  # (c, f, o, i)
        whole = sd[kinds : kinds + uneven, None] * (of_modes[:, :uneven].T @ of_lines)
        damped[kinds:] = 0.0
        damped[kinds : kinds + uneven] = whole[:, :, None, None] * each[:uneven]
        by = self.losses.of_structure(s, own) * (2 * self.theory * at.eigenvalues[:c])[:, None]
        erring[:] = by[:, :, None, None] * each[:c]

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

    def _of_losses(self, i: int, at: FrfPoint, receptance: Receptance) -> Iterator[tuple[int, np.ndarray]]:
        """j and S Z^-1 d(G' W G)/dx_j Z^-1 B' (f, o, i), by differences, of every x_j that the losses follow."""
        s, (_, _, _, _, c) = self.base.data.blocks[i].nodes, self.split(at.x)
        if not len(receptance.rows):
            return
        ends: dict[bytes, tuple[np.ndarray, np.ndarray]] = {}
        for j in chain(self.losses.followed(self.of_deck, c), range(self.k, self.k + self.t)):
            slope = 0.0
            for place, weight in self._stencil(at.x, j):
                there = at.x.copy()
                there[j] = place
                z, own, _, _, c = self.split(there)
                G, W = self.losses.local(s, z, own, c)
                if (key := G.tobytes()) not in ends:
                    ends[key] = receptance.across(G @ at.X)
                left, right = ends[key]
                slope = slope + weight * (left @ W @ right)
            yield j, slope

    def _stencil(self, x: np.ndarray, j: int) -> list[tuple[float, float]]:
        """Values of x_j, and weights of what is there, whose sum is the derivative."""
        if j >= self.k:
            return self.elastic.slope(x[self.k :], j - self.k)
        return [(x[j] + _STEP, 0.5 / _STEP), (x[j] - _STEP, -0.5 / _STEP)]


def _same(rows: np.ndarray, sensing: np.ndarray) -> np.ndarray:
    """(o, s): 1 where a row (o, r) reads what a sensor (s, r) of the modal test reads."""
    apart = np.linalg.norm(rows[:, None] - sensing[None], axis=2)
    return (apart < 1e-9 * np.linalg.norm(rows, axis=1)[:, None]).astype(float)

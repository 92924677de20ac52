"""Losses that are not spread like stiffness and mass: dashpots, lossy elements, and springs of causes with a law of their own.

They are of low rank, G' W(s) G with rows G (c, size) and cores W (f, c, c), beside Z_0 of the structure, diagonal in its modes.
"""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, effective_loss, residual
from mouse_cli.diagnosis.likelihoods.frf.damping import Damping, of_low_rank
from mouse_cli.diagnosis.likelihoods.frf.lossy import SAME, VISCOUS
from mouse_cli.diagnosis.likelihoods.modal.model import Model

_KEPT = 16  # factors of matrices of causes


class Losses:
    """What the losses of a model with causes add to those of the structure.

    model: structure and causes, all elastic; middle: omega_0, rad/s, to which viscous loss factors belong.
    """

    def __init__(self, model: Model, damping: Damping, middle: float):
        self.model, self.damping, self.middle = model, damping, middle
        self._factors: dict[tuple, tuple[np.ndarray, np.ndarray]] = {}
        self._last: tuple[tuple, np.ndarray, np.ndarray] | None = None

    def of_structure(self, s: np.ndarray, own: np.ndarray) -> np.ndarray:
        """g (f,) of the structure, its stiffness over that without damping, for unknowns `own` of its damping."""
        eta, _, beta, *_ = self.damping.values(own)
        return 1 + 1j * eta + s * beta

    def followed(self, of_deck: int, c: np.ndarray) -> list[int]:
        """Unknowns that `local` follows beside causes c: some of the `of_deck` first ones, and of those of the damping behind them.

        Springs with a law of their own know the structure's by g alone; in bars they follow the stiffness of these.
        """
        pairs = zip(self.model.changes(c), self.model.recipes, strict=True)
        lawful = [change for change, recipe in pairs if recipe.law != SAME]
        soft = any(change.softening is not None for change in lawful)
        return [*range(of_deck if soft else 0), *((of_deck, of_deck + 2) if lawful else ())]

    def local(self, s: np.ndarray, z: np.ndarray, own: np.ndarray, c: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Rows G (c, size) and cores W (f, c, c), for parameters z of the deck, `own` of the damping and c of the causes."""
        changes, g = self.model.changes(c), self.of_structure(s, own)
        rows, cores = [np.zeros((0, self.model.size))], [np.zeros((len(s), 0, 0))]
        if len(stated := self.damping.rows):
            rows.append(self._wide(stated, np.arange(self.model.base.r)))
            cores.append((1j * self.damping.own + s[:, None] * self.damping.viscous)[:, :, None] * np.eye(len(stated)))
        springs = self._springs(s, g, c)
        for i, change in enumerate(changes):
            for name, unit in (("C", s), ("D", np.full_like(s, 1j))):
                if getattr(change, name) is not None:
                    size, rank = self._factored(i, c, name, change)
                    rows.append(rank)
                    cores.append(unit[:, None, None] * np.diag(size))
            name = "K" if change.spring is None else "spring"
            if self.model.recipes[i].law != SAME and getattr(change, name) is not None:
                size, rank = self._factored(i, c, name, change)
                rows.append(rank)
                cores.append((springs[i] - g)[:, None, None] * np.diag(size))
        softer = [(i, change.softening) for i, change in enumerate(changes) if change.softening is not None]
        if any(self.model.recipes[i].law != SAME for i, _ in softer):
            key = s.tobytes(), g.tobytes(), c.tobytes()
            if self._last is None or self._last[0] != key:  # parameters of the deck move neither of them
                self._last = key, *self._softer(softer, changes, springs, g)
            _, bars, core = self._last
            rows.append(self.model.strain[bars].reshape(-1, self.model.size))
            cores.append(_diagonal(list(np.swapaxes(core * self.model.follow(bars, z), 0, 1))))
        return np.concatenate(rows), _diagonal(cores)

    def _factored(self, i: int, c: np.ndarray, name: str, change: Change) -> tuple[np.ndarray, np.ndarray]:
        """Sizes (a,) and rows (a, size) of one matrix of cause number i, kept where nothing but the damping moves."""
        key = i, name, c[self.model.own[i]].tobytes()
        if key not in self._factors:
            if len(self._factors) > _KEPT:
                self._factors.clear()
            (size, U), G = of_low_rank(getattr(change, name)), self.model.within[i]
            self._factors[key] = size, self._wide(U.T, self.model.places[i]) if G is None else U.T @ G
        return self._factors[key]

    def _wide(self, rows: np.ndarray, places: np.ndarray) -> np.ndarray:
        """Rows (c, own) of some coordinates as rows (c, size) of all."""
        wide = np.zeros((len(rows), self.model.size))
        wide[:, places] = rows
        return wide

    def _springs(self, s: np.ndarray, g: np.ndarray, c: np.ndarray) -> list[np.ndarray]:
        """g (f,) of the spring of each cause."""
        found = []
        for recipe, own in zip(self.model.recipes, self.model.own, strict=True):
            if recipe.law == SAME:
                found.append(g)
                continue
            loss = recipe.unknowns[-1].value(c[own][-1])
            found.append(1 + loss * (s / self.middle if recipe.law == VISCOUS else np.full_like(s, 1j)))
        return found

    def _softer(self, parts: list, changes: list[Change], springs: list[np.ndarray], g: np.ndarray):
        """Softer bars (b,): complex flexibilities in series, less what they are without losses of their own (f, b, 3, 3)."""
        bars, at = np.unique(np.concatenate([part.bars for _, part in parts]), return_inverse=True)
        total, start = np.zeros((len(g), len(bars), 3, 3), complex), 0
        for i, part in parts:
            own = at[start : start + len(part.bars)]
            for b, added in zip(own, part.added, strict=True):
                total[:, b] += added / springs[i][:, None, None]
            start += len(part.bars)
        scale, left = g[:, None, None, None], residual([part for _, part in parts], bars)
        core = scale * self.model.base.bars.lost(bars, scale * total)
        core = core if left is None else effective_loss(core, left / scale)
        return bars, core - scale * self.model.softer(changes)[1]


def _diagonal(blocks: list[np.ndarray]) -> np.ndarray:
    """Blocks (f, c, c) along the diagonal."""
    size = sum(block.shape[1] for block in blocks)
    W, at = np.zeros((len(blocks[0]), size, size), complex), 0
    for block in blocks:
        W[:, at : at + block.shape[1], at : at + block.shape[1]] = block
        at += block.shape[1]
    return W

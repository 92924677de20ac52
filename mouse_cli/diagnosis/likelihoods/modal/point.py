"""What a model predicts at one place, and what its data leave there."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.data import Data
from mouse_cli.diagnosis.likelihoods.modal.turning import Turn, measured


class Left:
    """A residual (q,), whitened, and the angles between close modes, `turns`, that it is whitened for."""

    residual: np.ndarray
    turns: tuple[Turn, ...]

    @property
    def chi2(self) -> float:
        """What is left of the data's misfit."""
        return float(self.residual @ self.residual)

    @property
    def nats(self) -> float:
        """By what the density of the data is lower than that of the residual, for those angles."""
        return sum(each.nats for each in self.turns)

    @property
    def free(self) -> float:
        """Number of data that angles of which nothing was known have taken."""
        return sum(each.free for each in self.turns)


@dataclass(frozen=True)
class Point(Left):
    """Model at x: all eigenvalues, shapes X (size, size), what sensors see of them (s, size), measured modes, residual, scales.

    turn: how close modes are turned into those that were measured, and for what the residual is whitened; None: none are close.
    """

    x: np.ndarray
    eigenvalues: np.ndarray
    X: np.ndarray
    seen: np.ndarray
    modes: np.ndarray
    residual: np.ndarray
    a: np.ndarray
    turn: Turn | None = None

    @property
    def pairing(self) -> np.ndarray:
        """Modes (m,) that the measured ones are."""
        return self.modes

    @property
    def turns(self) -> tuple[Turn, ...]:
        """The one that there is."""
        return () if self.turn is None else (self.turn,)

    @property
    def which(self) -> np.ndarray:
        """Modes (m + u,) that the measured shapes are made of, the measured ones first."""
        return self.modes if self.turn is None else self.turn.which

    def measured(self, shapes: np.ndarray) -> np.ndarray:
        """The measured ones (., m) of the shapes (., size) of all modes, close ones turned as they are in the test."""
        return measured(shapes, self.modes, self.turn)

    def jacobian(self, data: Data, d_eigenvalues: np.ndarray, d_seen: np.ndarray) -> np.ndarray:
        """d(prediction)/dx (q, k), whitened, for derivatives (m + u, k) and (s, m + u, k) of the modes `which`."""
        if self.turn is not None:
            d_seen = np.einsum("suk,um->smk", d_seen, self.turn.mixed)
        own = self.measured(self.seen)
        found = data.jacobian(self.eigenvalues[self.modes], own, self.a, d_eigenvalues[: len(self.modes)], d_seen)
        return found if self.turn is None else self.turn.whitened(found)

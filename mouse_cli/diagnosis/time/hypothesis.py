"""A model of a record: the deck's parameters and nuisances, and one law at one place."""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.time.linear import Linear
from mouse_cli.diagnosis.time.series import Series
from mouse_cli.dynamics.response import LocalForce, Plant
from mouse_cli.model.diagnosis import Site
from mouse_cli.terms.laws import Law, Scale


@dataclass(frozen=True)
class Place:
    """Where a law may act: B (n,), the motion in the coordinates of the model; ground: whether its other end is the ground."""

    site: Site
    B: np.ndarray
    ground: bool
    scale: Scale


@dataclass(frozen=True)
class Hypothesis:
    """x (k,): nuisances in prior sd, offsets of the measured forces among them, then ln parameters of the law.

    offset (i,): prior sd of a constant that a force channel reads wrongly. fixed: x that no fit moves.
    """

    linear: Linear
    offset: np.ndarray
    place: Place | None = None
    law: Law | None = None
    variant: int = 0
    fixed: np.ndarray | None = None

    @property
    def unknowns(self):
        """Parameters of the law at its place."""
        return self.law.unknowns(self.place.scale) if self.law else ()

    @property
    def _nuisances(self) -> int:
        return self.linear.k + len(self.offset)

    @property
    def mean(self) -> np.ndarray:
        """Of the prior (k,)."""
        return self._of(np.zeros(self._nuisances), [np.log(u.lower * u.upper) / 2 for u in self.unknowns])

    @property
    def sd(self) -> np.ndarray:
        """Of the prior; infinite for ln parameters of the law, which are uniform."""
        return self._of(np.ones(self._nuisances), [np.inf] * len(self.unknowns))

    @property
    def unit(self) -> np.ndarray:
        """A natural step of each."""
        return self._of(np.ones(self._nuisances), [1.0] * len(self.unknowns))

    @property
    def scale(self) -> np.ndarray:
        """1 for nuisances and ln parameters alike."""
        return self.unit

    @property
    def width(self) -> np.ndarray:
        """Of uniform priors; infinite for nuisances."""
        spans = [np.log(u.upper / u.lower) for u in self.unknowns]
        return self._of(np.full(self._nuisances, np.inf), spans)

    @property
    def bounds(self) -> tuple[np.ndarray, np.ndarray]:
        """Of x."""
        many = np.full(self._nuisances, np.inf)
        return (
            self._of(-many, [np.log(u.lower) for u in self.unknowns]),
            self._of(many, [np.log(u.upper) for u in self.unknowns]),
        )

    def _of(self, nuisances: np.ndarray, own: list[float]) -> np.ndarray:
        return np.zeros(0) if self.fixed is not None else np.concatenate([nuisances, own])

    @property
    def internal(self) -> int:
        """Internal states of the law."""
        return self.law.states if self.law else 0

    @property
    def extra(self) -> int:
        """Degrees of freedom of the law's own."""
        return len(self._matrices(self.mean_law)[0]) - 1 if self.law and self.law.linear else 0

    @property
    def mean_law(self) -> np.ndarray:
        """Parameters of the law in the middle of their ranges."""
        return np.array([np.sqrt(u.lower * u.upper) for u in self.unknowns])

    def _matrices(self, p: np.ndarray):
        return self.law.matrices(p, **self.law.variants[self.variant])

    def whole(self, many: np.ndarray) -> np.ndarray:
        """All x (P, k), the fixed ones where nothing is fitted."""
        return many if self.fixed is None else np.repeat(self.fixed[None], len(many), 0)

    def parameters(self, many: np.ndarray) -> np.ndarray:
        """Of the law (q, P)."""
        return np.exp(self.whole(many)[:, self._nuisances :]).T

    def local(self, many: np.ndarray) -> LocalForce | None:
        """The force of the law at x (P, k); None for linear laws."""
        if self.law is None or self.law.linear:
            return None
        p = self.parameters(many)[:, :, None, None]
        variant, law = self.law.variants[self.variant], self.law.force
        return lambda x, v, z: law(x, v, z, p, **variant)

    def plant(self, many: np.ndarray, series: Series) -> Plant:
        """The linear part at x (P, k), with the matrices of a linear law in it."""
        x = self.whole(many)
        M, C, K = self.linear.matrices(x[:, : self.linear.k])
        constant = (x[:, self.linear.k : self._nuisances] * self.offset) @ series.inputs.T
        inputs = np.repeat(series.inputs[None], len(many), 0)
        inputs = np.concatenate([inputs, constant[:, :, None]], axis=2)
        sensing, a = series.sensing, self.extra
        local = np.zeros((M.shape[1] + a, 1)) if self.place is None else np.append(self.place.B, np.zeros(a))[:, None]
        if self.law and self.law.linear:
            M, C, K = (np.pad(m, ((0, 0), (0, a), (0, a))) for m in (M, C, K))
            B = np.zeros((M.shape[1], 1 + a))
            B[: len(self.place.B), 0] = self.place.B
            B[len(self.place.B) :, 1:] = np.eye(a)
            for i, p in enumerate(self.parameters(many).T):
                k, c, m = self._matrices(p)
                K[i] += B @ k @ B.T
                C[i] += B @ c @ B.T
                M[i] += B @ m @ B.T
            inputs, sensing = np.pad(inputs, ((0, 0), (0, a), (0, 0))), np.pad(sensing, ((0, 0), (0, a)))
        return Plant(M, C, K, inputs, local, sensing, series.order)

    def padded_states(self, states: np.ndarray) -> np.ndarray:
        """Displacements and velocities (2n, ...) with those of the law's own degrees of freedom, like those of its place."""
        a, n = self.extra, len(self.linear.M)
        if not a or len(states) != 2 * n:
            return states
        own = [self.place.B @ half for half in (states[:n], states[n:])]
        if states.ndim == 1:
            own = [self.place.scale.x, self.place.scale.v]
        pad = [np.repeat(np.atleast_1d(one)[None], a, 0).reshape(a, *states.shape[1:]) for one in own]
        return np.concatenate([states[:n], pad[0], states[n:], pad[1]])

    def held(self, x: np.ndarray) -> "Hypothesis":
        """The same with x (k,) fixed: only initial states are free."""
        return replace(self, fixed=x)

    def at(self, law: Law, variant: int) -> "Hypothesis":
        """The same place under another law."""
        return replace(self, law=law, variant=variant)

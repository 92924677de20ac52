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
    """Where a law may act. B (m,): the motion in the coordinates of the simulation; motion (n,): by the degrees of freedom of the
    deck; ground: whether its other end is the ground.
    """

    site: Site
    B: np.ndarray
    ground: bool
    scale: Scale
    motion: np.ndarray


@dataclass(frozen=True)
class Acting:
    """A nonlinear law that the deck has already: its motion B (n,), its parameters p (q,)."""

    B: np.ndarray
    law: Law
    words: dict[str, float]
    p: np.ndarray


@dataclass(frozen=True)
class Hypothesis:
    """x (k,): nuisances in prior sd, offsets of the measured forces among them, then ln parameters of the law.

    offset (i,): prior sd of a constant that a force channel reads wrongly; known: laws that the deck has already. fixed: x that
    no fit moves.
    """

    linear: Linear
    offset: np.ndarray
    known: tuple[Acting, ...] = ()
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

    def acting(self, x: np.ndarray) -> list[Acting]:
        """The laws that are not linear at x (k,): those of the deck, then that of the hypothesis."""
        return [*self.known, *([self._own(self.parameters(x[None])[:, 0])] if self._nonlinear else [])]

    @property
    def _nonlinear(self) -> bool:
        return self.law is not None and not self.law.linear

    def _own(self, p: np.ndarray) -> Acting:
        return Acting(self.place.B, self.law, self.law.variants[self.variant], p)

    def local(self, many: np.ndarray) -> LocalForce | None:
        """The forces of all laws at x (P, k), internal states as a list; None where all is linear."""
        every = [*self.known, *([self._own(self.parameters(many)[:, :, None, None])] if self._nonlinear else [])]
        if not every:
            return None
        shaped = [one.p if one.p.ndim > 1 else one.p[:, None, None, None] for one in every]

        def forces(x: np.ndarray, v: np.ndarray, z: list):
            found = [
                one.law.force(x[:, [i]], v[:, [i]], z[i], p, **one.words)
                for i, (one, p) in enumerate(zip(every, shaped, strict=True))
            ]
            return np.concatenate([F for F, _ in found], axis=1), [after for _, after in found]

        return forces

    def plant(self, many: np.ndarray, series: Series) -> Plant:
        """The linear part at x (P, k), with the matrices of a linear law in it."""
        x = self.whole(many)
        M, C, K = self.linear.matrices(x[:, : self.linear.k])
        constant = (x[:, self.linear.k : self._nuisances] * self.offset) @ series.inputs.T
        inputs = np.repeat(series.inputs[None], len(many), 0)
        inputs = np.concatenate([inputs, constant[:, :, None]], axis=2)
        sensing, a = series.sensing, self.extra
        motions = [one.B for one in self.known] + ([self.place.B] if self._nonlinear else [])
        local = np.zeros((M.shape[1] + a, len(motions)))
        local[: M.shape[1]] = np.array(motions).reshape(-1, M.shape[1]).T
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

    def placed(self, place: Place) -> "Hypothesis":
        """The same with a place and no law there."""
        return replace(self, place=place, law=None)

    def held(self, x: np.ndarray) -> "Hypothesis":
        """The same with x (k,) fixed: only initial states are free."""
        return replace(self, fixed=x)

    def at(self, law: Law, variant: int) -> "Hypothesis":
        """The same place under another law."""
        return replace(self, law=law, variant=variant)

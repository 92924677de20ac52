"""A model of a record: the deck's parameters and nuisances, and laws at places."""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.dynamics.response import LocalForces, Plant
from mouse_cli.terms.laws import Law, Unknown
from mouse_cli.updating.recordings.acting import Acting, Part, Place
from mouse_cli.updating.recordings.calibration import KNOWN, Calibration
from mouse_cli.updating.recordings.channels import Read, read
from mouse_cli.updating.recordings.damping import followed
from mouse_cli.updating.recordings.linear import Linear
from mouse_cli.updating.recordings.series import Series


@dataclass(frozen=True)
class Hypothesis:
    """x (k,): nuisances in prior sd, of the model, of offsets of the measured forces, of channels; then ln parameters of each law.

    offset (i,): prior sd of a constant that a force channel reads wrongly; known: laws that the deck has already; parts: laws with
    free parameters. place: that which is looked at, or that of the last law. fixed: x that no fit moves. ground:
    whether the motion of the ground is all that excites the model. channels: gains and delays that are uncertain.
    inputs: names of the force channels.
    """

    linear: Linear
    offset: np.ndarray
    known: tuple[Acting, ...] = ()
    place: Place | None = None
    parts: tuple[Part, ...] = ()
    fixed: np.ndarray | None = None
    ground: bool = False
    channels: Calibration = KNOWN
    inputs: tuple[str, ...] = ()

    @property
    def law(self) -> Law | None:
        """The last law."""
        return self.parts[-1].law if self.parts else None

    @property
    def unknowns(self) -> tuple[Unknown, ...]:
        """Parameters of all laws."""
        return tuple(u for part in self.parts for u in part.unknowns)

    @property
    def nuisances(self) -> int:
        """How many of x are not parameters of a law."""
        return self.offsets.stop + len(self.channels.names)

    @property
    def offsets(self) -> slice:
        """Where in x those of the forces are, behind the nuisances of the model and before those of channels."""
        return slice(self.linear.k, self.linear.k + len(self.offset))

    @property
    def names(self) -> tuple[str, ...]:
        """Of the nuisances."""
        offsets = (f"offset of channel {name}" for name in self.inputs or range(1, len(self.offset) + 1))
        return (*self.linear.names, *offsets, *self.channels.names)

    @property
    def mean(self) -> np.ndarray:
        """Of the prior (k,)."""
        return self._of(np.zeros(self.nuisances), [np.log(u.lower * u.upper) / 2 for u in self.unknowns])

    @property
    def sd(self) -> np.ndarray:
        """Of the prior; infinite for ln parameters of the laws, which are uniform."""
        return self._of(np.ones(self.nuisances), [np.inf] * len(self.unknowns))

    @property
    def unit(self) -> np.ndarray:
        """A natural step of each."""
        return self._of(np.ones(self.nuisances), [1.0] * len(self.unknowns))

    @property
    def width(self) -> np.ndarray:
        """Of uniform priors; infinite for nuisances."""
        spans = [np.log(u.upper / u.lower) for u in self.unknowns]
        return self._of(np.full(self.nuisances, np.inf), spans)

    @property
    def bounds(self) -> tuple[np.ndarray, np.ndarray]:
        """Of x."""
        many = np.full(self.nuisances, np.inf)
        return (
            self._of(-many, [np.log(u.lower) for u in self.unknowns]),
            self._of(many, [np.log(u.upper) for u in self.unknowns]),
        )

    def _of(self, nuisances: np.ndarray, own: list[float]) -> np.ndarray:
        return np.zeros(0) if self.fixed is not None else np.concatenate([nuisances, own])

    @property
    def extra(self) -> int:
        """Degrees of freedom of the laws' own."""
        return sum(one.extra for one in (*self.known, *self.parts))

    def whole(self, many: np.ndarray) -> np.ndarray:
        """All x (P, k), the fixed ones where nothing is fitted."""
        return many if self.fixed is None else np.repeat(self.fixed[None], len(many), 0)

    def sizes(self, many: np.ndarray) -> list[tuple[Part, np.ndarray]]:
        """Each law with its parameters (q, P) at x (P, k)."""
        values = np.exp(self.whole(many)[:, self.nuisances :]).T
        ends = np.cumsum([len(part.unknowns) for part in self.parts])[:-1]
        return list(zip(self.parts, np.split(values, ends), strict=True)) if self.parts else []

    def acting(self, x: np.ndarray) -> list[Acting]:
        """The laws that are not linear at x (k,): those of the deck, then those of the hypothesis."""
        known = (one for one in self.known if not one.law.linear)
        return [*known, *(part.acting(p[:, 0]) for part, p in self.sizes(x[None]) if not part.law.linear)]

    def local(self, many: np.ndarray) -> LocalForces | None:
        """The forces of all laws at x (P, k), internal states as a list; None where all is linear."""
        own = [part.acting(p[:, :, None, None]) for part, p in self.sizes(many) if not part.law.linear]
        every = [*(one for one in self.known if not one.law.linear), *own]
        if not every:
            return None
        shaped = [one.p if one.p.ndim > 1 else one.p[:, None, None, None] for one in every]

        along = [one.law.along(p, one.words) for one, p in zip(every, shaped, strict=True)]

        def forces(x: np.ndarray, v: np.ndarray, z: list):
            if len(every) == 1:
                F, after = along[0](x, v, z[0])
                return F, [after]
            found = [force(x[:, i : i + 1], v[:, i : i + 1], z[i]) for i, force in enumerate(along)]
            return np.concatenate([F for F, _ in found], axis=1), [after for _, after in found]

        def implicit(one: Acting, p: np.ndarray):
            return lambda *step: one.law.implicit(*step, p[:, :, 0], **one.words)

        jump = [i for i, one in enumerate(every) if one.law.implicit]
        return LocalForces(forces, {i: implicit(every[i], shaped[i]) for i in jump})

    def read(self, many: np.ndarray, series: Series) -> Read:
        """What the channels of a series read at x (P, k)."""
        found = read(self.sizes(many), len(series.order), series.force.shape[1], len(many))
        return self.channels.read(self.whole(many)[:, self.offsets.stop : self.nuisances], found)

    def plant(self, many: np.ndarray, series: Series) -> Plant:
        """The linear part at x (P, k), with the matrices of linear laws in it."""
        x, a = self.whole(many), self.extra
        M, C, K = self.linear.matrices(x[:, : self.linear.k])
        m = M.shape[1]
        motions = [one.B for one in self.known if not one.law.linear] + [
            part.place.B for part in self.parts if not part.law.linear
        ]
        local = np.zeros((m + a, len(motions)))
        local[:m] = np.array(motions).reshape(-1, m).T
        bare = M, C, K
        if any(one.law.linear for one in (*self.known, *self.parts)):
            M, C, K = self._with_matrices(many, M, C, K)
        C = self._damped(x, bare, (M, C, K))
        sensing = np.pad(series.sensing, ((0, 0), (0, a)))
        each = [(one.B, one.extra) for one in self.known] + [(part.place.B, part.extra) for part in self.parts]
        own = [np.repeat(B[None] @ series.base, extra, 0) for B, extra in each]
        driven = replace(
            series, inputs=np.pad(series.inputs, ((0, a), (0, 0))), base=np.concatenate([series.base, *own])
        )
        inputs = driven.loads(M) / self.read(many, series).force[:, None, :]
        constant = np.einsum("pni,pi->pn", inputs, x[:, self.offsets] * self.offset)
        return Plant(M, C, K, np.concatenate([inputs, constant[:, :, None]], axis=2), local, sensing, series.order)

    def _with_matrices(self, many: np.ndarray, *matrices: np.ndarray) -> tuple[np.ndarray, ...]:
        """M, C, K (P, m + a, m + a) with those of linear laws."""
        a, m = self.extra, matrices[0].shape[1]
        M, C, K = (np.pad(one, ((0, 0), (0, a), (0, a))) for one in matrices)
        at = m
        for one in (each for each in self.known if each.law.linear):
            B = self._rows(one.directions, at, one.extra)
            at += one.extra
            for whole, own in zip((K, C, M), one.law.on(one.directions.shape[1], one.p, one.words), strict=True):
                whole += B @ own @ B.T
        for part, values in self.sizes(many):
            if not part.law.linear:
                continue
            B = self._rows(part.place.directions, at, part.extra)
            at += part.extra
            for i, p in enumerate(values.T):
                for whole, own in zip((K, C, M), part.matrices(p), strict=True):
                    whole[i] += B @ own @ B.T
        return M, C, K

    def _rows(self, directions: np.ndarray, at: int, extra: int) -> np.ndarray:
        """Motions (m + a, d + extra) of a law: along the structure (m, d), and its own degrees of freedom from `at` on."""
        m, d = directions.shape
        B = np.zeros((m + self.extra, d + extra))
        B[:m, :d], B[at : at + extra, d:] = directions, np.eye(extra)
        return B

    def _damped(self, x: np.ndarray, bare: tuple[np.ndarray, ...], whole: tuple[np.ndarray, ...]) -> np.ndarray:
        """C (P, m + a, m + a) of M, C, K `whole`, at x (P, k): damping by modes is that of the modes with linear laws, which `bare`
        does not have.

        A law with degrees of freedom of its own has damping of its own too, and leaves that of the others.
        """
        (M, _, K), C, m = bare, whole[1].copy(), bare[0].shape[1]
        if self.linear.by_modes is not None:
            after = (K, M) if self.extra else (whole[2], whole[0])
            C[:, :m, :m] += followed(self.linear.by_modes(x[:, : self.linear.k]), (K, M), after)
        return C

    def padded_states(self, states: np.ndarray) -> np.ndarray:
        """Displacements and velocities (2n, ...) with those of the laws' own degrees of freedom, like those of their places."""
        n = len(self.linear.M)
        if not self.extra or len(states) != 2 * n:
            return states
        halves = [[half] for half in (states[:n], states[n:])]
        sizes = [(one.B, one.extra, [np.abs(one.B) @ half for (half,) in halves]) for one in self.known]
        sizes += [(part.place.B, part.extra, [part.place.scale.x, part.place.scale.v]) for part in self.parts]
        for B, extra, both in sizes:
            for half, size in zip(halves, both, strict=True):
                own = np.asarray(size) if states.ndim == 1 else B @ half[0]
                half.append(np.broadcast_to(own, (extra, *states.shape[1:])))
        return np.concatenate([one for half in halves for one in half])

    def gauged(self, x: np.ndarray) -> np.ndarray:
        """x (k,) with all masses, stiffnesses, dampings and forces of laws multiplied by one factor, as the prior likes best.

        Where the ground alone moves a model, no record knows that factor, and a fit would creep along it.
        """
        if self.fixed is not None or self.known or not self.ground:
            return x
        factors = np.concatenate([[0.0], np.geomspace(1e-4, 1.0, 25)])
        tried = [self._scaled(x, float(np.exp(step))) for step in (*-factors[:0:-1], *factors)]
        cost = lambda one: float((((one - self.mean) / self.sd) ** 2).sum())
        return min((one for one in tried if one is not None), key=cost)

    def _scaled(self, x: np.ndarray, s: float) -> np.ndarray | None:
        """x (k,) with everything s times as large; None where nuisances or ranges do not reach."""
        z = x[: self.linear.k] if s == 1 else self.linear.scaled(x[: self.linear.k], s)
        if z is None:
            return None
        grows = [i in part.law.homogeneous for part in self.parts for i in range(len(part.unknowns))]
        found = np.concatenate(
            [z, x[self.linear.k : self.nuisances], x[self.nuisances :] + np.log(s) * np.array(grows)]
        )
        low, high = self.bounds
        return found if s == 1 or ((found >= low) & (found <= high)).all() else None

    def placed(self, place: Place) -> "Hypothesis":
        """The same, looking at a place."""
        return replace(self, place=place)

    def held(self, x: np.ndarray) -> "Hypothesis":
        """The same with x (k,) fixed: only initial states are free."""
        return replace(self, fixed=x)

    def at(self, law: Law, variant: int) -> "Hypothesis":
        """The same with one law more, at the place that is looked at."""
        return replace(self, parts=(*self.parts, Part(self.place, law, variant)))

    @property
    def without_last(self) -> "Hypothesis":
        """The same with one law less."""
        return replace(self, parts=self.parts[:-1])

"""What a hypothesis makes of stretches of records that are simulated side by side, as its channels read it, and its slopes."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mouse_cli.dynamics.response import LocalForces, Plant, simulate
from mouse_cli.updating.recordings.hypothesis import Hypothesis
from mouse_cli.updating.recordings.linear_response import answered
from mouse_cli.updating.recordings.segments import Segments
from mouse_cli.updating.recordings.series import sampled

_PERTURBED = 1e-4  # of prior or range


@dataclass(frozen=True)
class Slopes:
    """Of what is simulated, by x (s, t, G, k) and by initial states (s, t, G, 2n)."""

    J: np.ndarray
    X: np.ndarray

    def along(self, dx: np.ndarray, ds: np.ndarray) -> np.ndarray:
        """What a step dx (k,), ds (2n, G) does to what is simulated (s, t, G), by first order."""
        return self.J @ dx + np.einsum("stgn,ng->stg", self.X, ds)


class Simulator:
    """Filtered sensors over their sd of segments of records alike; internal: states in which the laws begin."""

    def __init__(self, hypothesis: Hypothesis, data: list[Segments]):
        self.h, self.series, self.data = hypothesis, data[0].series, data
        self.internal: list | None = None
        self.force = np.concatenate([part.force for part in data], axis=2)
        self.read = self._cleared(np.concatenate([part.measured for part in data], axis=2))
        acts = [part.acts for part in data]
        heard = None if any(own is None for own in acts) else np.concatenate(acts, axis=2)
        self.noise = self.series.repeated.over(self.read.shape[1], heard)
        self.measured = self.whitened(self.read)

    @property
    def jumps(self) -> bool:
        """Whether a force jumps with the velocity."""
        laws = (*(one.law for one in self.h.known), *(part.law for part in self.h.parts))
        return any(law.implicit is not None for law in laws)

    def whitened(self, x: np.ndarray) -> np.ndarray:
        """Outputs (..., s, t, G) behind the innovations filter of the noise of the excitation."""
        return x if self.noise is None else self.noise.whitened(x)

    def _cleared(self, x: np.ndarray) -> np.ndarray:
        """Outputs (..., s, t, G) without hum and drift."""
        return self.series.disturbance.cleared(x, self.series.dt, axis=-2)

    def slopes(self, x: np.ndarray, states: np.ndarray, spread: np.ndarray) -> Slopes:
        """At x (k,) and states (2n, G), laws in coarser steps than what is compared.

        They only lead to where least is left, and each may be a quarter of the work; those of forces that jump hold for their own
        steps alone.
        """
        local, taken = self.h.local(x[None]) is not None, self
        if local and not self.jumps:
            taken = self._coarser
            taken.internal = self.internal
        return taken._differences(x, states, spread, local)

    @cached_property
    def _coarser(self) -> "Simulator":
        """The same in the steps that slopes take."""
        return Simulator(self.h, [part.coarser for part in self.data])

    @np.errstate(over="ignore", invalid="ignore")  # simulations may diverge; they are given up by their cost
    def left(self, x: np.ndarray, states: np.ndarray) -> np.ndarray:
        """Measured less simulated (s, t, G)."""
        return self.measured - self.seen(x[None], states[None])[0]

    @np.errstate(over="ignore", invalid="ignore")
    def _differences(self, x: np.ndarray, states: np.ndarray, spread: np.ndarray, local: bool) -> Slopes:
        """Simulations at every perturbed x and from every perturbed state, by their spread (2n,), all at once.

        Where all is linear, one stretch without force shows what initial states do.
        """
        k, n2 = len(x), len(states)
        steps = np.where(x + _PERTURBED * self.h.unit > self.h.bounds[1], -1, 1) * _PERTURBED * self.h.unit
        nudge = _PERTURBED * spread
        many = np.vstack([x, x + np.diag(steps), np.repeat(x[None], n2 if local else 0, 0)])
        begin = np.repeat(states[None], len(many), 0)
        if local:
            begin[1 + k + np.arange(n2), np.arange(n2)] += nudge[:, None]
        seen = self.seen(many, begin)
        moved = seen[1:] - seen[0]
        J = np.stack([moved[j] / steps[j] for j in range(k)], -1) if k else np.zeros((*seen[0].shape, 0))
        by_states = np.stack([*moved[k:]], -1) if local else self._free(x, np.diag(nudge))
        return Slopes(J, np.broadcast_to(by_states / nudge, (*seen[0].shape, n2)))

    def _free(self, x: np.ndarray, begin: np.ndarray) -> np.ndarray:
        """Sensors (s, t, 1 or G, b) without force from states begin (2n, b) of a hypothesis that is linear."""
        plant, idle = self.h.plant(x[None], self.series), np.zeros((*self.force.shape[:2], begin.shape[1]))
        out = self._simulated(plant, idle, begin[None], None)
        each = self._as_read(out, self.h.read(x[None], self.series).gain)[0]
        own = 1 if self.noise is None else self.noise.stretches
        alike = np.broadcast_to(np.moveaxis(each, -1, 0)[..., None], (each.shape[-1], *each.shape[:-1], own))
        return np.moveaxis(self.whitened(alike), 0, -1)

    def seen(self, many: np.ndarray, begin: np.ndarray) -> np.ndarray:
        """Filtered sensors over their sd (P, s, t, G) at x (P, k) from states begin (P, 2n, G), as their channels read them.

        What a channel is late is taken off the record and not put into the simulation, so that any delay is exact.
        """
        read = self.h.read(many, self.series)
        late = np.zeros((len(many), *self.read.shape))
        for at in np.unique(read.delay, axis=0):
            if at.any():
                prompt = np.concatenate([part.earlier(at).measured for part in self.data], axis=2)
                late[(read.delay == at).all(axis=1)] += self.read - self._cleared(prompt)
        out = self._simulated(self.h.plant(many, self.series), self.force, begin, self.h.local(many))
        return self._read(out, read.gain, late)

    def _read(self, out: np.ndarray, gain: np.ndarray, late: np.ndarray | float = 0.0) -> np.ndarray:
        return self.whitened(self._as_read(out, gain) + late)

    def _as_read(self, out: np.ndarray, gain: np.ndarray) -> np.ndarray:
        """Simulated outputs (P, s, t, G) in their sd, without hum and drift, as channels of a gain (P, s) read them."""
        return self._cleared(out / self.series.sd[None, :, None, None]) * gain[:, :, None, None]

    def _simulated(self, plant: Plant, force: np.ndarray, begin: np.ndarray, local: LocalForces | None) -> np.ndarray:
        """Filtered sensors (P, s, t, G): by lines where all is linear, else step by step."""
        series, z = self.series, None
        h = series.dt / series.factor
        with np.errstate(all="ignore"):
            found = None if local else answered(plant, h, force, begin, series.factor)
            if found is not None:
                return found
            if self.internal is not None:
                z = [None if one is None else np.repeat(one[:, None], len(begin), 1) for one in self.internal]
            return sampled(simulate(plant, h, force, begin, local, z), series.factor)

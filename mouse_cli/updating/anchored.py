"""Levenberg-Marquardt to the posterior mode: the prior keeps its place, every step is checked by an exact re-solution.

Minimises J(z) = |R^-1/2 (y - h(u_p + L z))|^2 + |z|^2 (without the last term for estimators that know no prior). In z the
prior is the unit sphere, so the damping needs no scaling of its own.
"""

from dataclasses import replace

import numpy as np

from mouse_cli.estimators import bayes
from mouse_cli.estimators._linear import Estimator, Infeasible, LinearProblem, Unobservable
from mouse_cli.model.result import Status
from mouse_cli.updating.second_order import acceleration
from mouse_cli.updating.state import State, attempt
from mouse_cli.updating.trace import Trace

MEANING = (
    "anchored: the prior keeps its mean and S throughout; the result is the mode of the posterior distribution, each step "
    "checked by an exact re-solution"
)
TOLERANCE = 1e-4  # a step this small, in revised standard deviations, is the end
_DAMPING = (1e-3, 10.0, 1e12)  # first damping relative to |B|^2, its growth, and where to give up


def recur(trace: Trace, estimator: Estimator) -> Status:
    """Step until a full step is negligible, the partials are used up, or no step improves J."""
    run = _Descent(trace, estimator)
    options = trace.setting.problem.run
    trace.record(trace.state, run.cost(trace.state, run.z))
    most = options.cycles if options.cycles is not None else options.partials
    try:
        while trace.cycles[-1].index < most:
            length = run.step()
            if length is None:
                return trace.end("no-descent")
            if length < TOLERANCE and options.cycles is None:
                return trace.end("stationary")
    except Unobservable as problem:
        return trace.unobservable(str(problem), problem.loose)
    except Infeasible as problem:
        return trace.end("infeasible", reason=str(problem))
    return trace.end("stationary" if run.length < TOLERANCE else "not-converged")


class _Descent:
    """Where the search stands: z, its cost, and the damping that worked last."""

    def __init__(self, trace: Trace, estimator: Estimator):
        self.trace, self.estimator, self.setting = trace, estimator, trace.setting
        L = self.setting.coordinates.L
        self.z = np.zeros(L.shape[-1])
        self.alpha = 1.0 if estimator.uses_prior else 0.0
        self.noise = self.setting.sd if estimator.weighted else np.ones_like(self.setting.sd)
        self.damping, self.length = 0.0, np.inf

    def cost(self, state: State, z: np.ndarray) -> float:
        """J at `state`, with the prior's share |z|^2."""
        return float(np.sum((state.residual / self.noise) ** 2)) + self.alpha * float(z @ z)

    def step(self) -> float | None:
        """Take one step that lowers J, damped as far as needed; its length in revised sd, or None when there is none."""
        state, before = self.trace.state, self.trace.cycles[-1].cost
        first, growth, last = _DAMPING
        scale = self._scale(state)
        while self.damping <= last * scale:
            change = self._solve(state)
            length = self._length(state, change)
            z = self.z + change
            there = attempt(self.setting, self.setting.coordinates.mean + self._expand(z))
            if there is not None and self.cost(there, z) <= before * (1 + 1e-12) + 1e-14:
                self.z = z
                self.trace.record(there, self.cost(there, z), self.damping)
                self.length = length if self.damping < first * scale else np.inf
                self.damping = self.damping / growth if self.damping > first * scale else 0.0
                return self.length
            if length < TOLERANCE and self.damping == 0.0:  # at the rounding of J
                self.trace.record(state, before, self.damping)
                self.length = length
                return length
            self.damping = max(self.damping * growth, first * scale)
        return None

    def _solve(self, state: State) -> np.ndarray:
        """Change of z: the answer of the linearised problem, damped towards where the search stands."""
        coordinates, total = self.setting.coordinates, self.alpha + self.damping
        centre = self.z * (self.damping / total) if total > 0 else self.z
        origin = coordinates.mean + self._expand(centre)
        d = state.residual + state.T @ (state.u - origin)
        problem = LinearProblem(state.T, d, self.noise, coordinates.L)
        if coordinates.lower is not None:
            problem = replace(problem, lower=coordinates.lower - origin, upper=coordinates.upper - origin)
        if total == 0.0:
            change = self.estimator.solve(problem).z
        else:
            change = bayes.solve(replace(problem, L=coordinates.L / np.sqrt(total))).z / np.sqrt(total)
        change = centre + change - self.z
        if (
            self.setting.problem.run.step == "second-order"
            and self.damping == 0.0
            and coordinates.lower is None
        ):
            change = change + self._curved(state, change)
        return change

    def _curved(self, state: State, change: np.ndarray) -> np.ndarray:
        """Second-order correction of `change`, in z."""
        x = acceleration(self.setting, state, self._expand(change), self.estimator)
        L = self.setting.coordinates.L
        return x / L if L.ndim == 1 else np.linalg.lstsq(L, x, rcond=None)[0]

    def _length(self, state: State, change: np.ndarray) -> float:
        """Length of `change` in revised standard deviations: sqrt(dz' (B'B + alpha) dz)."""
        moved = state.T @ self._expand(change) / self.setting.sd
        return float(np.sqrt(moved @ moved + self.alpha * (change @ change)))

    def _scale(self, state: State) -> float:
        L = self.setting.coordinates.L
        B = (state.T * L if L.ndim == 1 else state.T @ L) / self.noise[:, None]
        return max(float(np.einsum("ij,ij->j", B, B).max(initial=0.0)), 1e-300)

    def _expand(self, z: np.ndarray) -> np.ndarray:
        L = self.setting.coordinates.L
        return L * z if L.ndim == 1 else L @ z

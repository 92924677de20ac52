"""Levenberg-Marquardt to the posterior mode: the prior keeps its place, every step is checked by an exact re-solution.

Minimises J(z) = |R^-1/2 (y - h(u_p + L z))|^2 + |z|^2 (without the last term for estimators that know no prior). In z the
prior is the unit sphere, so the damping needs no scaling of its own.
"""

from dataclasses import replace

import numpy as np

from mouse_cli.estimators import bayes
from mouse_cli.estimators.linear import Estimator, Infeasible, LinearProblem, Unobservable, expand, in_prior_units
from mouse_cli.model.result import Status
from mouse_cli.updating.second_order import acceleration
from mouse_cli.updating.state import State, attempt
from mouse_cli.updating.trace import Trace

MEANING = (
    "the prior keeps its mean and S throughout; the result is the mode of the posterior distribution, each step "
    "checked by an exact re-solution"
)
TOLERANCE = 1e-4  # a step this small, in revised standard deviations, is the end
_SEEN = 1e-7  # a promised gain below this share of J that does not come is rounding of the eigensolution
_FIRST, _GROWTH, _GIVE_UP = 1e-3, 3.0, 1e12  # damping relative to |B|^2: where it begins, how it grows, where it ends


def recur(trace: Trace, estimator: Estimator) -> Status:
    """Step until a full step is negligible, the partials are used up, or no step improves J."""
    run = _Descent(trace, estimator)
    options = trace.setting.problem.run
    trace.record(trace.state, run.cost(trace.state, run.z))
    if trace.guess is not None:
        run.jump(trace.guess)
    most = options.cycles if options.cycles is not None else options.partials
    try:
        while trace.cycles[-1].index < most:
            arrived = run.step()
            if arrived is None:
                return trace.end("no-descent")
            if arrived and options.cycles is None:
                return trace.end("stationary")
    except Unobservable as problem:
        return trace.unobservable(str(problem), problem.loose)
    except Infeasible as problem:
        return trace.end("infeasible", reason=str(problem))
    return trace.end("stationary" if run.arrived else "restless")


class _Descent:
    """Where the search stands: z, its cost, and the damping that worked last."""

    def __init__(self, trace: Trace, estimator: Estimator):
        self.trace, self.estimator, self.setting = trace, estimator, trace.setting
        self.z = self._in_prior_units(trace.state.u - self.setting.coordinates.mean)
        self.alpha = 1.0 if estimator.uses_prior else 0.0
        self.noise = self.setting.sd if estimator.weighted else np.ones_like(self.setting.sd)
        self.damping, self.arrived = 0.0, False

    def cost(self, state: State, z: np.ndarray) -> float:
        """J at `state`, with the prior's share |z|^2."""
        return float(np.sum((state.residual / self.noise) ** 2)) + self.alpha * float(z @ z)

    def jump(self, theta: np.ndarray) -> None:
        """Go on from the values theta (p,), if J is lower there."""
        coordinates = self.setting.coordinates
        z = self._in_prior_units(
            np.where(coordinates.logarithmic, np.log(np.maximum(theta, 1e-300)), theta) - coordinates.mean
        )
        at = coordinates.mean + self._expand(z)
        if coordinates.lower is not None and not np.all((at >= coordinates.lower) & (at <= coordinates.upper)):
            return
        there = attempt(self.setting, at)
        if there is not None and (cost := self.cost(there, z)) < self.trace.cycles[-1].cost:
            self.z = z
            self.trace.record(there, cost)

    def step(self) -> bool | None:
        """Take one step that lowers J, damped as far as needed: whether it was negligible, or None when there is none."""
        state, before = self.trace.state, self.trace.cycles[-1].cost
        scale = self._scale(state)
        while self.damping <= _GIVE_UP * scale:
            change = self._solve(state)
            length = self._length(state, change)
            if self.damping == 0.0 and length**2 < self.trace.enough * before:
                self.arrived = True
                return True
            there = attempt(self.setting, self.setting.coordinates.mean + self._expand(self.z + change))
            cost = np.inf if there is None else self.cost(there, self.z + change)
            small = length < TOLERANCE * self._misfit(before) and self.damping < scale
            unseen = length**2 < _SEEN * (1 + before) and self.damping < scale
            if (small or unseen) and not cost < before:  # at the rounding of J
                there, cost, change = state, before, np.zeros_like(change)
            if cost <= before:
                self._damp(state, change, before - cost, scale)
                self.z = self.z + change
                self.trace.record(there, cost, self.damping)
                trifle = self.damping < scale and before - cost < self.trace.enough * before
                self.arrived = small or trifle or there is state
                return self.arrived
            self.damping = max(self.damping * _GROWTH, _FIRST * scale)
        return None

    def _damp(self, state: State, change: np.ndarray, gained: float, scale: float) -> None:
        """More damping for the next step where the linearised model promised much more than was gained, else less.

        A step from (B'B + alpha + mu) dz = -gradient/2 promises to lower J by dz' (B'B + alpha + 2 mu) dz.
        """
        moved = state.T @ self._expand(change) / self.noise
        promised = float(moved @ moved) + (self.alpha + 2 * self.damping) * float(change @ change)
        if gained < 0.5 * promised:
            self.damping = max(self.damping * _GROWTH, _FIRST * scale)
        elif gained > 0.9 * promised:
            self.damping = self.damping / _GROWTH if self.damping > _FIRST * scale else 0.0

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
        if self.setting.problem.run.step == "second-order" and self.damping == 0.0:
            change = change + self._curved(state, change)
        return change

    def _curved(self, state: State, change: np.ndarray) -> np.ndarray:
        """Second-order correction of `change`, in z."""
        coordinates = self.setting.coordinates
        x = acceleration(self.setting, state, self._expand(change), self.estimator)
        there = coordinates.mean + self._expand(self.z + change) + x
        if coordinates.lower is not None and not np.all((there >= coordinates.lower) & (there <= coordinates.upper)):
            return np.zeros_like(change)
        return self._in_prior_units(x)

    def _length(self, state: State, change: np.ndarray) -> float:
        """Length of `change` in revised standard deviations: sqrt(dz' (B'B + alpha) dz)."""
        moved = state.T @ self._expand(change) / self.setting.sd
        return float(np.sqrt(moved @ moved + self.alpha * (change @ change)))

    def _misfit(self, cost: float) -> float:
        """How many times larger than its accuracy a datum's residual is: where that is much, steps need not be finer."""
        return max(1.0, cost / len(self.noise)) ** 0.5 if self.estimator.weighted else 1.0

    def _scale(self, state: State) -> float:
        """Square of the longest column of B = R^-1/2 T L: what damping is measured by."""
        B = in_prior_units(state.T, self.setting.coordinates.L) / self.noise[:, None]
        return max(float(np.einsum("ij,ij->j", B, B).max(initial=0.0)), 1e-300)

    def _expand(self, z: np.ndarray) -> np.ndarray:
        """u - u_p (p,) = L z."""
        return expand(self.setting.coordinates.L, z)

    def _in_prior_units(self, x: np.ndarray) -> np.ndarray:
        """z (k,) of x = L z (p,)."""
        return self.setting.coordinates.in_prior_units(x)

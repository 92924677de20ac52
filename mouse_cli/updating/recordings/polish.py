"""Output-error fit of a model with one local law: short horizons, each with a free initial state.

Maximum a posteriori by Levenberg-Marquardt. Segments of a record are simulated side by side, together with all perturbed
models; initial states belong to one segment each and are eliminated (Golub and Pereyra's variable projection for what is linear
nearly). The logarithm of the evidence is Laplace's.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.updating.recordings.continuity import gained
from mouse_cli.updating.recordings.fit import Fit
from mouse_cli.updating.recordings.hypothesis import Hypothesis
from mouse_cli.updating.recordings.linear import rigid
from mouse_cli.updating.recordings.segments import Segments
from mouse_cli.updating.recordings.series import passed
from mouse_cli.updating.recordings.simulator import Simulator, Slopes

_DAMPING, _UP, _DOWN = 1e-3, 10.0, 0.2  # of Levenberg and Marquardt
_STEPS = 25
_FURTHER, _KEPT = 4, 0.9  # steps by slopes of one before; least share of what they promise, that they are taken for
_SETTLED, _ROUGH = 0.05, 1e-3  # of the cost in nats, at which a step is no more worth its time; of what is above noise
# steps of a fit whose cost is so many times that of a better one, or of no motion
_PATIENCE, _BEHIND, _ASTRAY = 3, 2.0, 100.0
_DIVERGED = 1e12  # the same, of a start with a law from which no fit comes back
_HALVED = 10  # times that a start without stiffness is brought nearer to the mean
_PROBE, _LESS = 0.1, 0.75  # share of a step where its curvature is seen; most of the second order by the first
_ROUNDED = 1e-9  # of the largest stiffness, below zero
_SPEEDS, _TRIED = 2.5, 33  # speeds that no channel shows: how far, by their rms, and how many at a time


@dataclass
class _At:
    """Where a fit is: x (k,), states (2n, G), what is left (s, t, G), and its cost."""

    x: np.ndarray
    states: np.ndarray
    left: np.ndarray
    cost: float


class Polish:
    """The fit of one hypothesis to segments of records alike; spread (2n,): sd of initial states before the test."""

    def __init__(self, hypothesis: Hypothesis, data: list[Segments], spread: np.ndarray):
        self.h, self.series = hypothesis, data[0].series
        self.spread = hypothesis.padded_states(spread)
        self.simulator = Simulator(hypothesis, data)

    def fit(
        self, x: np.ndarray, states: np.ndarray, internal=None, steps: int = _STEPS, beat: float = np.inf
    ) -> Fit | None:
        """From x (k,), states (2n, G) and internal states of the law; None where no simulation stays finite.

        beat: the cost of a better fit, far behind which this one is not followed to its end.
        """
        try:
            return self._followed(x, states, internal, steps, beat)
        except np.linalg.LinAlgError:  # trajectories part so fast that data tell of initial states alone
            return None

    def _followed(self, x: np.ndarray, states: np.ndarray, internal, steps: int, beat: float) -> Fit | None:
        states = self.h.padded_states(states)
        x = self._sound(self.h.gauged(np.clip(x, *self.h.bounds)))
        self.simulator.internal = internal
        left = self.simulator.left(x, states)
        cost, damping = self._cost(left, x, states), _DAMPING
        loud = float((self.simulator.measured**2).sum())
        if not cost < (_DIVERGED * loud if self.h.parts else np.inf) or not self._stands(x):
            return None
        at, most = _At(x, states, left, cost), min(_BEHIND * beat, _ASTRAY * loud)
        slopes = self.simulator.slopes(x, states, self.spread)
        for step in range(steps):
            if step >= _PATIENCE and at.cost > most:
                break
            straight = self._step(slopes, at, damping)
            there, promised = self._tried(at, *self._bent(slopes, at, damping, *straight)), self._promised(slopes, at, *straight)
            if not there.cost <= at.cost and self.simulator.jumps:
                there = self._each(there, self._tried(at, there.x - at.x, np.zeros_like(at.states)))
            if not there.cost <= at.cost:
                if promised < self._worth(at):
                    break
                damping = max(damping, 1e-6) * _UP
                if damping > 1e8:
                    break
                continue
            serve = not self.simulator.jumps and at.cost - there.cost > _KEPT * promised
            damping, before = damping * _DOWN, at.cost
            at = self._further(slopes, there, damping) if serve else there
            if before - at.cost < self._worth(at):
                break
            slopes = self.simulator.slopes(at.x, at.states, self.spread)
        if self.h.parts and at.cost > _ASTRAY * loud:
            return None
        return self._fit(slopes, at)

    def _further(self, slopes: Slopes, at: _At, damping: float) -> _At:
        """Further steps by the same slopes, while they gain as they promise: a simulation each, where slopes take many."""
        for _ in range(_FURTHER):
            moved, worth = self._step(slopes, at, damping), self._worth(at)
            promised = self._promised(slopes, at, *moved)
            if promised < worth:
                break
            there = self._tried(at, *moved)
            if not there.cost <= at.cost:
                break
            gained, at = at.cost - there.cost, there
            if gained < max(_KEPT * promised, worth):
                break
        return at

    def _promised(self, slopes: Slopes, at: _At, dx: np.ndarray, ds: np.ndarray) -> float:
        """What a step gains if the slopes hold."""
        return at.cost - self._cost(at.left - slopes.along(dx, ds), at.x + dx, at.states + ds)

    def _tried(self, at: _At, dx: np.ndarray, ds: np.ndarray) -> _At:
        """What a step leads to; its cost is infinite where nothing stands there."""
        x, states = self.h.gauged(np.clip(at.x + dx, *self.h.bounds)), at.states + ds
        if not self.h.linear.sound(self.h.whole(x[None])[0, : self.h.linear.k]):
            return _At(x, states, at.left, np.inf)
        left = self.simulator.left(x, states)
        cost = self._cost(left, x, states)
        return _At(x, states, left, cost if np.isfinite(cost) else np.inf)

    def _each(self, one: _At, other: _At) -> _At:
        """Of two fits with the same x, each segment as in the one that leaves less there.

        A mass that sticks does not feel its speed, and a step of it may lead anywhere.
        """
        if not np.array_equal(one.x, other.x):
            return one
        prior = lambda at: ((at.states / self.spread[:, None]) ** 2).sum(axis=0)
        costs = [np.nan_to_num((at.left**2).sum(axis=(0, 1)) + prior(at), nan=np.inf) for at in (one, other)]
        first = costs[0] <= costs[1]
        states, left = (np.where(first, *pair) for pair in ((one.states, other.states), (one.left, other.left)))
        return _At(one.x, states, left, self._cost(left, one.x, states))

    @staticmethod
    def _worth(at: _At) -> float:
        """What a step has to gain for another one to be worth its time."""
        return max(2 * _SETTLED, _ROUGH * (at.cost - at.left.size))

    def nearer(self, x: np.ndarray, states: np.ndarray, internal) -> np.ndarray:
        """x (k,), or the same law with all nuisances at their mean, whichever costs less.

        A first look is linear in what the law leaves, and may put them anywhere.
        """
        own = self.h.nuisances
        if not self.h.parts or not x[:own].any():
            return x
        self.simulator.internal = internal
        states = self.h.padded_states(states)
        begun = [np.clip(each, *self.h.bounds) for each in (x, np.concatenate([self.h.mean[:own], x[own:]]))]
        costs = [self._cost(self.simulator.left(each, states), x, states) for each in begun]
        return begun[1] if not costs[0] <= costs[1] else x

    def with_speed(self, x: np.ndarray, states: np.ndarray, internal) -> np.ndarray:
        """States (2n, G) with that constant speed along motions which nothing holds that serves each segment best.

        Accelerations do not show it, and a mass that is taken to stick, or to slip the other way, has a minimum of its own.
        """
        n, model = len(self.h.linear.M), self.h.linear
        slow = self.series.slow * self.series.dt
        self.simulator.internal = internal
        for motion in rigid(model.K, model.M, slow).T:
            reach = _SPEEDS * np.abs(self.spread[n : 2 * n]).max() / np.abs(motion).max()
            for width in (reach, 2 * reach / _TRIED):
                steps = np.linspace(-width, width, _TRIED)
                many = np.repeat(states[None], _TRIED, 0)
                many[:, n : 2 * n] += (steps[:, None] * motion)[:, :, None]
                seen = self.simulator.seen(
                    np.repeat(x[None], _TRIED, 0), np.stack([self.h.padded_states(one) for one in many])
                )
                left = np.nan_to_num(((self.simulator.measured - seen) ** 2).sum(axis=(1, 2)), nan=np.inf)
                states = many[left.argmin(axis=0), :, np.arange(states.shape[1])].T
        return states

    def _sound(self, x: np.ndarray) -> np.ndarray:
        """x, its nuisances halved towards their mean until stiffness and mass are definite."""
        k = 0 if self.h.fixed is not None else self.h.linear.k
        for _ in range(_HALVED):
            if not k or self.h.linear.sound(x[:k]):
                break
            x = np.concatenate([x[:k] / 2, x[k:]])
        return x

    def _stands(self, x: np.ndarray) -> bool:
        """Whether the linear part has inertia and no negative stiffness: more lost than there is, and every motion would grow."""
        plant = self.h.plant(x[None], self.series)
        mass, stiffness = (np.linalg.eigvalsh(one[0])[0] for one in (plant.M, plant.K))
        return bool(mass > 0 and stiffness >= -_ROUNDED * np.abs(plant.K).max())

    @np.errstate(over="ignore", invalid="ignore")
    def _cost(self, residual: np.ndarray, x: np.ndarray, states: np.ndarray) -> float:
        prior = (((x - self.h.mean) / self.h.sd) ** 2).sum() + ((states / self.spread[:, None]) ** 2).sum()
        return float((residual**2).sum() + prior)

    @np.errstate(over="ignore", invalid="ignore")
    def _normal(self, slopes: Slopes, at: _At, damping: float):
        """Normal equations with the initial states eliminated: matrix, right side, what gives states back, and their precisions.

        A parameter that the data do not feel is held by the width of its range.
        """
        P0 = 1 / self.h.sd**2
        H, g = np.diag(P0 + 2 * np.pi / self.h.width**2), -P0 * (at.x - self.h.mean)
        backs, precisions = [], []
        for j in range(at.states.shape[1]):
            r, J, X = (
                at.left[:, :, j].ravel(),
                slopes.J[:, :, j].reshape(at.left[:, :, j].size, len(at.x)),
                slopes.X[:, :, j].reshape(-1, len(at.states)),
            )
            S0 = 1 / self.spread**2
            XX = X.T @ X + np.diag(S0)
            precisions.append(XX)
            XX = XX + damping * np.diag(np.diag(XX))
            XJ, Xr = X.T @ J, X.T @ r - S0 * at.states[:, j]
            solved = np.linalg.solve(XX, np.column_stack([XJ, Xr]))
            H = H + J.T @ J - XJ.T @ solved[:, :-1]
            g = g + J.T @ r - XJ.T @ solved[:, -1]
            backs.append(solved)
        return H, g, backs, precisions

    def _step(self, slopes: Slopes, at: _At, damping: float):
        H, g, backs, _ = self._normal(slopes, at, damping)
        moved = np.linalg.solve(H + damping * np.diag(np.diag(H)), g) if len(at.x) else np.zeros(0)
        return moved, np.stack([b[:, -1] - b[:, :-1] @ moved for b in backs], axis=1)

    @np.errstate(over="ignore", invalid="ignore")
    def _bent(self, slopes: Slopes, at: _At, damping: float, dx: np.ndarray, ds: np.ndarray):
        """A step dx, ds with its second order, along valleys that bend: parameters that act alike, one of them by its logarithm.

        Geodesic acceleration (M. K. Transtrum, J. P. Sethna, arXiv:1201.5885): d2 = -(J'J + D)^-1 J' f'' / 2, f'' the second
        derivative of the outputs along the step d; kept where it is the smaller of both.
        """
        if not len(dx):
            return dx, ds
        near = np.clip(at.x + _PROBE * dx, *self.h.bounds)
        bend = (at.left - self.simulator.left(near, at.states + _PROBE * ds)) / _PROBE - slopes.along(dx, ds)
        if not np.isfinite(bend).all():
            return dx, ds
        half = _At(self.h.mean, np.zeros_like(at.states), -bend / _PROBE, 0.0)  # of the second derivative
        d2x, d2s = self._step(slopes, half, damping)
        size = lambda a, b: float((a @ a) + ((b / self.spread[:, None]) ** 2).sum())
        return (dx + d2x, ds + d2s) if size(d2x, d2s) <= _LESS**2 * size(dx, ds) else (dx, ds)

    def _lost(self, s: int, t: int, G: int) -> int:
        """Amplitudes of hum and drift that the stretches have free."""
        own = self.series.disturbance
        return own.columns(t, self.series.dt) * s * G if own else 0

    def _fit(self, slopes: Slopes, at: _At) -> Fit:
        H, _, _, precisions = self._normal(slopes, at, 0.0)
        logs = sum(np.linalg.slogdet(one * np.outer(self.spread, self.spread))[1] for one in precisions)
        width = self.h.width
        own = np.isfinite(width)
        evidence = -at.cost / 2 - np.log(width[own] / np.sqrt(2 * np.pi)).sum() - (np.linalg.slogdet(H)[1] + logs) / 2
        evidence += gained(self.simulator, at.x, at.states, self.spread, precisions)
        misfit = float((at.left**2).sum())
        dof = passed() * at.left.size - len(at.x) - at.states.size - self._lost(*at.left.shape)
        noise, covariance = self.simulator.noise, np.linalg.inv(H)
        as_read = at.left if noise is None else noise.coloured(at.left)
        return Fit(self.h, at.x, at.states, covariance, misfit, dof, at.cost, float(evidence), as_read)


def followed(
    hypothesis: Hypothesis,
    data: list[Segments],
    spread: np.ndarray,
    x: np.ndarray,
    states,
    internal,
    beat: float = np.inf,
) -> Fit | None:
    """The fit over the first quarters of the segments, with fewer false minima, then over the whole of them, unless those alone
    cost far more than the whole of a better fit, `beat`.
    """
    begun = Polish(hypothesis, [part.begun() for part in data], spread)
    if data[0].series.adrift and not data[0].series.at_rest:
        states = begun.with_speed(x, states, internal)
    x = begun.nearer(x, states, internal)
    first, steps = begun.fit(x, states, internal), _STEPS
    if first is not None:
        x, states = first.x, first.states
        steps = _STEPS if first.cost <= _BEHIND * beat else 0
    return Polish(hypothesis, data, spread).fit(x, states, internal, steps, beat)

"""What a record says of motions and of one unknown force, line by line of the spectrum, whatever the law of the force."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mouse_cli.updating.recordings.linear import Linear, rigid
from mouse_cli.updating.recordings.series import Series, quick

_EVERYWHERE = 0.03  # rms of small unknown forces at every degree of freedom, by that of the measured force
_HERE = 3.0  # rms of the unknown force at one place, by that of the measured force
_QUIET, _MOST = 9.0, 6  # times the slowest motion falls by e in the room after the record; at most so many records long
_FIRST, _LEAST = 32, 32  # part of a free decay that shows its initial state; samples of it, at least
_UNSEEN, _LOOSE = 1e-6, 10.0  # singular value of an initial state that is not seen; times the record that one may make
_LOST = 1e12  # times the variance of its noise that a line has which hum or drift take
_OF_MODEL = ("padded", "w", "H", "S", "SH", "begun", "window", "read", "_lost")  # what does not depend on how a decay begins
_TAPER = 0.03  # share of the record at its end, and of its beginning where it does not begin at rest


def free(model: Linear, count: int, dt: float, order: int) -> np.ndarray:
    """Motions (2n, count, n) of a model begun with a unit of each displacement and velocity, differentiated `order` times."""
    from scipy.linalg import expm

    n = len(model.M)
    A = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(model.M, part) for part in (model.K, model.C)]])
    row, step = np.eye(2 * n)[:n] @ np.linalg.matrix_power(A, order), expm(A * dt)
    found, state = np.empty((count, n, 2 * n)), np.eye(2 * n)
    for k in range(count):
        found[k], state = row @ state, step @ state
    return found.transpose(2, 0, 1)


@dataclass(frozen=True)
class Spectrum:
    """A record and a linear model line by line: w (l,) rad/s; H (l, n, n) receptance; S (l, s, n): what sensors read of motion.

    missing (t, s): measured less the answer of the model, from rest. weights (l, s, s): of outputs over their sd, for noise
    that is not white; None: 1. state (2n,): in which a free decay begins; None: the one that its beginning shows.
    """

    series: Series
    linear: Linear
    weights: np.ndarray | None = None
    state: np.ndarray | None = None

    @cached_property
    def padded(self) -> int:
        """Length of the transforms: room for the motion after the record to die away before it comes round to the beginning."""
        from scipy.fft import next_fast_len

        model, n, t = self.linear, len(self.linear.M), len(self.series)
        A = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(model.M, part) for part in (model.K, model.C)]])
        slowest = max(float(-np.linalg.eigvals(A).real.max()), 1e-12)
        return next_fast_len(t + int(np.clip(_QUIET / slowest / self.series.dt, t // 4, _MOST * t)), real=True)

    @cached_property
    def w(self) -> np.ndarray:
        """Circular frequencies (l,)."""
        return 2 * np.pi * np.fft.rfftfreq(self.padded, self.series.dt)

    @cached_property
    def H(self) -> np.ndarray:
        """Receptance (l, n, n); that of the lowest line at 0 for a structure that is free there."""
        model, w = self.linear, self.w[:, None, None]
        Z = model.K - w**2 * model.M + 1j * w * model.C
        low = np.linalg.cond(Z[0]) > 1e12
        if low:
            Z[0] = Z[1]
        return np.linalg.inv(Z)

    @cached_property
    def S(self) -> np.ndarray:
        """Sensors by motion (l, s, n)."""
        return self.series.sensing[None] * (1j * self.w[:, None])[:, :, None] ** self.series.order[None, :, None]

    @cached_property
    def SH(self) -> np.ndarray:
        """Sensors by forces (l, s, n)."""
        return self.S @ self.H

    @cached_property
    def _lost(self) -> np.ndarray:
        """Mask (l,) of lines that hum and drift take."""
        return self.series.disturbance.lost(self.w / (2 * np.pi))

    def line(self, x: np.ndarray) -> np.ndarray:
        """Lines (l, ...) of a history (t, ...), zero after it."""
        from scipy.fft import rfft

        return rfft(x, self.padded, axis=0)

    def history(self, X: np.ndarray) -> np.ndarray:
        """History (t, ...) of lines (l, ...)."""
        from scipy.fft import irfft

        return irfft(X, self.padded, axis=0)[: len(self.series)]

    def whitened(self, x: np.ndarray) -> np.ndarray:
        """Outputs (t, s) over their sd, without what is slow, and by the weights."""
        own = x / self.series.sd
        own = quick(own, self.series.order, self.series.slow) if self.series.slow else own
        if self._lost.any():
            own = self.history(np.where(self._lost[:, None], 0.0, self.line(own)))
        return own if self.weights is None else self.history((self.weights @ self.line(own)[:, :, None])[:, :, 0])

    @cached_property
    def motion(self) -> np.ndarray:
        """Lines (l, n) of the motion of the model under the measured force."""
        F = self._forces @ self.series.loads(self.linear.M).T
        return np.einsum("lij,lj->li", self.H, F)

    @cached_property
    def carried(self) -> np.ndarray | None:
        """Lines (l, n) of the acceleration with which the ground carries the model along; None where it stands still."""
        return self._forces @ self.series.base.T if self.series.base.any() else None

    @property
    def _forces(self) -> np.ndarray:
        return self.line(self.series.force - self._mean)

    @cached_property
    def _loads(self) -> np.ndarray:
        """Histories (t, ...) of the measured forces, or of all that act on the model where the ground carries it along."""
        series = self.series
        return series.force if not series.base.any() else series.force @ series.loads(self.linear.M).T

    @property
    def _mean(self) -> np.ndarray:
        return self.series.force.mean(axis=0)

    @cached_property
    def read(self) -> np.ndarray:
        """Outputs (t, s), about their mean where their zero is free, and where they are places or speeds."""
        series = self.series
        return series.measured - series.measured.mean(axis=0) * ((series.order < 2) | series.disturbance.offset)

    @cached_property
    def _whole(self) -> np.ndarray:
        """Measured less simulated (t, s)."""
        answer = self.history(np.einsum("lsn,ln->ls", self.S, self.motion))
        answer += sum(
            (x @ (self.series.sensing * (self.series.order == k)[:, None]).T for k, x in enumerate(self.released))
        )
        return self.read - answer

    @cached_property
    def missing(self) -> np.ndarray:
        """The same, tapered at the end."""
        return self._whole * self.window[:, None]

    @cached_property
    def closed(self) -> np.ndarray:
        """Lines (l, s) of the same; of a structure that nothing holds as it is, faded beyond its ends in the room after it.

        Tapered, a mass that drifts would stand still at its ends.
        """
        if not self.series.slow:
            return self.line(self.missing)
        x, t = self._whole, len(self.series)
        m = min(max(2, int(_TAPER * t)), (self.padded - t) // 2)
        fall = (0.5 + 0.5 * np.cos(np.pi * (np.arange(m) + 1) / m))[:, None]
        found = np.zeros((self.padded, x.shape[1]))
        found[:t] = x
        found[t : t + m] = (2 * x[-1] - x[-2 : -m - 2 : -1]) * fall
        if not (self.series.at_rest or self.series.free):
            found[-m:] = (2 * x[0] - x[m:0:-1]) * fall[::-1]
        if self.series.adrift:  # what follows the record brings it back to rest: no line 0 shows a change of speed
            back = np.hanning(self.padded - t - 2 * m + 2)[1:-1, None]
            found[t + m : self.padded - m] -= found.sum(axis=0) * back / back.sum()
        return np.fft.rfft(found, axis=0)

    @cached_property
    def window(self) -> np.ndarray:
        """1, and a half cosine to 0 at the end (t,); at the beginning too."""
        t = len(self.series)
        m = max(2, int(_TAPER * t))
        fall = 0.5 + 0.5 * np.cos(np.pi * (np.arange(m) + 1) / m)
        found = np.ones(t)
        found[-m:] = fall
        if not (self.series.at_rest or self.series.free):
            found[:m] = fall[::-1]
        return found

    def with_speed(self, states: np.ndarray) -> np.ndarray:
        """States (2n, t) with the constant speed that no line of the spectrum shows, where no displacement does.

        Velocities have it on average; what accelerations tell of begins at rest, or ends about where it began.
        """
        series = self.series
        if not series.slow or (series.order == 0).any():
            return states
        x, v = np.split(states, 2)
        own = series.order == 1
        R = rigid(self.linear.K, self.linear.M, series.slow * series.dt)
        if own.any():
            short = (series.measured[:, own].T - series.sensing[own] @ v).mean(axis=1)
            more = R @ np.linalg.lstsq(series.sensing[own] @ R, short, rcond=None)[0]
        else:
            more = -v[:, 0] if series.at_rest else -R @ (R.T @ self.linear.M @ v.mean(axis=1))
        t = series.dt * np.arange(len(series))
        return np.concatenate([x + more[:, None] * t, v + more[:, None]])

    @property
    def _impulse(self) -> float:
        """rms of lines of the impulses that leave a free decay, of all degrees of freedom alike, so that the record is as large."""
        shown = (np.abs(self.closed / self.series.sd) ** 2).sum()
        passed = (np.abs(self.SH / self.series.sd[:, None]) ** 2).sum()
        return float(np.sqrt(shown / passed)) / _EVERYWHERE

    @cached_property
    def begun(self) -> np.ndarray:
        """Outputs (2n, t, s) of the model as it is, begun with a unit of each displacement and velocity; of a free decay."""
        model, t = self.linear, len(self.series)
        if not self.series.free:
            return np.zeros((0, t, len(self.series.order)))
        sensing, order = self.series.sensing, self.series.order
        return sum(free(model, t, self.series.dt, k) @ (sensing * (order == k)[:, None]).T for k in range(3))

    @property
    def begins(self) -> np.ndarray:
        """The same, windowed, each so many times as large as what is missing that a unit normal prior holds none of them."""
        size = np.linalg.norm(self.begun, axis=(1, 2), keepdims=True)
        return self.begun * self.window[:, None] * (_LOOSE * np.linalg.norm(self.missing) / np.maximum(size, 1e-300))

    @property
    def first(self) -> int:
        """Samples of a free decay whose motion its initial state alone tells; 0 of other records."""
        return max(len(self.series) // _FIRST, min(_LEAST, len(self.series))) if self.series.free else 0

    @cached_property
    def released(self) -> np.ndarray:
        """Displacements, velocities and accelerations (3, t, n) of the model as it is, begun as a free decay begins; else 0.

        Its initial state serves the beginning of the record best, where the model has not had the time to go astray.
        """
        series, model = self.series, self.linear
        if not series.free:
            return np.zeros((3, len(series), len(model.M)))
        state = self.state
        if state is None:
            m = self.first
            columns = (self.begun[:, :m] / series.sd).reshape(len(self.begun), -1).T
            size = np.maximum(np.linalg.norm(columns, axis=0), 1e-300)
            state = np.linalg.lstsq(columns / size, (self.read[:m] / series.sd).ravel(), rcond=_UNSEEN)[0] / size
        return np.stack([np.tensordot(state, free(model, len(series), series.dt, k), 1) for k in range(3)])

    def derivative(self, U: np.ndarray, order: int) -> np.ndarray:
        """History (t, n) of motions of lines U (l, n), differentiated so often; what begins at full size has no clean lines."""
        lines = (1j * self.w[:, None]) ** order
        if not self.series.free:
            return self.history(U * lines)
        return self.history((U - self.line(self.released[0])) * lines) + self.released[order]

    def begun_under(self, B: np.ndarray) -> "Spectrum":
        """The same, begun as a free decay most probably does when unknown forces act through B (n, r), from its first sample on.

        Least squares of all lines, weighed as they leave them: a stop that bears from the beginning is none of the initial state.
        """
        if not self.series.free:
            return self
        _, total = self._unknown(B)
        D = np.stack([self.line(one * self.window[:, None]) for one in self.begun], axis=2)
        weighed = np.linalg.solve(total, D)
        A = np.einsum("lsi,lsj->ij", D.conj(), weighed).real
        b = np.einsum("lsi,ls->i", weighed.conj(), self.line(self.read * self.window[:, None])).real
        size = 1 / np.sqrt(np.maximum(np.diag(A), 1e-300))
        state = size * np.linalg.lstsq(A * size * size[:, None], size * b, rcond=_UNSEEN**2)[0]
        found = replace(self, state=state)
        vars(found).update({name: own for name, own in vars(self).items() if name in _OF_MODEL})
        return found

    def _unknown(self, B: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """SH Q (l, s, n) and SH Q SH' + R (l, s, s) of unknown forces through B (n, r), and small ones everywhere."""
        free = self.series.free
        size, here = (self._impulse, _EVERYWHERE) if free else (np.sqrt((self._loads**2).mean(axis=0).sum()), _HERE)
        unit = B / np.maximum(np.linalg.norm(B, axis=0), 1e-300)
        Q = size**2 * (_EVERYWHERE**2 * np.eye(len(B)) + here**2 * unit @ unit.T)
        noise = self.series.sd**2 * (len(self.series) if free else 1)  # of lines, as the impulses are, or of samples, as forces are
        R = np.diag(noise) * np.where(self._lost, _LOST, 1.0)[:, None, None]
        G = self.SH @ Q
        return G, G @ self.SH.conj().transpose(0, 2, 1) + R

    def motions(self, B: np.ndarray) -> np.ndarray:
        """Lines (l, n) of the most probable motion when unknown forces act through B (n, r), and small ones everywhere.

        Forces of circular normal distribution with covariance Q: u = H f + H Q (SH)' (SH Q SH' + R)^-1 (y - S H f).
        """
        G, total = self._unknown(B)
        solved = np.linalg.solve(total, self.closed[:, :, None])
        begun = self.line(self.released[0]) if self.series.free else self.motion
        return begun + (self.H @ (G.conj().transpose(0, 2, 1) @ solved))[:, :, 0]

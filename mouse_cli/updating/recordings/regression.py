"""Which law at which place: the missing part of the record as the answer of the model to a force that follows from the motion.

The true structure answers y = S H (f - dZ u - B F(B'u, B'u')), H of the model as it is: linear in the sizes of dK, dC and F once
u is known. u is taken from the record, so that the fit has a closed form; it gives starts for `polish` and no verdict.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np

from mouse_cli.terms.laws import Law, registry
from mouse_cli.updating.recordings.acting import Acting, Place
from mouse_cli.updating.recordings.channels import corrected, read
from mouse_cli.updating.recordings.free_force import Spectrum
from mouse_cli.updating.recordings.hypothesis import Hypothesis
from mouse_cli.updating.recordings.law_forces import linear_force, stepped

_APART = 0.15  # of the logarithm of a size, from which on two starts are two
_FAR = 0.7  # most that ln parameters of a law that is there already move in a first look
_HELD = 1e3  # times as sure as its prior that a factor of all masses, stiffnesses and dampings, or of all gains, is
_SIDE_BY_SIDE, _FOLLOWED = 16, 1e-9  # columns at a time; share of one that is left where nuisances do the same
_SINGULAR = 1e-6  # of the largest singular value, below which columns are a sum of others
_STEP = 1e-3  # of ln parameters, in differences
_BEGIN = 0.02  # share of the record whose states are not known well, left out


@dataclass(frozen=True)
class Start:
    """A law at a place with sizes that explain most of the missing part: x (k,) of `hypothesis`; left: its chi2."""

    hypothesis: Hypothesis
    x: np.ndarray
    left: float


@dataclass(frozen=True)
class Local:
    """All that a place needs: histories x, v (t,) of its motion, lines X (l, d) of its motions, answers (l, s, d) of sensors to
    forces there.

    carried (l, d): lines of the acceleration of the ground along it.
    """

    place: Place
    x: np.ndarray
    v: np.ndarray
    X: np.ndarray
    answer: np.ndarray
    carried: np.ndarray


class Regression:
    """Regressions of one record at one place: nuisances are projected out once.

    begun (k,): x of `hypothesis`, about which laws that it has already are linear; None where it has none. error: sd of the closed
    form, by the rms of the missing part: nuisances leave their prior for no more than what it can tell.
    """

    def __init__(self, spectrum: Spectrum, hypothesis: Hypothesis, begun: np.ndarray | None = None, error: float = 0.0):
        self.base = hypothesis
        self.begun = np.zeros(hypothesis.nuisances) if begun is None else begun
        place = hypothesis.place
        others = [*(one.directions for one in hypothesis.known), *(part.place.directions for part in hypothesis.parts)]
        acting = np.concatenate([place.directions, *others], axis=1)
        self.spectrum = spectrum = _as_measured(spectrum, hypothesis, self.begun).begun_under(acting)
        self._U = U = spectrum.motions(acting)
        self._states = spectrum.with_speed(np.concatenate([spectrum.derivative(U, order).T for order in (0, 1)]))
        self.spread = self._states.std(axis=1)
        if spectrum.series.free:
            self.spread = np.maximum(self.spread, np.abs(np.concatenate(spectrum.released[:2], axis=1)).max(axis=0))
        histories = (place.B @ half for half in np.split(self._states, 2))
        B = place.directions
        self.local = Local(place, *histories, U @ B, spectrum.SH @ B, self._carried(B))
        t = len(spectrum.series)
        edge = int(_BEGIN * t) + spectrum.series.slow
        self.kept = slice(edge, t - edge - int(_BEGIN * t))
        self.missing = spectrum.missing + self._answer(self.begun)
        self.sd = 1.0
        self.y = self.stacked(self.missing)
        self.sd = float(np.hypot(1.0, error * np.sqrt((self.y**2).sum() / max(len(self.y), 1))))  # a short part may keep none
        self.y /= self.sd
        channels = hypothesis.channels.columns(spectrum)
        columns = *self._nuisances(U), *channels, *self._slopes(), *spectrum.begins
        self.J = np.stack([self.stacked(column) for column in columns], axis=1)
        self._prior = self._held()
        self.Q, self.R = np.linalg.qr(np.vstack([self.J, self._prior]))
        self.target = np.concatenate([self.y, np.zeros(len(self._prior))])
        self.target -= self.Q @ (self.Q.T @ self.target)

    def _held(self) -> np.ndarray:
        """Rows of the prior (k and more, k), with what would make everything nothing held: where the ground alone moves the model,
        its common factor, and where all channels may have gains, theirs.

        The recorded motion asks the model as it is for a force, and a model of nothing asks for none; channels that read nothing
        of a force and nothing of a motion leave nothing to explain.
        """
        k, first = self.J.shape[1], self.base.linear.k
        rows = np.zeros((2, k))
        if self.base.ground:
            rows[0, :first] = self.base.linear.common
        channels = self.spectrum.series.measured.shape[1] + self.spectrum.series.force.shape[1]
        gains = np.array([sd for _, sd in self.base.channels.gain])
        if len(gains) == channels:  # of all alike, in sd of each
            rows[1, first : first + channels] = 1 / gains
        sizes = np.linalg.norm(rows, axis=1, keepdims=True)
        return np.vstack([np.eye(k), *(_HELD / size * row for row, size in zip(rows, sizes, strict=True) if size)])

    def _answer(self, x: np.ndarray) -> np.ndarray:
        """What the laws of the deck and of the hypothesis, at x (k,), take off the outputs (t, s), at the motion of the record."""
        s, n, found = self.spectrum, len(self._states) // 2, np.zeros_like(self.spectrum.missing)
        add = lambda F, B: s.history(F[:, None] * (s.SH @ B)) * s.window[:, None]
        for one in self.base.acting(x):
            along, speed = one.B @ self._states[:n], one.B @ self._states[n:]
            if one.law.states:
                F = stepped(one.law, along, speed, one.p[:, None], one.words)[:, 0]
            else:
                F = one.law.force(along, speed, None, one.p, **one.words)[0]
            found += add(s.line(F * s.window), one.B)
        linear = [one for one in self.base.known if one.law.linear]
        linear += [part.acting(p[:, 0]) for part, p in self.base.sizes(x[None]) if part.law.linear]
        for one in linear:
            B = one.directions
            F = linear_force(one.law.on(B.shape[1], one.p, one.words), s.w, self._U @ B, self._carried(B))
            found += s.history(np.einsum("ld,lsd->ls", F, s.SH @ B)) * s.window[:, None]
        return found

    def _carried(self, B: np.ndarray) -> np.ndarray:
        """Lines (l, d) of the acceleration with which the ground carries motions B (n, d) along."""
        carried = self.spectrum.carried
        return np.zeros((len(self.spectrum.w), B.shape[1])) if carried is None else carried @ B

    def _slopes(self) -> Iterator[np.ndarray]:
        """Answers (t, s) to a change of the ln parameters of the laws that the hypothesis has."""
        for j in range(self.base.nuisances, len(self.begun)):
            step = np.zeros_like(self.begun)
            step[j] = _STEP
            yield (self._answer(self.begun - step) - self._answer(self.begun + step)) / (2 * _STEP)

    def states(self, at: np.ndarray) -> np.ndarray:
        """Displacements and velocities (2n, G) at samples (G,)."""
        return self._states[:, at]

    def internal(self, one: Acting, at: np.ndarray) -> np.ndarray | None:
        """Internal states (states, 1, G) of a law at samples (G,)."""
        law, p, words = one.law, one.p, one.words
        if not law.states:
            return None
        n = len(one.B)
        x, v = one.B @ self._states[:n], one.B @ self._states[n:]
        z, found = np.zeros((law.states, 1)), np.zeros((law.states, 1, len(at)))
        wanted, force = {int(sample): g for g, sample in enumerate(at)}, law.along(p[:, None], words)
        for i in range(int(max(at)) + 1):
            _, z = force(x[i], v[i], z)
            if i in wanted:
                found[:, :, wanted[i]] = z
        return found

    def stacked(self, columns: np.ndarray) -> np.ndarray:
        """Outputs (t, s) as the fit sees them, in sd."""
        return self.spectrum.whitened(columns)[self.kept].ravel() / self.sd

    def projected(self, column: np.ndarray) -> np.ndarray:
        """What nuisances do not follow of a stacked column."""
        own = np.concatenate([column, np.zeros(len(self._prior))])
        return own - self.Q @ (self.Q.T @ own)

    def begin(self, column: np.ndarray, own: np.ndarray) -> tuple[np.ndarray, float]:
        """x (k,) with the nuisances that go with a law whose answer is a stacked column, and its ln parameters `own`; its chi2."""
        left = self.target - self.projected(column)
        z = np.linalg.solve(self.R, self.Q.T @ np.concatenate([self.y - column, np.zeros(len(self._prior))]))
        offsets, first = self.base.offsets, self.base.nuisances
        of_model, of_channels, of_laws = np.split(
            z[: len(self.begun) - len(self.base.offset)], [offsets.start, first - len(self.base.offset)]
        )
        moved = self.begun[first:] + np.clip(of_laws, -_FAR, _FAR)
        return np.concatenate([of_model, self.begun[offsets], of_channels, moved, own]), float(left @ left)

    def _nuisances(self, U: np.ndarray) -> Iterator[np.ndarray]:
        """Answers (t, s) to forces -(dK u + iw dC u + dM a) of each nuisance, a = -w^2 u and what the ground adds."""
        s, w = self.spectrum, self.spectrum.w[:, None]
        a = -(w**2) * U + (0.0 if s.carried is None else s.carried)
        for dM, dC, dK in zip(*self.base.linear.slopes, strict=True):
            force = U @ dK.T + 1j * w * (U @ dC.T) + a @ dM.T
            yield s.history(-np.einsum("lsn,ln->ls", s.SH, force)) * s.window[:, None]

    def free(self, x: np.ndarray) -> np.ndarray:
        """The force (t,) at the place that the record asks for, whatever its law: nuisances as in x (k,), least squares by line.

        Lines in which no sensor feels a force there are left out.
        """
        s, k = self.spectrum, self.base.linear.k
        answer = np.zeros_like(self.missing)
        for z, column in zip(x[:k], self._nuisances(self._U), strict=True):
            answer += z * column
        E = s.line(self.missing - answer) / s.series.sd
        A = self.local.answer[:, :, 0] / s.series.sd
        size = (np.abs(A) ** 2).sum(axis=1)
        G = -(A.conj() * E).sum(axis=1) / np.where(size > 1e-6 * size.max(), size, np.inf)
        return s.history(G)

    @property
    def left(self) -> np.ndarray:
        """What the nuisances leave of the outputs (t, s), weighed; 0 at either end."""
        found = np.zeros_like(self.missing)
        found[self.kept] = self.sd * self.target[: len(self.y)].reshape(-1, found.shape[1])
        return found

    def share(self, forces: list[np.ndarray]) -> float:
        """Share of what is left that any sum of histories (t,) of a force at the place takes."""
        return self.taken([self._answered(self.spectrum.line(F * self.spectrum.window)[:, None]) for F in forces])[0]

    def taken(self, columns: list[np.ndarray]) -> tuple[float, np.ndarray]:
        """Share of what is left that stacked columns take, nuisances beside them, and their sizes."""
        A = np.column_stack([self.projected(column) for column in columns])
        scale = np.maximum(np.linalg.norm(A, axis=0), 1e-300)
        sizes, *_ = np.linalg.lstsq(A / scale, self.target, rcond=_SINGULAR)
        return 1 - float(((self.target - A / scale @ sizes) ** 2).sum()) / self.nothing, sizes / scale

    @property
    def nothing(self) -> float:
        """chi2 without any law, and the prior of the nuisances."""
        return float(self.target @ self.target)

    def forces(self, law: Law, variant: int, many: np.ndarray) -> Iterator[np.ndarray]:
        """Lines (l, d) of the forces of a law for each of its parameters (m, q)."""
        words, local, s = law.variants[variant], self.local, self.spectrum
        if law.states:
            found = stepped(law, local.x, local.v, many.T, words)
            yield from (s.line(column * s.window)[:, None] for column in found.T)
            return
        for p in many:
            if law.linear:
                yield linear_force(law.on(local.X.shape[1], p, words), s.w, local.X, local.carried)
            else:
                yield s.line(law.force(local.x, local.v, None, p, **words)[0] * s.window)[:, None]

    def _answered(self, force: np.ndarray) -> np.ndarray:
        """Stacked answer of the outputs to lines (l, d) of forces at the place."""
        s = self.spectrum
        answer = sum(F[:, None] * each for F, each in zip(force.T, self.local.answer.transpose(2, 0, 1), strict=True))
        return self.stacked(s.history(answer) * s.window[:, None])

    def best(self, law: Law, variant: int) -> Start | None:
        """The sizes of the law that leave least; None where no force of its sign leaves less than none."""
        return next(iter(self.apart(law, variant, 1)), None)

    def apart(self, law: Law, variant: int, most: int) -> list[Start]:
        """Up to `most` sizes of the law, that which leaves least first, each far from those before it in what is not linear."""
        many, tried = np.array(list(law.inner(self.local.place.scale))), []
        forces, Q = self.forces(law, variant, many), self.Q[: len(self.y)]
        for some in np.array_split(many, -(-len(many) // _SIDE_BY_SIDE)):
            columns = np.stack([self._answered(-force) for force in islice(forces, len(some))], axis=1)
            whole = (columns**2).sum(axis=0)
            sizes = whole - ((Q.T @ columns) ** 2).sum(axis=0)  # of what nuisances do not follow
            shared = columns.T @ self.target[: len(self.y)]  # nothing of the target is along Q
            for i in np.flatnonzero((sizes > _FOLLOWED * whole) & (shared > 0)):
                tried.append((self.nothing - shared[i] ** 2 / sizes[i], some[i], shared[i] / sizes[i]))
        found, near = [], []
        for left, p, factor in sorted(tried, key=lambda one: one[0]):
            if len(found) < most and all(np.abs(np.log(p / other)).max() > _APART for other in near):
                near.append(p)
                found.append(self._start(law, variant, law.scaled(p, factor), left))
        return found

    def _start(self, law: Law, variant: int, p: np.ndarray, left: float) -> Start:
        """The nuisances that go with sizes p (q,) of a law."""
        hypothesis = self.base.at(law, variant)
        (force,) = self.forces(law, variant, p[None])
        x, _ = self.begin(self._answered(-force), np.log(p))
        return Start(hypothesis, np.clip(x, *hypothesis.bounds), left)


def _as_measured(spectrum: Spectrum, hypothesis: Hypothesis, x: np.ndarray) -> Spectrum:
    """The record as its channels should have read it, by the errors that the hypothesis has at x (k,)."""
    if not hypothesis.parts:
        return spectrum
    measured, force = spectrum.series.measured, spectrum.series.force
    series = corrected(spectrum.series, read(hypothesis.sizes(x[None]), measured.shape[1], force.shape[1], 1))
    return spectrum if series is spectrum.series else replace(spectrum, series=series)


def allowed(place: Place, laws: list[Law] | None = None) -> list[Law]:
    """The laws that a first look tries at a place."""
    own = registry().values() if laws is None else laws
    if place.across is not None:
        return [law for law in own if law.at == ("body" if place.whole else "plane")]
    there = {"anywhere": True, "ground": place.ground, "link": place.scale.link > 0, "body": place.whole, "plane": False}
    return [law for law in own if law.key != "iwan" and there[law.at]]


def starts(looks: Iterable[Regression], laws: list[Law] | None = None) -> list[Start]:
    """Every law at every place that is looked at, that which leaves least first."""
    found = []
    for at in looks:
        for law in allowed(at.local.place, laws):
            options = [at.best(law, variant) for variant in law.variants_at(at.local.place.scale)]
            found += [one for one in options if one is not None]
    return sorted(found, key=lambda one: one.left)

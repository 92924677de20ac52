"""Which law at which place: the missing part of the record as the answer of the model to a force that follows from the motion.

The true structure answers y = S H (f - dZ u - B F(B'u, B'u')), H of the model as it is: linear in the sizes of dK, dC and F once
u is known. u is taken from the record, so that the fit has a closed form; it gives starts for `polish` and no verdict.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.time.free_force import Spectrum
from mouse_cli.diagnosis.time.hypothesis import Acting, Hypothesis, Place
from mouse_cli.terms.laws import Law, registry

_APART = 0.15  # of the logarithm of a size, from which on two starts are two
_BEGIN = 0.02  # share of the record whose states are not known well, left out


@dataclass(frozen=True)
class Start:
    """A law at a place with sizes that explain most of the missing part: x (k,) of `hypothesis`; left: its chi2."""

    hypothesis: Hypothesis
    x: np.ndarray
    left: float


@dataclass(frozen=True)
class Local:
    """All that a place needs: histories x, v (t,) of its motion, lines X (l,), answer (l, s) of sensors to a force there."""

    place: Place
    x: np.ndarray
    v: np.ndarray
    X: np.ndarray
    answer: np.ndarray


class Regression:
    """Regressions of one record at one place: nuisances are projected out once."""

    def __init__(self, spectrum: Spectrum, hypothesis: Hypothesis):
        self.spectrum, self.base = spectrum, hypothesis
        place = hypothesis.place
        U = spectrum.motions(np.stack([place.B, *(one.B for one in hypothesis.known)], axis=1))
        self._U = U
        X = U @ place.B
        both = np.concatenate([U, 1j * spectrum.w[:, None] * U], axis=1)
        self._states = spectrum.history(both).T
        self.spread = self._states.std(axis=1)
        histories = (spectrum.history(X * (1j * spectrum.w) ** order) for order in (0, 1))
        self.local = Local(place, *histories, X, spectrum.SH @ place.B)
        t = len(spectrum.series)
        self.kept = slice(int(_BEGIN * t), t - 2 * int(_BEGIN * t))
        self.missing = spectrum.missing + self._known()
        self.y = self._stacked(self.missing)
        self.J = np.stack([self._stacked(column) for column in self._nuisances(U)], axis=1)
        k = self.J.shape[1]
        self.Q, self.R = np.linalg.qr(np.vstack([self.J, np.eye(k)]))
        self.target = np.concatenate([self.y, np.zeros(k)])
        self.target -= self.Q @ (self.Q.T @ self.target)

    def _known(self) -> np.ndarray:
        """What the laws that the deck has already take off the outputs (t, s), at the motion of the record."""
        s, n, found = self.spectrum, len(self._states) // 2, np.zeros_like(self.spectrum.missing)
        for one in self.base.known:
            x, v = one.B @ self._states[:n], one.B @ self._states[n:]
            if one.law.states:
                F = stepped(one.law, x, v, one.p[:, None], one.words)[:, 0]
            else:
                F = one.law.force(x, v, None, one.p, **one.words)[0]
            found += s.history(s.line(F * s.window)[:, None] * (s.SH @ one.B)) * s.window[:, None]
        return found

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
        wanted = {int(sample): g for g, sample in enumerate(at)}
        for i in range(int(max(at)) + 1):
            _, z = law.force(x[i], v[i], z, p[:, None], **words)
            if i in wanted:
                found[:, :, wanted[i]] = z
        return found

    def _stacked(self, columns: np.ndarray) -> np.ndarray:
        return (columns / self.spectrum.series.sd)[self.kept].ravel()

    def _nuisances(self, U: np.ndarray) -> Iterator[np.ndarray]:
        """Answers (t, s) to forces -(dK + iw dC - w^2 dM) u of each nuisance."""
        s, w = self.spectrum, self.spectrum.w[:, None]
        for dM, dC, dK in zip(*self.base.linear.slopes, strict=True):
            force = U @ dK.T + 1j * w * (U @ dC.T) - w**2 * (U @ dM.T)
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
        A = self.local.answer / s.series.sd
        size = (np.abs(A) ** 2).sum(axis=1)
        G = -(A.conj() * E).sum(axis=1) / np.where(size > 1e-6 * size.max(), size, np.inf)
        return s.history(G)

    @property
    def nothing(self) -> float:
        """chi2 without any law, and the prior of the nuisances."""
        return float(self.target @ self.target)

    def forces(self, law: Law, variant: int, many: np.ndarray) -> Iterator[np.ndarray]:
        """Lines (l,) of the force of a law for each of its parameters (m, q)."""
        words, local, s = law.variants[variant], self.local, self.spectrum
        if law.states:
            found = stepped(law, local.x, local.v, many.T, words)
            yield from (s.line(column * s.window) for column in found.T)
            return
        for p in many:
            if law.linear:
                yield _stiffness(law.matrices(p, **words), s.w) * local.X
            else:
                yield s.line(law.force(local.x, local.v, None, p, **words)[0] * s.window)

    def best(self, law: Law, variant: int) -> Start | None:
        """The sizes of the law that leave least; None where no force of its sign leaves less than none."""
        return next(iter(self.apart(law, variant, 1)), None)

    def apart(self, law: Law, variant: int, most: int) -> list[Start]:
        """Up to `most` sizes of the law, that which leaves least first, each far from those before it in what is not linear."""
        many, s, tried = np.array(list(law.inner(self.local.place.scale))), self.spectrum, []
        for p, force in zip(many, self.forces(law, variant, many), strict=True):
            column = self._stacked(s.history(-force[:, None] * self.local.answer) * s.window[:, None])
            own = np.concatenate([column, np.zeros(self.J.shape[1])])
            own -= self.Q @ (self.Q.T @ own)
            size = float(own @ own)
            factor = float(own @ self.target) / size if size > 0 else 0.0
            if factor > 0:
                tried.append((self.nothing - factor**2 * size, p, factor))
        found, near = [], []
        for left, p, factor in sorted(tried, key=lambda one: one[0]):
            if len(found) < most and all(np.abs(np.log(p / other)).max() > _APART for other in near):
                near.append(p)
                found.append(self._start(law, variant, law.scaled(p, factor), left))
        return found

    def _start(self, law: Law, variant: int, p: np.ndarray, left: float) -> Start:
        """The nuisances that go with sizes p (q,) of a law."""
        hypothesis, s = self.base.at(law, variant), self.spectrum
        (force,) = self.forces(law, variant, p[None])
        column = self._stacked(s.history(-force[:, None] * self.local.answer) * s.window[:, None])
        z = np.linalg.solve(self.R, self.Q.T @ np.concatenate([self.y - column, np.zeros(self.J.shape[1])]))
        unknowns = hypothesis.unknowns
        p = np.clip(p, [u.lower for u in unknowns], [u.upper for u in unknowns])
        return Start(hypothesis, np.concatenate([z, np.zeros(len(self.base.offset)), np.log(p)]), left)


def _stiffness(matrices: tuple[np.ndarray, np.ndarray, np.ndarray], w: np.ndarray) -> np.ndarray:
    """Dynamic stiffness (l,) of a linear law against its motion, its own degrees of freedom eliminated."""
    K, C, M = matrices
    Z = K + 1j * w[:, None, None] * C - w[:, None, None] ** 2 * M
    if len(K) == 1:
        return Z[:, 0, 0]
    return Z[:, 0, 0] - (Z[:, :1, 1:] @ np.linalg.solve(Z[:, 1:, 1:], Z[:, 1:, :1]))[:, 0, 0]


def stepped(law: Law, x: np.ndarray, v: np.ndarray, p: np.ndarray, words: dict[str, float]) -> np.ndarray:
    """The forces (t, m) of a law with internal states along a motion (t,), for parameters (q, m)."""
    z, found = np.zeros((law.states, p.shape[1])), np.empty((len(x), p.shape[1]))
    for i in range(len(x)):
        found[i], z = law.force(x[i], v[i], z, p, **words)
    return found


def starts(spectrum: Spectrum, base: Hypothesis, places: list[Place], laws: list[Law] | None = None) -> list[Start]:
    """Every law at every place, that which leaves least first."""
    found = []
    for place in places:
        at = Regression(spectrum, base.placed(place))
        for law in laws or list(registry().values()):
            if (law.at == "ground" and not place.ground) or law.key == "iwan":
                continue
            options = [at.best(law, variant) for variant in range(len(law.variants))]
            found += [one for one in options if one is not None]
    return sorted(found, key=lambda one: one.left)

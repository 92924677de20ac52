"""What theory errs in all arrangements alike: in ln f of each mode, and by one matrix in those that are one model.

An error E of K, in coordinates of the modes of the model as it was given, has elements

    E_ii = 2 tau lambda_i g_ii,   E_ij = sqrt(2) tau sqrt(lambda_i lambda_j) g_ij,   g ~ N(0, 1),

for what acts on two modes does so by no more than on each, and an element beside the diagonal has half the variance of one on it;
see `modal/turning`. Modes psi_n of eigenvalues mu_n that an arrangement has, C in those coordinates, are off by

    d ln f_n = (C'EC)_nn / 2 mu_n,   d psi_n = sum_p (C'EC)_pn / (mu_n - mu_p) psi_p,

each turned by no more than 1. A model that is measured before and after something changed errs by one E in both: a few per cent of
scatter in members that no parameter has leave far more of shapes than sensors do, and yet nothing of what changed.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.data import Data
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.point import Point
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.dynamics.sensing import read
from mouse_cli.model.arrays import Matrix

_ALIKE = 1e-9  # share of the largest entry up to which matrices of two decks are the same
_BEYOND = 6  # modes towards which measured ones turn, beyond twice those of the test
_FELT = 1e-9  # of the sd of the data: an error that does no more is none
_UNSEEN = 1e-9  # share of the largest shape below which sensors see nothing of one


@dataclass(frozen=True)
class Modes:
    """Modes of an arrangement: eigenvalues (k,), motion (n, k), what sensors see of it (s, k), and which (m,) are measured.

    model: K and M (n, n) that err. origin: the modes of these, where a mechanism that was not given has changed them.
    """

    data: Data
    model: tuple[Matrix, Matrix]
    eigenvalues: np.ndarray
    motion: np.ndarray
    seen: np.ndarray
    which: np.ndarray
    origin: "Modes | None" = None

    @classmethod
    def of(cls, part: Reduced) -> "Modes":
        """Those of an arrangement as it is."""
        k = min(part.r, 2 * int(part.data.test.number.max()) + _BEYOND)
        lam, motion = np.maximum(part.eigenvalues[:k], 0.0), part.V[:, :k]
        seen = read(part.problem.test.measured_at, motion)
        return cls(part.data, part.assembly.matrices(part.theta), lam, motion, seen, part.data.pair(lam, seen))

    def at(self, model: Model, point: Point) -> "Modes | None":
        """The same as mechanisms in it have them; None where their model is not the one that errs."""
        V = model.base.V
        if len(V) != len(self.motion):
            return None
        k = max(len(self.eigenvalues), int(point.modes.max()) + 1)
        motion, own = V @ model.moved(point.X)[:, :k], point.eigenvalues[:k]
        return replace(self, eigenvalues=own, motion=motion, seen=point.seen[:, :k], which=point.modes, origin=self.given)

    @property
    def given(self) -> "Modes":
        """Without mechanisms."""
        return self.origin or self

    def same(self, other: "Modes") -> bool:
        """Whether one model errs in both."""
        pairs = zip(self.model, other.model, strict=True)
        return all(one.shape == two.shape and abs(one - two).max() <= _ALIKE * abs(one).max() for one, two in pairs)

    def within(self, first: "Modes") -> np.ndarray:
        """C (k0, k): these in coordinates of the modes of the model, `first`."""
        return first.motion.T @ (self.model[1] @ self.motion)


@dataclass(frozen=True)
class Errors:
    """What theory errs in `modes` of all arrangements alike, sd: tau."""

    modes: tuple[Modes, ...]
    sd: float

    @cached_property
    def numbers(self) -> np.ndarray:
        """Numbers (n,) of the measured modes."""
        return np.unique(np.concatenate([own.data.test.number for own in self.modes]))

    @cached_property
    def U(self) -> list[np.ndarray]:
        """What the errors, in their sd, do to the whitened data (q, n + c) of each arrangement; the first n are those of
        frequencies, by number of the mode.
        """
        found, further = [frequencies(own.data, self.numbers, self.sd) for own in self.modes], []
        for members in self.alike:
            group = [self.modes[i] for i in members]
            first, known = group[0].given, _known(group, self.numbers)
            i, j = np.triu_indices(len(first.eigenvalues))
            diagonal = np.flatnonzero(i == j)[list(known)]
            beside = [np.zeros((len(own), len(i) - len(known))) for own in found]
            for member, own in zip(members, group, strict=True):
                U = _by_matrix(own, first, i, j, self.sd)
                found[member][:, list(known.values())] = U[:, diagonal]
                beside[member] = np.delete(U, diagonal, axis=1)
            further.append(beside)
        return [np.hstack(own) for own in zip(found, *further, strict=True)]

    @cached_property
    def alike(self) -> list[list[int]]:
        """Numbers of the arrangements in which one model errs, of each model that several of them are."""
        found: list[list[int]] = []
        for i, own in enumerate(self.modes):
            same = next((members for members in found if own.same(self.modes[members[0]])), None)
            if same is None:
                found.append([i])
            else:
                same.append(i)
        return [members for members in found if len(members) > 1]

    def whitened(self, values: np.ndarray) -> np.ndarray:
        """(I + U U')^-1/2 times values (q,) or (q, .), whitened by what each test states."""
        B, by, _ = self._whitening
        return values - B @ (by * (B.T @ values).T).T

    @property
    def log_size(self) -> float:
        """ln |I + U U'|."""
        return self._whitening[2]

    @cached_property
    def _whitening(self) -> tuple[np.ndarray, np.ndarray, float]:
        """B (q, c) and h (c,), (I + U U')^-1/2 = I - B h B', see `modal/data`; and ln |I + U U'|."""
        U = np.vstack(self.U)
        x, W = np.linalg.eigh(U.T @ U)
        felt = x > _FELT
        length = np.sqrt(1 + x[felt])
        return U @ W[:, felt], 1 / (length * (1 + length)), float(2 * np.log(length).sum())


def frequencies(data: Data, numbers: np.ndarray, sd: float) -> np.ndarray:
    """U (q, n) of the frequencies of one arrangement, each mode of which errs by itself."""
    rows = np.flatnonzero(data.has_frequency)
    found = np.zeros((len(data.modes), len(numbers)))
    found[np.arange(len(rows)), np.searchsorted(numbers, data.test.number[rows])] = sd / data.sd_log[rows]
    return found


def _known(group: list[Modes], numbers: np.ndarray) -> dict[int, int]:
    """Modes of the model that were measured, and the place of the number of each."""
    found: dict[int, int] = {}
    first = group[0].given
    for own in group:
        nearest = np.abs(own.within(first)[:, own.which]).argmax(axis=0)
        places = np.searchsorted(numbers, own.data.test.number)
        for mode, place in zip(nearest.tolist(), places.tolist(), strict=True):
            if mode not in found and place not in found.values():
                found[mode] = place
    return found


def _by_matrix(own: Modes, first: Modes, i: np.ndarray, j: np.ndarray, sd: float) -> np.ndarray:
    """U (q, c) of one arrangement by the elements (i, j) (c,) of E in the modes `first` of the model."""
    data, n, mu, lam = own.data, own.which, np.maximum(own.eigenvalues, 0.0), first.eigenvalues
    C = own.within(first)
    size = np.sqrt(2 * lam[i] * lam[j]) * sd  # on the diagonal, where both products are one, half of E_ii
    size[i == j] /= np.sqrt(2)
    E = (C[i][:, :, None] * C[j][:, None, n] + C[j][:, :, None] * C[i][:, None, n]) * size[:, None, None]  # (c, k, m)
    apart = mu[n] - mu[:, None]
    least = np.sqrt(2 * mu[n] * mu[:, None]) * sd
    by = np.where(apart < 0, -1.0, 1.0) / np.maximum(np.maximum(np.abs(apart), least), 1e-300)
    by[n, np.arange(len(n))] = 0.0
    moved = np.einsum("sp,cpm->smc", own.seen, E * by, optimize=True)
    return data.jacobian(mu[n], own.seen[:, n], _scales(own), E[:, n, np.arange(len(n))].T, moved)


def _scales(own: Modes) -> np.ndarray:
    """Scales (m,) by which the shapes of the model are as long as the measured ones, and of their sign."""
    data = own.data
    f, y = np.where(data.has_shape, own.seen[:, own.which], 0.0), np.where(data.has_shape, data.test.shapes, 0.0)
    size = np.linalg.norm(f, axis=0)
    length = np.linalg.norm(y, axis=0) / np.maximum(size, max(_UNSEEN * size.max(initial=0.0), 1e-100))
    return np.where((f * y).sum(axis=0) < 0, -1.0, 1.0) * (length if data.scaled else 1.0)

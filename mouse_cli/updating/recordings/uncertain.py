"""What is uncertain in the linear model of a deck: its parameters, and stiffness and damping of every part they do not reach.

A parameter that is left out of a fit is found again as physics. So each link between two degrees of freedom, and from each to
the ground, may be stiffer or softer and damped otherwise, whether or not the deck has a parameter for it.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.model.arrays import Matrix, dense
from mouse_cli.model.problem import Problem
from mouse_cli.terms.assembly import assembly
from mouse_cli.updating.coordinates import coordinates
from mouse_cli.updating.recordings.basis import LARGEST, along, basis_of
from mouse_cli.updating.recordings.damping import UNDAMPED, by_ratios, structural
from mouse_cli.updating.recordings.linear import Linear

LOOSE = 2.0  # sd of the damping ratio assumed of each mode where the deck has no damping, by its value
# Sd at least of the damping ratio of a mode where the deck has damping: air, joints and supports add to it
LEFT_OUT = 0.01
_PUSHES = 1e-6  # of the largest value of a link: below zero by rounding
_MOST_LINKED = 400  # degrees of freedom of a model all of whose links are looked at
_Named = list[tuple[str, np.ndarray]]  # matrices (n, n) with the names of what they belong to
Own = Callable[[np.ndarray], tuple[np.ndarray, ...]]  # M, C, K at the nuisances
_STEP = 1e-4  # of finite differences, in prior sd


@dataclass(frozen=True)
class Links:
    """Motions B (n, l) along which a matrix acts between two degrees of freedom or to the ground, and its values (l,)."""

    B: np.ndarray
    values: np.ndarray

    @property
    def springs(self) -> bool:
        """Whether each of them is one: beams and condensed models have entries that would push, and no link by itself."""
        return bool((self.values > -_PUSHES * np.abs(self.values).max(initial=0.0)).all())


def links(K: Matrix) -> Links | None:
    """The links of K = sum of values B B', B = e_i - e_j or e_i; None where it is not made of few of them."""
    from scipy.sparse import coo_array

    n, entries = K.shape[0], coo_array(K)
    least = 1e-9 * np.abs(entries.data).max(initial=0.0)
    own = (entries.row < entries.col) & (np.abs(entries.data) > least)
    pairs = sorted(zip(entries.row[own].tolist(), entries.col[own].tolist(), strict=True))
    ground = np.flatnonzero(np.abs(K.sum(axis=1)) > least)
    if len(pairs) > 2 * n or n > _MOST_LINKED:
        return None
    K = K if isinstance(K, np.ndarray) else K.tocsr()
    B, values = np.zeros((n, len(pairs) + len(ground))), []
    for l, (i, j) in enumerate(pairs):
        B[i, l], B[j, l] = -1.0, 1.0
        values.append(-K[i, j])
    for l, i in enumerate(ground, len(pairs)):
        B[i, l] = 1.0
        values.append(K[i].sum())
    return Links(B, np.array(values))


@dataclass(frozen=True)
class Uncertain:
    """The linear model in the coordinates in which it is simulated: u = basis q, basis (n, m); remarks on what was assumed.

    along (m, n): q = along u of motions as a rigid body. theta(z (own,)): values of the parameters of the deck, which are the first
    `own` nuisances. bare: the deck has no damping, so that it is assumed.
    """

    linear: Linear
    basis: np.ndarray
    along: np.ndarray
    theta: Callable[[np.ndarray], np.ndarray]
    own: int
    remarks: tuple[str, ...]
    bare: bool = False


def uncertain(problem: Problem, highest_hz: float, at: np.ndarray) -> Uncertain:
    """The model of a deck, and all that is uncertain in it; see `basis_of` for `highest_hz` and `at` (n, q)."""
    found = assembly(problem)
    where = coordinates(problem, found)
    L = np.diag(where.L) if where.L.ndim == 1 else where.L
    k = L.shape[1]
    value = lambda z: where.value(where.mean + L @ z)
    bends = any(label[-2:-1] == "R" for label in problem.structure.labels)  # with modes far above any record
    V = basis_of(*found.matrices(value(np.zeros(k))), highest_hz, at, 0 if bends else LARGEST)
    reduce = lambda matrix: V.T @ (matrix @ V)

    stated = problem.modal_damping
    bare = stated is None and not any(m is not None for m in found.damping(value(np.zeros(k))))

    def given(z: np.ndarray) -> list[np.ndarray | None]:
        """K, M, C, D as the deck has them."""
        every = *found.matrices(value(z)), *found.damping(value(z))
        return [None if m is None else reduce(dense(m)) for m in every]

    K, M, _, D = given(np.zeros(k))
    apart = by_ratios(K, M, stated) if bare or stated is not None else np.zeros_like(K)

    def own(z: np.ndarray) -> tuple[np.ndarray, ...]:
        K, M, C, D = given(z)
        return M, apart + (0 if C is None else C) + (0 if D is None else structural(K, M, D)), K

    by_modes = apart if D is None else apart + structural(K, M, D)
    steady = found.linear and not where.logarithmic.any()
    linear, said = completed(problem, own, _names(problem, k), bare, steady, problem.structure.labels, by_modes)
    return Uncertain(linear, V, along(V, found.matrices(value(np.zeros(k)))[1]), value, k, said, bare)


def completed(
    problem: Problem, own: Own, names: list[str], bare: bool, steady: bool, labels: tuple[str, ...], by_modes: np.ndarray
) -> tuple[Linear, tuple[str, ...]]:  # fmt: skip
    """The linear model whose named nuisances z (k,) make M, C, K = own(z), and what they do not reach; what to say of it.

    bare: its damping is assumed; steady: own is linear in z; labels: of its degrees of freedom; by_modes (n, n): what of C is.
    """
    k = len(names)
    M, C, K = own(np.zeros(k))
    slopes = [np.zeros((k, *K.shape)) for _ in range(3)]
    for j in range(k):
        ends = [own(sign * _STEP * np.eye(k)[j]) for sign in (1, -1)]
        for slope, up, down in zip(slopes, *ends, strict=True):
            slope[j] = (up - down) / (2 * _STEP)
    by = problem.theory.link_stiffness, LOOSE if bare else problem.theory.link_damping
    extra = _extra(M, C, K, slopes, bare, labels, by)
    each = lambda z: by_modes + np.einsum("pe,eij->pij", extra.moved(z[:, k:])[:, extra.modal], extra.dC[extra.modal])
    linear = replace(_linear(own, (M, C, K), slopes, extra, names, steady), by_modes=each)
    return linear, _remarks(bare, len(extra.names), by)


@dataclass(frozen=True)
class _Extra:
    """dC, dK (e, n, n) of what the deck's own parameters do not move, a step of one sd; share (e,): that sd by the value.

    modal (e,): whether it is the damping of a mode.
    """

    dC: np.ndarray
    dK: np.ndarray
    share: np.ndarray
    names: list[str]
    modal: np.ndarray

    def moved(self, z: np.ndarray) -> np.ndarray:
        """Steps (P, e) at z (P, e): what is softer or less damped by many sd tends to nothing and never turns negative."""
        return np.where(z < 0, np.expm1(np.minimum(self.share * z, 0.0)) / self.share, z)

    def stepped(self, y: np.ndarray) -> np.ndarray | None:
        """z (e,) at steps y (e,): the inverse of `moved`; None where a part would be less than nothing."""
        if (self.share * y <= -1).any():
            return None
        return np.where(y < 0, np.log1p(np.minimum(self.share * y, 0.0)) / self.share, y)


def _extra(M, C, K, slopes, bare: bool, labels: tuple[str, ...], by: tuple[float, float]) -> _Extra:
    """Links, or modes, that the deck's own parameters do not move; where the deck has no damping, that of both."""
    at, (stiffer, loose) = links(K), by
    at = at if at is not None and at.springs and len(labels) == len(K) else None  # coordinates of modes have no links
    stiff = _by_mode(M, K) if at is None else _by_link(at, labels)
    own = _beyond([d for _, d in stiff], slopes[2])
    found = [(np.zeros_like(K), stiffer * d, stiffer, f"stiffness {name}") for name, d in (stiff[i] for i in own)]
    damped = _modal(M, C, K, loose)
    modes = len(damped)
    if at is not None:
        damped += [(loose * d, loose, name) for name, d in _dashpots(at, K, M, C, labels, bare)]
    # a parameter that moves stiffness, and damping in proportion, leaves the damping alone uncertain
    size = [np.linalg.norm(one) or 1.0 for one in (C, K)]
    both = lambda c, k: np.concatenate([c / size[0], k / size[1]], axis=-1)
    own = _beyond([both(d, np.zeros_like(K)) for d, _, _ in damped], both(slopes[1], slopes[2]))
    found += [(d, np.zeros_like(K), share, f"damping {name}") for d, share, name in (damped[i] for i in own)]
    modal = np.array([False] * (len(found) - len(own)) + [i < modes for i in own], bool)
    C, K = (np.array([one[i] for one in found]).reshape(-1, *K.shape) for i in (0, 1))
    return _Extra(C, K, np.array([one[2] for one in found]), [one[3] for one in found], modal)


def _by_link(at: Links, labels: tuple[str, ...]) -> _Named:
    """What each link is worth, by its name."""
    found = []
    for value, b in zip(at.values, at.B.T, strict=True):
        ends = [labels[i] for i in np.flatnonzero(b)]
        found.append((f"between {' and '.join([*ends, 'the ground'][:2])}", value * np.outer(b, b)))
    return found


def _dashpots(at: Links, K: np.ndarray, M: np.ndarray, C: np.ndarray, labels: tuple[str, ...], bare: bool) -> _Named:
    """Damping of each link, and of what only a dashpot links; of links alone where damping is assumed."""
    w = np.sqrt(np.median(np.diag(K) / np.diag(M))) or 1.0
    i, j = np.array([np.flatnonzero(b)[[0, -1]] for b in at.B.T], int).reshape(-1, 2).T
    own, usual = np.where(i == j, C.sum(axis=1)[i], -C[i, j]), 2 * UNDAMPED * at.values / w
    own = usual if bare else np.where(np.abs(own) > 0.01 * np.abs(usual), own, 0.1 * usual)
    found = _by_link(Links(at.B, own), labels)
    alone = links(C)
    if alone is None or bare:
        return found
    others = _by_link(alone, labels)
    return found + [others[i] for i in _beyond([d for _, d in others], np.array([d for _, d in found]))]


def _by_mode(M: np.ndarray, K: np.ndarray) -> _Named:
    """What each mode is worth of the stiffness, by its name."""
    from scipy.linalg import eigh

    values, shapes = eigh(K, M)
    return [
        (f"of mode {i}", v * np.outer(m, m)) for i, (v, m) in enumerate(zip(values, (M @ shapes).T, strict=True), 1)
    ]


def _modal(M: np.ndarray, C: np.ndarray, K: np.ndarray, loose: float) -> list[tuple[np.ndarray, float, str]]:
    """Damping of each mode: a step of one sd, that sd by the value, and the name.

    What a deck leaves out is no share of what it has: the sd of 2 zeta w is `loose` of it, and that of LEFT_OUT at least.
    """
    from scipy.linalg import eigh

    values, shapes = eigh(K, M)
    own = np.einsum("ij,ik,kj->j", shapes, C, shapes)
    sd = np.maximum(loose * own, 2 * LEFT_OUT * np.sqrt(np.maximum(values, 0.0)))
    parts = enumerate(zip(own, sd, (M @ shapes).T, strict=True), 1)
    return [(s * np.outer(m, m), s / max(d, 1e-9 * s), f"of mode {i}") for i, (d, s, m) in parts if s > 0]


def _beyond(candidates: list[np.ndarray], known: np.ndarray) -> list[int]:
    """Indices of those of `candidates` that no combination of `known` (k, ...) makes."""
    columns = known.reshape(len(known), int(np.prod(known.shape[1:]))).T
    norms = np.linalg.norm(columns, axis=0)
    columns = columns[:, norms > 0] / norms[norms > 0]
    found = []
    for i, one in enumerate(candidates):
        rest = one.ravel()
        if columns.shape[1]:
            rest = rest - columns @ np.linalg.lstsq(columns, rest, rcond=None)[0]
        if np.linalg.norm(rest) > 1e-6 * np.linalg.norm(one) > 0:
            found.append(i)
    return found


def _linear(own, mean, slopes, extra: _Extra, names: list[str], steady: bool) -> Linear:
    k, whole = (
        len(names),
        (
            np.concatenate([slopes[0], np.zeros_like(extra.dC)]),
            np.concatenate([slopes[1], extra.dC]),
            np.concatenate([slopes[2], extra.dK]),
        ),
    )

    def matrices(z: np.ndarray):
        z = np.column_stack([z[:, :k], extra.moved(z[:, k:])])
        if steady:
            return tuple(m + np.einsum("pk,kij->pij", z, d) for m, d in zip(mean, whole, strict=True))
        parts = (np.stack(one) for one in zip(*(own(row[:k]) for row in z), strict=True))
        moved = (0.0, np.einsum("pk,kij->pij", z[:, k:], extra.dC), np.einsum("pk,kij->pij", z[:, k:], extra.dK))
        return tuple(part + d for part, d in zip(parts, moved, strict=True))

    scaled = _scaled(mean, whole, extra, k) if steady else lambda z, s: None
    return Linear(*mean, matrices, whole, (*names, *extra.names), scaled)


def _scaled(mean, slopes, extra: _Extra, k: int) -> Callable[[np.ndarray, float], np.ndarray | None]:
    """How nuisances scale M, C and K alike: with M = M0 + sum y dM and M0 = sum y0 dM, C and K so too, y -> s y + (s - 1) y0."""
    size = [np.abs(one).max() or 1.0 for one in mean]
    target = np.concatenate([one.ravel() / norm for one, norm in zip(mean, size, strict=True)])
    columns = [d.reshape(len(d), -1) / norm for d, norm in zip(slopes, size, strict=True)]
    A = np.concatenate(columns, axis=1).T
    y0 = np.linalg.lstsq(A, target, rcond=None)[0] if A.shape[1] else np.zeros(0)
    if np.abs(A @ y0 - target).max() > 1e-6:
        return lambda z, s: None

    def scaled(z: np.ndarray, s: float) -> np.ndarray | None:
        y = s * np.concatenate([z[:k], extra.moved(z[k:])]) + (s - 1) * y0
        own = extra.stepped(y[k:])
        return None if own is None else np.concatenate([y[:k], own])

    return scaled


def _names(problem: Problem, k: int) -> list[str]:
    """Of the deck's own parameters, or of the directions in which their prior lets them move."""
    own = [one.name for one in problem.parameters]
    return own if len(own) == k else [f"direction {i} of the parameters" for i in range(1, k + 1)]


def _remarks(bare: bool, extra: int, by: tuple[float, float]) -> tuple[str, ...]:
    said = ()
    if extra:
        said += (
            f"beside the parameters of the deck, stiffness (sd {100 * by[0]:g} %) and damping "
            f"(sd {100 * by[1]:g} %) of each part and mode that they do not reach were free: {extra} in all",
        )
    if bare:
        said += (
            f"the deck has no damping: {100 * UNDAMPED:g} % of critical was assumed of each mode, "
            f"with an sd of {100 * UNDAMPED * LOOSE:g} %",
        )
    return said

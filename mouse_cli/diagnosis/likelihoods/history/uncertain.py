"""What is uncertain in the linear model of a deck: its parameters, and stiffness and damping of every part they do not reach.

A parameter that is left out of a fit is found again as physics. So each link between two degrees of freedom, and from each to
the ground, may be stiffer or softer and damped otherwise, by the errors of theory of the deck, whether or not it has a parameter
for it.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.likelihoods.history.linear import Linear
from mouse_cli.model.arrays import Matrix, dense
from mouse_cli.model.problem import Problem
from mouse_cli.model.theory import Theory
from mouse_cli.terms.assembly import assembly
from mouse_cli.updating.coordinates import coordinates

UNDAMPED = 0.01  # damping ratio assumed where the deck has no damping; its sd is as large
LARGEST = 40  # degrees of freedom that are simulated as they are; larger models by modes
_MOST_MODES = 60
_MOST_LINKED = 400  # degrees of freedom of a model all of whose links are looked at
_STEP = 1e-4  # of finite differences, in prior sd


@dataclass(frozen=True)
class Links:
    """Motions B (n, l) along which a matrix acts between two degrees of freedom or to the ground, and its values (l,)."""

    B: np.ndarray
    values: np.ndarray


def links(K: Matrix) -> Links | None:
    """The links of K = sum of values B B', B = e_i - e_j or e_i; None where it is not made of few of them."""
    from scipy.sparse import coo_array

    n, entries = K.shape[0], coo_array(K)
    least = 1e-9 * np.abs(entries.data).max()
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

    theta(z (own,)): values of the parameters of the deck, which are the first `own` nuisances.
    """

    linear: Linear
    basis: np.ndarray
    theta: Callable[[np.ndarray], np.ndarray]
    own: int
    remarks: tuple[str, ...]


def uncertain(problem: Problem, highest_hz: float, at: np.ndarray) -> Uncertain:
    """The model of a deck, and all that is uncertain in it; see `_basis` for `highest_hz` and `at` (n, q)."""
    found = assembly(problem)
    where = coordinates(problem, found)
    L = np.diag(where.L) if where.L.ndim == 1 else where.L
    k = L.shape[1]
    value = lambda z: where.value(where.mean + L @ z)
    V = _basis(*found.matrices(value(np.zeros(k))), highest_hz, at)
    reduce = lambda matrix: V.T @ (matrix @ V)

    def own(z: np.ndarray) -> tuple[np.ndarray, ...]:
        theta = value(z)
        K, M = (reduce(dense(m)) for m in found.matrices(theta))
        C, D = (None if m is None else reduce(dense(m)) for m in found.damping(theta))
        return M, _viscous(K, M, C, D), K

    M, C, K = own(np.zeros(k))
    slopes = [np.zeros((k, *K.shape)) for _ in range(3)]
    for j in range(k):
        ends = [own(sign * _STEP * np.eye(k)[j]) for sign in (1, -1)]
        for slope, up, down in zip(slopes, *ends, strict=True):
            slope[j] = (up - down) / (2 * _STEP)
    sizes = _sizes(problem.theory, not any(m is not None for m in found.damping(value(np.zeros(k)))))
    extra = _extra(M, C, K, slopes, sizes)
    steady = found.linear and not where.logarithmic.any()
    linear = _linear(own, (M, C, K), slopes, extra, k, steady)
    return Uncertain(linear, V, value, k, _remarks(sizes, len(extra[2])))


def _basis(K: Matrix, M: Matrix, highest_hz: float, at: np.ndarray) -> np.ndarray:
    """The degrees of freedom themselves; of a larger model the modes up to `highest_hz`, and what the others add by their static
    flexibility at the motions `at` (n, q), those of sensors and forces.
    """
    n = K.shape[0]
    if n <= LARGEST:
        return np.eye(n)
    from scipy.linalg import eigh
    from scipy.sparse import csc_array
    from scipy.sparse.linalg import splu

    from mouse_cli.dynamics.solver import EigenSolver

    limit = (2 * np.pi * highest_hz) ** 2
    found = EigenSolver().solve(K, M, min(_MOST_MODES, n))
    modes = np.asarray(found.shapes)[:, :_MOST_MODES][:, found.eigenvalues[:_MOST_MODES] < limit]
    static = splu(csc_array(K + limit * M)).solve(np.ascontiguousarray(at))
    static -= modes @ np.linalg.solve(modes.T @ (M @ modes), modes.T @ (M @ static))
    own, shares = np.linalg.svd(static / np.maximum(np.linalg.norm(static, axis=0), 1e-300), full_matrices=False)[:2]
    V = np.column_stack([modes, own[:, shares > 1e-6 * shares.max()]])
    return V @ eigh(V.T @ (K @ V), V.T @ (M @ V))[1]


def _viscous(K: np.ndarray, M: np.ndarray, C: np.ndarray | None, D: np.ndarray | None) -> np.ndarray:
    """C; structural damping as the viscous one that damps each mode as much; UNDAMPED where the deck has none."""
    found = np.zeros_like(K) if C is None else C
    if C is not None and D is None:
        return found
    from scipy.linalg import eigh

    values, shapes = eigh(K, M)
    w, weighted = np.sqrt(np.maximum(values, 1e-12 * values.max())), M @ shapes
    ratio = UNDAMPED * np.ones(len(w)) if D is None else np.einsum("ij,ik,kj->j", shapes, D, shapes) / w**2 / 2
    return found + (weighted * 2 * ratio * w) @ weighted.T


@dataclass(frozen=True)
class _Sizes:
    """sd of stiffness and of damping of a link, as shares of them; bare: the deck has no damping, and that of a link is assumed."""

    stiffness: float
    damping: float
    bare: bool


def _sizes(theory: Theory, bare: bool) -> _Sizes:
    return _Sizes(theory.link_stiffness, 1.0 if bare else theory.link_damping, bare)


def _extra(M, C, K, slopes, by: _Sizes) -> tuple[np.ndarray, np.ndarray, list[str]]:
    """dC, dK (e, n, n) of the links, or of the modes, that the deck's own parameters do not move; and their names."""
    at = links(K)
    dK, dC = _by_link(at, K, M, C, by) if at is not None else _by_mode(M, C, K, by)
    found = [(np.zeros_like(K), d, "stiffness") for d in _beyond(dK, slopes[2])]
    # a parameter that moves stiffness, and damping in proportion, leaves the damping alone uncertain
    both = lambda c, k: np.concatenate([c / np.linalg.norm(C), k / np.linalg.norm(K)], axis=-1)
    free = _beyond([both(d, np.zeros_like(K)) for d in dC], both(slopes[1], slopes[2]))
    found += [(d[:, : len(K)] * np.linalg.norm(C), np.zeros_like(K), "damping") for d in free]
    C, K = (np.array([one[i] for one in found]).reshape(-1, *K.shape) for i in (0, 1))
    return C, K, [f"{name} {i}" for i, (_, _, name) in enumerate(found, 1)]


def _by_link(at: Links, K: np.ndarray, M: np.ndarray, C: np.ndarray, by: _Sizes) -> tuple[list, list]:
    w = np.sqrt(np.median(np.diag(K) / np.diag(M)))
    pairs = [np.outer(b, b) for b in at.B.T]
    i, j = (np.array([np.flatnonzero(b)[end] for b in at.B.T]) for end in (0, -1))
    own = np.where(i == j, C.sum(axis=1)[i], -C[i, j])
    usual = 2 * UNDAMPED * at.values / w
    own = usual if by.bare else np.where(np.abs(own) > 0.01 * np.abs(usual), own, 0.1 * usual)
    return [by.stiffness * value * pair for value, pair in zip(at.values, pairs, strict=True)], [
        by.damping * value * pair for value, pair in zip(own, pairs, strict=True)
    ]


def _by_mode(M: np.ndarray, C: np.ndarray, K: np.ndarray, by: _Sizes) -> tuple[list, list]:
    from scipy.linalg import eigh

    values, shapes = eigh(K, M)
    weighted = M @ shapes
    pairs = [np.outer(m, m) for m in weighted.T]
    damped = np.einsum("ij,ik,kj->j", shapes, C, shapes)
    return [by.stiffness * v * pair for v, pair in zip(values, pairs, strict=True)], [
        by.damping * c * pair for c, pair in zip(damped, pairs, strict=True)
    ]


def _beyond(candidates: list[np.ndarray], known: np.ndarray) -> list[np.ndarray]:
    """Those of `candidates` that no combination of `known` makes."""
    columns = known.reshape(len(known), -1).T
    norms = np.linalg.norm(columns, axis=0)
    columns = columns[:, norms > 0] / norms[norms > 0]
    found = []
    for one in candidates:
        rest = one.ravel()
        if columns.shape[1]:
            rest = rest - columns @ np.linalg.lstsq(columns, rest, rcond=None)[0]
        if np.linalg.norm(rest) > 1e-6 * np.linalg.norm(one) > 0:
            found.append(one)
    return found


def _linear(own, mean, slopes, extra, k: int, steady: bool) -> Linear:
    dC, dK, names = extra
    whole = (
        np.concatenate([slopes[0], np.zeros_like(dC)]),
        np.concatenate([slopes[1], dC]),
        np.concatenate([slopes[2], dK]),
    )

    def matrices(z: np.ndarray):
        if steady:
            return tuple(m + np.einsum("pk,kij->pij", z, d) for m, d in zip(mean, whole, strict=True))
        parts = (np.stack(one) for one in zip(*(own(row[:k]) for row in z), strict=True))
        moved = (0.0, np.einsum("pk,kij->pij", z[:, k:], dC), np.einsum("pk,kij->pij", z[:, k:], dK))
        return tuple(part + d for part, d in zip(parts, moved, strict=True))

    return Linear(*mean, matrices, whole, tuple(f"parameter {i + 1}" for i in range(k)) + tuple(names))


def _remarks(by: _Sizes, extra: int) -> tuple[str, ...]:
    said = ()
    if extra:
        said += (
            f"beside the parameters of the deck, stiffness (sd {100 * by.stiffness:g} %) and damping "
            f"(sd {100 * by.damping:g} %) of each part that they do not reach were free: {extra} in all",
        )
    if by.bare:
        said += (f"the deck has no damping: {100 * UNDAMPED:g} % of critical was assumed, with as large an sd",)
    return said

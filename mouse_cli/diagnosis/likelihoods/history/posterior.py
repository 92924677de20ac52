"""The model of a fit of modes as recordings see it: its mechanisms in it, and all that modes leave uncertain its nuisances.

With C(x) the misfit of modes at x, expanded about a point as C0 + (x - m)' H (x - m), the prior of x for the recordings is
N(m, H^-1), what modes have made of it, and with the evidence of Laplace for either (MacKay, Information Theory, Inference and
Learning Algorithms, 28)

    ln Z(modes, records) = ln Z(modes) + ln Z(records | modes).

Each prior counts once. Where records lead far from the optimum of the modes, C is expanded anew where they lead.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from mouse_cli.diagnosis.evidence import capped
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.model.arrays import dense
from mouse_cli.model.problem import Problem
from mouse_cli.updating.recordings.basis import LARGEST, basis_of
from mouse_cli.updating.recordings.damping import by_ratios, structural
from mouse_cli.updating.recordings.uncertain import Uncertain, completed


@dataclass(frozen=True)
class Posterior:
    """What modes say of x (k + t,) = [z, c]: N(mean, H^-1), H (k + t, k + t); gained: of ln Z against that of their optimum."""

    one: Fit
    mean: np.ndarray
    H: np.ndarray
    gained: float = 0.0

    @property
    def root(self) -> np.ndarray:
        """R (k + t, k + t) with R R' = H^-1: x = mean + R y, y ~ N(0, I)."""
        return np.linalg.inv(np.linalg.cholesky(self.H)).T

    def x(self, y: np.ndarray) -> np.ndarray:
        """x (k + t,) at y, sizes within their ranges."""
        found, k = self.mean + self.root @ y, self.one.model.k
        found[k:] = np.clip(found[k:], *self.one.model.bounds.T)
        return found


def posterior(one: Fit) -> Posterior:
    """At the optimum of the modes."""
    return Posterior(one, one.point.x, capped(one.hessian, one.model.width))


def expanded(first: Posterior, x: np.ndarray) -> Posterior | None:
    """The same about x (k + t,); None where the modes have no model there."""
    one, k = first.one, first.one.model.k
    at = one.model.point(x)
    if at is None:
        return None
    own = np.arange(len(x)) < k
    T = one.model.jacobian(at)
    H = capped(T.T @ T + np.diag(own.astype(float)), one.model.width)
    pull = T.T @ at.residual - np.where(own, x, 0.0)
    step = np.linalg.solve(H, pull)
    least = at.chi2 + float(x[:k] @ x[:k] - pull @ step)
    size = np.linalg.slogdet(H)[1] - np.linalg.slogdet(first.H)[1]
    return Posterior(one, x + step, H, -0.5 * float(least - one.misfit + size))


def modelled(known: Posterior, problem: Problem, highest_hz: float, at: np.ndarray) -> Uncertain:
    """The model of a fit of modes, what modes leave of its x uncertain, and what they do not reach; see `uncertain`."""
    base, mean = known.one.model.base, known.mean
    G, A = _coordinates(known.one)
    matrices = lambda x: tuple(G.T @ matrix @ G for matrix in _matrices(known.one, x))
    W = basis_of(*matrices(mean)[:2], highest_hz, A.T @ at)
    own_dofs = A.shape[1] - base.V.shape[1]
    theta = lambda y: _theta(known, known.x(y))
    stated = problem.modal_damping
    bare = stated is None and not any(m is not None for m in base.assembly.damping(theta(np.zeros(len(mean)))))
    reduce = lambda matrix: W.T @ matrix @ W
    apart = by_ratios(*(reduce(matrix) for matrix in matrices(mean)[:2]), stated) if bare or stated is not None else 0.0

    def damped(x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """M, K, the whole of the damping and what of it is by modes."""
        K, M, C, D = (reduce(matrix) for matrix in matrices(x))
        C0, D0 = base.assembly.damping(_theta(known, x))
        C, D = (m if n is None else m + reduce(A.T @ dense(n) @ A) for m, n in ((C, C0), (D, D0)))
        by_modes = apart + structural(K, M, D)
        return M, K, C + by_modes, by_modes

    @lru_cache(maxsize=512)  # perturbed initial states ask for the same x again
    def at_bytes(y: bytes) -> tuple[np.ndarray, ...]:
        M, K, C, _ = damped(known.x(np.frombuffer(y)))
        return M, C, K

    names = [f"direction {i} of what modes leave uncertain" for i in range(1, len(mean) + 1)]
    labels = (*base.problem.structure.labels, *(f"own {i}" for i in range(1, own_dofs + 1)))
    own = lambda y: at_bytes(np.ascontiguousarray(y).tobytes())
    linear, said = completed(problem, own, names, bare, False, labels, damped(mean)[3])
    along = np.linalg.lstsq(W, _carried(A, matrices(mean)[0], base.V.shape[1]), rcond=None)[0]
    return Uncertain(linear, A @ W, along, theta, len(mean), said, bare)


def _carried(A: np.ndarray, K: np.ndarray, r: int) -> np.ndarray:
    """Coordinates (size, n) of motions of the deck; those of mechanisms, behind the first r, as their springs carry them along."""
    first = np.linalg.pinv(A[:, :r])
    return np.concatenate([first, -np.linalg.lstsq(K[r:, r:], K[r:, :r] @ first, rcond=None)[0]])


def _theta(known: Posterior, x: np.ndarray) -> np.ndarray:
    """Values (p,) of the deck's parameters."""
    base = known.one.model.base
    return base.parameters(x[: known.one.model.k])[: len(base.problem.parameters)]


def _coordinates(one: Fit) -> tuple[np.ndarray, np.ndarray]:
    """G (size, size): coordinates of the reduced model by those of the simulation; A (n, size): motion of the deck by the latter.

    They are degrees of freedom, with those of the mechanisms behind them, of a small model that keeps all of its modes.
    """
    V, size = one.model.base.V, one.model.size
    n, r = V.shape
    G, A = np.eye(size), np.zeros((n, size))
    A[:, :r] = V
    if n == r and n <= LARGEST:
        G[:r, :r] = np.linalg.inv(V)
        A = np.eye(n, size)
    return G, A


def _matrices(one: Fit, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """K, M, and C, D (size, size) of the mechanisms alone, at x (k + t,)."""
    model, r = one.model, one.model.base.r
    K, M, _ = model.added(x)
    for into, own in zip((K, M), model.base.matrices(x[: model.k]), strict=True):
        into[:r, :r] += own
    C, D = np.zeros((2, *K.shape))
    for at, change in zip(model.places, model.changes(x[model.k :]), strict=True):
        for into, own in ((C, change.C), (D, change.D)):
            if own is not None:
                into[np.ix_(at, at)] += own
    return K, M, C, D

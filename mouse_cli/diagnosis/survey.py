"""A first look over a large model: at which degrees of freedom a force could make the measured shapes.

The same matching as `locate`, at the update alone: what the parameters leave uncertain of the shapes of the model as it is, times
the misfit of the update, stands for what they leave uncertain of S R(lambda) B, so that every place costs a few products.
"""

import numpy as np

from mouse_cli.diagnosis.fit import Fit, Model, fit
from mouse_cli.diagnosis.matching import Matcher, shapes
from mouse_cli.diagnosis.reduced import Reduced
from mouse_cli.model.arrays import Matrix

_MODES = 8  # that are looked at
_LOOKED = 3000  # best degrees of freedom from which places are taken
_ALIKE = 0.999  # cosine squared, the mean over the modes, from which on two places are one
_PAIRS = 300_000  # pairs of degrees of freedom that are looked at; models that couple more of them are solids


def survey(model: Reduced, K: Matrix, count: int) -> np.ndarray:
    """At most `count` degrees of freedom, the best first, no two of which the sensors can hardly tell apart."""
    measured, update = shapes(model), fit(Model(model), np.zeros(0))
    if update is None or count < 1 or measured.dof < 1 or not len(measured.modes):
        return np.zeros(0, int)
    matcher = Matcher(model, measured, update.point.x)
    looked = np.linspace(0, len(measured.modes) - 1, min(_MODES, len(measured.modes))).round().astype(int)
    misfit, H = np.zeros(len(model.V)), []
    one, other = _pairs(K)
    between = np.zeros(len(one))
    for i in looked:
        W = _whitening(update, measured.modes[i], measured.weight[:, i])
        y = W @ measured.y[:, i]
        h = model.V @ (matcher.X @ (W @ matcher.response(i)).T)
        misfit += _left(y, h)
        for at in range(0, len(one), 50_000):
            some = slice(at, at + 50_000)
            between[some] += _left(y, h[one[some]] - h[other[some]])
        H.append(h)
    return _apart(_ordered(misfit, between, one, other), H, count)


def _whitening(update: Fit, mode: int, weight: np.ndarray) -> np.ndarray:
    """(I + J C J')^-1/2 (s, s), J derivatives of the whitened shape, C covariance of the update times its misfit."""
    test, k = update.model.base.data.test, update.model.k
    J = np.zeros((len(weight), k))
    have = update.model.base.data.has_shape
    first = int(update.model.base.data.has_frequency.sum())
    number = np.cumsum(have.ravel()).reshape(have.shape) - 1 + first
    T = update.model.jacobian(update.point)
    J[have[:, mode]] = T[number[have[:, mode], mode]]
    scale = max(1.0, update.point.chi2 / max(update.dof, 1))
    size, Q = np.linalg.eigh(np.eye(test.s) + scale * J @ np.linalg.solve(update.hessian, J.T))
    return (Q / np.sqrt(size)) @ Q.T


def _left(y: np.ndarray, h: np.ndarray) -> np.ndarray:
    """|y - a h|^2 (j,) at the best a, for h (j, s)."""
    size = np.einsum("js,js->j", h, h)
    along = (h @ y) ** 2
    return y @ y - np.divide(along, size, out=np.zeros(len(h)), where=size > 0)


def _pairs(K: Matrix) -> tuple[np.ndarray, np.ndarray]:
    """Degrees of freedom that K couples as a spring does; none where there are too many."""
    from scipy.sparse import coo_array

    entries = coo_array(K)
    kept = (entries.row < entries.col) & (entries.data < 0)
    if kept.sum() > _PAIRS:
        kept[:] = False
    return entries.row[kept], entries.col[kept]


def _ordered(misfit: np.ndarray, between: np.ndarray, one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Degrees of freedom by the best of what a force on them, or on them and another, leaves."""
    best = misfit.copy()
    np.minimum.at(best, one, between)
    np.minimum.at(best, other, between)
    return np.argsort(best, kind="stable")[:_LOOKED]


def _apart(order: np.ndarray, H: list[np.ndarray], count: int) -> np.ndarray:
    """The first `count` of `order` that sensors tell apart."""
    units = [h[order] / np.maximum(np.linalg.norm(h[order], axis=1), 1e-300)[:, None] for h in H]
    taken, free = [], np.ones(len(order), bool)
    while free.any() and len(taken) < count:
        i = int(np.argmax(free))
        taken.append(i)
        free &= np.mean([(u @ u[i]) ** 2 for u in units], axis=0) < _ALIKE
        free[i] = False
    return order[taken]

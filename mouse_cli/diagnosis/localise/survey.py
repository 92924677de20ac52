"""A first look over a large model: at which degrees of freedom a force could make the measured shapes.

The same matching as `locate`, at few values of the parameters: what those leave uncertain of the shapes of the model as it is,
times the misfit, stands for what they leave uncertain of S R(lambda) B, so that every place costs a few products. A mode that a
force somewhere does not make counts by the logarithm of its misfit: the place may hardly move in it.
"""

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.localise.force import matched
from mouse_cli.diagnosis.localise.matching import Matcher, shapes
from mouse_cli.diagnosis.search.fit import Fit, fit
from mouse_cli.model.arrays import Matrix

_MODES = 8  # that are looked at
_LOOKS, _FOLLOWED = 6, 24  # looks at most, and steps after each
_LOOKED = 3000  # best degrees of freedom from which places are taken
_TOLD = 1.0  # misfit of the shapes of two places up to which they are taken as one
_LIKE = 0.98  # cosine between effects on the data from which on two places are taken as one
_ONE = 0.9999  # from which on they are one place of a solid, such as nodes through its thickness
_EACH = 20_000  # places worked on at once
_PAIRS = 20_000  # pairs that are looked at, those first between whose ends a force does best


def survey(model: Reduced, K: Matrix, count: int) -> np.ndarray:
    """At most `count` degrees of freedom, the best first, no two of which the sensors can hardly tell apart.

    A look with the parameters of the update, with those before the test, then with those that the best places found lead to, as
    long as that helps.
    """
    measured, update = shapes(model), fit(Model(model), np.zeros(0))
    if update is None or count < 1 or measured.dof < 1 or not len(measured.modes):
        return np.zeros(0, int)
    solid = model.motion is None and _solid(K)
    pairs, best, found = _pairs(K, solid), np.inf, np.zeros(0, int)
    scale, starts = max(1.0, update.point.chi2 / max(update.dof, 1)), [update.point.x, np.zeros_like(update.point.x)]
    for _ in range(_LOOKS):
        places = _look(model, measured, update, starts.pop(0), scale, pairs, count)
        tried = matched(model, measured, model.V[places], _FOLLOWED)
        order = np.argsort(tried.cost, kind="stable")
        least = float(tried.cost[order[0]])
        found = _merged(places[order], found, count, least < best)
        if least < best - 1:
            best, scale = least, max(1.0, least / measured.dof)
            starts.append(tried.z[order[0]])
        if not starts:
            break
    weak = _most_sensitive(model, update, count // 4)
    joined = np.concatenate([found[: count - len(weak)], weak, found[count - len(weak) :]])
    joined = joined[np.sort(np.unique(joined, return_index=True)[1])]
    if not solid:
        return joined[:count]
    joined = np.concatenate(
        [joined, np.setdiff1d(_most_sensitive(model, update, 2 * count), joined, assume_unique=True)]
    )
    effect = _effects(update, model.V[joined] @ update.point.X)[0]
    effect /= np.maximum(np.linalg.norm(effect, axis=0), 1e-300)
    return joined[_first(effect.T @ effect > _ONE)][:count]


def _first(alike: np.ndarray) -> np.ndarray:
    """Numbers of those that are not like an earlier one that is kept, for a matrix (n, n) of what is alike."""
    free = np.ones(len(alike), bool)
    for i in range(len(alike)):
        if free[i]:
            free[i + 1 :] &= ~alike[i, i + 1 :]
    return np.flatnonzero(free)


def _most_sensitive(model: Reduced, update: Fit, count: int) -> np.ndarray:
    """The `count` degrees of freedom where a little spring or mass lowers the misfit most, no two that do the same to the data.

    To first order, the deck's parameters following: (g'r)^2 / (g'g - g'T (T'T + I)^-1 T'g) for derivatives g of the data. Shapes
    of a model that is nearly right are made by a force anywhere: what is weak is found so.
    """
    T, X = update.model.jacobian(update.point), update.point.X
    size = _EACH // 10
    gain = np.concatenate(
        [gained(update, T, model.V[i : i + size] @ X)[0] for i in range(0, len(model.V), size)], axis=1
    )
    found: list[int] = []
    for c in range(2):
        order = np.argsort(-gain[c], kind="stable")[: size // 4]
        effect = gained(update, T, model.V[order] @ X)[1][c]
        free = gain[c, order] > 0
        for _ in range(count - count // 2):
            if not free.any():
                break
            i = int(np.argmax(free))
            found.append(int(order[i]))
            free &= effect.T @ effect[:, i] < _LIKE * np.linalg.norm(effect[:, i]) * np.linalg.norm(effect, axis=0)
    return np.array(found[:count], int)


def gained(update: Fit, T: np.ndarray, B: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """What a little spring and a little mass gain (2, n) of the misfit at each row of B (n, r) in own modes.

    And what they do to the data (2, q, n), over the length of what the deck's parameters, of derivatives T (q, k), cannot follow.
    """
    follow = np.linalg.solve(T.T @ T + np.eye(T.shape[1]), T.T)
    g = _effects(update, B)
    left = np.maximum(np.einsum("cqn,cqn->cn", g, g - T @ (follow @ g)), 1e-300)
    return np.maximum(np.einsum("q,cqn->cn", update.point.residual, g), 0.0) ** 2 / left, g / np.sqrt(left)[:, None]


def _effects(update: Fit, B: np.ndarray) -> np.ndarray:
    """Derivatives (2, q, n) of the whitened data by a spring to the ground, and by a mass, at each row of B (n, r) in own modes."""
    at, data = update.point, update.model.base.data
    measured = at.eigenvalues[at.which]
    apart = measured[:, None] - at.eigenvalues
    apart[np.abs(apart) < 1e-9 * np.abs(measured)[:, None]] = np.inf
    own = B[:, at.which].T  # (m, n)
    stretched = np.stack([(at.seen / apart[i]) @ B.T for i in range(len(measured))], axis=1) * own  # (s, m, n)
    spring = own**2, stretched
    mass = -measured[:, None] * own**2, -measured[:, None] * stretched - 0.5 * own**2 * at.seen[:, at.which, None]
    return np.stack([at.jacobian(data, *each) for each in (spring, mass)])


def _merged(new: np.ndarray, old: np.ndarray, count: int, better: bool) -> np.ndarray:
    """The first of both: all of `new` that fit when they are better, with half of the old ones' share kept for those."""
    first, second = (new, old) if better else (old, new)
    joined = np.concatenate([first[: count - count // 4] if len(second) else first, second, first])
    _, at = np.unique(joined, return_index=True)
    return joined[np.sort(at)][:count]


def _look(model, measured, update: Fit, z: np.ndarray, scale: float, pairs, count: int) -> np.ndarray:
    """Degrees of freedom in the order of what a force on them, or on them and another, leaves at z (k,)."""
    modes = np.linspace(0, len(measured.modes) - 1, min(_MODES, len(measured.modes))).round().astype(int)
    own = [_whitening(update, mode, measured.weight[:, i], scale) for i, mode in enumerate(measured.modes)]
    matcher = Matcher(model, measured, z, own)
    one, other = pairs
    counts = (measured.weight > 0).sum(axis=0)
    left = lambda rows: sum(borne(matcher.nearest(i, rows)[1], int(counts[i])) for i in modes)
    misfit = np.concatenate([left(model.V[i : i + _EACH] @ matcher.X) for i in range(0, len(model.V), _EACH)])
    near = np.minimum(misfit[one], misfit[other])
    kept = np.argsort(near, kind="stable")[
        :_PAIRS
    ]  # a force at either end of where something is softer is no bad guess
    one, other = one[kept], other[kept]
    between = [
        left((model.V[one[i : i + _EACH]] - model.V[other[i : i + _EACH]]) @ matcher.X)
        for i in range(0, len(one), _EACH)
    ]
    order = np.argsort(misfit, kind="stable")[:_LOOKED]
    rows, size = model.V[order] @ matcher.X, [float(np.sum(matcher.y(i) ** 2)) for i in modes]
    places = _apart(order, [matcher.nearest(i, rows)[2] for i in modes], size, count - count // 4)
    if not len(one):
        return places
    ends = np.stack([one, other], axis=1)[np.argsort(np.concatenate(between), kind="stable")].ravel()
    _, first = np.unique(np.concatenate([places, ends]), return_index=True)
    return np.concatenate([places, ends])[np.sort(first)][:count]


def borne(misfit: np.ndarray, count: int) -> np.ndarray:
    """What a mode of so many components counts that leaves `misfit` (j,): n ln(1 + misfit / n), that of an unknown scatter.

    One mode that a place does not make, as it hardly moves there, must not hide that it makes all others.
    """
    return count * np.log1p(misfit / count)


def _whitening(update: Fit, mode: int, weight: np.ndarray, scale: float) -> np.ndarray:
    """(I + J C J')^-1/2 (s, s), J derivatives of the whitened shape, C covariance of the update with `scale` times the noise."""
    test, k = update.model.base.data.test, update.model.k
    J = np.zeros((len(weight), k))
    have = update.model.base.data.has_shape
    first = int(update.model.base.data.has_frequency.sum())
    number = np.cumsum(have.ravel()).reshape(have.shape) - 1 + first
    T = update.model.jacobian(update.point)
    J[have[:, mode]] = T[number[have[:, mode], mode]]
    prior = np.eye(k)
    size, Q = np.linalg.eigh(np.eye(test.s) + J @ np.linalg.solve((update.hessian - prior) / scale + prior, J.T))
    return (Q / np.sqrt(size)) @ Q.T


def _solid(K: Matrix) -> bool:
    """Whether K couples as a continuum does, some degrees of freedom with k_ij > 0: no two of them are joined by a spring."""
    from scipy.sparse import coo_array

    entries = coo_array(K)
    return bool((entries.data[entries.row != entries.col] > 0).any())


def _pairs(K: Matrix, solid: bool) -> tuple[np.ndarray, np.ndarray]:
    """Degrees of freedom that K couples as a spring does; none in a solid."""
    from scipy.sparse import coo_array

    if solid:
        return np.zeros(0, int), np.zeros(0, int)
    entries = coo_array(K)
    kept = (entries.row < entries.col) & (entries.data < 0)
    return entries.row[kept], entries.col[kept]


def _apart(order: np.ndarray, units: list[np.ndarray], size: list[float], count: int) -> np.ndarray:
    """The first `count` of `order` that sensors tell apart: directions `units` of shapes (j, s), for measured ones of `size`."""
    taken, free = [], np.ones(len(order), bool)
    while free.any() and len(taken) < count:
        i = int(np.argmax(free))
        taken.append(i)
        free &= sum(n * (1 - (u @ u[i]) ** 2) for n, u in zip(size, units, strict=True)) > _TOLD
        free[i] = False
    return order[taken]

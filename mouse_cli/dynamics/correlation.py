"""How alike two sets of mode shapes are, and which model mode a measured mode is."""

import numpy as np

LIKELY = 0.8  # a measured and a model mode farther apart than this are not one mode, such as MAC 0.3 and 5 %
# Detuning beyond which frequencies tell no more: a MAC above 0.8 makes a pair even in a model far too stiff
ANY_FREQUENCY = 0.6
_DOUBLE = 1e-3  # of their frequency: modes so close are one double mode, whose shapes are any two of a plane
_WITHIN = 0.1  # share by which the MAC with each tells modes of a plane apart, where that with the plane does not
_SAME_SHAPE = 1e-6  # of the largest singular value of its shapes: what sensors see of a plane less than that is nothing


def mac(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Modal assurance criterion (a, b) between columns of `one` (s, a) and `other` (s, b); NaN components are left out.

    MAC = |x'y|^2 / (x'x y'y), over the points that both measured (Allemang and Brown 1982).

    >>> import numpy as np
    >>> mac(np.array([[1.0], [2.0]]), np.array([[2.0, 2.0], [4.0, -1.0]])).round(12).tolist()
    [[1.0, 0.0]]
    """
    have_one, have_other = np.isfinite(one), np.isfinite(other)
    x, y = _scaled(np.where(have_one, one, 0.0)), _scaled(np.where(have_other, other, 0.0))
    size = ((x * x).T @ have_other) * (have_one.T @ (y * y))
    return np.divide((x.T @ y) ** 2, size, out=np.zeros_like(size), where=size > 0)


def _scaled(shapes: np.ndarray) -> np.ndarray:
    """Columns (s, m) by powers of two so that their largest is about 1: no square leaves the numbers, no digit is rounded."""
    return np.ldexp(shapes, -np.frexp(np.abs(shapes).max(axis=0, initial=0.0))[1])


def distance(likeness: np.ndarray, test_hz: np.ndarray, hz: np.ndarray, most: float = 1e3) -> np.ndarray:
    """How far each measured mode is from each model mode (m, k): 1 - MAC + 2 |ln(f / f_test)|, its second part at most `most`.

    likeness (m, k): the MAC, NaN where no shape tells; then it is 2 |ln| + ln^2, so that modes keep their order. test_hz (m,), NaN
    where not measured; hz (k,). A model mode of zero frequency is infinitely far, or nearly so.
    """
    with np.errstate(divide="ignore"):
        detuning = np.abs(np.log(np.maximum(hz, 0.0)[None, :] / test_hz[:, None]))
    bare = np.isnan(likeness)
    detuning = np.minimum(np.where(np.isnan(detuning), 0.0, detuning), 500.0)
    apart = np.where(bare, 2 * detuning + detuning**2, 1.0 - likeness + np.minimum(2 * detuning, most))
    apart[:, hz <= 0] = 1e6
    return apart


def pair(test_shapes: np.ndarray, test_hz: np.ndarray, shapes: np.ndarray, hz: np.ndarray) -> np.ndarray:
    """Index (m,) of the model mode that each measured mode is: the assignment of least total `distance`; k: it is none.

    It is complete where the model has no fewer modes. Shapes decide where they can, frequencies where shapes are alike.
    test_shapes (s, m), test_hz (m,) may hold NaN; shapes (s, k), hz (k,).
    """
    return paired(distance(_with_double(mac(test_shapes, shapes), test_shapes, shapes, hz), test_hz, hz))


def _with_double(macs: np.ndarray, test: np.ndarray, shapes: np.ndarray, hz: np.ndarray) -> np.ndarray:
    """`macs` (m, k), the MAC, where modes of the model are double: of each of these the squared cosine between a measured shape
    and all that they can be together, for s points and d such modes by (s - 1) / (s - d) less unlike, as chance has it.

    test (s, m) may hold NaN; shapes (s, k), hz (k,).
    """
    order = np.argsort(hz, kind="stable")
    rising = hz[order]
    close = (rising[:-1] > 0) & (np.diff(rising) <= _DOUBLE * rising[1:])
    if not close.any():
        return macs
    macs, have = macs.copy(), np.isfinite(test)
    edges = np.flatnonzero(np.diff(np.concatenate([[0], close, [0]])))
    where = have[:, :1] if have.all() else np.unique(have, axis=1)  # one factorisation for shapes measured at the same points
    for points in where.T:
        alike = np.flatnonzero((have == points[:, None]).all(axis=0))
        _as_groups(macs, alike, test[np.ix_(points, alike)], shapes[points], order, edges.reshape(-1, 2))
    return macs


def _as_groups(macs: np.ndarray, rows: np.ndarray, Y: np.ndarray, shapes: np.ndarray, order, edges) -> None:
    """Into those rows of `macs` what groups of double modes can be together, those of as many modes at once.

    Y (s, y): measured shapes of the rows; shapes (s, k); edges (g, 2): first and last mode of each group in `order` (k,).
    """
    count, measured = edges[:, 1] - edges[:, 0] + 1, np.maximum(np.square(Y).sum(axis=0), 1e-300)
    for d in set(count[count < len(Y)].tolist()):
        own = order[edges[count == d, :1] + np.arange(d)]  # (g, d)
        U, size, _ = np.linalg.svd(shapes[:, own].transpose(1, 0, 2), full_matrices=False)
        along = np.swapaxes(U * (size > _SAME_SHAPE * size[:, :1])[:, None], 1, 2) @ Y
        unlike = (1 - np.square(along).sum(axis=1) / measured) * (len(Y) - 1) / (len(Y) - d)
        at = np.ix_(rows, own.ravel())
        macs[at] = np.maximum(macs[at], 1 - np.repeat(unlike.T, d, axis=1) - _WITHIN * (1 - macs[at]))


class Measured:
    """Measured modes that are compared with those of many models: shapes (s, m) and hz (m,) may hold NaN."""

    def __init__(self, shapes: np.ndarray, hz: np.ndarray):
        have = np.isfinite(shapes)
        x = np.where(have, shapes, 0.0)
        self._shapes = shapes
        self._x, self._size, self._have = x.T.copy(), np.square(x).sum(axis=0)[:, None], have.T.astype(float)
        self._hz, self._log = hz, np.log(hz)[:, None]
        self._plain = bool(np.isfinite(hz).all() and (self._size > 0).all())

    def pair(self, shapes: np.ndarray, hz: np.ndarray) -> np.ndarray:
        """As `pair`, of finite `shapes` (s, k) and hz (k,)."""
        size = self._size * (self._have @ np.square(shapes))
        plain = self._plain and (size > 0).all() and (hz > 0).all()
        alike = (self._x @ shapes) ** 2
        alike = alike / size if plain else np.divide(alike, size, out=np.zeros_like(size), where=size > 0)
        alike = _with_double(alike, self._shapes, shapes, hz)
        if not plain:
            return paired(distance(alike, self._hz, hz))
        detuning = np.minimum(2 * np.abs(np.log(hz) - self._log), 1e3)
        return paired(1.0 - alike + detuning)


def paired(apart: np.ndarray) -> np.ndarray:
    """Column (m,) of each row of `apart` (m, k) so that their sum is least and no two are the same;
    k, which is none, of a row that is left over where k < m.
    """
    if not apart.size:
        return np.full(len(apart), apart.shape[1])
    nearest = apart.argmin(axis=1)
    if len(set(nearest.tolist())) == len(nearest):  # no two want the same one: nothing to settle
        return nearest
    from scipy.optimize import linear_sum_assignment

    rows, columns = linear_sum_assignment(apart)
    found = np.full(len(apart), apart.shape[1])
    found[rows] = columns
    return found


def match(apart: np.ndarray, limit: float = LIKELY) -> np.ndarray:
    """Index (m,) of the model mode that each measured mode is, -1 for a mode without a likely partner.

    The assignment of least total `apart` (m, k), where to leave a measured mode without partner costs `limit`: no pair is
    farther apart than that.
    """
    m, k = apart.shape
    alone = np.full((m, m), limit)  # m places for modes that stay alone
    found = paired(np.hstack([apart, alone]))
    return np.where(found < k, found, -1)


def scale_factors(test: np.ndarray, model: np.ndarray) -> np.ndarray:
    """Modal scale factors (a,): what brings each `test` shape (s, a) nearest to its `model` shape (s, a).

    MSF = t'x / t't over the components measured (Allemang 2003); NaN for a shape without any.

    >>> import numpy as np
    >>> scale_factors(np.array([[1.0], [2.0], [np.nan]]), np.array([[-2.0], [-4.0], [7.0]])).tolist()
    [-2.0]
    """
    t, x = np.nan_to_num(test), np.where(np.isfinite(test), model, 0.0)
    size = np.einsum("sa,sa->a", t, t)
    return np.divide(np.einsum("sa,sa->a", t, x), size, out=np.full(len(size), np.nan), where=size > 0)


def comac(test: np.ndarray, model: np.ndarray) -> np.ndarray:
    """Co-ordinate MAC (s,) of paired shapes (s, a): (sum |t x|)^2 / (sum t^2 sum x^2) over the modes (Lieven and Ewins 1988).

    Every pair is first brought to unit length. Blind to signs; NaN for a sensor that measured nothing or reads nothing.
    """
    t, x = _unit_pairs(test, model)
    size = np.sum(t**2, axis=1) * np.sum(x**2, axis=1)
    return np.divide(np.sum(np.abs(t * x), axis=1) ** 2, size, out=np.full(len(t), np.nan), where=size > 0)


def ecomac(test: np.ndarray, model: np.ndarray) -> np.ndarray:
    """Enhanced COMAC (s,) of paired shapes (s, a): the mean of |t - x| / 2 over the modes, of unit length (Hunt 1992).

    0: no difference. It sees signs. NaN for a sensor that measured nothing.
    """
    have = np.isfinite(test)
    t, x = _unit_pairs(test, model)
    count = have.sum(axis=1)
    apart = np.sum(np.abs(t - x), axis=1) / 2
    return np.divide(apart, count, out=np.full(len(t), np.nan), where=count > 0)


def _unit_pairs(test: np.ndarray, model: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Both sets at unit length over the components measured, zero where not, signs agreeing mode by mode."""
    have = np.isfinite(test)
    t, x = np.where(have, test, 0.0), np.where(have, model, 0.0)
    for shapes in (t, x):
        size = np.linalg.norm(shapes, axis=0)
        shapes /= np.where(size > 0, size, 1.0)
    return t, x * np.where(np.sum(t * x, axis=0) < 0, -1.0, 1.0)


def subspace_cosines(test: np.ndarray, model: np.ndarray) -> np.ndarray:
    """Squared cosines (min(a, b),) of the principal angles between the spans of `test` (s, a) and `model` (s, b), descending.

    1: a direction that both have; for a = b = 1 the MAC (Bjoerck and Golub 1973). Points that not all of `test` measured are
    left out. NaN where no more points are left than shapes: any spans agree then.
    """
    from scipy.linalg import subspace_angles

    rows = np.isfinite(test).all(axis=1)
    if rows.sum() <= max(test.shape[1], model.shape[1]):
        return np.full(min(test.shape[1], model.shape[1]), np.nan)
    return np.sort(np.cos(subspace_angles(test[rows], model[rows])) ** 2)[::-1]


def least_squares_scale(theory: np.ndarray, test: np.ndarray, mass: np.ndarray) -> float:
    """Factor c of `test` (s,) that brings it nearest to `theory` (s,) in the metric of `mass` (s, s).

    c = theory' M test / test' M test; it carries the sign. 0 when the two are unrelated.
    """
    return float(theory @ mass @ test) / float(test @ mass @ test)


def align(basis: np.ndarray, test: np.ndarray) -> np.ndarray:
    """Rotation (c, c) of a cluster's shapes `basis` (s, c) whose first columns lie along those of `test` (s, t), t <= c.

    Modes of equal frequency are defined only up to a rotation. Each test shape, of any length, is the combination of least squares;
    the orthogonal matrix nearest to these, at unit length (Schoenemann 1966), is the same wherever the s points are.
    """
    t = test.shape[1]
    along = np.linalg.lstsq(basis, test, rcond=None)[0]
    size = np.linalg.norm(along, axis=0)
    left, _, right = np.linalg.svd(along / np.where(size > 0, size, 1.0))
    return np.hstack([left[:, :t] @ right, left[:, t:]])

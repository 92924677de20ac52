"""A first look at pairs of places that nothing joins: along which of them a spring could make what was measured.

By two rules, as neither alone finds all. To first order a spring k along b moves the data by k g, g their derivatives; with the
deck's parameters following, T their derivatives, it gains

    (g'r)^2 / (g'g - g'T (T'T + I)^-1 T'g)        where g'r > 0

of the misfit of the residual r: it ranks what is weak, and what acts on frequencies alone. And for what is not weak, the modes of
diag(lambda) + k b b' in the lowest coordinates at a few k, each measured mode beside the one that is most like it; the frequencies
may be off by what the prior of the parameters allows, I + T T' in their accuracies.
"""

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest, total_mass
from mouse_cli.diagnosis.localise.matching import Shapes, shapes
from mouse_cli.diagnosis.localise.survey import gained
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.diagnosis.sites.pairs import MOST, Pairs, pairs

_SIZES = 10.0 ** np.arange(-2.5, 3.0)  # of the mass times the lowest measured eigenvalue
_CLOSER, _HALVINGS = 300, 5  # best ones whose size is sought closer, by steps that are halved so often
_COARSE, _BESIDE = 24, 8  # coordinates at least, and besides those of the measured modes
_EACH = 256  # pairs worked on at once


def ties(model: Reduced) -> dict[tuple[int, int, int], float] | None:
    """Keys of the MOST pairs that are worth fitting, and a stiffness for each (N/m), nan where unknown; None: no more."""
    found = pairs(model)
    if len(found) <= MOST:
        return None
    update = fit(Model(model), np.zeros(0))
    if update is None:
        return None
    gain, _ = gained(update, update.model.jacobian(update.point), found.rows @ update.point.X)
    order, k = [np.argsort(-gain[0], kind="stable")], np.full(len(found), np.nan)
    measured = shapes(model)
    if len(measured.modes) and measured.dof > 0:
        left, k = _sized(model, measured, found)
        order.append(np.argsort(left, kind="stable"))
    mixed = np.stack(order, axis=1).ravel()
    kept = mixed[np.sort(np.unique(mixed, return_index=True)[1])][:MOST]
    return {tuple(found.keys[i].tolist()): float(k[i]) for i in np.sort(kept)}


def _sized(model: Reduced, measured: Shapes, found: Pairs) -> tuple[np.ndarray, np.ndarray]:
    """The least misfit (c,) of shapes and frequencies over the sizes of a spring between each of `found`, and its k (c,)."""
    sizes = _SIZES * lowest(model) * total_mass(model)
    each = np.array([_left(model, measured, found, np.full(len(found), size)) for size in sizes])
    left, k = each.min(axis=0), sizes[each.argmin(axis=0)]
    best = np.argsort(left, kind="stable")[:_CLOSER]
    near, step = found.only(best), _SIZES[1] / _SIZES[0]
    for _ in range(_HALVINGS):
        step = np.sqrt(step)
        for there in (k[best] / step, k[best] * step):
            closer = _left(model, measured, near, there)
            k[best] = np.where(closer < left[best], there, k[best])
            left[best] = np.minimum(left[best], closer)
    return left, k


def _left(model: Reduced, measured: Shapes, found: Pairs, k: np.ndarray) -> np.ndarray:
    """The misfit (c,) with a spring k (c,) between each of `found`."""
    own = model.data.test.number[measured.modes] - 1
    r = min(model.r, max(_COARSE, int(own.max()) + 1 + _BESIDE))
    dK, dM = model.slopes(np.zeros(model.L.shape[1]))
    T = (dK[:, own, own] - model.eigenvalues[own] * dM[:, own, own]).T / measured.sd[:, None]
    C = np.linalg.inv(np.eye(len(own)) + T @ T.T)
    cost, effective = np.zeros(len(found)), k / (1 + k * found.left(model.eigenvalues[:r]))
    for first in range(0, len(found), _EACH):
        own = slice(first, first + _EACH)
        b = found.rows[own, :r]
        A = np.diag(model.eigenvalues[:r]) + effective[own, None, None] * b[:, :, None] * b[:, None, :]
        values, Q = np.linalg.eigh(A)
        cost[own] = _misfit(measured, C, values, model.sensing[:, :r] @ Q)
    return cost


def _misfit(measured: Shapes, C: np.ndarray, values: np.ndarray, seen: np.ndarray) -> np.ndarray:
    """Of models (c,) with eigenvalues `values` (c, r), of which sensors see `seen` (c, s, r).

    Sum of ln(1 + misfit) over modes: the parameters turn shapes of close modes, and what makes all others need not fail by two.
    """
    at = np.arange(len(values))
    total, off = np.zeros(len(values)), np.zeros((len(values), len(measured.modes)))
    for i, lam in enumerate(measured.eigenvalue):
        h, y = seen * measured.weight[:, i, None], measured.y[:, i]
        shape = y @ y - np.einsum("s,csr->cr", y, h) ** 2 / np.maximum(np.einsum("csr,csr->cr", h, h), 1e-300)
        t = (values - lam) / measured.sd[i]
        best = np.argmin(shape + C[i, i] * t**2, axis=1)
        total += np.log1p(np.maximum(shape[at, best], 0.0))
        off[:, i] = t[at, best]
    each = np.maximum(np.einsum("ci,ij,cj->c", off, C, off), 0.0) / off.shape[1]
    return total + off.shape[1] * np.log1p(each)

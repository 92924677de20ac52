"""Fits of one rival, at other spreads, lengths or sites, as one that knows of the others."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.nameless._field import Smooth
from mouse_cli.diagnosis.noise import scale
from mouse_cli.diagnosis.search.descents import idealised
from mouse_cli.diagnosis.search.fit import Fit

_LEAST = 1e-4  # share in the evidence below which a fit is no matter


def averaged(fits: Sequence[Fit], weights: Sequence[float], total: float) -> Fit:
    """The most probable of `fits` with `total` as log evidence, and the others with their shares; weights (f,): ln of these.

    Its theory is no better than that of what has a name.
    """
    share, first = np.exp(weights - np.logaddexp.reduce(weights)), int(np.argmax(weights))
    known = [(one, float(p)) for one, p in zip(fits, share, strict=True) if p > _LEAST and one is not fits[first]]
    ideal = idealised(fits[first])
    ideal = ideal if ideal is fits[first] else signed(ideal)
    evidence = total + ideal.log_evidence - fits[first].log_evidence
    return replace(ideal, log_evidence=float(evidence), variants=tuple(known))


def mean_values(one: Fit) -> tuple[np.ndarray, np.ndarray]:
    """Values (c,) of a field and their sd, by all of its spreads and lengths; what the fit leaves beyond the noise scales these.

    A mean has the variance of all values about it; of a change of rank one the sign of the leading fit.
    """
    alike = [(each, p) for each, p in one.variants if each.nameless.cells.sites == one.nameless.cells.sites]
    parts = [(one, 1 - sum(p for _, p in one.variants)), *alike]
    p = np.array([share for _, share in parts]) / sum(share for _, share in parts)
    values, variance = (np.array(each) for each in zip(*(_values(each) for each, _ in parts), strict=True))
    if one.nameless.sign:
        values *= np.where(values @ values[0] < 0, -1.0, 1.0)[:, None]
    mean = p @ values
    return mean, np.sqrt(p @ (variance + (values - mean) ** 2))


def signed(one: Fit) -> Fit:
    """The fit with the evidence that it has where only a positive sum of its values is possible: Z P(sum > 0 | data) / P(sum > 0).

    By the same normal distributions as Laplace's method: 1/2 beforehand.
    """
    from scipy.special import log_ndtr

    extent = one.nameless.cells.positive
    if extent is None:
        return one
    own = _own(one)
    g = one.nameless.P.T @ extent
    mean, sd = float(g @ one.point.x[own]), float(np.sqrt(g @ one.covariance[own, own] @ g))
    return replace(one, log_evidence=one.log_evidence + float(np.log(2) + log_ndtr(mean / sd)))


def _own(one: Fit) -> slice:
    """Unknowns of the field; of functions, damping and gains come behind."""
    deck = one.model.base.first.deck
    return slice(deck, deck + one.nameless.P.shape[1])


def values_of_other(one: Fit) -> tuple[np.ndarray, np.ndarray]:
    """Values (c,) of the other rival beside the field of a fit, and their sd."""
    other, begin = one.model.base.other.nameless, _own(one).stop
    values, variance = _values(one, other, slice(begin, begin + other.P.shape[1]))
    return values, np.sqrt(variance)


def _values(one: Fit, field: Smooth | None = None, own: slice | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Values (c,) of one fit and their variances, of its own field unless another with its unknowns is given."""
    field, own = field or one.nameless, own or _own(one)
    noise = scale(one.misfit, one.dof)
    return field.values(one.point.x[own]), noise * np.einsum("cw,wv,cv->c", field.P, one.covariance[own, own], field.P)

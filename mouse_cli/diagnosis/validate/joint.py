"""What data that were held out have to do with those that were fitted: both are fitted together, and the evidence is compared.

ln p(d2 | d1) = ln Z(d1, d2) - ln Z(d1), each by Laplace. It is the density of the linear prediction N(f, I + T C T') where the
model is linear within what the fitted data leave open. Where two modes of it cross within that range it is not, and the common
optimum may lie beyond the crossing, so that descents begin at points of the posterior of the fit too.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.evidence import log_determinant
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.point import Point
from mouse_cli.diagnosis.search.fit import End, Fit, descended
from mouse_cli.updating.chi_square import upper_tail

_SAMPLE, _BEGUN = 64, 4  # points of the posterior at which new data are predicted; of these, where descents begin
_CHANCE = 0.05  # p-value of what the best of them leaves from which on no other is begun
# Times its degrees of freedom: misfit of a fit from which on what its data leave open says nothing of others
_NOTHING = 100.0
_CURVED = 0.1  # chi-square from which on a prediction one standard deviation away is another than the linear one


@dataclass(frozen=True)
class Two:
    """Two models at the same x, and the residual of both."""

    x: np.ndarray
    each: tuple
    residual: np.ndarray

    @property
    def chi2(self) -> float:
        """What is left of the misfit of all data."""
        return float(self.residual @ self.residual)


class Both:
    """The model that was fitted, and the same with what was held out: what `descended` needs of a model."""

    def __init__(self, fitted: Model, held: Model):
        self.models = fitted, held
        self.base, self.recipes, self.k, self.t = fitted.base, fitted.recipes, fitted.k, fitted.t
        self.bounds, self.width = fitted.bounds, fitted.width

    def point(self, x: np.ndarray) -> Two | None:
        """Both at x (k + t,); None where one is not physical."""
        one = self.models[0].point(x)
        other = None if one is None else self.models[1].point(x)
        return None if other is None else Two(x, (one, other), np.concatenate([one.residual, other.residual]))

    def jacobian(self, at: Two) -> np.ndarray:
        """d(prediction)/dx (q, k + t), whitened."""
        return np.vstack([model.jacobian(own) for model, own in zip(self.models, at.each, strict=True)])

    def curvature(self, at: Two) -> np.ndarray | float:
        """See `Model`."""
        return sum(model.curvature(own) for model, own in zip(self.models, at.each, strict=True))


def beyond_linear(one: Fit, held: Model, at: Point, T: np.ndarray, misfit: float) -> tuple[float, float] | None:
    """Misfit that the data of `held` add to that of a fit, and ln p of these given those, but for their own `log_sd`.

    at, T (q, k + t): what `held` predicts at the fit, and its derivatives; misfit: that of the linear prediction. None where that
    is as good, or the fit explains nothing.
    """
    if not T.size or one.misfit > _NOTHING * max(one.dof, 1):
        return None
    root = one.root
    least = root @ np.linalg.svd(T @ root, full_matrices=False)[2][0]
    if upper_tail(misfit, len(T)) > _CHANCE and _linear(held, at, T, least):
        return None
    both, k, best = Both(one.model, held), one.model.k, None
    for x in _starts(one, held, root):
        end = descended(both, x[k:], x[:k], reach=np.inf if best is None else best.misfit)
        best = min((each for each in (best, end) if each), key=lambda each: each.misfit, default=None)
        if best and upper_tail(best.misfit - one.misfit, len(T)) > _CHANCE:
            break
    if best is None:
        return None
    there = best.point.each[1]
    more = max(best.misfit - one.misfit, there.chi2)  # less only where the fit was no optimum of its own data
    return more, -0.5 * (more + _size(both, best) - log_determinant(one.hessian, both.width)) - there.nats


def _starts(one: Fit, held: Model, root: np.ndarray) -> list[np.ndarray]:
    """The fit, and what is best with the new data of a sample of what it leaves open, within the ranges."""
    x, k = one.point.x, held.k
    lower, upper = np.hstack([np.full((2, k), [[-np.inf], [np.inf]]), held.bounds.T])
    draws = np.random.default_rng(0).standard_normal((_SAMPLE, len(x)))
    points = [held.point(np.clip(x + root @ z, lower, upper)) for z in draws]
    costs = [(at.chi2 + float(z @ z), at.x) for at, z in zip(points, draws, strict=True) if at is not None]
    return [x, *(there for _, there in sorted(costs, key=lambda item: item[0])[:_BEGUN])]


def _linear(held: Model, at: Point, T: np.ndarray, step: np.ndarray) -> bool:
    """Whether one standard deviation to either side moves the prediction as its derivatives say."""
    k = held.k
    lower, upper = np.hstack([np.full((2, k), [[-np.inf], [np.inf]]), held.bounds.T])
    for x in (np.clip(at.x + step, lower, upper), np.clip(at.x - step, lower, upper)):
        there = held.point(x)
        if there is None or np.sum((there.residual - at.residual + T @ (x - at.x)) ** 2) > _CURVED:
            return False
    return True


def _size(both: Both, end: End) -> float:
    """ln |H| of all data at a common optimum."""
    J = both.jacobian(end.point)
    H = J.T @ J + np.diag(np.arange(J.shape[1]) < both.k)
    return log_determinant(H, both.width)

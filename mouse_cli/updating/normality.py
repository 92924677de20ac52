"""Whether the posterior is the normal density that a run reports: its true fall from the mode beside the quadratic.

At t standard deviations along a principal axis the normal density has J - J_mode = t^2. The root of the ratio of the true fall to
that is by how much the posterior is narrower there (above 1) or wider (below 1) than it is said to be.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mouse_cli._errors import WARNING, Diagnostic
from mouse_cli.estimators.linear import Estimator, expand
from mouse_cli.model.arrays import is_sparse
from mouse_cli.model.result import Result
from mouse_cli.updating.posterior import Laplace, cost, laplace, leading
from mouse_cli.updating.state import Setting, State

FACTOR = 1.5  # narrower or wider by this: quantiles of the normal density are wrong by a third or more
STEPS = (-2.0, -1.0, 1.0, 2.0)  # standard deviations
_FLAT = 0.1
_DOFS = 30  # degrees of freedom up to which two more solutions cost less than a seventh of a run


@dataclass(frozen=True)
class Fall:
    """At `steps` standard deviations along the axis (p,), given in values of the parameters for one: the posterior is narrower
    than the normal density by `ratio`; infinite where it has ended."""

    axis: np.ndarray
    steps: float
    ratio: float

    @property
    def doubtful(self) -> bool:
        """Whether that is far from 1."""
        return not 1 / FACTOR <= self.ratio <= FACTOR

    @property
    def flat(self) -> bool:
        """Whether the density is no lower there, or hardly."""
        return self.ratio < _FLAT


def falls(normal: Laplace, axes: np.ndarray, steps: tuple[float, ...] = STEPS) -> Iterator[Fall]:
    """The fall along the columns `axes` of the root, from each mode to both sides; what limits cut off is left out."""
    setting = normal.setting
    root = expand(setting.coordinates.L, normal.root) * setting.coordinates.slope(normal.state.u)[:, None]
    for axis in axes:
        for t in steps:
            z = normal.z + t * normal.root[:, axis]
            J, state = cost(setting, z)
            if state is None and _limited(setting, z):
                continue
            yield Fall(root[:, axis], t, float(np.sqrt(max(J - normal.cost, 0.0))) / abs(t))


def _limited(setting: Setting, z: np.ndarray) -> bool:
    return not setting.coordinates.within(setting.coordinates.mean + expand(setting.coordinates.L, z))


def widest(normal: Laplace) -> int:
    """The axis along which one standard deviation changes a property by the largest share of its value."""
    coordinates = normal.setting.coordinates
    size = np.where(coordinates.logarithmic, 1.0, np.abs(normal.state.u))
    moved = np.abs(expand(coordinates.L, normal.root))
    share = np.divide(moved, size[:, None], out=np.zeros_like(moved), where=size[:, None] > 0)
    return int(share.max(axis=0).argmax())


def remark(result: Result, setting: Setting, state: State, estimator: Estimator) -> Iterator[Diagnostic]:
    """The warning MD550 of an answer of a small model, by two more solutions, along the widest axis."""
    problem = setting.problem
    asked = problem.run.recursion == "anchored" and estimator.uses_prior and estimator.weighted
    if not asked or result.status.exit_code or result.at_limit.any() or not len(setting.y):
        return
    if (
        problem.structure.n > _DOFS
        or is_sparse(problem.structure.K)
        or setting.frf is not None
        or not setting.coordinates.L.size
    ):
        return
    normal = laplace(setting, state)
    found = [each for each in falls(normal, np.array([widest(normal)]), (-2.0, 2.0)) if each.doubtful]
    if (
        result.rejected
    ):  # a misfit bends the density as well; but a place that is no mode at all may be why it is rejected
        found = [each for each in found if each.flat]
    if found:
        yield finding(problem.parameters, result.sd_theta, found)


def finding(parameters: tuple, sd: np.ndarray, found: list[Fall]) -> Diagnostic:
    """The worst of the doubtful falls, as a warning; sd (p,): of the parameters."""
    worst = max(found, key=lambda each: round(abs(np.log(np.clip(each.ratio, 1e-3, 1e3))), 4))
    share = np.divide(np.abs(worst.axis), sd, out=np.zeros_like(worst.axis), where=sd > 0)
    most = int(leading(share))
    side = "above" if worst.axis[most] * worst.steps > 0 else "below"
    if not np.isfinite(worst.ratio):
        how = "ends there"
    elif worst.flat:
        how = "is no lower there"
    elif worst.ratio > 1:
        how = f"is narrower there by a factor of {worst.ratio:.2g}"
    else:
        how = f"is wider there by a factor of {1 / worst.ratio:.2g}"
    return Diagnostic(
        "MD550",
        WARNING,
        f"the posterior of {parameters[most].name} is not normal: {abs(worst.steps):g} standard deviations {side} its mode "
        f"it {how}",
        parameters[most].span,
        help="`mouse sample` gives it as it is",
    )

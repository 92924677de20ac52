"""Between the values of the parameters and the coordinates in which they are estimated.

u: identity or logarithm of each value, so that steps in u keep logarithmic parameters positive. Everything that may not
vary - a parameter without standard deviation, the total mass when it is held - is left out of the root L of the prior.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mouse_cli.model.problem import Problem
from mouse_cli.terms.assembly import Assembly


@dataclass(frozen=True)
class Coordinates:
    """mean (p,) of the prior in u; L its root, (p, k) or the diagonal (p,); lower, upper (p,) limits in u, or None.

    logarithmic (p,): mask of the parameters whose u is the logarithm of their value.
    """

    logarithmic: np.ndarray
    mean: np.ndarray
    L: np.ndarray
    lower: np.ndarray | None
    upper: np.ndarray | None

    def value(self, u: np.ndarray) -> np.ndarray:
        """Values (p,) in the units of the properties."""
        if self._linear:
            return np.array(u, float)
        return np.where(self.logarithmic, np.exp(np.where(self.logarithmic, u, 0.0)), u)

    def slope(self, u: np.ndarray) -> np.ndarray:
        """d(value)/du (p,)."""
        if self._linear:
            return np.ones(len(u))
        return np.where(self.logarithmic, self.value(u), 1.0)

    @cached_property
    def _linear(self) -> bool:
        """Whether u is the value of every parameter."""
        return not self.logarithmic.any()

    def in_prior_units(self, x: np.ndarray) -> np.ndarray:
        """z (k,) with x = L z, for a change x (p,) of u."""
        return x / self.L if self.L.ndim == 1 else np.linalg.lstsq(self.L, x, rcond=None)[0]

    def within(self, u: np.ndarray) -> bool:
        """Whether u (p,) lies within all limits."""
        return self.lower is None or bool(np.all((u >= self.lower) & (u <= self.upper)))

    def at_limit(self, u: np.ndarray) -> np.ndarray:
        """Mask (p,) of the parameters that stand at a limit."""
        if self.lower is None:
            return np.zeros(len(u), bool)
        near = 1e-7 * np.maximum(np.abs(u), np.abs(u - self.mean))
        return (u - self.lower <= near) | (self.upper - u <= near)


def coordinates(problem: Problem, assembly: Assembly) -> Coordinates:
    """The coordinates of `problem`, its prior in square-root form, its limits, and what it holds fixed."""
    nominal = problem.prior.mean
    logarithmic = np.array([p.transform == "log" for p in problem.parameters], bool)
    slope = np.where(logarithmic, nominal, 1.0)
    mean = np.where(logarithmic, np.log(np.where(logarithmic, nominal, 1.0)), nominal)
    sd = problem.prior.sd / slope
    held = _total_mass(problem, assembly)
    lower, upper = _limits(problem, logarithmic, mean, sd)
    return Coordinates(logarithmic, mean, _root(problem, slope, sd, held), lower, upper)


def _total_mass(problem: Problem, assembly: Assembly) -> np.ndarray:
    """Direction (p,) that changes the total mass, zero when that is free to change."""
    if not problem.run.fix_total_mass:
        return np.zeros(len(problem.parameters))
    return assembly.total_mass(problem.prior.mean, _translating(problem))


def _translating(problem: Problem) -> np.ndarray:
    """Degrees of freedom whose masses make the total: as named, else one direction of a structure, else all."""
    geometry = problem.structure.geometry
    if problem.run.total_mass_dofs or geometry is None:
        return np.array(problem.run.total_mass_dofs or range(problem.structure.n))
    most = np.bincount(geometry.direction[geometry.direction < 3], minlength=1).argmax()
    return np.flatnonzero(geometry.direction == most)


def _root(problem: Problem, slope: np.ndarray, sd: np.ndarray, held: np.ndarray) -> np.ndarray:
    """Root L of the prior covariance in u, with full column rank: S = L L' given that held'u stays."""
    if problem.prior.cov.ndim == 1:
        if (sd > 0).all() and not held.any():
            return sd
        L = np.diag(sd)[:, sd > 0]
    else:
        w, V = np.linalg.eigh(problem.prior.cov / np.outer(sd * slope, sd * slope))
        L = (V * np.sqrt(np.maximum(w, 0.0)))[:, w > 1e-12 * w.max()] * sd[:, None]
    c = L.T @ held
    if c.any():
        L = L @ np.linalg.qr(c[:, None], mode="complete")[0][:, 1:]
    return L


def _limits(
    problem: Problem, logarithmic: np.ndarray, mean: np.ndarray, sd: np.ndarray
) -> tuple[np.ndarray | None, np.ndarray | None]:
    """Limits (p,) in u, from the parameters and from `limit_sd`; None when nothing is limited."""
    lower = np.array([p.lower for p in problem.parameters], float)
    upper = np.array([p.upper for p in problem.parameters], float)
    with np.errstate(divide="ignore", invalid="ignore"):
        lower = np.where(logarithmic, np.log(np.maximum(lower, 0.0)), lower)
        upper = np.where(logarithmic, np.log(np.maximum(upper, 0.0)), upper)
    if problem.run.limit_sd is not None:
        lower = np.maximum(lower, mean - problem.run.limit_sd * sd)
        upper = np.minimum(upper, mean + problem.run.limit_sd * sd)
    if np.isinf(lower).all() and np.isinf(upper).all():
        return None, None
    return lower, upper

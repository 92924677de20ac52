"""The penalty method of Hall, Calkin and Sholar (section 2 of the report): steepest descent on the weighted misfit, no prior."""

import numpy as np

from mouse_cli.estimators.linear import expand, in_prior_units
from mouse_cli.methods import OWN, PARAMETERS, Method
from mouse_cli.methods.by_loop import movements
from mouse_cli.methods.found import Found
from mouse_cli.methods.given import Given
from mouse_cli.model.updated import KEPT, LOST, PARTLY
from mouse_cli.updating.prior_model import begin
from mouse_cli.updating.state import Setting, State, attempt

MOST_SOLUTIONS = 400  # eigensolutions
_ENDS = 1e-6  # relative decrease of the penalty that ends the search
_SHORTEST = 1e-12  # step, over the first one


def update(given: Given) -> Found:
    """The values of the parameters, in units of their sd, that lower sum ((test - model) / sd)^2 along its gradient.

    Each trial is an eigensolution, and `iterations` counts them: the expense that the report objects to.
    """
    setting, state = begin(given.problem, given.notice)
    solutions, length, decrease = 1, None, np.inf
    while solutions < MOST_SOLUTIONS and decrease > _ENDS:
        slope = in_prior_units(state.T, setting.coordinates.L).T @ (state.residual / setting.sd**2)
        length = length or 1 / max(float(slope @ slope) ** 0.5, 1e-300)
        reached, tried, length = _search(setting, state, slope, length)
        solutions += tried
        decrease = 0.0 if reached is None else 1 - reached.chi2 / max(state.chi2, 1e-300)
        state = reached or state
    moved = movements(given.problem, state.theta)
    return Found(state.K, state.M, solutions, float(decrease), decrease <= _ENDS, moved)


def _search(setting: Setting, state: State, slope: np.ndarray, length: float) -> tuple[State | None, int, float]:
    """A lower state along the slope, how many were tried, and the length for the next search; the step doubles or halves."""
    tried, first = 0, length
    while length > _SHORTEST * first:
        found = attempt(setting, _ahead(setting, state, length * slope))
        tried += 1
        if found is not None and found.chi2 < state.chi2:
            return found, tried, 2 * length
        length /= 2
    return None, tried, length


def _ahead(setting: Setting, state: State, z: np.ndarray) -> np.ndarray:
    """u (p,) so far from the state, within the limits."""
    at = setting.coordinates
    u = state.u + expand(at.L, z)
    return u if at.lower is None else np.clip(u, at.lower, at.upper)


METHOD = Method(
    "penalty",
    "penalty method of Hall, Calkin and Sholar",
    "p <- p + a T'R^-1 (y - h(p)), a by search along the line",
    "section 2 of the 1972 report, reference 8",
    (
        (LOST, "the parameters may not be able to reproduce them, and steepest descent may end before they do"),
        (KEPT, "a step to values without real frequencies is not taken"),
        (KEPT, "elements do not resist rigid motion, whatever their properties"),
        (KEPT, "the matrices are those of the same elements"),
        (PARTLY, "every number is a property; nothing holds one that the data do not determine"),
    ),
    (OWN, PARAMETERS),
    update,
)

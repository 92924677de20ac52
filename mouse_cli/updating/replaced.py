"""The loop of 1972 (Figure 4-1): each cycle's revised values replace the prior mean, and S stays.

Prior information is thereby used anew in every cycle, so that the recursion tends to the weighted least squares solution
and S only damps its steps.
"""

import numpy as np

from mouse_cli.dynamics.eigen import IndefiniteError
from mouse_cli.estimators.linear import Estimator, Infeasible, LinearProblem, Unobservable
from mouse_cli.model.result import Status
from mouse_cli.updating.second_order import acceleration
from mouse_cli.updating.state import State
from mouse_cli.updating.trace import Trace

MEANING = (
    "the values revised in each cycle replace the prior mean and S is kept; the result tends to the weighted "
    "least squares solution, the prior only damps the steps"
)
_STILL = 1e-4  # a step that moves the data by less than this many standard deviations changes nothing that anyone reads
_GROWTH = 1e6  # a misfit grown so many times over the first one will not come back


def recur(trace: Trace, estimator: Estimator) -> Status:
    """Run O-1 to O-10 until the exceedance test passes, the partials are used up, or the model turns unphysical."""
    options = trace.setting.problem.run
    trace.record(trace.state, trace.state.chi2)
    most = options.cycles if options.cycles is not None else options.partials
    extra = options.extra_update and options.cycles is None
    step = np.inf
    while trace.cycles[-1].index < most:
        if options.cycles is None and trace.passed:
            if not extra:
                break
            extra = False
        try:
            change, step = revise(trace, trace.state, estimator)
            state = trace.setting.state(trace.state.u + change)
        except Unobservable as problem:
            return trace.unobservable(str(problem), problem.loose)
        except Infeasible as problem:
            return trace.end("infeasible", reason=str(problem))
        except (IndefiniteError, np.linalg.LinAlgError) as problem:
            return trace.unphysical(trace.state.u + change, str(problem))
        trace.record(state, state.chi2)
        if options.cycles is None and (step < 1e-9 or not state.chi2 < _GROWTH * trace.cycles[0].chi2 + 1e6):
            break
    return _ending(trace, step)


def _ending(trace: Trace, step: float) -> Status:
    if trace.passed:
        return trace.end("passed")
    if step < _STILL:
        return trace.end("stalled")
    if trace.state.chi2 > 10 * trace.cycles[0].chi2:
        return trace.end("diverged")
    return trace.end("exceeded")


def revise(trace: Trace, state: State, estimator: Estimator) -> tuple[np.ndarray, float]:
    """Change of u (p,) by O-4 to O-8, `passes` times over one T; and its length: how far it moves the data, in their sd."""
    setting, options = trace.setting, trace.setting.problem.run
    lower, upper = setting.coordinates.lower, setting.coordinates.upper
    change = np.zeros(len(state.u))
    for _ in range(options.passes):
        left = None if lower is None else lower - state.u - change
        right = None if upper is None else upper - state.u - change
        problem = LinearProblem(
            state.T, state.residual - state.T @ change, setting.sd, setting.coordinates.L, left, right
        )
        estimate = estimator.solve(problem)
        change = change + estimate.x
        if np.all(np.abs(estimate.x) <= 1e-15 * np.abs(change)):
            break  # later passes would add nothing
    if options.step == "second-order":
        change = change + acceleration(setting, state, change, estimator)
        if lower is not None:
            change = np.clip(change, lower - state.u, upper - state.u)
    return change, float(np.linalg.norm(state.T @ change / setting.sd))

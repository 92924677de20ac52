"""Methods that are the loop of `mouse run`: support of those members."""

import numpy as np

from mouse_cli.methods.found import Found
from mouse_cli.methods.given import Given
from mouse_cli.model.problem import Problem
from mouse_cli.model.updated import Moved
from mouse_cli.updating import run


def by_loop(given: Given) -> Found:
    """What `run` finds, with the deck's own options."""
    result = run(given.problem, notice=given.notice)
    last = [cycle.theta for cycle in result.cycles[-2:]]
    spread = np.array([p.sd or 1.0 for p in given.problem.parameters])
    change = float(np.abs((last[-1] - last[0]) / spread).max()) if len(last) > 1 else 0.0
    theta = result.revised.theta
    settled = result.status.answered and result.status.exit_code == 0
    moved = movements(given.problem, theta)
    rejected = "the data contradict the form of the model, whatever the values of its properties"
    return Found(
        result.revised.K,
        result.revised.M,
        iterations=len(result.cycles) - 1,
        change=change,
        converged=settled,
        moved=moved,
        conditioning=result.conditioning,
        against=rejected if result.rejected else "",
    )


def movements(problem: Problem, theta: np.ndarray) -> tuple[Moved, ...]:
    """The properties that may vary, before and at theta (p,)."""
    rows = zip(problem.parameters, problem.prior.mean, theta, strict=False)
    return tuple(Moved(p.name, p.unit, float(a), float(b)) for p, a, b in rows if p.sd > 0)

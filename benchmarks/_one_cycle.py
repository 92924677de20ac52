"""One updating cycle through the code of a run, in parts: assembly, eigensolution, sensitivities, estimate."""

import time
from collections.abc import Callable

import numpy as np

from mouse_cli.estimators.bayes import solve
from mouse_cli.estimators.linear import LinearProblem
from mouse_cli.model.problem import Problem
from mouse_cli.updating.prior_model import begin

CHANGE = 0.02  # of the parameters from one cycle to the next, relative to their prior mean


def seconds(action: Callable[[], object]) -> tuple[float, object]:
    """How long one call takes of processor time, and its answer."""
    start = time.process_time()
    answer = action()
    return time.process_time() - start, answer


class Cycles:
    """A run that has begun: its setting, and the state of its last cycle."""

    def __init__(self, problem: Problem):
        self.problem, self.rng = problem, np.random.default_rng(1)
        self.setting, self.state = begin(problem)
        self.state.T  # what a run sets up once - orderings, patterns - is there before anything is timed  # noqa: B018

    def once(self) -> dict[str, float]:
        """Seconds of the parts of one cycle, at values of the parameters as far from the last as in a run."""
        setting, parts = self.setting, {}
        mean = setting.coordinates.mean
        u = mean * (1 + CHANGE * self.rng.standard_normal(len(mean)))
        parts["state"], state = seconds(lambda: setting.state(u))
        parts["sensitivities"], _ = seconds(lambda: state.T)
        parts["Bayes"], _ = seconds(
            lambda: solve(LinearProblem(state.T, state.residual, setting.sd, setting.coordinates.L))
        )
        parts["cycle"] = sum(parts.values())
        parts["assembly"], _ = seconds(lambda: setting.assembly.matrices(setting.coordinates.value(u)))
        parts["eigensolution"] = parts.pop("state") - parts["assembly"]
        self.state = state
        return parts

"""Bootstrap and jackknife of a modal test: which runs are done, and what their answers say together.

A datum of mode i and sensor s counts w = c_i c_s times: its variance is divided by that. The prior stays. To first order, with
B = R^-1/2 T L and C = (I + B'B)^-1 in prior units, a replicate lies at C B'(w - 1) r from the answer, r being the residuals in
standard deviations: were these independent, the replicates would have the covariance C B' diag(var w) B C.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli._errors import ERROR, DeckError, Diagnostic
from mouse_cli.batch.job import Job
from mouse_cli.estimators import estimator
from mouse_cli.estimators.linear import expand, in_prior_units
from mouse_cli.model.problem import Problem
from mouse_cli.updating.loop import begin
from mouse_cli.updating.posterior import laplace
from mouse_cli.updating.state import Setting

OVER = ("modes", "sensors", "both")


@dataclass(frozen=True)
class Plan:
    """Numbers of modes and sensors of which each is drawn as often; 0 for what is not drawn. counts (replicates, units)."""

    over: str
    m: int
    s: int
    counts: np.ndarray

    @property
    def units(self) -> int:
        """Number of modes and sensors that are drawn or left out."""
        return self.m + self.s

    def drawn(self, counts: np.ndarray) -> dict[str, list[int]]:
        """The option of a job for counts (units,), modes first."""
        found = {"modes": counts[: self.m], "sensors": counts[self.m :]}
        return {key: [int(c) for c in value] for key, value in found.items() if len(value)}


def plan(problem: Problem, over: str, replicates: int, seed: int) -> Plan:
    """Multinomial counts of modes and of sensors, drawn with replacement, as many as there are. Raises DeckError (MD934)."""
    if problem.test is None or problem.frf or problem.recordings:
        raise DeckError(_refused("the deck has no modal test, or fits functions too"))
    if not estimator(problem.run.estimator).weighted:
        raise DeckError(
            _refused(f"the estimator {problem.run.estimator} does not weight data, so that none counts twice")
        )
    test, rng = problem.test, np.random.default_rng(seed)
    m = test.m if over != "sensors" else 0
    s = test.s if over != "modes" else 0
    if (over != "sensors" and m < 2) or (over != "modes" and s < 2):
        raise DeckError(_refused(f"the test has {test.m} modes at {test.s} sensors"))
    parts = [rng.multinomial(n, np.full(n, 1 / n), size=replicates) for n in (m, s) if n]
    return Plan(over, m, s, np.hstack(parts) if parts else np.zeros((replicates, 0), int))


def _refused(why: str) -> Diagnostic:
    message = f"there are no modes or sensors to draw: {why}"
    return Diagnostic("MD934", ERROR, message, help="two of each kind that is drawn are needed; see --over")


def jobs(deck: str, plan: Plan, base: dict, outside: bool) -> list[Job]:
    """The deck as it is, without each unit in turn, and the replicates."""
    ones = np.ones(plan.units, int)
    left_out = [ones - (np.arange(plan.units) == i) for i in range(plan.units)]
    drawn = [{"drawn": plan.drawn(counts)} for counts in (*left_out, *plan.counts)]
    return [Job(deck, options=base | more, outside=outside) for more in ({}, *drawn)]


def predicted(problem: Problem, theta: np.ndarray, plan: Plan) -> tuple[np.ndarray, np.ndarray]:
    """Standard deviations (p,) of parameters and (m,) of frequencies over replicates, to first order, were all accuracies right."""
    from mouse_cli.dynamics.frequency import frequency_hz, sd_frequency_hz

    setting, _ = begin(problem)
    logarithmic = setting.coordinates.logarithmic
    u = np.where(logarithmic, np.log(np.where(logarithmic, theta, 1.0)), theta)
    normal = laplace(setting, setting.state(u))
    B = in_prior_units(normal.state.T, setting.coordinates.L) / setting.sd[:, None]
    spread = normal.root @ normal.root.T if _keeps_prior(problem) else np.linalg.pinv(B.T @ B)
    gain = spread @ (B * np.sqrt(_variances(setting, plan))[:, None]).T
    values = expand(setting.coordinates.L, gain) * setting.coordinates.slope(normal.state.u)[:, None]
    have = setting.observable.has_frequency
    modal = in_prior_units(normal.state.T, setting.coordinates.L)[: have.sum()] @ gain
    hz = frequency_hz(np.maximum(normal.state.solution.eigenvalues[normal.state.modes], 0.0))
    sd = np.full(len(hz), np.nan)
    sd[have] = sd_frequency_hz(hz[have], np.linalg.norm(modal, axis=1))
    return np.linalg.norm(values, axis=1), sd


def _keeps_prior(problem: Problem) -> bool:
    """Whether the answer is drawn to the prior; else, as where the replaced recursion ends, C is (B'B)^-1."""
    return problem.run.recursion == "anchored" and estimator(problem.run.estimator).uses_prior


def _variances(setting: Setting, plan: Plan) -> np.ndarray:
    """var w (q,) of multinomial counts: 1 - 1/n of each, of a product (2 - 1/m)(2 - 1/s) - 1."""
    of_mode = 1 - 1 / plan.m if plan.m else 0.0
    of_sensor = 1 - 1 / plan.s if plan.s else 0.0
    shapes = (1 + of_mode) * (1 + of_sensor) - 1
    frequencies = int(setting.observable.has_frequency.sum())
    found = np.full(len(setting.y), shapes)
    found[:frequencies] = of_mode
    return found

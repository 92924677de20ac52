"""Bootstrap and jackknife of a test: which runs are done, and what their answers say together.

A datum of mode i and sensor s counts w = c_i c_s times: its variance is divided by that. The prior stays. To first order, with
B = R^-1/2 T L and C = (I + B'B)^-1 in prior units, a replicate lies at C B'(w - 1) r from the answer, r being the residuals in
standard deviations: were these independent, the replicates would have the covariance C B' diag(var w) B C.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli._errors import ERROR, DeckError, Diagnostic
from mouse_cli.batch.drawn import functions, stretches
from mouse_cli.batch.job import Job
from mouse_cli.estimators.linear import expand, in_prior_units
from mouse_cli.model.campaign import Answered
from mouse_cli.model.problem import Problem
from mouse_cli.updating.posterior import laplace
from mouse_cli.updating.prior_model import begin, estimator
from mouse_cli.updating.state import Setting


@dataclass(frozen=True)
class Plan:
    """Names of the units of each kind (of `batch.drawn`) that is drawn. counts (replicates, units): how often."""

    over: str
    named: dict[str, tuple[str, ...]]
    counts: np.ndarray

    @property
    def sizes(self) -> tuple[int, ...]:
        """Numbers of units of each kind."""
        return tuple(len(each) for each in self.named.values())

    def drawn(self, counts: np.ndarray) -> dict[str, list[int]]:
        """The option of a job for counts (units,)."""
        parts = np.split(counts, np.cumsum(self.sizes)[:-1])
        return {kind: [int(c) for c in part] for kind, part in zip(self.named, parts, strict=True)}

    def variance(self, kind: str) -> float:
        """Of multinomial counts: 1 - 1/n."""
        return 1 - 1 / len(self.named[kind]) if kind in self.named else 0.0


def natural(problem: Problem) -> str:
    """What is drawn of a deck unless something is asked for."""
    if problem.by_recordings:
        return "records"
    return "functions" if problem.test is None else "modes"


def plan(problem: Problem, over: str, replicates: int, seed: int) -> Plan:
    """Multinomial counts of units, drawn with replacement, as many as there are. Raises DeckError (MD334, MD934)."""
    if not problem.by_recordings and not estimator(problem).weighted:
        raise DeckError(
            _refused(f"the estimator {problem.run.estimator} does not weight data, so that none counts twice")
        )
    named = _units(problem, over)
    if any(len(each) < 2 for each in named.values()):
        counts = " and ".join(f"{len(each)} {kind}" for kind, each in named.items())
        raise DeckError(_refused(f"the test has {counts}"))
    rng = np.random.default_rng(seed)
    parts = [rng.multinomial(len(each), np.full(len(each), 1 / len(each)), size=replicates) for each in named.values()]
    return Plan(over, named, np.hstack(parts))


def _units(problem: Problem, over: str) -> dict[str, tuple[str, ...]]:
    """What is drawn or left out: `mode 3`, `sensor 12TY`, `function H(3,1)`, `samples 0 to 300 of run 1`."""
    if over == "functions":
        return {"functions": functions(problem)}
    if over == "records":
        found = stretches(problem)[0] if problem.by_recordings else ()
        return {
            "records": tuple(f"samples {one.start} to {one.start + len(one.samples)} of {one.title}" for one in found)
        }
    test = problem.test
    modes, labels = (), ()
    if test is not None:
        modes = tuple(f"mode {number}" for number in test.number)
        labels = test.sensors or tuple(problem.structure.labels[dof] for dof in test.dofs)
    found = {"modes": modes, "sensors": tuple(f"sensor {label}" for label in labels)}
    return found if over == "both" else {over: found[over]}


def _refused(why: str) -> Diagnostic:
    message = f"there is nothing to draw: {why}"
    return Diagnostic("MD934", ERROR, message, help="two of each kind that is drawn are needed; see --over")


def jobs(deck: str, plan: Plan, base: dict, outside: bool) -> list[Job]:
    """The deck as it is (of recordings with each stretch once), without each unit in turn, and the replicates."""
    count = sum(plan.sizes)
    drawn = [{"drawn": plan.drawn(counts)} for counts in (np.ones(count), *(1 - np.eye(count)), *plan.counts)]
    drawn[0] = drawn[0] if plan.over == "records" else {}
    return [Job(deck, options=base | more, outside=outside) for more in drawn]


def predicted(problem: Problem, answer: Answered, plan: Plan) -> tuple[np.ndarray, np.ndarray]:
    """Standard deviations (p,) of parameters and (m,) of frequencies over replicates, to first order, were all accuracies right.

    Of recordings, all of which are drawn, by what the answer leaves of the prior alone: C B'B C = C - C C.
    """
    from mouse_cli.dynamics.frequency import frequency_hz, sd_frequency_hz

    theta = answer.theta
    if problem.by_recordings:
        share = np.clip((answer.sd / problem.prior.sd) ** 2, 0.0, 1.0)
        return answer.sd * np.sqrt((1 - share) * plan.variance("records")), np.zeros(0)
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
    return problem.run.recursion == "anchored" and estimator(problem).uses_prior


def _variances(setting: Setting, plan: Plan) -> np.ndarray:
    """var w (q,) of multinomial counts: 1 - 1/n of each, of a product (2 - 1/m)(2 - 1/s) - 1; functions after the modal test."""
    of_mode, of_sensor = plan.variance("modes"), plan.variance("sensors")
    of_functions = sum(len(one) for one in setting.frf.observables) if setting.frf else 0
    frequencies, modal = int(setting.observable.has_frequency.sum()), len(setting.y) - of_functions
    found = np.full(len(setting.y), plan.variance("functions"))
    found[:modal] = (1 + of_mode) * (1 + of_sensor) - 1
    found[:frequencies] = of_mode
    return found

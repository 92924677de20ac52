"""One run: eigensolution of the prior model, innovation test, recursion, tests and covariance of what came out."""

import sys
from dataclasses import replace

import numpy as np

from mouse_cli import __version__
from mouse_cli.dynamics.solver import EigenSolver, Notice
from mouse_cli.estimators import estimator as find_estimator
from mouse_cli.estimators.conditioning import conditioning
from mouse_cli.estimators.linear import (
    Estimator,
    LinearEstimate,
    LinearProblem,
    Unobservable,
    conditioned,
    in_prior_units,
)
from mouse_cli.model.conditioning import Conditioning
from mouse_cli.model.problem import MOST_COVARIANCE, Problem
from mouse_cli.model.result import ChiSquareTest, Result, Snapshot, Status
from mouse_cli.updating import alternatives, anchored, model_form, normality, refusals, replaced
from mouse_cli.updating.convergence import ExceedanceTest
from mouse_cli.updating.frf_fit import fits
from mouse_cli.updating.frf_start import start as frf_start
from mouse_cli.updating.posterior import laplace
from mouse_cli.updating.prior_model import begin
from mouse_cli.updating.prior_model import estimator as estimator_of
from mouse_cli.updating.remarks import remarks
from mouse_cli.updating.state import Setting, State, reference_eigenvalue
from mouse_cli.updating.trace import Progress, Trace

_HIGHER = 1e-3  # of J, by which another mode of the posterior is higher than where a run ended
RECURSIONS = {"replaced": replaced, "anchored": anchored}


def run(
    problem: Problem,
    progress: Progress = lambda cycle: None,
    notice: Notice = lambda text: None,
    guess: np.ndarray | None = None,
    enough: float = 0.0,
    solver: EigenSolver | None = None,
    search: bool = True,
) -> Result:
    """Revise the model of `problem` by its test.

    progress is called with each Cycle as it ends, notice with a sentence as each phase of a large model begins. guess (p,):
    values of the parameters near the answer, where the anchored recursion goes first; the prior stays. enough: the share of its
    cost that a step must promise and gain, else the anchored recursion ends. solver: one that solved this model before. search:
    look for other modes of the posterior. Raises DeckError for a deck whose test cannot belong to its model (a rigid-body mode
    named as measured, shapes that are unrelated), NumericalError where no eigensolution exists.

    >>> import mouse_cli
    >>> result = mouse_cli.run(mouse_cli.read_deck("decks/sound_chain.yaml"))
    >>> result.status.key, result.revised.theta.round().tolist(), result.sd_theta.round(1).tolist()
    ('converged', [1105.0, 951.0, 1055.0, 900.0], [8.6, 5.9, 6.6, 4.7])
    """
    estimator = estimator_of(problem)
    try:
        setting, start = begin(problem, notice, solver)
        if guess is not None:  # modal damping and gains add parameters behind those of the deck
            guess = np.concatenate([guess, setting.problem.prior.mean[len(guess) :]])
        trace = Trace(
            setting,
            ExceedanceTest(problem.run.confidence, problem.run.convergence),
            progress,
            start,
            guess=guess,
            enough=enough,
        )
        return _run(trace, estimator, search)
    except np.linalg.LinAlgError as reason:
        raise refusals.unphysical(problem, f"{reason} (values beyond what can be computed with)") from None


def _run(trace: Trace, estimator: Estimator, search: bool) -> Result:
    """`run`, once the prior model is solved."""
    setting, start = trace.setting, trace.state
    innovation = model_form.innovation(setting, start)
    if setting.frf is not None and setting.frf.observables and setting.problem.run.recursion == "anchored":
        trace.guess = frf_start(setting, trace.guess)
    status = RECURSIONS[setting.problem.run.recursion].recur(trace, estimator)
    found = alternatives.posterior_modes(setting, trace.state, estimator) if search and not status.exit_code else []
    if found and found[0].cost < laplace(setting, trace.state).cost - _HIGHER:  # it ended on a saddle, or a lower mode
        trace = Trace(setting, trace.test, trace.progress, start, guess=found[0].state.theta, enough=trace.enough)
        status = RECURSIONS[setting.problem.run.recursion].recur(trace, estimator)
    status = trace.sound(status)
    result = _result(trace, start, status, estimator, innovation)
    if len(found) > 1:
        result = replace(result, alternatives=alternatives.stated(found))
    doubt = normality.remark(result, setting, trace.state, estimator)
    return replace(result, warnings=(*remarks(result), *doubt))


def _result(trace: Trace, start: State, status: Status, estimator: Estimator, innovation: ChiSquareTest) -> Result:
    """Everything that is reported of a run that began at `start` and left `trace`."""
    setting, problem, end = trace.setting, trace.setting.problem, trace.state
    end.settle()
    estimate, at_limit = _spread(setting, end, estimator if status.answered else find_estimator("bayes"))
    residual, shift = model_form.residual_and_shift(setting, end, at_limit, estimator.uses_prior)
    slope = setting.coordinates.slope(end.u)
    wanted = problem.run.print_covariance or len(slope) <= MOST_COVARIANCE
    covariance = estimate.covariance() * np.outer(slope, slope) if wanted else None
    predicted = np.sum(in_prior_units(start.T, setting.coordinates.L) ** 2, axis=1)
    return Result(
        problem=problem,
        status=status,
        cycles=tuple(trace.cycles),
        prior=_snapshot(start, predicted),
        revised=_snapshot(end, estimate.predicted_variance(end.T)),
        y=setting.y,
        sd=setting.sd,
        labels=tuple(setting.labels()),
        test_shapes=setting.observable.shapes,
        test_shape_sd=setting.observable.shape_sd,
        shape_factor=setting.observable.factor,
        covariance=covariance,
        sd_theta=np.sqrt(np.maximum(estimate.variance, 0.0)) * slope,
        at_limit=at_limit,
        innovation=innovation,
        residual=residual,
        prior_shift=shift,
        rigid_modes=start.solution.rigid(reference_eigenvalue(problem, start.solution.eigenvalues)),
        z=trace.test.z,
        allowed=trace.cycles[-1].allowed,
        exceeding=trace.test.exceeding(end.residual, setting.sd),
        B=end.B if problem.run.print_partials else None,
        T=end.T if problem.run.print_partials else None,
        versions={"mouse": __version__, "numpy": np.__version__, "python": sys.version.split()[0]},
        partials_error=end.error,
        conditioning=_conditioning(setting, end, estimator),
        **vars(fits(start, end, _root(setting.coordinates.L), estimate.root)),
    )


def _conditioning(setting: Setting, end: State, estimator: Estimator) -> Conditioning | None:
    """What errors of data and sensitivities can do to the answer."""
    L, shift = setting.coordinates.L, end.u - setting.coordinates.mean
    z = (
        np.divide(shift, L, out=np.zeros_like(shift), where=L > 0)
        if L.ndim == 1
        else np.linalg.lstsq(L, shift, rcond=None)[0]
    )
    problem = LinearProblem(end.T, end.residual + end.T @ shift, setting.sd, L)
    return conditioning(problem, z, estimator.weighted, estimator.uses_prior, end.error)


def _root(L: np.ndarray) -> np.ndarray:
    """The root of the prior as a matrix (p, k)."""
    return np.diag(L) if L.ndim == 1 else L


def _spread(setting: Setting, state: State, estimator: Estimator) -> tuple[LinearEstimate, np.ndarray]:
    """Covariance of the revised parameters, with T of the final model (O-11); and which of them stand at a limit (p,)."""
    problem = LinearProblem(state.T, state.residual, setting.sd, setting.coordinates.L)
    try:
        estimate = estimator.solve(problem)
    except Unobservable:
        estimate = find_estimator("bayes").solve(problem)
    at_limit = setting.coordinates.at_limit(state.u)
    if at_limit.any():
        in_u = replace(problem, L=np.eye(len(state.u)))
        root = np.where(at_limit[:, None], 0.0, conditioned(in_u, estimate.root(), at_limit))
        estimate = replace(estimate, root=lambda: root, variances=None, seen=None)
    return estimate, at_limit


def _snapshot(state: State, variance: np.ndarray) -> Snapshot:
    """What a report needs of `state`, with the `variance` (q,) that the uncertainty of the parameters gives its data."""
    return Snapshot(
        theta=state.theta,
        K=state.K,
        M=state.M,
        eigenvalues=state.solution.eigenvalues,
        shapes=state.solution.shapes,
        modes=state.modes,
        model_shapes=state.shapes,
        predicted=state.predicted,
        sd_predicted=np.sqrt(variance),
        mac=state.mac,
    )

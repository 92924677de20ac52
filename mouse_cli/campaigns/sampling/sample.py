"""From a deck to its posterior: mode by a run, other modes, weights of normal draws, the ensemble, what it says."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mouse_cli._errors import ERROR, WARNING, Diagnostic, NumericalError
from mouse_cli.campaigns.sampling import chains, ensemble, pareto, search
from mouse_cli.campaigns.sampling.kept import Kept
from mouse_cli.campaigns.sampling.pool import pool_of
from mouse_cli.estimators.linear import expand
from mouse_cli.model.problem import Problem
from mouse_cli.model.result import Result
from mouse_cli.model.sampled import Chain, PosteriorMode, Quantity, Sampled, Sampling
from mouse_cli.updating.loop import run
from mouse_cli.updating.normality import falls, finding
from mouse_cli.updating.posterior import Laplace, laplace
from mouse_cli.updating.prior_model import begin
from mouse_cli.updating.state import Setting

_DRAWS = 2000  # so many that a k-hat up to 0.7 is told from a larger one: 1 - 1/log10(s)
_SHIFTED, _WIDER = 0.5, 1.25  # standard deviations, and factor, by which samples may differ from the run unremarked
_QUANTILES = (0.025, 0.16, 0.5, 0.84, 0.975)


def sample(
    problem: Problem, choices: Sampling, say: Callable[[str], None] = lambda text: None, keep: str | None = None
) -> Sampled:
    """Samples of the posterior of `problem`: its prior and the likelihood of its data, whatever its estimator.

    keep: file of samples to come; beside it stands how far a walk has come, and one that was broken off goes on from there.

    Raises MouseError: MD940 without emcee, MD941 where there is nothing to sample; and what a run raises.
    """
    ensemble.package()
    problem = _posed(problem)
    result = run(problem, notice=say, search=False)
    setting, _ = begin(problem)
    if not setting.coordinates.L.size or not len(setting.y) or not result.status.answered:
        raise NumericalError(_nothing(problem, result))
    rng = np.random.default_rng(choices.seed)
    normal = laplace(setting, setting.state(_found(setting, result)))
    say("seeking other modes of the posterior")
    modes = search.modes(setting, rng, normal)
    density = ensemble.Density(setting, modes[0].z, modes[0].root)
    walkers = choices.walkers or max(16, 4 * len(normal.z))
    begun = search.start(modes, max(walkers + walkers % 2, 2 * len(normal.z)), rng)
    with pool_of(problem, density, choices.processes) as pool:
        say(f"weighing {_DRAWS} draws from the normal density of the run")
        k_hat = _k_hat(normal, density, pool.map if pool else map, rng)
        walked = ensemble.walk(density, begun, choices.steps, choices.seed, pool, say, Kept(keep))
    found = _summed(problem, result, setting, modes, walked, rng)
    evaluations = _DRAWS + walked.steps * len(begun)
    found = replace(found, k_hat=k_hat, draws=_DRAWS, evaluations=evaluations, seed=choices.seed)
    return replace(found, warnings=tuple(_remarks(found, normal)))


def _posed(problem: Problem) -> Problem:
    """With the estimator and the recursion that find the mode of the posterior."""
    options = replace(
        problem.run, estimator="bayes", recursion="anchored", cycles=None, partials=max(problem.run.partials, 30)
    )
    return replace(problem, run=options)


def _nothing(problem: Problem, result: Result) -> Diagnostic:
    why = result.status.sentence if not result.status.answered else "no property may vary, or nothing was measured"
    message = f"the deck '{problem.title.strip()}' has no posterior to sample: {why}"
    return Diagnostic("MD941", ERROR, message, problem.place("order"), help="check it with `mouse run`")


def _found(setting: Setting, result: Result) -> np.ndarray:
    """Coordinates (p,) of the revised values; within the limits to the last digit."""
    logarithmic, theta = setting.coordinates.logarithmic, result.revised.theta
    u = np.where(logarithmic, np.log(np.where(logarithmic, theta, 1.0)), theta)
    lower, upper = setting.coordinates.lower, setting.coordinates.upper
    return u if lower is None else np.clip(u, lower, upper)


def _k_hat(normal: Laplace, density: ensemble.Density, each: Callable, rng: np.random.Generator) -> float:
    """Pareto k-hat of draws from the normal density: log weights -J/2 + |w|^2/2."""
    w = rng.standard_normal((_DRAWS, len(normal.z)))
    logs = np.array([log_p for log_p, _ in each(density, density.w(normal.z + w @ normal.root.T))])
    return pareto.k_hat(0.5 * (np.sum(w * w, axis=1) + normal.cost) + logs)


def _summed(
    problem: Problem,
    result: Result,
    setting: Setting,
    modes: list[Laplace],
    walked: ensemble.Walked,
    rng: np.random.Generator,
) -> Sampled:
    """What the chain says of every parameter and frequency."""
    flat = walked.z.reshape(-1, walked.z.shape[2])
    theta = setting.coordinates.value(setting.coordinates.mean + expand(setting.coordinates.L, flat.T).T)
    theta = theta.reshape(*walked.z.shape[:2], -1)
    shares = search.nearest(modes, flat)
    peaks = [
        PosteriorMode(each.state.theta, each.cost, float(share)) for each, share in zip(modes, shares, strict=True)
    ]
    return Sampled(
        problem, result, tuple(_parameters(setting, result, theta)), tuple(_frequencies(result, walked.hz, rng)),
        tuple(peaks), Chain(theta, walked.log_p, walked.hz), walked.steps, walked.burn, walked.tau, walked.acceptance,
        walked.long_enough, np.nan, 0, 0, 0,
    )  # fmt: skip


def _parameters(setting: Setting, result: Result, theta: np.ndarray):
    parameters = setting.problem.parameters
    for i, parameter in enumerate(parameters):
        normal = float(result.revised.theta[i]), float(result.sd_theta[i])
        yield _quantity(parameter.name, parameter.unit, normal, theta[:, :, i])


def _frequencies(result: Result, hz: np.ndarray, rng: np.random.Generator):
    from mouse_cli.report.result_document import modes

    test = result.problem.test
    for i, mode in enumerate(modes(result)):
        chain = hz[:, :, i]
        sd = test.frequency_sd_hz[i]
        noise = rng.standard_normal(chain.shape) * (sd if np.isfinite(sd) else np.nan)
        predicted = np.quantile(chain + noise, (0.025, 0.975)) if np.isfinite(sd) else None
        spread = mode["sd_hz"] if mode["sd_hz"] is not None else np.nan
        found = _quantity(str(mode["mode"]), "Hz", (mode["revised_hz"], spread), chain)
        yield replace(found, measured=float(test.frequency_hz[i]), predicted=predicted)


def _quantity(name: str, unit: str, normal: tuple[float, float], chain: np.ndarray) -> Quantity:
    """One column (s, w) of the chain."""
    tau = float(chains.times(chain[:, :, None])[0])
    r_hat = float(chains.r_hat(chain[:, :, None])[0])
    return Quantity(
        name, unit, *normal, float(chain.mean()), float(chain.std()), np.quantile(chain, _QUANTILES), tau, chain.size / tau, r_hat
    )  # fmt: skip


def _remarks(found: Sampled, normal: Laplace):
    """What a careful reader of the samples should know."""
    doubts = [each for each in falls(normal, np.arange(len(normal.z))) if each.doubtful]
    if doubts:
        yield replace(finding(normal.setting.problem.parameters, found.result.sd_theta, doubts), help="use the samples")
    if not found.k_hat <= pareto.DOUBTFUL:
        message = (
            f"the normal density of the run is no substitute for the posterior: k-hat of its draws is {found.k_hat:.2g}"
        )
        yield Diagnostic(
            "MD942", WARNING, message, help="use the samples, and not the standard deviations of `mouse run`"
        )
    if len(found.modes) > 1:
        shares = ", ".join(f"{each.share:.2g}" for each in found.modes)
        message = f"the posterior has {len(found.modes)} modes, with shares {shares} of the samples; a run knows of one"
        yield Diagnostic(
            "MD943", WARNING, message, help="measure what separates them, or state in the prior what is known"
        )
    for each in (one for one in found.parameters if one.normal_sd > 0):
        shift, ratio = (each.mean - each.normal_mean) / each.normal_sd, each.sd / each.normal_sd
        if abs(shift) > _SHIFTED or not 1 / _WIDER < ratio < _WIDER:
            message = (
                f"{each.name}: the mean of the samples lies {shift:+.2g} standard deviations of the run from its value, and their "
                f"standard deviation is {ratio:.2g} times as large"
            )
            yield Diagnostic(
                "MD945", WARNING, message, help="use the samples, and not the standard deviations of `mouse run`"
            )
    if not found.long_enough:
        length = (found.steps - found.burn) / found.tau
        worst = max(each.r_hat for each in found.parameters)
        message = f"the chain is too short: {length:.0f} autocorrelation times, R-hat up to {worst:.3f}"
        help = f"allow more --steps: {chains.ENOUGH} autocorrelation times and R-hat below {chains.AGREED} are enough"
        yield Diagnostic("MD944", WARNING, message, help=help)

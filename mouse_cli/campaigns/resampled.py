"""What the runs of a bootstrap say together; intervals after Efron and Tibshirani, An Introduction to the Bootstrap, 1993."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mouse_cli._errors import WARNING, Diagnostic, NumericalError
from mouse_cli.batch.outcome import Outcome
from mouse_cli.campaigns import answers, bootstrap
from mouse_cli.campaigns.bootstrap import Plan
from mouse_cli.campaigns.sweep import paired
from mouse_cli.model.campaign import Bootstrap, Spread
from mouse_cli.model.problem import Problem

_LEVEL = 0.005  # chance by which a spread that the accuracies account for is called too large, or too small
_LARGE = 1.0  # posterior standard deviations by which one mode or sensor may move an answer


def summed(problem: Problem, plan: Plan, outcomes: list[Outcome], seed: int) -> Bootstrap:
    """`outcomes` of `bootstrap.jobs`, in their order. Raises NumericalError (MD935) where the deck itself has no answer."""
    names = [each.name for each in problem.parameters]
    numbers, modes = paired(outcomes[0])
    first, *rest = (answers.read(each, names, modes) for each in outcomes)
    if not first.found:
        message = f"the deck itself has no answer: {first.ended}"
        raise NumericalError.of("MD935", message, help="check it with `mouse run`")
    units = tuple(name for each in plan.named.values() for name in each)
    left_out, drawn = rest[: len(units)], rest[len(units) :]
    predicted = bootstrap.predicted(problem, first, plan)
    kept = [each for each in drawn if each.found]
    parameters = tuple(
        _spread(each.name, each.unit, (first.theta[i], first.sd[i], predicted[0][i]), [a.theta[i] for a in kept],
                [a.theta[i] for a in left_out], plan)
        for i, each in enumerate(problem.parameters)
    )  # fmt: skip
    sd = [np.nan if each["sd_hz"] is None else each["sd_hz"] for each in answers.document(outcomes[0]).get("modes", ())]
    frequencies = tuple(
        _spread(str(number), "Hz", (first.hz[i], sd[i], predicted[1][i]), [a.hz[i] for a in kept],
                [a.hz[i] for a in left_out], plan)
        for i, number in enumerate(numbers)
    )  # fmt: skip
    found = Bootstrap(
        problem, plan.over, seed, first, units, tuple(left_out), tuple(drawn), plan.counts, parameters,
        frequencies, first.exit_code,
    )  # fmt: skip
    return replace(found, warnings=tuple(_remarks(found, plan)))


def _spread(
    name: str, unit: str, run: tuple[float, float, float], drawn: list[float], left_out: list[float], plan: Plan
) -> Spread:
    """`run`: value, posterior sd and what was predicted."""
    value, sd, predicted = (float(each) for each in run)
    x, without = np.array(drawn, float), np.array(left_out, float)
    x = x[np.isfinite(x)]
    samples = [part[np.isfinite(part)] for part in np.split(without, np.cumsum(plan.sizes)[:-1])]
    samples = [part for part in samples if len(part) > 1]
    influence = (without - value) / sd if sd > 0 else np.full(len(without), np.nan)
    jackknife = jackknife_sd(samples) if samples else np.nan
    if len(x) < 2:
        none = np.full(2, np.nan)
        return Spread(name, unit, value, sd, predicted, np.nan, np.nan, none, none, jackknife, influence)
    return Spread(
        name, unit, value, sd, predicted, float(x.std(ddof=1)), float(x.mean() - value), percentile(x),
        bca(x, value, samples), jackknife, influence,
    )  # fmt: skip


def limits(plan_units: int) -> tuple[float, float]:
    """Between what sd / predicted of n units lies 99 times in 100, as chi / sqrt(n - 1) does."""
    from scipy.stats import chi2

    dof = max(1, plan_units - 1)
    low, high = chi2.ppf([_LEVEL, 1 - _LEVEL], dof) / dof
    return float(np.sqrt(low)), float(np.sqrt(high))


def _remarks(found: Bootstrap, plan: Plan) -> Iterator[Diagnostic]:
    """What a careful reader of a bootstrap should know."""
    low, high = limits(min(plan.sizes))
    ratios = [(s.sd / s.predicted, s.name) for s in found.parameters if s.predicted > 0 and np.isfinite(s.sd)]
    if ratios and max(ratios)[0] > high:
        ratio, name = max(ratios)
        times = f"{ratio:.2g}" if ratio < 100 else f"{ratio:.0f}"
        message = f"{name} spreads {times} times as far as the accuracies of the test account for"
        help = "the data disagree among themselves, or their standard deviations are stated too small"
        yield Diagnostic("MD936", WARNING, message, help=help)
    if ratios and max(ratios)[0] < low:
        message = (
            f"no property spreads more than {max(ratios)[0]:.2g} times as far as the accuracies of the test account for"
        )
        yield Diagnostic("MD937", WARNING, message, help="the standard deviations of the data are stated too large")
    yield from _influential(found)
    for runs, what in ((found.replicates, "replicates"), (found.left_out, "runs that leave one out")):
        silent = sum(not each.found for each in runs)
        if silent:
            message = f"{silent} of {len(runs)} {what} have no answer and are left out"
            yield Diagnostic("MD931", WARNING, message, help="see their codes in the files of the answers")


def _influential(found: Bootstrap) -> Iterator[Diagnostic]:
    for each in found.parameters:
        unit = each.most_influential
        if unit is not None and abs(each.influence[unit]) > _LARGE:
            message = f"without {found.units[unit]} {each.name} moves by {each.influence[unit]:+.2g} posterior standard deviations"
            yield Diagnostic("MD938", WARNING, message, help="check that measurement: the answer depends on it")


LEVEL = 0.95


def percentile(replicates: np.ndarray) -> np.ndarray:
    """Ends (2,) of the interval between quantiles of replicates (b,); section 13.3."""
    return np.quantile(replicates, [(1 - LEVEL) / 2, (1 + LEVEL) / 2])


def bca(replicates: np.ndarray, value: float, left_out: list[np.ndarray]) -> np.ndarray:
    """Ends (2,) of the bias-corrected, accelerated interval; section 14.3. left_out: for each sample, answers without one unit.

    z0 = Phi^-1(share of replicates below the value, ties by half); a = sum l^3 / n^3 / 6 (sum l^2 / n^2)^(3/2), where
    l = (n - 1)(mean - left out), summed over the n units of every sample. NaN where all replicates lie to one side.
    """
    from scipy.special import ndtr, ndtri

    below = (np.mean(replicates < value) + np.mean(replicates <= value)) / 2
    z0 = ndtri(below)
    parts = [((len(x) - 1) * (x.mean() - x), len(x)) for x in left_out]
    cubes = sum(float(np.sum(l**3)) / n**3 for l, n in parts)
    squares = sum(float(np.sum(l**2)) / n**2 for l, n in parts)
    a = cubes / (6 * squares**1.5) if squares > 0 else 0.0
    z = z0 + ndtri(np.array([(1 - LEVEL) / 2, (1 + LEVEL) / 2]))
    with np.errstate(invalid="ignore"):
        shares = ndtr(z0 + z / (1 - a * z))
    return np.quantile(replicates, shares) if np.isfinite(shares).all() else np.full(2, np.nan)


def jackknife_sd(left_out: list[np.ndarray]) -> float:
    """Root of sum (n - 1)/n sum (left out - mean)^2 over the samples; section 11.2."""
    return float(np.sqrt(sum((len(x) - 1) / len(x) * np.sum((x - x.mean()) ** 2) for x in left_out)))

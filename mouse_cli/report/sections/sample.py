"""What the report says of a posterior by samples."""

from collections.abc import Iterator

from mouse_cli.model.sampled import Sampled
from mouse_cli.report.blocks import Block, Column, Table, Text, heads
from mouse_cli.report.section import RESULT, VERDICT, Options, Section
from mouse_cli.report.sections._wording import counted, deck_table, worded


def verdict(found: Sampled, options: Options) -> Iterator[Block]:
    """Samples in brief: whether the chain and the model can be trusted, and what the normal density is worth."""
    if found.result.rejected:
        yield Text("The form of the model is rejected: the posterior is that of a model which cannot give these data.")
    if not found.long_enough:
        yield Text("Do not use these samples: the chain is too short.")
    trusted = "may stand" if not found.doubtful else "must not stand"
    several = f" The posterior has {len(found.modes)} modes." if len(found.modes) > 1 else ""
    yield Text(
        f"The normal density of the run {trusted} for the posterior: Pareto k-hat of {found.draws} draws from it is {{}}.{several}",
        (round(found.k_hat, 2),),
    )


_QUANTITIES_COLUMNS = heads(
    "<property | <unit | run | sd of run | mean | sd | median | 68 % from | to | 95 % from | to"
)
_CHAIN = heads("<property | autocorrelation time [steps] | effective sample size | R-hat")


def properties(found: Sampled, options: Options) -> Iterator[Block]:
    """One line a property: what the run says, and what the samples say; then how well the chain knows it."""
    rows = []
    for each in found.parameters:
        low, left, median, right, high = (float(value) for value in each.quantiles)
        means = each.normal_mean, each.normal_sd, each.mean, each.sd
        rows.append((each.name, each.unit, *means, median, left, right, low, high))
    yield Table(_QUANTITIES_COLUMNS, rows).without_empty_columns()
    yield Table(_CHAIN, tuple((e.name, round(e.tau, 1), round(e.size), round(e.r_hat, 3)) for e in found.parameters))
    yield Text("Intervals are between quantiles of the samples, with equal shares on either side.")


_FREQUENCIES_COLUMNS = heads(
    "mode | test [Hz] | run [Hz] | sd of run [Hz] | mean [Hz] | sd [Hz] | 95 % from [Hz] | to [Hz] | "
    "new test from [Hz] | to [Hz]"
)


def frequencies(found: Sampled, options: Options) -> Iterator[Block]:
    """Natural frequencies of the revised model by samples, and what a new measurement would give."""
    rows = []
    for each in found.frequencies:
        low, high = each.quantiles[0], each.quantiles[-1]
        new = (None, None) if each.predicted is None else tuple(float(value) for value in each.predicted)
        rows.append((each.name, each.measured, each.normal_mean, each.normal_sd, each.mean, each.sd, low, high, *new))
    if rows:
        yield Table(_FREQUENCIES_COLUMNS, rows).without_empty_columns()
        yield Text(
            "The 95 % interval is of the model's own frequency; a new measurement of the same accuracy lies within the last two "
            "columns with probability 0.95."
        )


def modes(found: Sampled, options: Options) -> Iterator[Block]:
    """One line a mode, the highest first; nothing where there is one."""
    if len(found.modes) < 2:
        return
    own = tuple(Column(p.name, p.unit, literal=True) for p in found.result.problem.parameters)
    columns = heads("mode", *own, "J | share")
    rows = tuple((i, *each.theta[: len(own)], each.cost, each.share) for i, each in enumerate(found.modes, 1))
    yield Table(columns, rows)
    yield Text(
        "J is chi-square of the data with that of the prior; the share is that of the samples nearest to the mode."
    )


def remarks(found: Sampled, options: Options) -> Iterator[Block]:
    """What a careful reader of samples should know, in words. One paragraph a remark."""
    yield from worded((*found.problem.warnings, *found.warnings), options)


def heading(found: Sampled, options: Options) -> Iterator[Block]:
    """Heading of samples of a posterior: program, deck, how long the chain is. What was sampled and how well."""
    yield deck_table(found.problem)
    kept, walkers = found.chain.log_posterior.shape
    yield Text(
        f"An ensemble of {counted(walkers, 'walker')} took {counted(found.steps, 'step')} each from the result of the run "
        f"(estimator bayes, recursion anchored), of which the first {found.burn} are left out; {{}} of 100 proposals were taken. "
        f"The autocorrelation time is {{}} steps, so that each walker went on for {{}} of them; seed {found.seed}, "
        f"{counted(found.evaluations, 'model')} solved.",
        (round(100 * found.acceptance), round(found.tau, 1), round(kept / found.tau)),
    )


SECTIONS = (
    Section("sample-verdict", 10, "Posterior by samples", verdict, (Sampled,), place=VERDICT),
    Section("sample-properties", 20, "Properties", properties, (Sampled,), place=RESULT),
    Section("sample-frequencies", 30, "Natural frequencies", frequencies, (Sampled,), place=RESULT),
    Section("sample-modes", 40, "Modes of the posterior", modes, (Sampled,), place=RESULT),
    Section("sample-remarks", 60, "Remarks", remarks, (Sampled,), place=RESULT),
    Section("sample-heading", 10, "Sampling", heading, (Sampled,)),
)

"""How a run ended, whether the form of the model holds, and what to do next."""

import os
from collections.abc import Iterator

from mouse_cli._texts import capital
from mouse_cli.estimators import estimator
from mouse_cli.model.result import NO_ANSWER, Result
from mouse_cli.report.blocks import Block, Lines, Text
from mouse_cli.report.section import RESULT, VERDICT, Options, Section
from mouse_cli.report.sections._diagnosis_wording import p_value
from mouse_cli.report.sections._wording import test_table, worded

_UNFINISHED = {
    "stalled": "more data lie outside their limits than chance allows",
    "diverged": "the run has moved away from them",
}


def verdict(result: Result, options: Options) -> Iterator[Block]:
    """Conclusion, status, tests of the model's form."""
    yield Text(_conclusion(result))
    if result.alternatives is not None and result.alternatives.doubtful:
        most = max(each.share for each in result.alternatives.others)
        yield Text(
            f"These values are not the only ones that fit: others hold {100 * most:.0f} per cent of the posterior. Do not use them "
            "before a measurement has decided."
        )
    yield Text(" ".join(filter(None, (result.status.sentence, result.status.advice))))
    if options.short:
        yield Text(_tests(result))
        return
    yield test_table((result.innovation, result.residual, result.prior_shift))
    yield Text(_residual(result))
    yield Text(_prior_shift(result))
    if result.partials_error:
        yield Text(
            f"The partial derivatives of this answer have an estimated relative error of {result.partials_error:.0e}; `--exact` "
            "computes them to rounding."
        )


def _tests(result: Result) -> str:
    """The tests of the model's form on one line."""
    fit, shift = result.residual, result.prior_shift
    parts = [f"goodness of fit {p_value(fit.p)} (chi-square {fit.chi2:.4g} on {fit.dof})"] if fit.dof else []
    parts += [f"shift from the prior {p_value(shift.p)}"] if shift.dof else []
    before = result.innovation
    parts += [f"before the revision {p_value(before.p)}"] if before.dof else []
    text = "; ".join(parts) or "nothing is left to test the model by"
    return f"{capital(text)}."


def _residual(result: Result) -> str:
    test = result.residual
    if test.dof == 0:
        return "Residual: there are no more data than properties, so no residual can contradict the model."
    if test.rejects:
        within = " within their limits" if result.at_limit.any() else ""
        return (
            f"Residual: inconsistent with the accuracies of the test for any values of the properties{within} "
            f"({p_value(test.p)})."
        )
    return f"Residual: consistent with the accuracies of the test ({p_value(test.p)})."


def _prior_shift(result: Result) -> str:
    test = result.prior_shift
    if test.dof == 0 and estimator(result.problem.run.estimator).uses_prior:
        return "Prior shift: not tested, for the data do not determine the properties."
    if test.dof == 0:
        return "Prior shift: not tested, for this estimator uses no prior."
    if test.rejects:
        return (
            "Prior shift: the values that fit the data are inconsistent with prior values and standard deviations "
            f"({p_value(test.p)})."
        )
    return (
        f"Prior shift: the revised values are consistent with prior values and standard deviations ({p_value(test.p)})."
    )


def _conclusion(result: Result) -> str:
    """The plain statement."""
    form = result.model_form
    if form == "rejected" and result.residual.rejects:
        return (
            "The form of the model is rejected: the data show what the model lacks, or are less accurate than stated. The "
            "revised properties compensate for something else; do not trust them."
        )
    if form == "rejected":
        return (
            "The form of the model is rejected: it fits the data only with values of its properties that the prior excludes. "
            "Either the prior standard deviations are too small, or the properties compensate for missing physics."
        )
    if form == "untested":
        reason = "the run gave no answer" if not result.status.answered else "the run was interrupted"
        if result.status.exit_code < NO_ANSWER:
            reason = "the data leave nothing to test it by"
        return f"The form of the model is not tested: {reason}."
    if result.status.exit_code:
        return (
            "The data do not contradict the form of the model, to first order; but "
            f"{_UNFINISHED.get(result.status.key, 'the run has not come to its end')}, and its values are not to be "
            "trusted yet."
        )
    return "The model explains the data."


def warnings(result: Result, options: Options) -> Iterator[Block]:
    """What a careful reader of a run should know: warnings of the deck and of the update. One paragraph each."""
    yield from worded((*result.problem.warnings, *result.warnings), options)


def commands(result: Result, options: Options) -> Iterator[Block]:
    """One line a command, of a short report alone: the whole one is not read at the terminal."""
    deck = result.problem.source.path
    if not options.short or not os.path.isfile(deck):
        return
    pairs = [(command.format(deck), what) for command, what in _next(result)]
    wide = max((len(command) for command, _ in pairs), default=0)
    yield Lines(tuple(f"{command:<{wide}}  # {what}" for command, what in pairs))


def _next(result: Result) -> Iterator[tuple[str, str]]:
    """What helps with such an answer."""
    if result.rejected:
        yield "mouse diagnose {}", "what the model lacks, and where"
    if result.status.exit_code:
        yield "mouse correlate {}", "pairs of modes, sensors that look faulty"
    if result.status.exit_code < NO_ANSWER:
        yield "mouse run {} --json -o result.json", "for `mouse report` and `mouse plot`"


def innovation(result: Result, options: Options) -> Iterator[Block]:
    """Before the cycles: are the data consistent with the prediction of the prior model and its uncertainty?"""
    test = result.innovation
    yield test_table((test,))
    if test.dof == 0:
        yield Text("The data leave nothing to test.")
    elif test.rejects:
        yield Text(
            f"The data are inconsistent with the prediction of the prior model ({p_value(test.p)}). The form of the model, prior "
            "standard deviations or the accuracies of the test are wrong, or the differences are too large for first-order "
            "partial derivatives."
        )
    else:
        yield Text(
            "The data are consistent with the prediction of the prior model, its uncertainty and the accuracies of the test "
            f"({p_value(test.p)})."
        )


SECTIONS = (
    Section("verdict", 120, "Verdict", verdict, place=VERDICT),
    Section("warnings", 130, "Warnings", warnings, place=RESULT),
    Section("next", 140, "Next", commands, place=RESULT),
    Section("innovation", 40, "Test against prior model", innovation),
)

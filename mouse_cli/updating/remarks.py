"""What a careful reader of an answer should know: properties the data do not determine, limits, signs, modes mistaken."""

from collections.abc import Iterator

import numpy as np

from mouse_cli._errors import WARNING, Diagnostic
from mouse_cli._span import Span
from mouse_cli.dynamics.correlation import mac
from mouse_cli.dynamics.frequency import frequency_hz
from mouse_cli.model.result import REJECT, Result
from mouse_cli.terms.assembly import assembly

_SILENT = 0.99  # revised over prior standard deviation: above this the data said nothing
_TIED = 0.995  # correlation above which two properties are determined only together
_UNLIKE, _FAR = 0.1, 0.5  # MAC below which, and share of its frequency beyond which, a partner is none
_FEW = 5  # degrees of freedom below which a close fit is nothing remarkable


def remarks(result: Result) -> Iterator[Diagnostic]:
    """What a careful reader of the answer should know."""
    if not result.status.answered:
        return
    yield from _too_good(result)
    yield from _idle_mass(result)
    yield from _insensitive(result)
    yield from _tied(result)
    yield from _limits(result)
    yield from _signs(result)
    yield from _places(result)
    yield from _strangers(result)
    yield from _undamped(result)


def _too_good(result: Result) -> Iterator[Diagnostic]:
    """A fit much closer than the accuracies let expect: they are overstated, and so is every standard deviation."""
    if result.residual.dof >= _FEW and result.residual.p > 1 - REJECT:
        yield _remark(
            "MD507",
            f"the data agree with the model better than their stated accuracies imply (chi-square {result.residual.chi2:.3g} on "
            f"{result.residual.dof} degrees of freedom)",
            help="check the stated accuracies: if they are too large, so are the revised standard deviations",
        )


def _idle_mass(result: Result) -> Iterator[Diagnostic]:
    problem = result.problem
    moved = (problem.elements.is_mass & (np.abs(problem.A).sum(axis=1) > 0)).any()
    if problem.run.fix_total_mass and not moved and not any("M" in term.places for term in problem.terms):
        yield _remark("MD508", "the total mass is held, but no property moves a mass", help="leave fix_total_mass out")


def _insensitive(result: Result) -> Iterator[Diagnostic]:
    prior = result.problem.prior
    for i, parameter in enumerate(result.problem.parameters):
        before, after = prior.sd[i], result.sd_theta[i]
        if parameter.transform == "log":  # as shares of the value, as it is estimated
            before, after = before / abs(prior.mean[i]), after / abs(result.revised.theta[i])
        if before > 0 and not result.at_limit[i] and after > _SILENT * before:
            unit = " of its value" if parameter.transform == "log" else ""
            yield _remark(
                "MD502",
                f"the data do not determine {parameter.name}: its standard deviation is {after:.4g}{unit}, before the test "
                f"{before:.4g}",
                parameter.span,
                "measure a mode or a point that it moves",
            )


def _tied(result: Result) -> Iterator[Diagnostic]:
    if result.covariance is None:
        return
    sd = np.where(result.sd_theta > 0, result.sd_theta, np.inf)
    correlation = np.triu(result.covariance / np.outer(sd, sd), 1)
    names = [p.name for p in result.problem.parameters]
    for i, j in np.argwhere(np.abs(correlation) > _TIED)[:10]:
        kind = "sum" if correlation[i, j] < 0 else "ratio or difference"
        yield _remark(
            "MD503",
            f"{names[i]} and {names[j]} are determined only together (correlation {correlation[i, j]:+.4f}): trust their {kind}",
        )


def _limits(result: Result) -> Iterator[Diagnostic]:
    for parameter, value, stopped in zip(result.problem.parameters, result.revised.theta, result.at_limit, strict=True):
        if stopped:
            yield _remark(
                "MD504",
                f"{parameter.name} stopped at its limit, {value:.6g}; its standard deviation is not meaningful there",
                parameter.span,
                "if the limit is not physical, widen it; if it is, look for missing physics",
            )


def _signs(result: Result) -> Iterator[Diagnostic]:
    for parameter, value in zip(result.problem.parameters, result.revised.theta, strict=True):
        if parameter.nominal > 0 >= value:
            yield _remark(
                "MD505",
                f"{parameter.name} became {value:.6g}; its prior value was {parameter.nominal:.6g}",
                parameter.span,
                "use transform: log or lower: 0 if it cannot be negative",
            )


def _places(result: Result) -> Iterator[Diagnostic]:
    """Measured modes that look like another model mode than the one they were compared with."""
    test, revised = result.problem.test, result.revised
    if np.isfinite(test.shapes).sum(axis=0).min(initial=3) < 3:
        return
    likeness = mac(test.shapes, test.read(revised.shapes))
    for i, mode in enumerate(revised.modes):
        best = int(np.argmax(likeness[i]))
        if best != mode and likeness[i, best] > 0.8 and likeness[i, mode] < 0.5:
            yield _remark(
                "MD506",
                f"the shape measured for mode {test.number[i]} resembles model mode {best + 1} (MAC "
                f"{likeness[i, best]:.2f}), but was compared with mode {mode + 1} (MAC {likeness[i, mode]:.2f})",
                help="pair them by their shapes: --pairing mac of `mouse run`, or pairing: mac under run",
            )


def _strangers(result: Result) -> Iterator[Diagnostic]:
    """Measured modes whose partner has nothing in common with them, before or after the revision."""
    test = result.problem.test
    for i in range(test.m if result.problem.run.pairing == "mac" else 0):
        for when, model in (("before", result.prior), ("after", result.revised)):
            hz = float(frequency_hz(model.eigenvalues[model.modes[i]]))
            far = abs(hz - test.frequency_hz[i]) > _FAR * test.frequency_hz[i]
            if far and model.mac[i] < _UNLIKE and np.isfinite(test.shapes[:, i]).sum() > 1:
                yield _remark(
                    "MD509",
                    f"measured mode {test.number[i]} at {test.frequency_hz[i]:.5g} Hz has no likely partner: {when} the revision "
                    f"it was compared with model mode {model.modes[i] + 1} at {hz:.5g} Hz, MAC {model.mac[i]:.2f}",
                    help="check it with `mouse correlate`, and leave it out of the test until it is understood",
                )
                break


def _undamped(result: Result) -> Iterator[Diagnostic]:
    """Functions of a model whose resonances are infinite."""
    measured = [fit.test for fit in (*result.frf, *result.held_frf)]
    if not measured or any(test.decay_rate > 0 for test in measured):
        return
    damping = assembly(result.problem).damping(result.revised.theta)
    if not any(abs(matrix).max() > 0 for matrix in damping if matrix is not None):
        yield _remark(
            "MD518",
            "the model has no damping: its frequency response functions are infinite at its resonances",
            help="give elements loss_factor, stiffness_damping or mass_damping, or dashpots, and make the amount a parameter; "
            "or modal_damping",
        )


def _remark(code: str, message: str, span: Span | None = None, help: str = "") -> Diagnostic:
    return Diagnostic(code, WARNING, message, span, help=help)

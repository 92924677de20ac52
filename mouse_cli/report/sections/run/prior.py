"""What was known before: the properties with their uncertainty, and the test with its accuracy."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.problem import Problem
from mouse_cli.model.result import Forecast, Result
from mouse_cli.report.blocks import Block, Column, Heading, Matrix, Table, Text
from mouse_cli.report.measured import NOT_MEASURED, eigenvalue_index, positions
from mouse_cli.report.section import APPENDIX, Options, Section
from mouse_cli.report.sections._wording import LEFT, names


def prior(subject: Result | Forecast, options: Options) -> Iterator[Block]:
    """Properties; then, of a test, frequencies and shapes."""
    problem = subject.problem
    yield Heading("Properties", 2)
    yield _properties(problem)
    if changes_only(problem):
        yield Text("The deck gives no values of the properties; they are counted as changes from the model as given.")
    yield from _correlations(problem, options)
    if isinstance(subject, Result) and problem.test.m:
        yield Heading("Measured data", 2)
        yield _frequencies(subject)
        yield from _shapes(subject)


def changes_only(problem: Problem) -> bool:
    """Whether the deck gave no nominal value, as card decks cannot."""
    return not any(problem.prior.mean) and problem.source.format == "cards"


def _properties(problem: Problem) -> Table:
    columns = (
        Column("property", align=LEFT),
        Column("unit", align=LEFT),
        Column("nominal value"),
        Column("standard deviation"),
        Column("lower limit"),
        Column("upper limit"),
        Column("transform", align=LEFT),
        Column("", align=LEFT),
    )
    rows = tuple(
        (
            p.name,
            p.unit,
            float(mean),
            float(sd),
            _finite(p.lower),
            _finite(p.upper),
            p.transform if p.transform != "identity" else None,
            None if sd > 0 else "held",
        )
        for p, mean, sd in zip(problem.parameters, problem.prior.mean, problem.prior.sd, strict=True)
    )
    return Table(columns, rows).without_empty_columns()


def _finite(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def _correlations(problem: Problem, options: Options) -> Iterator[Block]:
    """The prior covariance, where properties are uncertain together."""
    cov = problem.prior.cov
    if cov.ndim == 1 or not (cov - np.diag(np.diag(cov))).any():
        return
    if len(cov) > options.properties:
        yield Text("The prior uncertainties of the properties are correlated.")
        return
    yield Matrix("prior covariance of the properties", cov, names(problem), names(problem))


def _frequencies(result: Result) -> Table:
    """One line a measured mode: frequency, eigenvalue and their accuracies; the factor that scaled its shape."""
    test, index = result.problem.test, eigenvalue_index(result)
    columns = (
        Column("mode"),
        Column("test frequency", "Hz"),
        Column("standard deviation", "Hz"),
        Column("test eigenvalue", "rad2/s2"),
        Column("standard deviation", "rad2/s2"),
        Column("positions measured"),
        Column("scale factor of shape"),
    )
    rows = tuple(
        (
            int(test.number[i]),
            float(test.frequency_hz[i]),
            float(test.frequency_sd_hz[i]),
            float(result.y[k]) if k != NOT_MEASURED else None,
            float(result.sd[k]) if k != NOT_MEASURED else None,
            int(np.isfinite(test.shapes[:, i]).sum()),
            float(result.shape_factor[i]) if np.isfinite(test.shapes[:, i]).any() else None,
        )
        for i, k in enumerate(index.tolist())
    )
    return Table(columns, rows)


def _shapes(result: Result) -> Iterator[Block]:
    """The measured shapes as given, and their accuracy: one number where it is one."""
    test = result.problem.test
    measured = np.isfinite(test.shapes)
    if not measured.any():
        yield Text("No mode shape was measured.")
        return
    modes, corner = tuple(str(n) for n in test.number), ("position", "mode")
    yield Matrix("measured mode shapes, as given", test.shapes, positions(result), modes, corner=corner)
    sd = test.shape_sd[measured]
    if np.ptp(sd) == 0:
        yield Text("The standard deviation of every measured component is {}.", (float(sd[0]),))
    else:
        shown = np.where(measured, test.shape_sd, np.nan)
        yield Matrix("their standard deviations", shown, positions(result), modes, corner=corner)


SECTION = Section("prior", 30, "Before the test", prior, (Result, Forecast), place=APPENDIX)

"""Test against revised model, in the layout of Table 5-5: eigenvalues, then eigenvectors, with the data beyond their limits."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.dynamics.frequency import frequency_hz
from mouse_cli.model.result import Result
from mouse_cli.report.blocks import Block, Cell, Column, Table, Text
from mouse_cli.report.measured import NOT_MEASURED, eigenvalue_index, positions, shape_index
from mouse_cli.report.section import APPENDIX, Options, Section
from mouse_cli.report.sections._wording import counted


def comparison(result: Result, options: Options) -> Iterator[Block]:
    """Both tables and what a star means."""
    if result.problem.test.m:
        yield _eigenvalues(result)
    if (shape_index(result) != NOT_MEASURED).any():
        yield _eigenvectors(result)
    count = int(result.exceeding.sum())
    outside = f"{count} lie outside, marked *" if count else "none lies outside"
    if count == 1:
        outside = "1 lies outside and is marked *"
    yield Text(
        f"The interval is the half width of the {result.problem.run.confidence} per cent confidence interval of the test, "
        f"{result.z:.3f} standard deviations. Of {counted(len(result.y), 'datum', 'data')} {outside}; "
        f"the convergence test allows {result.allowed or 'none'}."
    )


_COLUMNS = (
    Column("mode"),
    Column("model mode"),
    Column("revised eigenvalues", "rad2/s2"),
    Column("test eigenvalues", "rad2/s2"),
    Column("revised frequency", "Hz"),
    Column("test frequency", "Hz"),
    Column("test sd", "Hz"),
    Column("interval", "Hz"),
    Column("difference", "Hz"),
    Column("prior MAC"),
    Column("revised MAC"),
    Column("*"),
)


def _eigenvalues(result: Result) -> Table:
    """One line a mode; the model's own number is shown where it differs from the test's."""
    index = eigenvalue_index(result)
    renumbered = bool((result.problem.test.number != result.revised.modes + 1).any())
    rows = tuple(_mode(result, i, int(k), renumbered) for i, k in enumerate(index))
    return Table(_COLUMNS, rows).without_empty_columns()


def _mode(result: Result, i: int, k: int, renumbered: bool) -> tuple[Cell, ...]:
    """Line of measured mode i, whose eigenvalue is datum k."""
    test, mode, measured = result.problem.test, int(result.revised.modes[i]), k != NOT_MEASURED
    revised = float(result.revised.eigenvalues[mode])
    hz, test_hz, sd = frequency_hz(revised), test.frequency_hz[i], test.frequency_sd_hz[i]
    frequency = (test_hz, sd, result.z * sd, test_hz - hz) if measured else (np.nan,) * 4
    return (
        int(test.number[i]),
        mode + 1 if renumbered else None,
        revised,
        float(result.y[k]) if measured else None,
        float(hz),
        *map(float, frequency),
        float(result.prior.mac[i]),
        float(result.revised.mac[i]),
        "*" if measured and result.exceeding[k] else None,
    )


def _eigenvectors(result: Result) -> Table:
    """Mode by mode, position by position; test vectors at the scale of the theory."""
    columns = (
        Column("position"),
        Column("mode"),
        Column("revised eigenvectors"),
        Column("test eigenvectors"),
        Column("interval"),
        Column("difference"),
        Column("*"),
    )
    places, numbers = positions(result), result.problem.test.number
    model, test, interval = result.revised.model_shapes, result.test_shapes, result.z * result.test_shape_sd
    rows = tuple(
        (
            places[s],
            int(numbers[i]),
            float(model[s, i]),
            float(test[s, i]),
            float(interval[s, i]),
            float(test[s, i] - model[s, i]),
            "*" if result.exceeding[k] else None,
        )
        for i, column in enumerate(shape_index(result).T)
        for s, k in enumerate(column)
        if k != NOT_MEASURED
    )
    return Table(columns, rows, keys=2).without_empty_columns()


SECTION = Section("comparison", 90, "Comparison of eigenvalues and eigenvectors", comparison, place=APPENDIX)

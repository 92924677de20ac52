"""Frequency response functions against the model, before and after: one line a function."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.frf_fit import FrfFit
from mouse_cli.model.result import Result
from mouse_cli.observables.frf import MEDIAN, UNKNOWN, names
from mouse_cli.report.blocks import Block, Column, Heading, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import LEFT, counted

_FORMS = {
    "complex": "as they are",
    "log": "as ln of their magnitudes",
    "log-phase": "as ln of their magnitudes and phases",
}
_COLUMNS = (
    Column("response", align=LEFT),
    Column("force", align=LEFT),
    Column("lines"),
    Column("prior median error", "dB"),
    Column("revised median error", "dB"),
    Column("prior FRAC"),
    Column("revised FRAC"),
)
_MOST_ROWS = 60


def frf_before_after(result: Result, options: Options) -> Iterator[Block]:
    """For each measurement: what was fitted, the table, the likeness of deflections."""
    for fit in result.frf:
        if len(result.frf) > 1:
            yield Heading(fit.test.title or "Frequency response functions", 2)
        yield Text(_fitted(fit))
        yield _table(fit)
        before, after = fit.median_db(fit.prior), fit.median_db(fit.revised)
        yield Text(
            "The median of |20 log10 of model / test| over all of them is {} dB before and {} dB after.",
            (before, after),
        )
        shapes = fit.fdac(fit.prior), fit.fdac(fit.revised)
        if np.isfinite(shapes[0]).any():
            yield Text(
                "Deflections at equal frequencies are alike (FDAC, mean over lines) by {} before and by {} after.",
                tuple(float(np.nanmean(each)) for each in shapes),
            )


def _fitted(fit: FrfFit) -> str:
    hz = fit.test.frequency_hz
    text = (
        f"{fit.test.kind.capitalize()} at {counted(len(hz), 'line')}, {hz[0]:.5g} to {hz[-1]:.5g} Hz; fitted at "
        f"{len(fit.lines)} of them, {_FORMS[fit.form]}."
    )
    if fit.assumed:
        text += (
            f" Where the accuracy of a value is unknown, {100 * UNKNOWN:.0f} per cent of its magnitude and {100 * MEDIAN:.0f} "
            "per cent of the median of its function were taken: state it with `sd` or `averages`."
        )
    if fit.basis:
        text += f" Computed in a basis of {fit.basis} vectors, with an error of at most {fit.basis_error:.0e} at the lines checked."
    return text


def _table(fit: FrfFit) -> Table:
    outputs, inputs = names(fit.test)
    off = [np.abs(fit.off_db(model)) for model in (fit.prior, fit.revised)]
    alike = [fit.frac(model) for model in (fit.prior, fit.revised)]
    rows = []
    for k in range(len(inputs)):
        for o in range(len(outputs)):
            have = fit.have[:, o, k]
            if have.any():
                errors = (float(np.nanmedian(each[have, o, k])) for each in off)
                rows.append((outputs[o], inputs[k], int(have.sum()), *errors, *(float(each[o, k]) for each in alike)))
    return Table(_COLUMNS, tuple(rows[:_MOST_ROWS]), keys=2)


SECTION = Section("frf-before-after", 116, "Frequency response functions, before and after", frf_before_after)

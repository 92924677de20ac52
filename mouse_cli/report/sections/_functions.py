"""What sections say of models beside measured frequency response functions."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.frf_fit import FrfFit
from mouse_cli.observables.frf import ASSUMED_OF_MAGNITUDE, ASSUMED_OF_MEDIAN, names
from mouse_cli.report.blocks import Block, Column, Heading, Table, Text, heads
from mouse_cli.report.sections._wording import counted

_FORMS = {
    "complex": "as they are",
    "log": "as ln of their magnitudes",
    "log-phase": "as ln of their magnitudes and phases",
}
_MOST_ROWS = 60


def functions(fits: tuple[FrfFit, ...]) -> Iterator[Block]:
    """For each measurement: what was fitted, the table, all of it together with the FDAC."""
    for fit in fits:
        if len(fits) > 1:
            yield Heading(fit.test.title or "Frequency response functions", 2)
        yield Text(_measured(fit))
        yield _table(fit)
        alike = [float(np.nanmean(each)) for model in fit.models if np.isfinite(each := fit.fdac(model.H)).any()]
        noise = "noise that was assumed" if fit.assumed else "noise of the measurement"
        deflections = f" The mean FDAC is {_each(fit, '{}')}." if alike else ""
        yield Text(
            f"The median error of all of them is {_each(fit, '{} dB')}. The rms residual is {_each(fit, '{}')} times the "
            f"{noise}.{deflections}",
            (*(fit.median_db(model.H) for model in fit.models), *(fit.rms_sd(model.H) for model in fit.models), *alike),
        )


def _each(fit: FrfFit, value: str) -> str:
    """`value` for each model, with its name."""
    return " and ".join(f"{value} ({model.name})" for model in fit.models)


def _measured(fit: FrfFit) -> str:
    hz = fit.test.frequency_hz
    text = f"{fit.test.kind.capitalize()} at {counted(len(hz), 'line')}, {hz[0]:.5g} to {hz[-1]:.5g} Hz"
    text += f"; fitted at {len(fit.lines)} of them, {_FORMS[fit.form]}." if len(fit.lines) else "; none was fitted."
    if fit.assumed:
        text += (
            f" Where the accuracy of a value is unknown, {100 * ASSUMED_OF_MAGNITUDE:.0f} per cent of its magnitude and "
            f"{100 * ASSUMED_OF_MEDIAN:.0f} per cent of the median of its function were taken: state it with `sd` or `averages`."
        )
    if fit.basis:
        text += f" Computed in a basis of {fit.basis} vectors, with an error of at most {fit.basis_error:.0e} at the lines checked."
    return text


def _table(fit: FrfFit) -> Table:
    outputs, inputs = names(fit.test)
    columns = heads(
        "<response | <force | lines",
        *(Column(f"median error, {model.name}", "dB") for model in fit.models),
        *(Column(f"FRAC, {model.name}") for model in fit.models),
    )
    off = [np.abs(fit.off_db(model.H)) for model in fit.models]
    alike = [fit.frac(model.H) for model in fit.models]
    rows = []
    for k in range(len(inputs)):
        for o in range(len(outputs)):
            have = fit.have[:, o, k]
            if have.any():
                errors = (float(np.nanmedian(each[have, o, k])) for each in off)
                rows.append((outputs[o], inputs[k], int(have.sum()), *errors, *(float(each[o, k]) for each in alike)))
    return Table(columns, tuple(rows[:_MOST_ROWS]), keys=2)


def covered(fits: tuple[FrfFit, ...]) -> Iterator[Block]:
    """How much of the magnitudes that were held out lies where the models say it does."""
    for fit in fits:
        shares = [100 * fit.covered(model) for model in fit.models]
        if np.isfinite(shares).all():
            title = f" of {fit.test.title}" if len(fits) > 1 and fit.test.title else ""
            yield Text(f"Within 90 % intervals lie {_each(fit, '{} %')} of the magnitudes{title}.", tuple(shares))

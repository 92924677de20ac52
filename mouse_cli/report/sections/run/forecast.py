"""The modes of the prior model and how uncertain they are."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.dynamics.frequency import eigenvalue
from mouse_cli.model.result import Forecast
from mouse_cli.report.blocks import Block, Matrix, Table, Text, heads
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import counted, deck_table


def frequencies(forecast: Forecast, options: Options) -> Iterator[Block]:
    """Natural frequencies of the prior model and how uncertain they are. One line a mode."""
    columns = heads(
        "mode | eigenvalue [rad2/s2] | frequency [Hz] | standard deviation [Hz] | coefficient of variation [per cent]"
    )
    rows = []
    for i, (hz, sd) in enumerate(zip(forecast.frequencies_hz, forecast.sd_hz, strict=True), 1):
        elastic = i > forecast.rigid_modes and hz > 0
        hz = float(hz) if elastic else 0.0
        rows.append((i, eigenvalue(hz), hz, sd, 100 * sd / hz if elastic else None))
    yield Table(columns, rows)
    rigid = counted(forecast.rigid_modes, "rigid-body mode") if forecast.rigid_modes else "no rigid-body mode"
    yield Text(f"The model has {rigid}.")


def damping(forecast: Forecast, options: Options) -> Iterator[Block]:
    """Damping of the prior model: ratios of its complex modes, how uncertain they are, how far shapes are from real ones."""
    found = forecast.damped
    if found is None:
        return
    columns = heads("mode | frequency [Hz] | damping ratio [per cent] | standard deviation [per cent] | complexity")
    rigid = forecast.rigid_modes
    values = zip(found.frequencies_hz, found.damping, found.damping_sd, found.complexity, strict=True)
    yield Table(columns, ((rigid + i, hz, 100 * ratio, 100 * sd, c) for i, (hz, ratio, sd, c) in enumerate(values, 1)))
    yield Text(
        "Frequencies are |s| / 2 pi of the poles s, damping ratios -Re s / |s|, half of the loss factor at resonance. Complexity "
        "is 0 for a shape whose points move in phase or against it, and up to 1."
    )
    if found.error > 0:
        yield Text("The poles are off by at most {}, relative, by their residuals.", (found.error,))


def heading(forecast: Forecast, options: Options) -> Iterator[Block]:
    """Heading of a forecast: program, title, source, size of the model. What the model is."""
    problem = forecast.problem
    yield deck_table(problem)
    yield Text(
        f"The model has {counted(problem.structure.n, 'degree', 'degrees')} of freedom and "
        f"{counted(len(problem.parameters), 'uncertain property', 'uncertain properties')}. The standard deviations of "
        "its natural frequencies and mode shapes follow from those of its properties by first-order partial derivatives."
    )


def shapes(forecast: Forecast, options: Options) -> Iterator[Block]:
    """Shapes, then their standard deviations; of a large model at the measured positions, or its first ones."""
    structure, test = forecast.problem.structure, forecast.problem.test
    dofs, where = np.arange(structure.n), ""
    if structure.n > options.shape_dofs and test is not None and test.s:
        dofs, where = test.dofs, "at the measured positions"
    elif structure.n > options.shape_dofs:
        dofs, where = dofs[: options.shape_dofs], f"at the first {options.shape_dofs} of them"
    if where:
        yield Text(f"The model has {structure.n} degrees of freedom; its shapes are shown {where}.")
    rows = tuple(structure.labels[d] for d in dofs)
    columns = tuple(str(i + 1) for i in range(forecast.shapes.shape[1]))
    for name, array in (
        ("mode shapes, unit modal mass", forecast.shapes),
        ("standard deviations of the mode shapes", forecast.shape_sd),
    ):
        yield Matrix(name, array[dofs], rows, columns, corner=("position", "mode"))


SECTIONS = (
    Section("forecast-frequencies", 50, "Natural frequencies", frequencies, (Forecast,), place=RESULT),
    Section("forecast-damping", 55, "Damping", damping, (Forecast,), place=RESULT),
    Section("forecast-heading", 10, "Model", heading, (Forecast,)),
    Section("forecast-shapes", 60, "Mode shapes", shapes, (Forecast,)),
)

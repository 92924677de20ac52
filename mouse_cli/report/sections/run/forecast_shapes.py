"""Mode shapes of the prior model and how uncertain they are."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.result import Forecast
from mouse_cli.report.blocks import Block, Matrix, Text
from mouse_cli.report.section import Options, Section


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


SECTION = Section("forecast-shapes", 60, "Mode shapes", shapes, (Forecast,))

"""Heading of a forecast: program, title, source, size of the model."""

from collections.abc import Iterator

from mouse_cli.model.result import Forecast
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import counted, deck_table


def heading(forecast: Forecast, options: Options) -> Iterator[Block]:
    """What the model is."""
    problem = forecast.problem
    yield deck_table(problem)
    yield Text(
        f"The model has {counted(problem.structure.n, 'degree', 'degrees')} of freedom and "
        f"{counted(len(problem.parameters), 'uncertain property', 'uncertain properties')}. The standard deviations of "
        "its natural frequencies and mode shapes follow from those of its properties by first-order partial derivatives."
    )


SECTION = Section("forecast-heading", 10, "Model", heading, (Forecast,))

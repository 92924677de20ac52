"""Damping of the prior model: ratios of its complex modes, how uncertain they are, how far shapes are from real ones."""

from collections.abc import Iterator

from mouse_cli.model.result import Forecast
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import RESULT, Options, Section


def damping(forecast: Forecast, options: Options) -> Iterator[Block]:
    """One line a complex mode."""
    found = forecast.damped
    if found is None:
        return
    columns = (
        Column("mode"),
        Column("frequency", "Hz"),
        Column("damping ratio", "per cent"),
        Column("standard deviation", "per cent"),
        Column("complexity"),
    )
    values = zip(found.frequencies_hz, found.damping, found.damping_sd, found.complexity, strict=True)
    rigid = forecast.rigid_modes
    yield Table(
        columns,
        tuple(
            (rigid + i, float(hz), float(100 * ratio), float(100 * sd), float(complexity))
            for i, (hz, ratio, sd, complexity) in enumerate(values, 1)
        ),
    )
    yield Text(
        "Frequencies are |s| / 2 pi of the poles s, damping ratios -Re s / |s|, half of the loss factor at resonance. Complexity "
        "is 0 for a shape whose points move in phase or against it, and up to 1."
    )
    if found.error > 0:
        yield Text("The poles are off by at most {}, relative, by their residuals.", (found.error,))


SECTION = Section("forecast-damping", 55, "Damping", damping, (Forecast,), place=RESULT)

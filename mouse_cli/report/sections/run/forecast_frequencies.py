"""Natural frequencies of the prior model and how uncertain they are."""

from collections.abc import Iterator

from mouse_cli.dynamics.frequency import eigenvalue
from mouse_cli.model.result import Forecast
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import counted


def frequencies(forecast: Forecast, options: Options) -> Iterator[Block]:
    """One line a mode."""
    columns = (
        Column("mode"),
        Column("eigenvalue", "rad2/s2"),
        Column("frequency", "Hz"),
        Column("standard deviation", "Hz"),
        Column("coefficient of variation", "per cent"),
    )
    rows = []
    for i, (hz, sd) in enumerate(zip(forecast.frequencies_hz, forecast.sd_hz, strict=True), 1):
        elastic = i > forecast.rigid_modes and hz > 0
        hz = float(hz) if elastic else 0.0
        rows.append((i, float(eigenvalue(hz)), hz, float(sd), float(100 * sd / hz) if elastic else None))
    yield Table(columns, tuple(rows))
    rigid = counted(forecast.rigid_modes, "rigid-body mode") if forecast.rigid_modes else "no rigid-body mode"
    yield Text(f"The model has {rigid}.")


SECTION = Section("forecast-frequencies", 50, "Natural frequencies", frequencies, (Forecast,), place=RESULT)

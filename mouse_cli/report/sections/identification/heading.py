"""Heading of an identification: what was identified, how, and where its noise comes from."""

from collections.abc import Iterator

from mouse_cli import __version__
from mouse_cli.model.identification import Identification
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import LEFT, counted


def heading(found: Identification, options: Options) -> Iterator[Block]:
    """Source, method, every number of the method, and the outcome."""
    rows = [
        ("program", f"mouse {__version__}"),
        ("title", found.title),
        *[("source", source) for source in found.sources],
        ("method", found.method),
        ("band", f"{found.band_hz[0]:.6g} to {found.band_hz[1]:.6g} Hz"),
        ("noise", found.noise),
        *[(name, value if isinstance(value, str) else f"{value:.6g}") for name, value in found.details.items()],
    ]
    yield Table((Column("", align=LEFT), Column("", align=LEFT)), tuple(rows))
    sensors = counted(len(found.sensors), "sensor")
    if found.exit_code == 0:
        yield Text(f"{counted(found.modes.m, 'mode')} at {sensors}; no warnings.")
    elif found.modes.m:
        yield Text(
            f"{counted(found.modes.m, 'mode')} at {sensors}, with warnings: see the remarks before they are used."
        )
    else:
        yield Text("No mode was identified: see the remarks.")


SECTION = Section("identification-heading", 10, "Modal identification", heading, (Identification,))

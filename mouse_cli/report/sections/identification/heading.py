"""Heading of an identification: what was identified, how, and where its noise comes from."""

from collections.abc import Iterator

from mouse_cli import __version__
from mouse_cli.model.identification import Identification
from mouse_cli.report.blocks import Block, Column, Table
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import LEFT


def heading(found: Identification, options: Options) -> Iterator[Block]:
    """Source, method, every number of the method."""
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


SECTION = Section("identification-heading", 10, "Source and method", heading, (Identification,))

"""The identification in one sentence."""

from collections.abc import Iterator

from mouse_cli.model.identification import Identification
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import VERDICT, Options, Section
from mouse_cli.report.sections._wording import counted


def verdict(found: Identification, options: Options) -> Iterator[Block]:
    """How many modes, and whether anything speaks against them."""
    sensors = counted(len(found.sensors), "sensor")
    if found.exit_code == 0:
        yield Text(f"{counted(found.modes.m, 'mode')} at {sensors}; no warnings.")
    elif found.modes.m:
        yield Text(
            f"{counted(found.modes.m, 'mode')} at {sensors}, with warnings: see the remarks before they are used."
        )
    else:
        yield Text("No mode was identified: see the remarks.")


SECTION = Section("identification-verdict", 10, "Modal identification", verdict, (Identification,), place=VERDICT)

"""What of the test took no part in the revision."""

from collections.abc import Iterator

from mouse_cli.model.hold_out import HoldOut
from mouse_cli.model.result import Result
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import counted


def held_out(result: Result, options: Options) -> Iterator[Block]:
    """One sentence; nothing where all data were used."""
    held = result.problem.hold_out
    if held is not None:
        yield Text(f"Held out, and used by no fit: {told(held)}. `mouse diagnose` tells how well they are foreseen.")


def told(held: HoldOut) -> str:
    """What is held out, in words."""
    parts = []
    if len(held.modes):
        numbers = ", ".join(str(number) for number in held.whole.number[held.modes])
        parts.append(f"{'mode' if len(held.modes) == 1 else 'modes'} {numbers}")
    if len(held.sensors):
        parts.append(f"{counted(len(held.sensors), 'sensor')} of {held.whole.s}")
    parts += [
        f"{counted(len(one.number), 'frequency', 'frequencies')} of the configuration '{one.title}'"
        for one in held.altered
    ]
    return "; ".join(parts)


SECTION = Section("held-out", 117, "Data held out", held_out)

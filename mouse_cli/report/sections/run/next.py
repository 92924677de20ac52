"""What to do next: commands that take the deck as it is."""

import os
from collections.abc import Iterator

from mouse_cli.model.result import NO_ANSWER, Result
from mouse_cli.report.blocks import Block, Lines
from mouse_cli.report.section import RESULT, Options, Section


def commands(result: Result, options: Options) -> Iterator[Block]:
    """One line a command, of a short report alone: the whole one is not read at the terminal."""
    deck = result.problem.source.path
    if not options.short or not os.path.isfile(deck):
        return
    pairs = [(command.format(deck), what) for command, what in _next(result)]
    wide = max((len(command) for command, _ in pairs), default=0)
    yield Lines(tuple(f"{command:<{wide}}  # {what}" for command, what in pairs))


def _next(result: Result) -> Iterator[tuple[str, str]]:
    """What helps with such an answer."""
    if result.rejected:
        yield "mouse diagnose {}", "what the model lacks, and where"
    if result.status.exit_code:
        yield "mouse correlate {}", "pairs of modes, sensors that look faulty"
    if result.status.exit_code < NO_ANSWER:
        yield "mouse run {} --json -o result.json", "for `mouse report` and `mouse plot`"


SECTION = Section("next", 140, "Next", commands, place=RESULT)

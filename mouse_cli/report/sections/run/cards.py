"""Echo of the cards, as they were punched, with their numbers."""

from collections.abc import Iterator

from mouse_cli._errors import RULER
from mouse_cli.model.result import Forecast, Result
from mouse_cli.report.blocks import Block, Lines
from mouse_cli.report.section import APPENDIX, Options, Section


def cards(subject: Result | Forecast, options: Options) -> Iterator[Block]:
    """Only a deck of cards is echoed; a YAML deck is short and at hand."""
    source = subject.problem.source
    if source.format != "cards" or not source.lines:
        return
    digits = max(4, len(str(len(source.lines))))
    ruler = tuple(f"{'':{digits}}   {line}" for line in RULER)
    yield Lines(ruler + tuple(f"{i:{digits}}   {line}" for i, line in enumerate(source.lines, 1)))


SECTION = Section("cards", 20, "Echo of the cards", cards, (Result, Forecast), place=APPENDIX)

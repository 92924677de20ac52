"""One file, one look of the report: blocks in, text out."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from mouse_cli import _registry
from mouse_cli.report.blocks import Block
from mouse_cli.report.numbers import Numbers
from mouse_cli.report.section import APPENDIX


@dataclass(frozen=True)
class Renderer:
    """`render(blocks, numbers)` gives the report's text; `numbers`: the style it uses when nobody asks for another.

    level: the last place that it shows when nobody asks for another.
    """

    key: str
    numbers: str
    render: Callable[[Iterable[Block], Numbers], str]
    level: int = APPENDIX


def renderer(key: str) -> Renderer:
    """The renderer called `key`. Raises ValueError that lists the known ones."""
    return _registry.member(__name__, "RENDERER", key, "form of the report")

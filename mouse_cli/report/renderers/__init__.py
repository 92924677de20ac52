"""One file, one look of the report: blocks in, text out."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from mouse_cli import _registry
from mouse_cli.report.blocks import Block
from mouse_cli.report.numbers import Numbers


@dataclass(frozen=True)
class Renderer:
    """`render(blocks, numbers)` gives the report's text; `numbers`: the style it uses when nobody asks for another."""

    key: str
    suffix: str
    numbers: str
    render: Callable[[Iterable[Block], Numbers], str]


def renderer(key: str) -> Renderer:
    """The renderer called `key`. Raises ValueError that lists the known ones."""
    known = _registry.discover(__name__, "RENDERER")
    if key not in known:
        raise ValueError(f"no form of the report is called '{key}'; there are {', '.join(known)}")
    return known[key]

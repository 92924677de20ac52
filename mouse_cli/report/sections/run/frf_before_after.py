"""Frequency response functions against the model, before and after: one line a function."""

from collections.abc import Iterator

from mouse_cli.model.result import Result
from mouse_cli.report.blocks import Block
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._functions import functions


def frf_before_after(result: Result, options: Options) -> Iterator[Block]:
    """Those that were fitted."""
    yield from functions(result.frf)


SECTION = Section(
    "frf-before-after", 116, "Frequency response functions, before and after", frf_before_after, place=RESULT
)

"""Frequency response functions, or lines of them, that took no part in the revision, and what both models say of them."""

from collections.abc import Iterator

from mouse_cli.model.result import Result
from mouse_cli.report.blocks import Block
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._functions import covered, functions


def frf_held_out(result: Result, options: Options) -> Iterator[Block]:
    """The same tables as of those that were fitted, and how much lies within the intervals of the models."""
    yield from functions(result.held_frf)
    yield from covered(result.held_frf)


SECTION = Section("frf-held-out", 118, "Frequency response functions held out", frf_held_out, place=RESULT)

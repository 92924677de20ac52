"""A section of the report: one file of a folder of `sections`, found by itself, that turns a result into blocks."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cache

from mouse_cli import _registry
from mouse_cli.model.result import Forecast, Result
from mouse_cli.report.blocks import Block, Heading
from mouse_cli.report.kinds import KINDS, kind

_FOLDERS = "mouse_cli.report.sections"


@dataclass(frozen=True)
class Options:
    """How much is printed; none of these changes a number.

    matrix_dofs: models up to this size show K and M in full. shape_dofs: larger ones show shapes at the measured points
    only. modes: columns of the modal matrix. properties: more than these are shown in short. correlations, elements: most
    of each that are listed.
    """

    matrix_dofs: int = 12
    shape_dofs: int = 140
    modes: int = 10
    properties: int = 12
    cycle_properties: int = 5
    correlations: int = 20
    elements: int = 200


@dataclass(frozen=True)
class Section:
    """`blocks(subject, options)` yields what the section says, nothing when it has nothing to say.

    order: its place in the report. subjects: what it can speak of, Result or Forecast or both.
    """

    key: str
    order: int
    title: str
    blocks: Callable[[Result | Forecast, Options], Iterable[Block]]
    subjects: tuple[type, ...] = (Result,)


def registry() -> dict[str, Section]:
    """All sections of all kinds of answers, by key, and those of third parties."""
    found = _registry.discover(_FOLDERS, "SECTION")
    for folder in sorted({each.folder for each in KINDS.values()}):
        found = found | _registry.discover(f"{_FOLDERS}.{folder}", "SECTION")
    return found


@cache
def sections(subject: type) -> tuple[Section, ...]:
    """The sections that speak of `subject`, in the order of the report. Other kinds of answers are not loaded."""
    own = _registry.discover(f"{_FOLDERS}.{kind(subject).folder}", "SECTION")
    found = (_registry.discover(_FOLDERS, "SECTION") | own).values()
    return tuple(sorted((s for s in found if subject in s.subjects), key=lambda s: (s.order, s.key)))


def blocks(subject: Result | Forecast, options: Options | None = None) -> Iterator[Block]:
    """The whole report of `subject`; a section without blocks has no heading either."""
    for section in sections(type(subject)):
        body = list(section.blocks(subject, options or Options()))
        if body:
            yield Heading(section.title)
            yield from body

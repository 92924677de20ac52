"""A section of the report: what turns a result into blocks, one of the SECTIONS of a file for its kind of answer.

Every section has a place; a report is its sections place by place, and a short one ends after the results.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cache

from mouse_cli import _registry
from mouse_cli.model.result import Forecast, Result
from mouse_cli.report.blocks import Block, Heading, Matrix, Table, Text
from mouse_cli.report.kinds import KINDS, kind

_FOLDER = "mouse_cli.report.sections"

VERDICT, RESULT, EVIDENCE, APPENDIX = range(4)  # places, in the order of every report


@dataclass(frozen=True)
class Options:
    """How much is printed; none of these changes a number.

    matrix_dofs: models up to this size show K and M in full. shape_dofs: larger ones show shapes at the measured points
    only. modes: columns of the modal matrix. properties: more than these are shown in short. correlations, elements: most
    of each that are listed. level: the last place that is shown, None: as the form has it. rows, columns: largest tables and
    matrices of a report that ends after the results; longer tables are folded.
    """

    level: int | None = None
    rows: int = 12
    columns: int = 8
    matrix_dofs: int = 12
    shape_dofs: int = 140
    modes: int = 10
    properties: int = 12
    cycle_properties: int = 5
    correlations: int = 20
    elements: int = 200

    @property
    def short(self) -> bool:
        """Whether the report ends after the results."""
        return self.level is not None and self.level < EVIDENCE


@dataclass(frozen=True)
class Section:
    """`blocks(subject, options)` yields what the section says, nothing when it has nothing to say.

    order: among the sections of its place. subjects: what it can speak of, Result or Forecast or both.
    """

    key: str
    order: int
    title: str
    blocks: Callable[[Result | Forecast, Options], Iterable[Block]]
    subjects: tuple[type, ...] = (Result,)
    place: int = EVIDENCE


def registry() -> dict[str, Section]:
    """All sections of all kinds of answers, by key, and those of third parties."""
    folders = sorted({each.sections for each in KINDS.values()})
    return {each.key: each for folder in folders for each in _of(folder)}


@cache
def sections(subject: type) -> tuple[Section, ...]:
    """The sections that speak of `subject`, in the order of the report. Other kinds of answers are not loaded."""
    found = (section for section in _of(kind(subject).sections) if subject in section.subjects)
    return tuple(sorted(found, key=lambda s: (s.place, s.order, s.key)))


def _of(sections: str) -> list[Section]:
    """Those of one kind of answers, and those that third parties register for it or for all."""
    return [*_registry.discover(f"{_FOLDER}.{sections}", "SECTION").values(), *_registry.plugins(_FOLDER)]


def blocks(subject: Result | Forecast, options: Options | None = None) -> Iterator[Block]:
    """The report of `subject`; a section without blocks has no heading either."""
    options = options or Options()
    level, more = APPENDIX if options.level is None else options.level, []
    for section in sections(type(subject)):
        body = section.blocks(subject, options)
        if section.place > level:
            more += [section.title] if next(iter(body), None) is not None else []
            continue
        body = list(body)
        if body:
            yield Heading(section.title)
            yield from folded(body, options) if options.short else body
    if more:
        yield Heading("More")
        yield Text(f"`--full` adds: {'; '.join(title.lower() for title in more)}.")


def folded(body: Iterable[Block], options: Options) -> Iterator[Block]:
    """`body` with the rows that count of every table, the others counted; wide matrices are left to the whole report."""
    for block in body:
        if isinstance(block, Matrix) and max(block.array.shape) > options.columns:
            rows, columns = block.array.shape
            yield Text(f"{block.name}: {rows} by {columns}; `--full`")
            continue
        kept = min(block.kept or options.rows, options.rows) if isinstance(block, Table) else 0
        if not kept or len(block.rows) <= kept:
            yield block
            continue
        yield replace(block, rows=block.rows[:kept])
        yield Text(f"and {len(block.rows) - kept} more{block.rest and ' '}{block.rest}; `--full`")

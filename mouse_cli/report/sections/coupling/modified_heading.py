"""Heading of a modified structure: program, title, source, and the changes."""

from collections.abc import Iterator

from mouse_cli import __version__
from mouse_cli.model.modified import Modified
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import LEFT, counted
from mouse_cli.report.sections.coupling.coupling_heading import connections


def heading(found: Modified, options: Options) -> Iterator[Block]:
    """What is changed."""
    asked, problem = found.modification, found.modification.problem
    rows = [("program", f"mouse {__version__}"), ("title", asked.title.strip()), ("source", asked.path)]
    if asked.path != problem.source.path:
        rows.append(("model", problem.source.path))
    yield Table((Column("", align=LEFT), Column("", align=LEFT)), tuple(rows))
    properties = counted(len(problem.parameters), "uncertain property", "uncertain properties")
    yield Text(
        f"The model has {counted(problem.structure.n, 'degree', 'degrees')} of freedom and {properties}, whose uncertainty "
        f"all standard "
        "deviations below follow from, to first order."
    )
    if found.connections:
        places = asked.part.places
        names = [(places[one.at.place], places[one.to.place] if one.to else "") for one in found.connections]
        yield connections(found.connections, names)


SECTION = Section("modified-heading", 10, "Changes", heading, (Modified,))

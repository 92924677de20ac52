"""Heading of coupled structures: program, title, source; parts, interfaces and connections."""

from collections.abc import Iterator

from mouse_cli import __version__
from mouse_cli.model.coupled import Coupled
from mouse_cli.model.coupling import Connection, Coupling
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import LEFT


def heading(found: Coupled, options: Options) -> Iterator[Block]:
    """What is put together, and by what."""
    coupling = found.coupling
    rows = ("program", f"mouse {__version__}"), ("title", coupling.title.strip()), ("source", coupling.path)
    yield Table((Column("", align=LEFT), Column("", align=LEFT)), rows)
    yield _parts(coupling)
    yield Text(
        f"{_joined(len(coupling.interfaces))}Receptances Y of the parts become those of the whole by Y - Y B' (B Y B' + "
        f"1/z)^-1 B Y, with "
        "B the conditions of compatibility and z the dynamic stiffnesses of connections."
    )
    if coupling.connections:
        names = [(coupling.name(one.at), coupling.name(one.to) if one.to else "") for one in coupling.connections]
        yield connections(coupling.connections, names)
    if coupling.truncate:
        yield Text("Singular values of the interface below {} of the largest are left out.", (coupling.truncate,))


def _joined(pairs: int) -> str:
    if not pairs:
        return ""
    what = "One pair of degrees of freedom moves" if pairs == 1 else f"{pairs} pairs of degrees of freedom move"
    return f"{what} together. "


def _parts(coupling: Coupling) -> Table:
    columns = (
        Column("part", align=LEFT, literal=True), Column("known by", align=LEFT), Column("source", align=LEFT, literal=True),
        Column("degrees of freedom"), Column("degrees of freedom used"), Column("", align=LEFT),
    )  # fmt: skip
    rows = tuple(
        (
            part.name,
            f"measured {part.frf.kind}" if part.measured else "its model",
            part.problem.source.path if part.problem else part.frf.path,
            None if part.measured else part.problem.structure.n,
            len(part.places),
            "taken away" if part.removed else "",
        )
        for part in coupling.substructures
    )
    return Table(columns, rows).without_empty_columns()


def connections(each: tuple[Connection, ...], names: list[tuple[str, str]]) -> Table:
    """One line a connection; names: of its two ends."""
    columns = (
        Column("connection", align=LEFT, literal=True), Column("at", align=LEFT, literal=True),
        Column("to", align=LEFT, literal=True),
        Column("mass"), Column("stiffness"), Column("loss factor"), Column("damping"), Column("", align=LEFT),
    )  # fmt: skip
    rows = tuple(
        (
            one.name,
            at,
            to,
            one.mass or None,
            one.stiffness or None,
            one.loss_factor or None,
            one.damping or None,
            "hung" if one.hung else "",
        )
        for one, (at, to) in zip(each, names, strict=True)
    )
    return Table(columns, rows, 2).without_empty_columns()


SECTION = Section("coupling-heading", 10, "Parts and connections", heading, (Coupled,))

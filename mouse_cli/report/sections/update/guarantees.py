"""What a method guarantees for any data, beside what it came to for these."""

from collections.abc import Iterator

from mouse_cli.model.updated import ASPECTS, Checked, Updated
from mouse_cli.report.blocks import Block, Column, Table
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import LEFT

_COLUMNS = (
    Column("what a structure has", align=LEFT),
    Column("guaranteed", align=LEFT),
    Column("here", align=LEFT),
    Column("because", align=LEFT),
)


def guarantees(found: Updated, options: Options) -> Iterator[Block]:
    """One line for each aspect."""
    here = came_to(found.checked)
    yield Table(_COLUMNS, tuple((g.aspect, g.given, here.get(g.aspect, ""), g.why) for g in found.about.guarantees))


def came_to(checked: Checked) -> dict[str, str]:
    """What became of the aspects that can be counted."""
    modes, definite, rigid, sparse, _ = ASPECTS
    return {
        modes: "" if checked.misfit != checked.misfit else f"force left: {checked.misfit:.1g} of inertia",
        definite: f"{checked.negative} negative eigenvalues" if checked.negative else "no negative eigenvalue",
        rigid: f"{checked.rigid} of {checked.rigid_before}",
        sparse: f"{checked.filled} of {checked.stored + checked.filled} elements new",
    }


SECTION = Section("update-guarantees", 20, "What the method guarantees, and what came of it", guarantees, (Updated,))

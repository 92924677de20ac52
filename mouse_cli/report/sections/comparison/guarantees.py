"""What each method guarantees and what came of it."""

from collections.abc import Iterator

from mouse_cli.model.updated import ASPECTS, Compared
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import LEFT


def guarantees(found: Compared, options: Options) -> Iterator[Block]:
    """Guarantees, one line a method; then what can be counted in its answer."""
    columns = Column("method", align=LEFT), *(Column(aspect, align=LEFT) for aspect in ASPECTS)
    yield Table(columns, tuple((u.about.key, *(g.given for g in u.about.guarantees)) for u in found.updates))
    counted = (
        Column("method", align=LEFT),
        Column("negative eigenvalues"),
        Column("rigid-body modes"),
        Column("of"),
        Column("new elements in K"),
        Column("force left", "of inertia"),
    )
    rows = [
        (u.about.key, u.checked.negative, u.checked.rigid, u.checked.rigid_before, u.checked.filled, u.checked.misfit)
        for u in found.updates
    ]
    yield Table(counted, tuple(rows))
    yield Text(
        "Force left: the largest |(K - lambda M) x| of a fitted mode x over |lambda M x|, by the energy of such forces."
    )


SECTION = Section(
    "comparison-guarantees", 20, "What the methods guarantee, and what came of it", guarantees, (Compared,)
)

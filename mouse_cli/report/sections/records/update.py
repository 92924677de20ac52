"""The answer of an update by recordings: revised parameters of the deck, and of its laws."""

from collections.abc import Iterator

from mouse_cli.model.record_update import RecordUpdate
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import VERDICT, Options, Section
from mouse_cli.report.sections._wording import LEFT


def update(found: RecordUpdate, options: Options) -> Iterator[Block]:
    """The verdict on the model, then one line a parameter."""
    residual = found.residual
    yield Text(
        f"{found.message[:1].upper()}{found.message[1:]}. It leaves {residual.chi2 / residual.dof:.4g} times the variance that the "
        f"accuracy of the channels has; standard deviations are for {found.noise_scale:.4g} times."
    )
    columns = (
        Column("property", align=LEFT),
        Column("unit", align=LEFT),
        Column("prior"),
        Column("prior sd"),
        Column("revised"),
        Column("sd"),
    )
    prior = found.problem.prior
    told = zip(found.problem.parameters, prior.mean, prior.sd, found.theta, found.sd_theta, strict=True)
    rows = [(p.name, p.unit, *(f"{value:.5g}" for value in values)) for p, *values in told]
    yield Table(columns, tuple(rows)).without_empty_columns()
    yield from _laws(found)


def _laws(found: RecordUpdate) -> Iterator[Block]:
    if not found.laws:
        return
    columns = (
        Column("law", align=LEFT),
        Column("place", align=LEFT),
        Column("size", align=LEFT),
        Column("unit", align=LEFT),
        Column("deck"),
        Column("revised"),
        Column("sd"),
    )
    rows = [
        (
            one.title,
            one.site.text,
            size.name,
            size.unit,
            f"{given.values[size.name]:.5g}",
            f"{size.value:.5g}",
            f"{size.sd:.3g}",
        )
        for one, given in zip(found.laws, found.problem.laws, strict=True)
        for size in one.sizes
    ]
    yield Table(columns, tuple(rows))


SECTION = Section("record-update", 10, "Update by recordings", update, (RecordUpdate,), place=VERDICT)

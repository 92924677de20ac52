"""The map of places: where a single force that the model lacks could make all measured shapes."""

from collections.abc import Iterator

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._diagnosis_wording import nats, place, probable
from mouse_cli.report.sections._wording import LEFT, chance, counted

_MOST = 15  # places listed
TIE = 3.0  # nats below the best within which places are tied


def places(found: Diagnosis, options: Options) -> Iterator[Block]:
    """The most probable places; nothing where none was looked for."""
    location = found.location
    if location is None or not location.places:
        return
    columns = (
        Column("place", align=LEFT),
        Column("channel", align=LEFT),
        Column("probability"),
        Column("below the best", "nats"),
    )
    shown = location.places[:_MOST]
    yield Table(columns, tuple((place(p.site), p.channel, probable(p.probability), nats(p.deficit)) for p in shown))
    tied, region = sum(p.deficit <= TIE for p in location.places), location.region
    left = "that leaves much more than noise: no single place is it"
    if location.single:
        left = f"noise alone leaves a larger misfit than the best place does {chance(location.p)}"
    yield Text(
        "One force that the model lacks, whatever its law and cause, would make the measured shapes if it acted there. Of "
        f"{counted(len(location.places), 'place')} that were tried, {region} {'holds' if region == 1 else 'hold'} 90 % of the "
        f"probability, and {tied} {'lies' if tied == 1 else 'lie'} within {TIE:g} nats of the best, which the shapes hardly tell "
        f"apart; {left}."
    )


SECTION = Section("diagnosis-places", 60, "Places", places, (Diagnosis,))

"""The map of places: where a single force that the model lacks could make all measured shapes."""

from collections.abc import Iterator

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._diagnosis_wording import place, probable
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
    yield Table(columns, tuple((place(p.site), p.channel, probable(p.probability), float(p.deficit)) for p in shown))
    tied = sum(p.deficit <= TIE for p in location.places)
    yield Text(
        f"Of {counted(len(location.places), 'place')} that were tried, {location.region} hold 90 % of the probability and "
        f"{tied} {'lies' if tied == 1 else 'lie'} within {TIE:g} nats of the best, which the shapes hardly tell apart. By chance "
        f"the best place would leave a larger misfit {chance(location.p)}"
        + ("." if location.single else ": no single place is it.")
    )


SECTION = Section("diagnosis-places", 60, "Places", places, (Diagnosis,))

"""Localisation: sites where a single force that the model lacks could make all measured shapes."""

from collections.abc import Iterator

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._diagnosis_wording import nats, p_value, place, probable
from mouse_cli.report.sections._wording import LEFT, counted

_MOST = 15  # sites listed
TIE = 3.0  # nats below the best within which sites are tied


def places(found: Diagnosis, options: Options) -> Iterator[Block]:
    """The most probable sites; nothing where none was looked for."""
    location = found.location
    if location is None or not location.places:
        return
    columns = (
        Column("site", align=LEFT),
        Column("channel", align=LEFT),
        Column("probability"),
        Column("below the best", "nats"),
    )
    shown = location.places[:_MOST]
    yield Table(columns, tuple((place(p.site), p.channel, probable(p.probability), nats(p.deficit)) for p in shown))
    tied, region = sum(p.deficit <= TIE for p in location.places), location.region
    left = "that leaves much more than noise: no single site is it"
    if location.single:
        left = f"the goodness of fit of the best is {p_value(location.p)}"
    yield Text(
        "One force that the model lacks, whatever its law, would make the measured shapes if it acted there. Of "
        f"{counted(len(location.places), 'site')} that were tried, {region} {'holds' if region == 1 else 'hold'} 90 % of the "
        f"probability, and {tied} {'lies' if tied == 1 else 'lie'} within {TIE:g} in log evidence of the "
        f"best, which the shapes hardly distinguish; {left}."
    )


SECTION = Section("diagnosis-places", 60, "Localisation", places, (Diagnosis,))

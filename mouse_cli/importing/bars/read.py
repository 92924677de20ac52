"""Bulk data of bars as a mesh of mouse's own elements."""

from mouse_cli.importing import bulk
from mouse_cli.importing.bars.elements import elements
from mouse_cli.importing.bars.parts import Bars
from mouse_cli.importing.bars.rest import links, masses, supports
from mouse_cli.importing.bars.springs import springs
from mouse_cli.importing.bulk_systems import Systems
from mouse_cli.importing.cards import Faults

_READ = ("GRID", "CONM2", "RBE2", "RBAR", *bulk.BARS, *bulk.SPRINGS)


def bars_of(path: str, outside: bool = False) -> Bars | None:
    """The model of a file of bulk data without shells and solids; None for every other file.

    Raises DeckError (MD231 to MD273) with all that is wrong, by file and line.
    """
    if not bulk.is_bulk(path):
        return None
    faults = Faults()
    deck = bulk.opened(path, faults, outside)
    if not bulk.of_bars(deck):
        return None
    bulk.unread(deck, _READ)
    bars = Bars(deck, Systems(deck))
    for card in deck.of("GRID"):
        number = deck.whole(card, 0)
        deck.at[number] = bars.systems.grid(number, card)
    for step in (elements, springs, masses, links, supports):
        step(bars)
    faults.stop()
    return bars

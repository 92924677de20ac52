"""Bulk data of bars as a mesh of mouse's own elements."""

from mouse_cli.importing import bulk
from mouse_cli.importing.bars.elements import elements
from mouse_cli.importing.bars.parts import Bars
from mouse_cli.importing.bars.properties import SHEARLESS, profiles
from mouse_cli.importing.bars.rest import links, masses, supports
from mouse_cli.importing.bars.springs import springs
from mouse_cli.importing.bulk_deck import BulkDeck
from mouse_cli.importing.bulk_systems import Systems
from mouse_cli.importing.cards import Faults
from mouse_cli.model.revision import Job, JobSection

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
    bars = Bars(deck, _systems(deck))
    for card in deck.of("GRID"):
        number = deck.whole(card, 0)
        deck.at[number] = bars.systems.grid(number, card)
    for step in (elements, springs, masses, links, supports):
        step(bars)
    faults.stop()
    return bars


def _systems(deck: BulkDeck) -> Systems:
    """Systems of coordinates, stated in the rectangular one that all grid points move in, or in the basic one."""
    moved = {deck.whole(card, 5) for card in deck.of("GRID")}
    basic = Systems(deck)
    if len(moved) != 1 or moved == {0}:
        return basic
    common = basic.system(moved.pop(), deck.of("GRID")[0])
    return Systems(deck, common.R.T) if common.kind == "R" else basic


def numbers(bars: Bars) -> Job:
    """What the job calls materials, sections and elements that the deck has by name."""
    deck = bars.deck
    materials = {deck.name("MAT", n, f"MAT1_{n}"): n for n in (deck.whole(card, 0) for card in deck.of("MAT1"))}
    sections = {}
    for number, own in profiles(deck).items():
        shear = tuple(0.0 if k == SHEARLESS else k for k in own.kappa or (0.0, 0.0))
        sections[own.name] = JobSection(number, own.material, own.mass / deck.mass, shear, bool(own.Iyz))
    return Job(materials, sections, frozenset(deck.numbers), deck.mass)

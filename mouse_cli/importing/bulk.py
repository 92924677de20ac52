"""Bulk data of Nastran as cards of CalculiX, whose elements then stand for those of Nastran; what has no such card is refused.

Sets are the properties, under the names that comments of preprocessors give them, else PSHELL_3; supports are SPC_1, SPC1_1_2.
"""

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace

from mouse_cli.formats import nastran_fields
from mouse_cli.formats.data_files import existing, line_span, text_lines
from mouse_cli.importing.bulk_deck import BulkDeck, text
from mouse_cli.importing.bulk_defaults import filled
from mouse_cli.importing.bulk_masses import masses, rigid
from mouse_cli.importing.bulk_passed import PASSED
from mouse_cli.importing.bulk_springs import springs
from mouse_cli.importing.bulk_supports import supports
from mouse_cli.importing.bulk_systems import Systems
from mouse_cli.importing.bulk_weighted import weighted
from mouse_cli.importing.cards import Card, Faults, included

_IS_BULK = re.compile(
    r"\s*(SOL\b|CEND|BEGIN\s+BULK|GRID[ *,]|ASSIGN\b|NASTRAN\b|INIT\b|INCLUDE\b|ID\s+\w+\s*,|\$)", re.IGNORECASE
)
_BULK_DATA = re.compile(r"\s*BEGIN\s+BULK|(GRID|CBAR|CQUAD4|CHEXA|PARAM)[*]?[ ,\t]+[0-9A-Z]", re.IGNORECASE)
_HEAD = 500  # lines of a file within which bulk data begin
_HEXA = (
    *range(12),
    *range(16, 20),
    *range(12, 16),
)  # mid-side nodes: those of the far face before those between the faces
_PENTA = (*range(9), *range(12, 15), *range(9, 12))
_ELEMENTS = {  # type of CalculiX by the number of nodes, and their order
    "CQUAD4": {4: ("S4", range(4))}, "CTRIA3": {3: ("S3", range(3))},
    "CQUAD8": {8: ("S8R", range(8))}, "CTRIA6": {6: ("S6", range(6))},
    "CHEXA": {8: ("C3D8I", range(8)), 20: ("C3D20R", _HEXA)}, "CPENTA": {6: ("C3D6", range(6)), 15: ("C3D15", _PENTA)},
    "CTETRA": {4: ("C3D4", range(4)), 10: ("C3D10", range(10))}, "CROD": {2: ("T3D2", range(2))},
}  # fmt: skip
_SHELLS = {  # fields of the nodes end before the first; then those of an offset and of thicknesses of its own
    "CQUAD4": (6, 7, 9, 10, 11, 12, 13), "CTRIA3": (5, 6, 9, 10, 11, 12), "CQUAD8": (10, 10, 11, 12, 13, 15),
    "CTRIA6": (8, 9, 10, 11, 12),
}  # fmt: skip
BARS = ("CBAR", "CBEAM", "CROD", "CONROD", "CTUBE")
SPRINGS = ("CELAS1", "CELAS2", "CBUSH")
_BARS_HELP = "let Nastran write K and M (DMIG, OUTPUT4), or model the shells by bars: a model of bars alone is read"
_INCLUDE = re.compile(r"\s*INCLUDE\b\s*=?([^$]*)", re.IGNORECASE)
_NAMES = re.compile(
    r"\$\s*(?:Femap (Property|Material) ([0-9]+)\s*:\s*(.+)|HMNAME (PROP|MAT)\s+([0-9]+)\s*\"([^\"]+)\")", re.IGNORECASE
)


def is_bulk(path: str) -> bool:
    """Whether the first line of a file that is not empty is of Nastran, or bulk data follow within some pages."""
    existing(path)
    lines = [line for line in text_lines(path)[:_HEAD] if line.strip()]
    if not lines or lines[0].lstrip().startswith("*"):
        return False
    return bool(_IS_BULK.match(lines[0])) or any(map(_BULK_DATA.match, lines))


def opened(path: str, faults: Faults, outside: bool = False) -> BulkDeck:
    """The bulk data of a file, and of those that it includes, with what GRDSET, BAROR and BEAMOR give to other cards.

    Raises DeckError (MD252) where a field is no number, (MD231, MD250, MD266, MD267) where a file cannot be included.
    """
    deck = BulkDeck(nastran_fields.Bulk(path, list(_lines((path,), outside))), faults)
    for card in deck.bulk.cards():
        deck.by.setdefault(card.name, []).append(card)
    _named(deck)
    filled(deck)
    deck.mass = deck.parameter("WTMASS", 1.0)
    return deck


def of_bars(deck: BulkDeck) -> bool:
    """Whether no element but bars, rods, springs and masses stands in it."""
    return not deck.of(*(set(_ELEMENTS) - {"CROD"})) and bool(deck.of(*BARS, *SPRINGS))


def unread(deck: BulkDeck, read: Iterable[str]) -> None:
    """Notes every kind of card that is neither read nor without effect on K and M."""
    for name in sorted(deck.by.keys() - {*read, *PASSED}, key=lambda name: deck.by[name][0].line):
        if name in ("MPC", "MPCADD") and not deck.chosen("MPC"):
            continue
        deck.refuse(deck.by[name][0], f"{name[:12]} has no counterpart that is read, and may change K or M")


def cards(deck: BulkDeck) -> list[Card]:
    """Bulk data as cards of CalculiX."""
    for card in deck.of(*BARS)[: 0 if of_bars(deck) else 1]:
        if card.name != "CROD":
            deck.refuse(
                card, f"this {card.name} stands among shells or solids, which CalculiX makes K and M of", _BARS_HELP
            )
    unread(deck, {"GRID", "CONM2", "CELAS1", "CELAS2", "CBUSH", "RBE2", "RBE3", *_ELEMENTS, *BARS})
    for step in (_nodes, _elements, _materials, _sections, masses, springs, rigid, weighted, supports, _step):
        step(deck)
    return deck.found


def _lines(chain: tuple[str, ...], outside: bool) -> Iterator[tuple[str, str, int]]:
    """Lines of the last file of `chain`, those of included files in their place, each with its file and number (from 1).

    A name between quotes may go on on the lines that follow.
    """
    lines = enumerate(text_lines(chain[-1]), 1)
    for number, line in lines:
        begun = _INCLUDE.match(line)
        if begun is None:
            yield line, chain[-1], number
            continue
        name = begun[1].strip()
        while name[:1] in ("'", '"') and name.count(name[0]) == 1 and (more := next(lines, None)) is not None:
            name += more[1].strip()
        name = name[1:].partition(name[0])[0] if name[:1] in ("'", '"') else name
        place = line_span(chain[-1], number, line)
        yield from _lines((*chain, included(place, name, chain, outside)), outside)


def _named(deck: BulkDeck) -> None:
    """Names that comments give to properties and materials, each once, with letters that a set may have."""
    for line in deck.bulk.lines:
        if found := _NAMES.match(line):
            kind = "MAT" if (found[1] or found[4]).upper().startswith("MAT") else "PROP"
            name = re.sub(r"\W+", "_", (found[3] or found[6]).strip()).strip("_").upper()
            if name and not name.isdigit() and name not in deck.names.values():
                deck.names[kind, int(found[2] or found[5])] = name


def _nodes(deck: BulkDeck) -> None:
    lines, systems = [], Systems(deck)
    for card in deck.of("GRID"):
        number = deck.whole(card, 0)
        deck.at[number] = systems.grid(number, card)
        if systems.turned(card):
            deck.turned.add(number)
        lines.append(deck.line(card, number, *deck.at[number].tolist()))
    if lines:
        deck.card(deck.of("GRID")[0], "NODE", lines)


def _elements(deck: BulkDeck) -> None:
    """A card for each property and type of element."""
    found: dict[tuple[str, str], list] = {}
    for card in deck.of(*_ELEMENTS):
        kinds = _ELEMENTS[card.name]
        ends, *own = _SHELLS.get(card.name, (None,))
        nodes = deck.rest(replace(card, fields=card.fields[:ends]), 2)
        if any(_given(card, at) for at in own):
            deck.refuse(card, f"this {card.name} has an offset or thicknesses of its own")
        if len(nodes) not in kinds:
            deck.refuse(
                card, f"this {card.name} has {len(nodes)} nodes; expected {' or '.join(map(str, kinds))}", code="MD265"
            )
            continue
        kind, order = kinds[len(nodes)]
        line = deck.line(card, deck.whole(card, 0), *(nodes[k] for k in order))
        found.setdefault((_set_of(deck, deck.whole(card, 1)), kind), []).append((card, line))
    for (name, kind), each in found.items():
        deck.card(each[0][0], "ELEMENT", [line for _, line in each], TYPE=kind, ELSET=name)


def _given(card: nastran_fields.Card, at: int) -> bool:
    return at < len(card.fields) and bool(card.fields[at]) and card.fields[at].strip("0.+-") != ""


def _set_of(deck: BulkDeck, number: int) -> str:
    """The name of the element set of a property."""
    own = [card for card in deck.of("PSHELL", "PSOLID", "PROD") if deck.whole(card, 0) == number]
    return deck.name("PROP", number, f"{own[0].name if own else 'PROPERTY'}_{number}")


def _materials(deck: BulkDeck) -> None:
    for card in deck.of("MAT1"):
        E, G, nu = (deck.real(card, k) for k in (1, 2, 3))
        if not text(card, 3) and E and G:
            nu = E / (2 * G) - 1
        number = deck.whole(card, 0)
        deck.card(card, "MATERIAL", NAME=deck.name("MAT", number, f"MAT1_{number}"))
        deck.card(card, "ELASTIC", [deck.line(card, E or 2 * G * (1 + nu), nu)])
        if deck.real(card, 4):
            deck.card(card, "DENSITY", [deck.line(card, deck.real(card, 4) * deck.mass)])


def _sections(deck: BulkDeck) -> None:
    for card in deck.of("PSHELL", "PSOLID", "PROD"):
        name = deck.name("PROP", deck.whole(card, 0), f"{card.name}_{deck.whole(card, 0)}")
        if not any(each.keyword == "ELEMENT" and each.options["ELSET"] == name for each in deck.found):
            continue  # no element has it
        material = deck.name("MAT", deck.whole(card, 1), f"MAT1_{deck.whole(card, 1)}")
        lines = []
        if card.name == "PSHELL":
            if deck.whole(card, 3) != deck.whole(card, 1) or (text(card, 4) and deck.real(card, 4) != 1):
                deck.refuse(card, "this PSHELL bends otherwise than its membrane material does")
            if deck.real(card, 7):
                deck.refuse(card, "this PSHELL has a nonstructural mass", "give it by density, or by CONM2")
            lines = [deck.line(card, deck.real(card, 2))]
        elif card.name == "PROD":
            if deck.real(card, 3) or deck.real(card, 5):
                deck.refuse(card, "this PROD has a torsional stiffness or a nonstructural mass, which a truss has not")
            lines = [deck.line(card, deck.real(card, 2))]
        elif text(card, 6).upper() not in ("", "SMECH"):
            deck.refuse(card, "this PSOLID is a fluid")
        keyword = "SHELL SECTION" if card.name == "PSHELL" else "SOLID SECTION"
        deck.card(card, keyword, lines, ELSET=name, MATERIAL=material)


def _step(deck: BulkDeck) -> None:
    """The frequencies that the job asks for, so that a revised job asks for them too."""
    for card in deck.of("EIGRL")[:1]:
        deck.card(card, "STEP")
        deck.card(card, "FREQUENCY", [deck.line(card, str(deck.whole(card, 3) or 10))])
        deck.card(card, "END STEP")

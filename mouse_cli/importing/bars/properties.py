"""PBAR, PBARL, PBEAM, PBEAML, PROD and PTUBE of Nastran bulk data: cross sections and the materials they are of."""

from collections.abc import Callable
from dataclasses import dataclass, field
from math import pi

from mouse_cli.formats import nastran_fields
from mouse_cli.importing.bars.shapes import CENTRED, SHAPES, of_shape
from mouse_cli.importing.bulk_deck import BulkDeck, text

_EQUAL = 1e-6  # relative difference up to which both ends of a beam have one section
_PER_LINE = 8
_STATION = ("YES", "YESA", "NO")
_DIVIDE = "divide it into beams of one section each"


@dataclass(frozen=True)
class Profile:
    """Constants of a cross section. Iz (I1) of bending in the plane of the orientation vector, Iy (I2) across it, Iyz (I12).

    kappa: shares of A that carry shear along y and z, None where shear does not count; mass: nonstructural, per length.
    """

    name: str
    card: nastran_fields.Card
    material: int
    A: float
    Iy: float = 0.0
    Iz: float = 0.0
    J: float = 0.0
    Iyz: float = 0.0
    kappa: tuple[float, float] | None = None
    mass: float = 0.0
    used: list[int] = field(default_factory=list)


def profiles(deck: BulkDeck) -> dict[int, Profile]:
    """All of them by property number; what has no counterpart is noted."""
    found = {}
    for name, read in _READERS.items():
        for card in deck.of(name):
            made = read(deck, card)
            if made is not None:
                found[deck.whole(card, 0)] = made
    return found


def called(deck: BulkDeck, card: nastran_fields.Card) -> str:
    """As comments name the property, else such as PBAR_3."""
    number = deck.whole(card, 0)
    return deck.name("PROP", number, f"{card.name}_{number}")


def _made(
    deck: BulkDeck, card: nastran_fields.Card, mass: float, shear: tuple[float, float] = (0.0, 0.0), **values: float
) -> Profile:
    """shear: K1 and K2, 0 where there is none to count."""
    given = (abs(shear[0]), abs(shear[1]))
    kappa = tuple(k or SHEARLESS for k in given) if any(given) else None
    return Profile(called(deck, card), card, deck.whole(card, 1), kappa=kappa, mass=mass * deck.mass, **values)


SHEARLESS = 1e6  # share of A that stands for no shear in one plane, beside shear in the other


def _bar(deck: BulkDeck, card: nastran_fields.Card) -> Profile:
    A, I1, I2, J, mass = (deck.real(card, k) for k in range(2, 7))
    shear = deck.real(card, 16), deck.real(card, 17)
    return _made(deck, card, mass, shear, A=A, Iz=I1, Iy=I2, J=J, Iyz=deck.real(card, 18))


def _rod(deck: BulkDeck, card: nastran_fields.Card) -> Profile:
    return _made(deck, card, deck.real(card, 5), A=deck.real(card, 2), J=deck.real(card, 3))


def _tube(deck: BulkDeck, card: nastran_fields.Card) -> Profile | None:
    outer, wall = deck.real(card, 2), deck.real(card, 3)
    inner = outer - 2 * wall if wall else 0.0
    if text(card, 5) and deck.real(card, 5) not in (0.0, outer):
        return deck.refuse(card, "this PTUBE has two diameters", _DIVIDE)
    return _made(deck, card, deck.real(card, 4), A=pi * (outer**2 - inner**2) / 4, J=pi * (outer**4 - inner**4) / 32)


def _beam(deck: BulkDeck, card: nastran_fields.Card) -> Profile | None:
    """A PBEAM whose stations have one section: those of ends that are not given are as end A."""
    first = [deck.real(card, k) for k in range(2, 8)]
    at = 2 * _PER_LINE
    if text(card, _PER_LINE).upper() in _STATION:  # the stress points of end A may be left out
        at = _PER_LINE
    while text(card, at).upper() in _STATION:
        other = [deck.real(card, at + k) if text(card, at + k) else first[k - 2] for k in range(2, 8)]
        if any(abs(a - b) > _EQUAL * max(abs(a), abs(b)) for a, b in zip(first, other, strict=True)):
            return deck.refuse(card, "this PBEAM changes its section along the beam", _DIVIDE)
        at += 2 * _PER_LINE if text(card, at).upper() == "YES" else _PER_LINE
    shear = tuple(deck.real(card, at + k) if text(card, at + k) else 1.0 for k in (0, 1))
    if any(deck.real(card, at + k) for k in (4, 5)):
        return deck.refuse(card, "this PBEAM has a nonstructural inertia", "give it by CONM2")
    far = [deck.real(card, at + _PER_LINE + k) for k in range(8)]
    if any(far[4:]) or (first[5] and any(far[:4])):
        what = "neutral axis" if any(far[4:]) else "nonstructural mass"
        return deck.refuse(
            card, f"the {what} of this PBEAM is off its shear centre", "give both at one place, by offsets of CBEAM"
        )
    A, I1, I2, I12, J, mass = first
    return _made(deck, card, mass, shear, A=A, Iz=I1, Iy=I2, J=J, Iyz=I12)


def _shaped(deck: BulkDeck, card: nastran_fields.Card) -> Profile | None:
    """PBARL and PBEAML: a kind of section and its dimensions; of the latter also those of other stations."""
    kind = text(card, 3).upper()
    if kind not in SHAPES:
        known = ", ".join(SHAPES)
        return deck.refuse(
            card, f"the section {kind[:12]} of this {card.name} is not read", f"give one of {known}, or a PBAR"
        )
    count = SHAPES[kind][0]
    numbers = [deck.real(card, _PER_LINE + k) for k in range(count)]
    mass, at = deck.real(card, _PER_LINE + count), _PER_LINE + count + 1
    while card.name == "PBEAML" and text(card, at).upper() in _STATION:
        other = [deck.real(card, at + 2 + k) if text(card, at + 2 + k) else numbers[k] for k in range(count)]
        if any(abs(a - b) > _EQUAL * abs(a) for a, b in zip(numbers, other, strict=True)):
            return deck.refuse(card, "this PBEAML changes its section along the beam", _DIVIDE)
        at += 3 + count
    found = of_shape(kind, numbers)
    if found is None:
        return deck.refuse(card, f"there is no {kind} of the dimensions {numbers}", "mend the dimensions", "MD265")
    if card.name == "PBEAML" and kind not in CENTRED:
        message = f"the shear centre of the section {kind} of this PBEAML is off its centroid"
        return deck.refuse(card, message, "give a PBEAM of its constants, and offsets of CBEAM")
    shear = found.pop("kappa_y", 0.0), found.pop("kappa_z", 0.0)
    return _made(deck, card, mass, shear, **found)


_READERS: dict[str, Callable[[BulkDeck, nastran_fields.Card], Profile | None]] = {
    "PBAR": _bar, "PBARL": _shaped, "PBEAM": _beam, "PBEAML": _shaped, "PROD": _rod, "PTUBE": _tube,
}  # fmt: skip

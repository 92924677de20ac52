"""CONM2 and RBE2 of Nastran bulk data: point masses, with inertia where a rigid body carries them, as points of it."""

import numpy as np

from mouse_cli.formats import nastran_fields
from mouse_cli.importing.bulk_deck import BulkDeck, text

_OPEN = 1e-9  # of the largest principal moment of inertia: what the sum of two may be below the third by rounding


def masses(deck: BulkDeck) -> None:
    """A MASS for each CONM2: at its node, or at points of the rigid body that has the node, where it is off it or has inertia."""
    for card in deck.of("CONM2"):
        own, heavy = deck.whole(card, 0), deck.real(card, 3) * deck.mass
        offset, inertia = np.array([deck.real(card, k) for k in (4, 5, 6)]), _inertia(deck, card)
        if not offset.any() and not inertia.any():
            deck.single(card, f"CONM2_{own}", own, "MASS", [deck.whole(card, 1)], [deck.line(card, heavy)])
            continue
        arms = _arms(deck, card, heavy, inertia)
        if arms is not None:
            _spread(deck, card, heavy, deck.at[deck.whole(card, 1)] + offset + arms)


def rigid(deck: BulkDeck) -> None:
    """A rigid body for each RBE2, with the points that masses of it are spread over."""
    for card in deck.of("RBE2"):
        if not _whole(card):
            components = text(card, 2)
            deck.refuse(card, f"this RBE2 joins the directions {components[:6]} alone" if len(components) < 6
                        else "this RBE2 has a thermal expansion")  # fmt: skip
            continue
        name, nodes = f"RBE2_{deck.whole(card, 0)}", deck.rest(card, 3) + deck.carried.get(deck.whole(card, 0), [])
        deck.card(card, "NSET", [deck.line(card, str(node)) for node in nodes], NSET=name)
        deck.card(card, "RIGID BODY", NSET=name, REF_NODE=str(deck.whole(card, 1)))


def _whole(card: nastran_fields.Card) -> bool:
    """Whether an RBE2 joins all six directions, and nothing else."""
    return "." not in card.fields[-1] and set(text(card, 2)) == set("123456")


def _inertia(deck: BulkDeck, card: nastran_fields.Card) -> np.ndarray:
    """Moments of inertia (3, 3) about the centre of the mass; products I21, I31 and I32 stand with a minus in them."""
    xx, yx, yy, zx, zy, zz = (deck.real(card, k) * deck.mass for k in range(8, 14))
    return np.array([[xx, -yx, -zx], [-yx, yy, -zy], [-zx, -zy, zz]])


def _arms(deck: BulkDeck, card: nastran_fields.Card, heavy: float, inertia: np.ndarray) -> np.ndarray | None:
    """Where points of equal mass are, from the centre (k, 3): one, or pairs on the principal axes; None, refused, where no body
    has such inertia or no rigid one carries it.
    """
    what = "has a rotary inertia, which a MASS of CalculiX has not" if inertia.any() else "is off its node"
    if _body(deck, card) is None:
        deck.refuse(card, f"this CONM2 {what}", "join its node to others by an RBE2 of all six directions, or spread the mass")
    elif deck.whole(card, 2):
        deck.refuse(card, f"this CONM2 {what}, in a system of its own", "give it in the basic system")
    elif not inertia.any():
        return np.zeros((1, 3))
    else:
        moments, axes = np.linalg.eigh(inertia)
        squares = 1.5 * (moments.sum() - 2 * moments)  # of the arms, times the mass: six points of a sixth of it
        if heavy > 0 and squares.min() > -_OPEN * moments.max():
            arms = axes * np.sqrt(squares.clip(0) / heavy)
            return np.vstack([arms.T, -arms.T])
        deck.refuse(card, "no body has the inertia of this CONM2: each principal moment is at most the sum of the two others",
                    "mend the moments: a thin plate has as much about its normal as about both axes in it")  # fmt: skip
    return None


def _body(deck: BulkDeck, card: nastran_fields.Card) -> int | None:
    """The rigid body, a whole RBE2, that has the node of a mass."""
    node = deck.whole(card, 1)
    own = (each for each in deck.of("RBE2") if _whole(each) and node in (deck.whole(each, 1), *deck.rest(each, 3)))
    return next((deck.whole(each, 0) for each in own), None) if node in deck.at else None


def _spread(deck: BulkDeck, card: nastran_fields.Card, heavy: float, places: np.ndarray) -> None:
    """Equal masses at these places (k, 3), one element set of them, points of the rigid body."""
    own, name = deck.whole(card, 0), f"CONM2_{deck.whole(card, 0)}"
    carried = deck.carried.setdefault(_body(deck, card), [])
    node = max(deck.grids) + 1 + sum(len(each) for each in deck.carried.values())
    element = max(deck.numbers) + 1 + sum(len(each) for each in deck.carried.values())
    numbers = range(node, node + len(places))
    carried += numbers
    deck.card(card, "NODE", [deck.line(card, n, *at) for n, at in zip(numbers, places.tolist(), strict=True)])
    lines = [deck.line(card, e, n) for e, n in zip([own, *range(element, element + len(places) - 1)], numbers, strict=True)]
    deck.card(card, "ELEMENT", lines, TYPE="MASS", ELSET=name)
    deck.card(card, "MASS", [deck.line(card, heavy / len(places))], ELSET=name)

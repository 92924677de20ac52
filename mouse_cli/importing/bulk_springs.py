"""CELAS1, CELAS2 and CBUSH of Nastran bulk data as springs of CalculiX."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.formats import nastran_fields
from mouse_cli.importing.bulk_deck import BulkDeck, text
from mouse_cli.importing.bulk_systems import Systems
from mouse_cli.importing.jobs import real

SMALL = 1e-9  # of the coordinates, or of an axis: points at one place, directions that are the same


Ends = list[tuple[int, int]]  # nodes and directions, from 1; direction 0 of scalar points


def springs(deck: BulkDeck) -> None:
    """A spring for each CELAS1 and CELAS2, and for each stiffness of a CBUSH."""
    for card, k, ends in scalar_springs(deck):
        if not ends or any(not 1 <= d <= 3 for _, d in ends):
            deck.refuse(card, f"this {card.name} acts on a rotation or on a scalar point")
            continue
        for node, d in ends:
            deck.global_directions(card, [node], str(d))
        _spring(deck, card, f"{card.name}_{deck.whole(card, 0)}", deck.whole(card, 0), ends, k)
    _bushes(deck)


def scalar_springs(deck: BulkDeck) -> Iterator[tuple[nastran_fields.Card, float, Ends]]:
    """Each CELAS1 and CELAS2 with its stiffness and its ends."""
    stiffness = {
        deck.whole(card, k): deck.real(card, k + 1) for card in deck.of("PELAS") for k in (0, 4) if text(card, k)
    }
    for card in deck.of("CELAS1", "CELAS2"):
        own = card.name == "CELAS2"
        k = deck.real(card, 1) if own else stiffness.get(deck.whole(card, 1), 0.0)
        ends = [(deck.whole(card, at), deck.whole(card, at + 1)) for at in (2, 4)]
        yield card, k, [(node, d) for node, d in ends if node]


def _bushes(deck: BulkDeck) -> None:
    properties = {deck.whole(card, 0): bush_stiffness(deck, card) for card in deck.of("PBUSH")}
    systems, number = Systems(deck), _highest(deck)
    for card in deck.of("CBUSH"):
        own, k = deck.whole(card, 0), properties.get(deck.whole(card, 1))
        nodes = [deck.whole(card, at) for at in (2, 3) if deck.whole(card, at)]
        if k is None or not set(nodes) <= set(deck.at) or not nodes:
            what = "has no PBUSH" if k is None else "names a grid point that is not defined"
            deck.refuse(card, f"this CBUSH {what}", "mend the number", "MD272")
            continue
        axes = _axes(deck, card, systems, [deck.at[n] for n in nodes], k)
        if axes is None:
            continue
        plain = np.allclose(axes, np.eye(3), rtol=0, atol=SMALL)
        deck.global_directions(card, nodes, "1")
        if not plain:
            words = [real(x) for x in axes[:, :2].T.ravel().tolist()]
            deck.card(card, "ORIENTATION", [deck.line(card, *words)], NAME=f"CBUSH_{own}")
        for d in np.flatnonzero(k[:3]).tolist():
            number += 1
            name = f"CBUSH_{own}_{d + 1}" if np.count_nonzero(k) > 1 else f"CBUSH_{own}"
            turned = {} if plain else {"ORIENTATION": f"CBUSH_{own}"}
            _spring(deck, card, name, number, [(n, d + 1) for n in nodes], float(k[d]), **turned)


def _highest(deck: BulkDeck) -> int:
    """A number that no element of the deck exceeds."""
    lines = (line for card in deck.found if card.keyword == "ELEMENT" for line in card.lines)
    return max((int(line.words[0]) for line in lines), default=0)


def bush_stiffness(deck: BulkDeck, card: nastran_fields.Card) -> np.ndarray:
    """K1 to K6 (6,) of a PBUSH; what else it has is damping, but for its mass."""
    words = [word.upper() for word in card.fields]
    if "M" in words:
        deck.refuse(card, "this PBUSH has a mass", "give it by CONM2")
    at = words.index("K") + 1 if "K" in words else len(words)
    rigid = [word for word in words[at : at + 6] if word == "RIGID"]
    if rigid:
        deck.refuse(card, "this PBUSH is rigid", "give a stiffness, or an RBE2 in its place")
    return np.zeros(6) if rigid else np.array([deck.real(card, at + d) for d in range(6)])


def _axes(deck: BulkDeck, card: nastran_fields.Card, systems: Systems, at: list[np.ndarray], k: np.ndarray):
    """Directions (3, 3) of K1 to K3, as columns; None where the bush does what no springs between two points do."""
    if k[3:].any():
        return deck.refuse(
            card, "this CBUSH has a stiffness against rotation", "leave K4 to K6 out where they matter little"
        )
    if text(card, 9) not in ("", "-1"):
        return deck.refuse(card, "this CBUSH has an offset")
    axes, length = bush_axes(deck, card, systems, at, k, np.eye(3)), at[-1] - at[0]
    across = [] if axes is None else [
        d for d in range(3) if k[d] and np.linalg.norm(np.cross(axes[:, d], length)) > SMALL * np.linalg.norm(length)
    ]  # fmt: skip
    if _long(at) and across:
        message = f"K{across[0] + 1} of this CBUSH acts across its length, and so turns its ends"
        return deck.refuse(card, message, "let both its points be at one place")
    return axes


def _long(at: list[np.ndarray]) -> bool:
    """Whether two points are apart."""
    return bool(np.linalg.norm(at[-1] - at[0]) > SMALL * max(float(np.abs(at).max()), 1.0))


def bush_axes(
    deck: BulkDeck, card: nastran_fields.Card, systems: Systems, at: list[np.ndarray], k: np.ndarray, R: np.ndarray
) -> np.ndarray | None:
    """Directions (3, 3) of K1 to K6, as columns; None where they are not determined. R: those that its first point moves in."""
    if text(card, 7):
        system = systems.system(deck.whole(card, 7), card)
        if system.kind != "R":
            return deck.refuse(card, f"the axes of this CBUSH are of system {text(card, 7)}, which is not rectangular")
        return system.R
    if not _long(at):
        return deck.refuse(card, "this CBUSH has no length, and no CID that would orient it", "give its CID, such as 0")
    x = (at[-1] - at[0]) / np.linalg.norm(at[-1] - at[0])
    turned = k[1:3].any() or k[4:].any()
    aside = _aside(deck, card, at[0], R) if turned else np.eye(3)[np.argmin(np.abs(x))]
    z = np.cross(x, aside)
    if np.linalg.norm(z) < SMALL * np.linalg.norm(aside) or not aside.any():
        return deck.refuse(card, "this CBUSH has no orientation", "give a vector that is not along it, or a CID")
    z /= np.linalg.norm(z)
    return np.column_stack([x, np.cross(z, x), z])


def _aside(deck: BulkDeck, card: nastran_fields.Card, origin: np.ndarray, R: np.ndarray) -> np.ndarray:
    """The vector (3,) that orients a CBUSH: to a grid point, or given in directions R (3, 3)."""
    if text(card, 4).isdigit() and not text(card, 5) and not text(card, 6):
        return deck.at.get(deck.whole(card, 4), origin) - origin
    return R @ [deck.real(card, d) for d in (4, 5, 6)]


def _spring(
    deck: BulkDeck, card, name: str, number: int, ends: list[tuple[int, int]], k: float, **options: str
) -> None:
    """An element of a set of its own, such as CELAS1_7; ends: nodes and directions."""
    data = [deck.line(card, *(str(d) for _, d in ends)), deck.line(card, k)]
    deck.single(card, name, number, "SPRING", [node for node, _ in ends], data, **options)

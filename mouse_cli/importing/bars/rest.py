"""CONM2, RBE2, RBAR and supports of Nastran bulk data: masses off their nodes, rigid links, what cannot move."""

import numpy as np

from mouse_cli.importing.bars.parts import Bars
from mouse_cli.importing.bulk_deck import text
from mouse_cli.importing.bulk_supports import held

_ALL = "123456"
_INERTIA = {"Jx": (0, 0), "Jy": (1, 1), "Jz": (2, 2)}
_PRODUCTS = {"Jxy": (0, 1), "Jxz": (0, 2), "Jyz": (1, 2)}


def masses(bars: Bars) -> None:
    """CONM2: a mass off its node, with moments of inertia about axes through it; I21 to I32 are integrals of x y dm."""
    deck = bars.deck
    for card in deck.of("CONM2"):
        node = deck.whole(card, 1)
        if not bars.known(card, [node]):
            continue
        system = bars.systems.system(deck.whole(card, 2), card) if text(card, 2) != "-1" else None
        if system is None or system.kind != "R":
            deck.refuse(
                card, "the system of this CONM2 is not rectangular, or -1", "give its offset in a rectangular system"
            )
            continue
        I11, I21, I22, I31, I32, I33 = (deck.real(card, k) for k in range(8, 14))
        J = np.array([[I11, -I21, -I31], [-I21, I22, -I32], [-I31, -I32, I33]]) * deck.mass
        J, offset = system.R @ J @ system.R.T, system.R @ [deck.real(card, k) for k in (4, 5, 6)]
        own = {name: float(J[at]) for name, at in _INERTIA.items() if J[at]}
        own |= {name: -float(J[at]) for name, at in _PRODUCTS.items() if abs(J[at]) > 1e-12 * np.abs(J).max()}
        mass = deck.real(card, 3) * deck.mass
        if mass or own:
            options = {"offset": offset.tolist()} if offset.any() else {}
            bars.add(card, "mass", [node], {"mass": mass} | own, options=options)


def links(bars: Bars) -> None:
    """RBE2 and RBAR: points that follow another one as a rigid body, in some directions or in all."""
    deck = bars.deck
    for card in deck.of("RBE2"):
        if "." in card.fields[-1]:
            card = type(card)(
                card.name, card.fields[:-1], card.line
            )  # a thermal expansion, which does nothing to K and M
        _linked(bars, card, deck.whole(card, 1), deck.rest(card, 3), text(card, 2))
    for card in deck.of("RBAR"):
        first, second = deck.whole(card, 1), deck.whole(card, 2)
        whose = [set(text(card, k)) for k in (3, 4)]
        if whose not in ([set(_ALL), set()], [set(), set(_ALL)]):
            deck.refuse(card, "this RBAR follows both of its points", "let one point have all of CNA, and none of CNB")
            continue
        lead, follow, along = (first, second, text(card, 6)) if whose[0] else (second, first, text(card, 5))
        _linked(bars, card, lead, [follow], along or _ALL)


def _linked(bars: Bars, card, lead: int, follow: list[int], components: str) -> None:
    if not bars.known(card, [lead, *follow]):
        return
    by: dict[tuple[int, ...], list[int]] = {}
    for node in dict.fromkeys(follow):
        by.setdefault(bars.directions(card, node, components), []).append(node)
    bars.links += [(card, lead, nodes, along) for along, nodes in by.items() if along]


def supports(bars: Bars) -> None:
    """What SPC, SPC1 and GRID hold, in basic directions."""
    for (_, components), each in held(bars.deck).items():
        for card, nodes in each:
            for node in nodes if bars.known(card, nodes) else ():
                for d in bars.directions(card, node, components.replace("0", "")):
                    bars.held.setdefault((node, d), card)

"""CELAS1, CELAS2 and CBUSH of Nastran bulk data as springs and joints of mouse."""

import numpy as np

from mouse_cli.formats import nastran_fields
from mouse_cli.importing.bars.parts import Bars, Spring
from mouse_cli.importing.bulk_deck import text
from mouse_cli.importing.bulk_springs import SMALL, bush_axes, bush_stiffness, scalar_springs
from mouse_cli.model.geometry import DIRECTIONS


def springs(bars: Bars) -> None:
    """One element for each of them; each stiffness is a parameter."""
    for card, k, ends in scalar_springs(bars.deck):
        _scalar(bars, card, k, ends)
    properties = {bars.deck.whole(card, 0): bush_stiffness(bars.deck, card) for card in bars.deck.of("PBUSH")}
    for card in bars.deck.of("CBUSH"):
        k = properties.get(bars.deck.whole(card, 1))
        nodes = [bars.deck.whole(card, at) for at in (2, 3) if bars.deck.whole(card, at)]
        if k is None or not nodes:
            bars.deck.refuse(
                card, f"this CBUSH has no {'PBUSH' if k is None else 'grid point'}", "mend the number", "MD272"
            )
        elif bars.known(card, nodes) and k.any():
            _bush(bars, card, nodes, k)


def _scalar(bars: Bars, card: nastran_fields.Card, k: float, ends: list[tuple[int, int]]) -> None:
    """A spring on one direction of a point, or on the difference of one direction of two."""
    if not ends or any(not 1 <= d <= 6 for _, d in ends):
        return bars.deck.refuse(
            card, f"this {card.name} acts on a scalar point", "let it act on directions of grid points"
        )
    if not bars.known(card, [node for node, _ in ends]):
        return None
    (node, d), (other, e) = ends[0], ends[-1]
    if (
        d != e
        or not np.allclose(bars.axes(node), bars.axes(other), rtol=0, atol=1e-9)
        or (len(ends) == 2 and node == other)
    ):
        message = f"this {card.name} joins two directions that are not one"
        return bars.deck.refuse(card, message, "let it join the same direction of two points")
    _added(bars, card, "spring", [node for node, _ in ends], {d - 1: k}, bars.axes(node))
    return None


def _bush(bars: Bars, card: nastran_fields.Card, nodes: list[int], k: np.ndarray) -> None:
    """Between two points a joint at the place of the bush, with rigid arms; else a spring to the ground."""
    deck, at = bars.deck, [bars.deck.at[node] for node in nodes]
    axes = bush_axes(deck, card, bars.systems, at, k, bars.axes(nodes[0]))
    if axes is None:
        return
    stiff = {d: float(k[d]) for d in np.flatnonzero(k).tolist()}
    if len(nodes) == 1:
        return _added(bars, card, "spring", nodes, stiff, axes)
    share = deck.real(card, 8) if text(card, 8) else 0.5
    place = at[0] + share * (at[1] - at[0])
    if text(card, 9) not in ("", "-1"):
        place = bars.systems.system(deck.whole(card, 9), card).place(
            np.array([deck.real(card, k) for k in (10, 11, 12)])
        )
    return _added(bars, card, "joint", nodes, stiff, axes, {"at": place.tolist()})


def _added(
    bars: Bars, card, type: str, nodes: list[int], stiff: dict[int, float], axes: np.ndarray, more: dict | None = None
) -> None:
    """The element, and its stiffnesses (by direction, from 0) as parameters called as the job calls the element."""
    properties = {DIRECTIONS[d]: k for d, k in stiff.items()}
    plain = np.allclose(axes, np.eye(3), rtol=0, atol=SMALL)
    options = ({} if plain else {"axes": axes[:, :2].T.tolist()}) | (more or {})
    number = bars.add(card, type, nodes, properties, options=options)
    name = f"{card.name}_{bars.deck.whole(card, 0)}"
    bars.springs += [Spring(name if len(stiff) == 1 else f"{name}_{d + 1}", number, DIRECTIONS[d]) for d in stiff]

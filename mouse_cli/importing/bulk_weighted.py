"""RBE3 of Nastran bulk data: a grid point that moves as the weighted mean of others, as equations of CalculiX."""

import numpy as np

from mouse_cli.formats import nastran_fields
from mouse_cli.importing.bulk_deck import BulkDeck, text

_AWAY = 1e-9  # of the largest singular value: points that leave a rotation open
_TERMS = 4  # on a line


def weighted(deck: BulkDeck) -> None:
    """Three equations for each RBE3.

    Its point moves as the rigid body that fits u_j of the others best, sum of w_j |u_j - U - theta x r_j|^2 least
    (MSC Nastran Quick Reference Guide, RBE3): U = first rows of (R' W R)^-1 R' W u.
    """
    for card in deck.of("RBE3"):
        point, weights = deck.whole(card, 2), _weights(deck, card)
        if weights is None:
            continue
        if point not in deck.at or not set(weights) <= set(deck.at):
            deck.refuse(card, "a grid point of this RBE3 is not defined", "mend the number", "MD272")
            continue
        if any(point in deck.rest(each, 3) or point == deck.whole(each, 1) for each in deck.of("RBE2")):
            deck.refuse(card, "the point of this RBE3 is one of an RBE2 too, which takes its rotations")
            continue
        others = list(weights)
        r = np.array([deck.at[n] for n in others]) - deck.at[point]
        R = np.vstack([np.hstack([np.eye(3), [[0, z, -y], [-z, 0, x], [y, -x, 0]]]) for x, y, z in r.tolist()])
        root = np.sqrt(np.repeat([weights[n] for n in others], 3))
        size = max(float(np.abs(r).max()), 1e-300)
        scale = np.array([1, 1, 1, 1 / size, 1 / size, 1 / size])
        if np.linalg.svd(root[:, None] * R * scale, compute_uv=False)[-1] < _AWAY * root.max():
            deck.refuse(card, "the grid points of this RBE3 are on one line, or too few", "join three or more points")
            continue
        motion = np.linalg.lstsq(root[:, None] * R * scale, np.diag(root), rcond=None)[0][:3]
        for d in range(3):
            terms = [(point, d + 1, 1.0)]
            terms += [(n, k + 1, -float(motion[d, 3 * j + k])) for j, n in enumerate(others) for k in range(3)]
            terms = [each for each in terms if abs(each[2]) > _AWAY]
            lines = [deck.line(card, str(len(terms)))]
            for first in range(0, len(terms), _TERMS):
                some = terms[first : first + _TERMS]
                lines.append(deck.line(card, *(str(word) for term in some for word in term)))
            deck.card(card, "EQUATION", lines)


def _weights(deck: BulkDeck, card: nastran_fields.Card) -> dict[int, float] | None:
    """The weight of each grid point; None where the card says what no equation of three directions does."""
    if set(text(card, 3)) not in (set("123"), set("123456")):
        return deck.refuse(card, f"this RBE3 moves its point in the directions {text(card, 3)[:6]} alone")
    deck.global_directions(card, [deck.whole(card, 2)], "1")
    weights: dict[int, float] = {}
    words = [word.upper() for word in card.fields[4:] if word]
    k = 0
    while k < len(words):
        if words[k] in ("UM", "ALPHA") or k + 1 >= len(words) or set(words[k + 1]) != set("123"):
            return deck.refuse(card, "this RBE3 has other than the directions 123 of its points, UM or ALPHA")
        weight = deck.real(nastran_fields.Card(card.name, [words[k]], card.line), 0)
        last = k + 2
        while last < len(words) and (words[last].isdigit() or words[last] == "THRU"):
            last += 1
        nodes = deck.rest(nastran_fields.Card(card.name, words[k + 2 : last], card.line), 0)
        deck.global_directions(card, nodes, "1")
        weights |= {n: weights.get(n, 0.0) + weight for n in nodes}
        k = last
    return weights or None

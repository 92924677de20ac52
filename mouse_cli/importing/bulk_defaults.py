"""GRDSET, BAROR and BEAMOR of Nastran bulk data: what fields of other cards are where these leave them empty."""

from collections.abc import Iterable
from dataclasses import replace

from mouse_cli.formats import nastran_fields
from mouse_cli.importing.bulk_deck import BulkDeck, text

_OF = {
    "GRDSET": ("GRID", (1, 5, 6, 7), ()),
    "BAROR": ("CBAR", (1, 7), (4, 5, 6)),
    "BEAMOR": ("CBEAM", (1, 7), (4, 5, 6)),
}


def filled(deck: BulkDeck) -> None:
    """Puts in the defaults: each field by itself, the three of a vector together."""
    for name, (of, single, vector) in _OF.items():
        for default in deck.of(name)[:1]:
            deck.by[of] = [_filled(card, default, single, vector) for card in deck.by.get(of, [])]


def _filled(
    card: nastran_fields.Card, default: nastran_fields.Card, single: Iterable[int], vector: Iterable[int]
) -> nastran_fields.Card:
    at = [k for k in single if not text(card, k)]
    if not any(text(card, k) for k in vector):
        at += vector
    fields = card.fields + [""] * (8 - len(card.fields))
    for k in at:
        fields[k] = text(default, k)
    return replace(card, fields=fields)

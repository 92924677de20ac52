"""Nodes of Nastran bulk data (.bdf, .dat, .nas, .pch): GRID cards in the basic system of coordinates."""

from mouse_cli.formats.data_files import FileFormat
from mouse_cli.formats.nastran_fields import Bulk
from mouse_cli.formats.node_files import Rows


def _read(path: str) -> Rows:
    bulk = Bulk(path)
    found: Rows = []
    for card in bulk.cards("GRID"):
        if bulk.whole(card, 1):
            bulk.refuse(
                card, "this GRID is in a local system of coordinates", "write the grid points in the basic system"
            )
        place = [repr(bulk.real(card, field)) for field in (2, 3, 4)]
        found.append((card.line, bulk.lines[card.line - 1], [card.fields[0], *place]))
    return found


FORMAT = FileFormat("bdf", _read, ("bdf", "dat", "nas", "pch"))

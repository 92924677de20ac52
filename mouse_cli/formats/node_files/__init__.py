"""Files that say where the nodes of an imported model are: one module = one format."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mouse_cli.formats import data_files
from mouse_cli.formats.data_files import line_span, reject

Rows = list[tuple[int, str, list[str]]]  # of each node: line number, line, and the words id, x, y, z
_LARGEST = 2**31 - 1  # node number


@dataclass(frozen=True, slots=True)
class NodeFormat:
    """A format of files with nodes: read(path) gives Rows."""

    key: str
    read: Callable[[str], Rows]
    suffixes: tuple[str, ...] = ()
    claims: Callable[[bytes], bool] | None = None


def read_nodes(path: str) -> tuple[np.ndarray, np.ndarray]:
    """Numbers (k,) and coordinates (k, 3) of nodes, in the global system and in the unit of length of the file.

    Raises DeckError (MD250 to MD262).
    """
    nothing = "the file holds no node", "export the nodes with their coordinates"
    rows = data_files.rows_of(__name__, path, "a file of nodes", *nothing)
    seen: dict[int, list[float]] = {}
    for number, line, words in rows:
        node, place = _node(words)
        if node is None or node in seen:
            again = "this node was given before" if node in seen else "expected a node number and three coordinates"
            reject("MD252", path, again, "give each node once, as number, x, y, z", line_span(path, number, line))
        seen[node] = place
    return np.array(list(seen)), np.array(list(seen.values()))


def _node(words: list[str]) -> tuple[int | None, list[float]]:
    try:
        place = [float(word.upper().replace("D", "E")) for word in words[1:]]
        right = words[0].isascii() and words[0].isdigit() and len(words[0]) < 13 and 0 < int(words[0]) <= _LARGEST
    except (ValueError, IndexError):
        return None, []
    return (int(words[0]) if right and len(place) == 3 and np.isfinite(place).all() else None), place

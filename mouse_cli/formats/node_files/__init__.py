"""Files that say where the nodes of an imported model are: one module = one format, whose read(path) gives Rows."""

import numpy as np

from mouse_cli.formats import data_files
from mouse_cli.formats.data_files import line_span, natural, reject

Rows = list[tuple[int, str, list[str]]]  # of each node: line number, line, and the words id, x, y, z


def read_nodes(path: str) -> tuple[np.ndarray, np.ndarray]:
    """Numbers (k,) and coordinates (k, 3) of nodes, in the global system and in the unit of length of the file.

    Raises DeckError (MD250 to MD262).
    """
    nothing = "the file holds no node", "export the nodes with their coordinates"
    rows = data_files.rows_of(__name__, path, "a file of nodes", *nothing)
    seen: dict[int, list[float]] = {}
    for number, line, words in rows:
        node, place = natural(words[0]) if words else 0, _place(words[1:])
        if not node or not place or node in seen:
            again = (
                "this node was given before"
                if node in seen and place
                else "expected a node number and three coordinates"
            )
            reject("MD252", path, again, "give each node once, as number, x, y, z", line_span(path, number, line))
        seen[node] = place
    return np.array(list(seen)), np.array(list(seen.values()))


def _place(words: list[str]) -> list[float]:
    """Three finite coordinates; empty where there are none."""
    try:
        place = [float(word.upper().replace("D", "E")) for word in words]
    except ValueError:
        return []
    return place if len(place) == 3 and np.isfinite(place).all() else []

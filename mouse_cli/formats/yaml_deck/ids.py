"""Numbers of nodes and elements as a deck writes them: `5`, `1-58`, `all`, or a list of these."""

import re

import numpy as np

from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.kinds import KINDS, MAX_WHOLE
from mouse_cli.formats.yaml_deck.nodes import Document, Node

MOST = 4_000_000  # numbers that one range may stand for
_PART = re.compile(r"\s*([0-9]+)\s*(?:-\s*([0-9]+)\s*)?", re.ASCII)


def ids(document: Document, node: Node, what: str, everything: np.ndarray | None = None) -> np.ndarray | None:
    """The numbers (k,), in the order given; `everything` is what `all` stands for."""
    if yaml_values.is_list(node):
        quick = yaml_values.plain_numbers(node.value)
        if quick is not None and _are_ids(quick):
            return quick.astype(int)
        parts = [ids(document, item, what, everything) for item in node.value]
        if not parts:
            return document.error("MD216", node, f"{what} is empty", "give a number or a range")
        if any(part is None for part in parts):
            return None
        if sum(map(len, parts)) > MOST:
            message = f"{what} stands for {sum(map(len, parts))} numbers"
            return document.error("MD409", node, message, f"give at most {MOST} numbers")
        return np.concatenate(parts)
    if yaml_values.is_scalar(node) and node.value.strip() == "all" and everything is not None:
        return everything
    return _range(document, node, what)


def _are_ids(values: np.ndarray) -> bool:
    return len(values) > 0 and bool(((values >= 0) & (values <= MAX_WHOLE) & (values == np.floor(values))).all())


def _range(document: Document, node: Node, what: str) -> np.ndarray | None:
    """`5`, `1-58` or `1, 4-6`."""
    texts = node.value.split(",") if yaml_values.is_scalar(node) else [""]
    found = [_PART.fullmatch(text) for text in texts]
    if not all(found):
        return yaml_values.mistyped(document, node, what, KINDS["ids"].words)
    pairs = [(int(part[1]), int(part[2] or part[1])) for part in found]
    total = 0
    for first, last in pairs:
        total += last - first + 1
        if last < first or last > MAX_WHOLE or total > MOST:
            message = f"{what} has the range {first}-{last}"
            return document.error("MD409", node, message, f"give the lower number first, at most {MOST} numbers")
    return np.concatenate([np.arange(first, last + 1) for first, last in pairs])


def ranges(numbers: np.ndarray) -> str:
    """The same numbers as text, runs of ascending ones as ranges: the value of a key in a deck.

    >>> import numpy as np
    >>> ranges(np.array([1, 2, 3, 7])), ranges(np.array([4])), ranges(np.arange(1, 59))
    ('[1-3, 7]', '4', '1-58')
    """
    numbers = np.asarray(numbers)
    breaks = np.flatnonzero(np.diff(numbers) != 1) + 1
    parts = []
    for run in np.split(numbers, breaks):
        first, last = int(run[0]), int(run[-1])
        parts += [f"{first}-{last}"] if last > first + 1 else [str(i) for i in range(first, last + 1)]
    return parts[0] if len(parts) == 1 else f"[{', '.join(parts)}]"

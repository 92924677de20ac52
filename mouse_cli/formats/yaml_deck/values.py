"""Values of YAML nodes: numbers, words and lists of them, each checked against what its key expects."""

import math
import re
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import yaml

from mouse_cli.formats.draft import Entries
from mouse_cli.formats.yaml_deck.kinds import KINDS, MAX_WHOLE, PERCENT
from mouse_cli.formats.yaml_deck.nodes import PLAIN, QUOTED, Document, Node, is_null
from mouse_cli.model.materials import DENSITIES, MODULI

_NUMBER = re.compile(r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?", re.ASCII)
_FORTRAN = re.compile(r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)[dD][-+]?[0-9]+", re.ASCII)
_COMMA = re.compile(r"[-+]?[0-9]+,[0-9]+([eE][-+]?[0-9]+)?", re.ASCII)
_WITH_UNIT = re.compile(
    r"([-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)(\s*)([A-Za-z][A-Za-z0-9/^]*)", re.ASCII
)
_UNITS = {**MODULI, **DENSITIES, "m": 1.0, "mm": 1e-3, "cm": 1e-2, "mm2": 1e-6, "cm2": 1e-4, "mm4": 1e-12, "cm4": 1e-8, "kg": 1.0,
          "g": 1e-3, "t": 1e3, "N/m": 1.0, "N/mm": 1e3, "kN/m": 1e3, "kN/mm": 1e6, "MN/m": 1e6, "Hz": 1.0, "kHz": 1e3,
          "rad/s": 0.15915494309189535, "rpm": 1 / 60}  # fmt: skip
_PERCENT = re.compile(PERCENT, re.ASCII)
_SPECIAL = {".nan": np.nan, ".inf": np.inf, "+.inf": np.inf, "-.inf": -np.inf}
_FLAGS = {"true": True, "yes": True, "on": True, "false": False, "no": False, "off": False}
_DIGITS = "0123456789+-.eE"
LARGEST = 1e150  # products of larger numbers are beyond all floating-point numbers: they count as infinite
_MOST_SHOWN = 20  # errors of one list; more say no more


def is_scalar(node: Node) -> bool:
    """Whether the node is a single value."""
    return isinstance(node, yaml.ScalarNode)


def is_list(node: Node) -> bool:
    """Whether the node is a list."""
    return isinstance(node, yaml.SequenceNode)


def is_mapping(node: Node) -> bool:
    """Whether the node is a mapping."""
    return isinstance(node, yaml.MappingNode)


def keys_of(node: Node | None) -> dict[str, Node]:
    """The keys of a mapping, with their nodes; none of anything else."""
    return {key.value: value for key, value in node.value} if node is not None and is_mapping(node) else {}


def shown(node: Node) -> str:
    """A value as a message quotes it."""
    if is_list(node):
        return f"a list of {len(node.value)}"
    if is_mapping(node):
        return "a mapping"
    return "empty" if is_null(node) else f"'{node.value[:40]}'"


def mistyped(document: Document, node: Node, what: str, words: str) -> None:
    """Note that a value is of another kind than its key expects; returns None, the missing value."""
    if (node.tag not in (PLAIN, QUOTED) and is_scalar(node)) or ":" in str(node.tag):
        tag = node.tag.replace("tag:yaml.org,2002:", "!!")
        document.error("MD203", node, f"{what} carries the tag {tag}; tags are not read", "delete the tag")
        return
    document.error("MD213", node, f"{what} is {shown(node)}; expected {words}", _remedy(node, words))


def _remedy(node: Node, words: str) -> str:
    if is_scalar(node) and _FORTRAN.fullmatch(node.value):
        return f"write the exponent with e: {re.sub('[dD]', 'e', node.value)}"
    if node.tag == QUOTED and _NUMBER.fullmatch(node.value):
        return "write the number without quotes"
    if is_scalar(node) and _COMMA.fullmatch(node.value):
        return f"write a decimal point: {node.value.replace(',', '.')}"
    with_unit = _WITH_UNIT.fullmatch(node.value) if is_scalar(node) else None
    if with_unit and with_unit[3] in _UNITS:
        value = float(with_unit[1]) * _UNITS[with_unit[3]]
        return f"write the number alone, without its unit: {value:.6g} in SI"
    return f"give {words}"


def as_number(node: Node) -> float | None:
    """The number that a plain scalar spells, also as `1e5` and `.nan`; None when it spells none."""
    if node.tag != PLAIN or not is_scalar(node):
        return None
    if _NUMBER.fullmatch(node.value):
        return _bounded(float(node.value))
    return _SPECIAL.get(node.value.lower())


def _bounded(value: float) -> float:
    return value if abs(value) < LARGEST else math.copysign(math.inf, value)


def as_percent(node: Node) -> float | None:
    """The 5 of `5 %`; None when it is no percentage."""
    if not is_scalar(node) or not _PERCENT.match(node.value):
        return None
    return _bounded(float(node.value.replace("%", "")))


def number(document: Document, node: Node, what: str, words: str = "a number") -> float | None:
    """A number, infinite ones included."""
    value = as_number(node)
    if value is None:
        mistyped(document, node, what, words)
    return value


def share(document: Document, node: Node, what: str, words: str = KINDS["sd"].words) -> float | None:
    """A number, or a percentage as a share of 1."""
    percent = as_percent(node)
    return number(document, node, what, words) if percent is None else percent / 100


def decimal_comma(node: Node) -> str:
    """How a list looks to be meant where two of its items are parted by a comma alone, and others by a comma and a blank."""
    items = node.value if is_list(node) else []
    gaps = [b.start_mark.index - a.end_mark.index for a, b in pairwise(items)]
    if 1 not in gaps or len(set(gaps)) == 1 or not all(is_scalar(item) for item in items):
        return ""
    at = gaps.index(1)
    one, other = items[at].value, items[at + 1].value
    return f"{one},{other} are two numbers here: write {one}.{other} if it is one, or a blank after the comma"


def whole(document: Document, node: Node, what: str, words: str = "a whole number") -> int | None:
    """A whole number; 3.0 counts as one."""
    value = as_number(node)
    if value is None or not abs(value) <= MAX_WHOLE or value != int(value):
        return mistyped(document, node, what, words)
    return int(value)


def text(document: Document, node: Node, what: str, words: str = "text") -> str | None:
    """A word or a line of text; what looks like a number is text too."""
    if is_scalar(node) and node.tag in (PLAIN, QUOTED):
        return node.value
    return mistyped(document, node, what, words)


def flag(document: Document, node: Node, what: str, words: str = "true or false") -> bool | None:
    """True or false."""
    value = _FLAGS.get(node.value.lower()) if is_scalar(node) and node.tag == PLAIN else None
    return mistyped(document, node, what, words) if value is None else value


def items(document: Document, node: Node, what: str, words: str) -> list[Node] | None:
    """The nodes of a list."""
    return node.value if is_list(node) and ":" not in node.tag else mistyped(document, node, what, words)


def numbers(
    document: Document, node: Node, what: str, words: str = "a list of numbers", missing: bool = False
) -> np.ndarray | None:
    """A list of numbers as an array; with `missing`, null stands for NaN."""
    nodes = items(document, node, what, words)
    return None if nodes is None else _array(document, nodes, what, missing)


def texts(document: Document, node: Node, what: str, words: str) -> list[str] | None:
    """A list of words."""
    nodes = items(document, node, what, words)
    if nodes is None:
        return None
    values = [text(document, item, f"{what}[{i}]") for i, item in enumerate(nodes, 1)]
    return None if None in values else values


def wholes(document: Document, node: Node, what: str, words: str) -> np.ndarray | None:
    """A list of whole numbers as an array."""
    nodes = items(document, node, what, words)
    return None if nodes is None else indices(document, nodes, what)


def rows(
    document: Document, node: Node, what: str, words: str, missing: bool = False
) -> tuple[list[Node], list[np.ndarray]] | None:
    """A list of lists of numbers: the nodes of its rows, and their values."""
    nodes = items(document, node, what, words)
    if nodes is None:
        return None
    values = [numbers(document, row, f"{what}, row {i}", missing=missing) for i, row in enumerate(nodes, 1)]
    return None if any(v is None for v in values) else (nodes, values)


def entries(document: Document, node: Node, what: str, words: str, width: int = 3) -> Entries | None:
    """A list of [row, column, value], or with `width` 2 of [row, column]; the missing values are 1."""
    nodes = items(document, node, what, words)
    if nodes is None or not _all_of_width(document, nodes, what, width):
        return None
    flat = [item for row in nodes for item in row.value]
    row, col = (indices(document, flat[i::width], what) for i in (0, 1))
    value = _array(document, flat[2::width], what) if width == 3 else np.ones(len(nodes))
    if row is None or col is None or value is None:
        return None
    return Entries(row, col, value, document.where(nodes))


def _all_of_width(document: Document, nodes: Sequence[Node], what: str, width: int) -> bool:
    bad = [node for node in nodes if not is_list(node) or len(node.value) != width]
    words = "[row, column, value]" if width == 3 else "[row, column]"
    for node in bad[:_MOST_SHOWN]:
        document.error("MD213", node, f"an item of {what} is {shown(node)}; expected {words}", f"give {words}")
    return not bad


def indices(document: Document, nodes: list[Node], what: str) -> np.ndarray | None:
    """Whole numbers of the nodes of a list, as an array."""
    values = plain_numbers(nodes)
    if values is not None and (np.abs(values) <= MAX_WHOLE).all() and (values == np.floor(values)).all():
        return values.astype(int)
    singly = [whole(document, node, f"an index in {what}") for node in _wrong(nodes, _is_whole)]
    return None if singly else np.array([int(as_number(node)) for node in nodes], dtype=int)


def _is_whole(node: Node) -> bool:
    value = as_number(node)
    return value is not None and abs(value) <= MAX_WHOLE and value == int(value)


def _array(document: Document, nodes: list[Node], what: str, missing: bool = False) -> np.ndarray | None:
    values = plain_numbers(nodes)
    if values is not None:
        return values
    wrong = _wrong(nodes, lambda node: as_number(node) is not None or (missing and is_null(node)))
    words = "a number or null" if missing else "a number"
    for node in wrong:
        number(document, node, f"a value in {what}", words)
    return None if wrong else np.array([np.nan if is_null(node) else as_number(node) for node in nodes], dtype=float)


def _wrong(nodes: list[Node], right) -> list[Node]:
    return [node for node in nodes if not right(node)][:_MOST_SHOWN]


def plain_numbers(nodes: list[Node]) -> np.ndarray | None:
    """All values at once, when each is plainly a number: the way of nearly every list, four times quicker."""
    try:
        if "".join([node.value for node in nodes]).strip(_DIGITS):
            return None
        values = np.array([float(node.value) for node in nodes])
    except (TypeError, ValueError):
        return None
    values[np.abs(values) >= LARGEST] *= np.inf
    return None if any(node.tag != PLAIN for node in nodes) else values

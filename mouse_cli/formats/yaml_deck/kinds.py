"""Kinds of values in a YAML deck, and what a key and a section are made of."""

from dataclasses import dataclass
from typing import Any

from mouse_cli.model.geometry import DIRECTIONS

VERSION = 1
MAX_WHOLE = 2**31 - 1

PERCENT = r"^\s*[0-9]*\.?[0-9]+([eE][-+]?[0-9]+)?\s*%\s*$"
RANGE = r"^\s*(all|[0-9]+(\s*-\s*[0-9]+)?(\s*,\s*[0-9]+(\s*-\s*[0-9]+)?)*)\s*$"
_NUMBER = {"type": "number"}
_WHOLE = {"type": "integer"}
_PERCENT = {"type": "string", "pattern": PERCENT}
_MAYBE = {"type": ["number", "null"]}
_NAME = {"type": ["string", "number"]}


def _list(*items: dict[str, Any], **limits: int) -> dict[str, Any]:
    """JSON Schema of a list; several `items` are those of a list of fixed length."""
    if len(items) == 1:
        return {"type": "array", "items": items[0], **limits}
    return {"type": "array", "prefixItems": list(items), "items": False, "minItems": len(items)}


def _each(section: str) -> dict[str, Any]:
    """JSON Schema of sections by sensor: names or sections in a mapping, or sections in a list."""
    below = {"$ref": f"#/$defs/{section}"}
    named = {"type": "object", "additionalProperties": {"anyOf": [_NAME, below]}, "minProperties": 1}
    return {"anyOf": [named, _list(below, minItems=1)]}


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of value: as messages call it, and as JSON Schema checks it."""

    words: str
    schema: dict[str, Any]


_FILE = {"$ref": "#/$defs/file"}
_RANGE = {"anyOf": [_WHOLE, {"type": "string", "pattern": RANGE}]}
_IDS = {"anyOf": [_RANGE, _list(_RANGE, minItems=1)]}
_DIRECTIONS = _list({"enum": list(DIRECTIONS)}, minItems=1)
_VECTOR = _list(_NUMBER, minItems=2, maxItems=3)
_INLINE_NODES = {"type": "object", "minProperties": 1, "additionalProperties": _VECTOR}
_POINTS = {"type": "object", "additionalProperties": {"anyOf": [_NAME, _list(_NAME, minItems=1)]}, "minProperties": 1}
_POSITIONS = {"anyOf": [_INLINE_NODES, {"$ref": "#/$defs/node_block"}]}
KINDS = {
    "text": Kind("text", _NAME),
    "flag": Kind("true or false", {"type": "boolean"}),
    "choice": Kind("one of a few words", {}),
    "whole": Kind("a whole number", _WHOLE),
    "number": Kind("a number", _NUMBER),
    "sd": Kind("a number or a percentage such as 5 %", {"anyOf": [_NUMBER, _PERCENT]}),
    "accuracy": Kind(
        "a number, a percentage such as 5 %, or a list of both, [5 %, 0.001]",
        {"anyOf": [_NUMBER, _PERCENT, _list({"anyOf": [_NUMBER, _PERCENT]}, minItems=2, maxItems=2)]},
    ),
    "texts": Kind("a list of names", _list(_NAME)),
    "numbers": Kind("a list of numbers", _list(_NUMBER, minItems=1)),
    "wholes": Kind("a list of whole numbers", _list(_WHOLE)),
    "maybes": Kind("a list of numbers, null where not measured", _list(_MAYBE, minItems=1)),
    "dofs": Kind("a list of degrees of freedom, by number from 1 or by label", _list(_NAME)),
    "sensor direction": Kind(
        "TX, TY, TZ, RX, RY or RZ, with - before it when reversed, or [x, y, z]",
        {"anyOf": [{"type": "string", "pattern": "^[-+]?[TR][XYZ]$"}, _list(_NUMBER, minItems=3, maxItems=3)]},
    ),
    "sensor weights": Kind(
        "a mapping of degrees of freedom to numbers",
        {"type": "object", "additionalProperties": _NUMBER, "minProperties": 1},
    ),
    "square": Kind("a list of rows of numbers", _list(_list(_NUMBER, minItems=1), minItems=1)),
    "pairs": Kind("a list of [row, column]", _list(_list(_WHOLE, _WHOLE))),
    "triples": Kind("a list of [row, column, value]", _list(_list(_WHOLE, _WHOLE, _NUMBER))),
    "triples or file": Kind(
        "a list of [row, column, value], or {file: name}",
        {"anyOf": [_list(_list(_WHOLE, _WHOLE, _NUMBER)), _FILE]},
    ),
    "links": Kind("a list of [parameter, parameter, correlation]", _list(_list(_NAME, _NAME, _NUMBER))),
    "power": Kind("[parameter, exponent], such as [thickness, 3]", _list(_NAME, _NUMBER)),
    "sds": Kind(
        "a number, a percentage such as 2 %, or a list of numbers",
        {"anyOf": [_NUMBER, _PERCENT, _list(_MAYBE)]},
    ),
    "grid": Kind(
        "a list of rows of numbers (null where not measured), or {file: name}",
        {"anyOf": [_list(_list(_MAYBE)), _FILE]},
    ),
    "sd grid": Kind(
        "a number, a percentage such as 2 %, a list of rows of numbers, or {file: name}",
        {"anyOf": [_NUMBER, _PERCENT, _list(_list(_MAYBE)), _FILE]},
    ),
    "flag or dofs": Kind(
        "true, false or {dofs: [...]}",
        {"anyOf": [{"type": "boolean"}, {"$ref": "#/$defs/total_mass"}]},
    ),
    "path": Kind("the name of a file", {"type": "string", "minLength": 1}),
    "word or words": Kind("a word or a list of words", {"anyOf": [_NAME, _list(_NAME)]}),
    "direction": Kind("a list of TX, TY, TZ, RX, RY, RZ", _DIRECTIONS),
    "ids": Kind("a number, a range such as 1-58, or a list of these", _IDS),
    "chain": Kind(
        "nodes as a range such as 1-59 or a list; or a list of the nodes of each element, [[1, 2], [2, 3]]",
        {"anyOf": [_IDS, _list(_list(_WHOLE, minItems=1), minItems=1)]},
    ),
    "vector": Kind("[x, y, z], or [x, y] with z = 0", _VECTOR),
    "two vectors": Kind("two vectors, [[x, y, z], [x, y, z]]", _list(_VECTOR, minItems=2, maxItems=2)),
    "end vectors": Kind("{end: [x, y, z], ...}", {"type": "object", "additionalProperties": _VECTOR}),
    "end directions": Kind("{end: directions, ...}", {"type": "object", "additionalProperties": _DIRECTIONS}),
    "positions": Kind(
        "{node: [x, y, z], ...}, {line: ...} or {file: ...}, or a list of these",
        {"anyOf": [_POSITIONS, _list(_POSITIONS, minItems=1)]},
    ),
    "supports": Kind(
        "{node: directions, ...}; nodes also as a range such as 1-5, or all",
        {"type": "object", "additionalProperties": {"anyOf": [_DIRECTIONS, {"const": "all"}]}},
    ),
    "span": Kind("[first, last]", _list(_WHOLE, minItems=2, maxItems=2)),
    "pairs of numbers": Kind("a list of [lowest, highest]", _list(_list(_NUMBER, minItems=2, maxItems=2), minItems=1)),
    "pair": Kind("[lowest, highest]", _list(_NUMBER, minItems=2, maxItems=2)),
    "text or numbers": Kind("a name, or a list of numbers", {"anyOf": [_NAME, _list(_MAYBE, minItems=1)]}),
    "text or texts": Kind(
        "a name, or a list of numbers such as 0.1+0.2j", {"anyOf": [_NAME, _list(_NAME, minItems=1)]}
    ),
    "channels": Kind("{sensor: channel, ...}, or a list of channels that name their sensors", _each("channel")),
    "functions": Kind("{sensor: channel, ...}, or a list of functions that name their sensors", _each("function")),
    "renames": Kind(
        "{sensor: name in the file, ...}", {"type": "object", "additionalProperties": _NAME, "minProperties": 1}
    ),
    "point": Kind(
        "a degree of freedom, or {substructure: degree of freedom}",
        {"anyOf": [_NAME, {"type": "object", "additionalProperties": _NAME, "minProperties": 1, "maxProperties": 1}]},
    ),
    "points": Kind("{substructure: degrees of freedom, ...}", _POINTS),
    "joined": Kind("a list of {substructure: degrees of freedom, substructure: degrees of freedom}", _list(_POINTS)),
    "expectations": Kind(
        "{what: value, ...}, such as {status: converged, posterior k1: 83699 +- 20}",
        {"type": "object", "additionalProperties": {"anyOf": [_NAME, _list(_NAME, minItems=1)]}},
    ),
    "value or values": Kind(
        "a number, or a list of one number for each element", {"anyOf": [_NUMBER, _list(_NUMBER, minItems=1)]}
    ),
}


@dataclass(frozen=True, slots=True)
class Key:
    """One key: kind of value (of KINDS, `section NAME`, `list NAME` or `map NAME`), meaning, default, unit, limits."""

    kind: str
    meaning: str
    default: str = ""
    unit: str = ""
    required: bool = False
    choices: tuple[Any, ...] = ()
    low: float | None = None
    high: float | None = None


@dataclass(frozen=True, slots=True)
class Section:
    """A mapping: its keys; `forms`, sets of keys of which exactly one is given.

    needs: sets of keys of which at least one is given as a whole. variants: names of the sections that it may be, told by `type`.
    """

    meaning: str
    keys: dict[str, Key]
    forms: tuple[tuple[str, ...], ...] = ()
    needs: tuple[tuple[str, ...], ...] = ()
    variants: tuple[str, ...] = ()

"""YAML scalars and flow lists as text: each number reads back exactly, in YAML 1.1 and 1.2."""

import re
from collections.abc import Iterable

import numpy as np

_PLAIN = re.compile(r"[A-Za-z][A-Za-z0-9_./()*^-]*( [A-Za-z0-9_./()*^=+,-]+)*", re.ASCII)
_RESERVED = frozenset(["true", "false", "yes", "no", "on", "off", "null", "y", "n"])
_WIDTH = 110


def real(value: float) -> str:
    """The shortest decimal that reads back as `value`, with a point, also in exponent form: `2.5e+05`."""
    if np.isnan(value):
        return ".nan"
    if np.isinf(value):
        return ".inf" if value > 0 else "-.inf"
    plain = repr(float(value))
    power = np.format_float_scientific(value, unique=True, trim="0", exp_digits=2)
    return plain if "e" not in plain and len(plain) <= len(power) else power


def maybe(value: float) -> str:
    """A measured number, or null where there is none."""
    return "null" if np.isnan(value) else real(value)


def word(text: str, flow: bool = True) -> str:
    """Text, in quotes unless it is plainly a word; inside brackets (`flow`) a comma needs them too."""
    plain = _PLAIN.fullmatch(text) and text.lower() not in _RESERVED and not (flow and "," in text)
    return text if plain else '"' + "".join(map(_escaped, text)) + '"'


def _escaped(character: str) -> str:
    if character in '"\\':
        return "\\" + character
    if character.isprintable():
        return character
    code = ord(character)
    if 0xD800 <= code < 0xE000:  # half a pair, e.g. from a file name, is no character
        return "?"
    return f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"


def flow(items: Iterable[str]) -> str:
    """A list on one line."""
    return f"[{', '.join(items)}]"


def wrapped(items: Iterable[str], indent: int) -> str:
    """A list, broken into lines of readable length when it is long; `indent` is that of its key."""
    items = list(items)
    whole = flow(items)
    if indent + len(whole) <= _WIDTH:
        return whole
    margin = " " * (indent + 2)
    lines, line = [], margin
    for item in items:
        if len(line) + len(item) + 2 > _WIDTH and line.strip():
            lines.append(line.rstrip())
            line = margin
        line += item + ", "
    return "[\n" + "\n".join([*lines, line.rstrip(", ")]) + "\n" + " " * indent + "]"

"""Damage: what is done to the bytes, lines, words, numbers and keys of an input."""

import json
import random
import re
from collections.abc import Callable

import yaml

_NUMBER = re.compile(rb"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_WORD = re.compile(rb"[A-Za-z_][A-Za-z_0-9-]*")
NUMBERS = ("0 -1 1 2 7 99999999 2147483648 9223372036854775808 1e308 -1e308 1e200 1e150 1e-150 1e-308 5e-324 1e30 1e-30 "
           "-1e30 1e9 0.5 -0.0 1e999 nan inf -inf .nan .inf 1+2j 5% 0x10 1_000 1e5").split()  # fmt: skip
TOKENS = [
    *(
        b"[ ] { } : , &a *a !!int !!binary | > ' \" - # ? <<: null ~ .inf .nan 1e999 -1 0 5% \t \x00 \xff \r \n --- ..."
    ).split(b" "),
    *(
        b"[[]]",
        b"[]",
        b"{}",
        b"{file: x.mtx}",
        b"{file: .}",
        b"9" * 30,
        b"a" * 5000,
        "€é\u202e".encode(),
        b"::error::x",
    ),
]
VALUES = (None, True, False, 0, -1, 3, 1.5, 1e308, -1e-308, 10**30, float("nan"), float("inf"), "", "x", "1", "5 %", "1TX", "../x",
          "::", [], {}, [[]], [1], [1, 2, 3], [None], {"file": "x.csv"}, {"a": 1}, ["x"] * 3, "\u202e€")  # fmt: skip


def damaged(rng: random.Random, name: str, raw: bytes, others: list[bytes]) -> bytes:
    """A file with up to four kinds of damage; others: files to take pieces from."""
    for _ in range(rng.choice((0, 1, 1, 1, 1, 2, 4))):
        raw = rng.choice(_kinds(name))(rng, raw, others) or b"x"
    return raw


def _kinds(name: str) -> list[Callable]:
    plain = [_bytes, _token, _cut, _number, _number, *[_near] * 6]
    if name.endswith((".npz", ".npy", ".mat", ".h5", ".wav", ".tdms")) or "binary" in name:
        return [_bytes, _bytes, _cut, _integer, _splice]
    if name.endswith((".yaml", ".json")):
        return [*plain, _line, _word, _tree, _tree, _tree, _tree, _splice]
    if name.endswith(".dat"):
        return [*plain, _line, _line, _card, _card, _splice]
    return [*plain, _line, _line, _word, _splice]


def _bytes(rng: random.Random, raw: bytes, others: list[bytes]) -> bytes:
    found = bytearray(raw or b"x")
    for _ in range(rng.randint(1, 4)):
        found[rng.randrange(len(found))] = rng.randrange(256)
    return bytes(found)


def _token(rng: random.Random, raw: bytes, others: list[bytes]) -> bytes:
    at = rng.randrange(len(raw) + 1)
    return raw[:at] + rng.choice(TOKENS) + raw[at + rng.choice((0, 0, 1, 7)) :]


def _cut(rng: random.Random, raw: bytes, others: list[bytes]) -> bytes:
    at, length = rng.randrange(len(raw) + 1), rng.choice((1, 12, 200, len(raw)))
    return raw[:at] + raw[at + length :]


def _integer(rng: random.Random, raw: bytes, others: list[bytes]) -> bytes:
    """A number of 2, 4 or 8 bytes at its ends."""
    size = rng.choice((2, 4, 8))
    value = rng.choice((0, 1, 255, 2 ** (8 * size - 1) - 1, 2 ** (8 * size - 1), 2 ** (8 * size) - 1))
    at = rng.randrange(len(raw) + 1)
    return raw[:at] + value.to_bytes(size, rng.choice(("little", "big"))) + raw[at + size :]


def _number(rng: random.Random, raw: bytes, others: list[bytes]) -> bytes:
    found = list(_NUMBER.finditer(raw[:200_000]))
    if not found:
        return _token(rng, raw, others)
    for one in sorted(rng.sample(found, min(len(found), rng.choice((1, 1, 1, 3)))), key=lambda m: -m.start()):
        new = rng.choice(NUMBERS).encode()
        if rng.random() < 0.3:
            new = (b"-" + one[0], one[0] + b"0", one[0] + b"e3", b"", one[0] + b" " + one[0])[rng.randrange(5)]
        raw = raw[: one.start()] + new + raw[one.end() :]
    return raw


def _near(rng: random.Random, raw: bytes, others: list[bytes]) -> bytes:
    """Numbers as they might be: some digits or an exponent off, of the same length where columns count."""
    found = [one for one in _NUMBER.finditer(raw[:200_000]) if len(one[0]) > 1] or list(_NUMBER.finditer(raw[:200_000]))
    if not found:
        return _token(rng, raw, others)
    for one in sorted(rng.sample(found, min(len(found), rng.choice((1, 2, 8)))), key=lambda m: -m.start()):
        digits = bytearray(one[0])
        at = rng.choice([k for k, digit in enumerate(digits) if chr(digit).isdigit()])
        digits[at] = ord(rng.choice("0123456789"))
        raw = raw[: one.start()] + bytes(digits) + raw[one.end() :]
    return raw


def _word(rng: random.Random, raw: bytes, others: list[bytes]) -> bytes:
    """A word in the place of another of the same file, or of another file."""
    found = list(_WORD.finditer(raw[:200_000]))
    given = _WORD.findall(rng.choice([raw, *others])[:20_000])
    if not found or not given:
        return _token(rng, raw, others)
    one = rng.choice(found)
    return raw[: one.start()] + rng.choice(given) + raw[one.end() :]


def _line(rng: random.Random, raw: bytes, others: list[bytes]) -> bytes:
    lines = raw.split(b"\n")
    i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
    kind = rng.randrange(6)
    if kind == 0:
        del lines[i]
    elif kind == 1:
        lines[i], lines[j] = lines[j], lines[i]
    elif kind == 2:
        lines[i:i] = [lines[j]] * rng.choice((1, 1, 30))
    elif kind == 3:
        lines[i] = b" " * rng.randrange(8) + lines[i].lstrip()
    elif kind == 4:
        return rng.choice((b"\r\n", b"\r", b"\n\n")).join(lines)
    else:
        del lines[i : i + rng.randint(2, 20)]
    return b"\n".join(lines)


def _card(rng: random.Random, raw: bytes, others: list[bytes]) -> bytes:
    """A field of a card, in its columns, or the card moved by some."""
    lines = raw.split(b"\n")
    i, width = rng.randrange(len(lines)), rng.choice((4, 8, 16, 20))
    at = width * rng.randrange(80 // width)
    new = rng.choice((*NUMBERS, "")).encode()[:width]
    new = rng.choice((new.rjust(width), new.ljust(width)))
    moved = b" " * rng.randint(1, 3) + lines[i]
    lines[i] = moved if rng.random() < 0.2 else lines[i].ljust(80)[:at] + new + lines[i].ljust(80)[at + width :]
    return b"\n".join(lines)


def _splice(rng: random.Random, raw: bytes, others: list[bytes]) -> bytes:
    other = rng.choice([raw, *others])
    i, j = rng.randrange(len(other) + 1), rng.randrange(len(raw) + 1)
    return raw[:j] + other[i : i + rng.choice((8, 80, 800))] + raw[j + rng.choice((0, 80)) :]


def _tree(rng: random.Random, raw: bytes, others: list[bytes]) -> bytes:
    """Keys and entries of the document taken away, doubled, moved, or of another type."""
    tree, dump = _parsed(raw)
    spots = list(_spots(tree)) if tree is not None else []
    if not spots:
        return _line(rng, raw, others)
    for _ in range(rng.choice((1, 1, 2))):
        _struck(rng, tree, rng.choice(spots))
    return dump(tree).encode(errors="replace")


def _parsed(raw: bytes) -> tuple[object, Callable]:
    text = raw.decode(errors="replace")
    try:
        return json.loads(text), json.dumps
    except (ValueError, RecursionError):
        pass
    try:
        return yaml.load(text, _Loader), lambda tree: yaml.safe_dump(
            tree, sort_keys=False, default_flow_style=None, width=120
        )
    except (yaml.YAMLError, ValueError, RecursionError, TypeError):
        return None, str


class _Loader(yaml.SafeLoader):
    """YAML whose numbers may be written 1e5."""


_Loader.add_implicit_resolver(
    "tag:yaml.org,2002:float", re.compile(r"^[-+]?\d+(\.\d*)?[eE][-+]?\d+$"), list("-+0123456789")
)


def _spots(tree: object):
    """Every place of a tree: what holds it, and its key there."""
    if isinstance(tree, dict | list):
        for key in list(tree) if isinstance(tree, dict) else range(len(tree)):
            yield tree, key
            yield from _spots(tree[key])


def _struck(rng: random.Random, tree: object, spot: tuple) -> None:
    holder, key = spot
    if key not in (holder if isinstance(holder, dict) else range(len(holder))):
        return
    value, kind = holder[key], rng.randrange(6)
    if kind == 0:
        del holder[key]
    elif kind == 1:
        holder[key] = rng.choice(VALUES)
    elif kind == 2:
        holder[key] = [value] if rng.random() < 0.5 else {"a": value}
    elif kind == 3 and isinstance(holder, list):
        holder[key:key] = [value] * rng.choice((1, 1, 2, 40))
    elif kind == 3:
        holder[rng.choice(list(holder))] = value
    elif kind == 4:
        other, name = rng.choice(list(_spots(tree)))
        if not _holds(value, other):
            other[name] = value
    elif isinstance(value, int | float):
        holder[key] = rng.choice(
            (-value, value * 1e3, value * 1e-12, value * 1e12, 0, 1e308, 1e-308, int(1e8), str(value))
        )
    else:
        holder[key] = rng.choice(VALUES)


def _holds(value: object, other: object) -> bool:
    return value is other or any(_holds(part, other) for part in (value.values() if isinstance(value, dict) else value)) if (
        isinstance(value, dict | list)
    ) else False  # fmt: skip

"""Damaged files of every format: an answer, or diagnostics that name the file; never another exception, a warning or a hang.

`MOUSE_FUZZ=2000` reads so many damaged files of each sample, others at each run.
"""

import os
import random
import re
import warnings
import zipfile
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
import samples
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from mouse_cli._errors import MouseError, frame
from mouse_cli._registry import discover

LONG = int(os.environ.get("MOUSE_FUZZ", "0"))
SETTINGS = settings(
    max_examples=LONG or 40, derandomize=not LONG, deadline=None, database=None, suppress_health_check=list(HealthCheck),
    phases=[Phase.explicit, Phase.generate],  # a seed says all, and does not get simpler by being smaller
)  # fmt: skip
CASES = [
    *((package, name) for package, formats in samples.FILES.items() for each in formats.values() for name in each),
    *(("others", name) for name in samples.OTHERS),
]
SLOW = {"couple.yaml": 4, "modify.yaml": 4, "result.json": 2}  # as many times fewer
NUMBER = re.compile(rb"[-+]?[0-9]+(?:\.[0-9]*)?(?:[eEdD][-+]?[0-9]+)?")
WORDS = (
    b"nan", b"inf", b"-inf", b"1e400", b"-1e400", b"-0", b"0", b"-1", b"9" * 20, b"9" * 5000, b"1e-320", b"", b"x", b"1_0", b"2.5",
    b"\xc2\xb2",
)  # fmt: skip
_BINARY: dict[str, tuple[float, ...]] = {
    "<u4": (0, 1, 2**31 - 1, 2**31, 2**32 - 1),
    ">u4": (1, 2**31, 2**32 - 1),
    "<u8": (2**40, 2**63, 2**64 - 1),
    "<u2": (0, 65535),
    "<f8": (np.nan, np.inf, 1e308, -0.0),
    ">f8": (np.nan,),
    "<f4": (np.nan, np.inf),
}
BINARY = [np.array([value], kind).tobytes() for kind, values in _BINARY.items() for value in values]
ENDS = (b"\r\n", b"\r", b"\n\n", b"\x0b", b"\x85", b"")


def test_every_format_has_a_sample():
    """Who adds a format adds a sound file of it to `samples.py`: what is not fuzzed falls to the first damaged file."""
    for package, formats in samples.FILES.items():
        assert set(discover(f"mouse_cli.formats.{package}", "FORMAT")) == set(formats)
    folders = {
        path.parent.name for path in Path(samples.__file__).parents[2].glob("mouse_cli/formats/*_files/__init__.py")
    }
    assert folders == set(samples.FILES)


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("samples")
    samples.beside(folder)
    return folder


def case(package: str, name: str) -> tuple[object, object]:
    """What writes a sample, and what reads it."""
    if package == "others":
        return samples.OTHERS[name]
    written = next(each[name] for each in samples.FILES[package].values() if name in each)
    return written, samples.READERS[package]


@pytest.mark.parametrize(("package", "name"), CASES)
@pytest.mark.usefixtures("no_hang")
def test_damage(package, name, folder, capfd):
    written, read = case(package, name)
    path = folder / f"{package}_{name}"
    samples.write(path, written)
    raw = path.read_bytes()
    read(str(path))  # a sound one

    @settings(SETTINGS, max_examples=max(1, SETTINGS.max_examples // SLOW.get(name, 1)))
    @given(st.integers(0, 2**64 - 1))
    def damaged(seed):
        path.write_bytes(damage(raw, random.Random(seed)))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            try:
                read(str(path))
            except MouseError as error:
                told(error, str(path))

    damaged()
    assert capfd.readouterr() == ("", "")


def told(error: MouseError, path: str) -> None:
    """Diagnostics that can be shown, the first of which names the file."""
    assert error.diagnostics
    for each in error.diagnostics:
        assert re.fullmatch(r"MD\d{3}", each.code) and each.message and frame(each)
        assert len(each.headline) < 3000
    first = error.diagnostics[0]
    assert error.exit_code == 5 or path in f"{first.span} {first.message} {first.note}", first.headline


def damage(raw: bytes, rng: random.Random) -> bytes:
    """`raw` after one to four accidents; those within a zip archive happen to what is packed, half of the time."""
    if raw[:4] == b"PK\x03\x04" and rng.random() < 0.5:
        return repacked(raw, rng)
    for _ in range(rng.choice((1, 1, 2, 4))):
        raw = rng.choice(ACCIDENTS)(raw, rng)
    return raw


def repacked(raw: bytes, rng: random.Random) -> bytes:
    """The archive with damaged members."""
    found = BytesIO()
    with zipfile.ZipFile(BytesIO(raw)) as old, zipfile.ZipFile(found, "w", zipfile.ZIP_DEFLATED) as new:
        members = old.infolist()
        hit = rng.randrange(len(members))
        for i, member in enumerate(members):
            data = old.read(member)
            new.writestr(member.filename, damage(data, rng) if i == hit else data)
    return found.getvalue()


def flip(raw: bytes, rng: random.Random) -> bytes:
    changed = bytearray(raw or b"x")
    for _ in range(rng.choice((1, 2, 8))):
        changed[rng.randrange(len(changed))] ^= 1 << rng.randrange(8)
    return bytes(changed)


def flip_head(raw: bytes, rng: random.Random) -> bytes:
    """Where most of what is promised stands."""
    return flip(raw[:300], rng) + raw[300:]


def cut(raw: bytes, rng: random.Random) -> bytes:
    return raw[: rng.randrange(len(raw) + 1)]


def hole(raw: bytes, rng: random.Random) -> bytes:
    at = rng.randrange(len(raw) + 1)
    return raw[:at] + raw[at + rng.choice((1, 4, 8, 80, 500)) :]


def insert(raw: bytes, rng: random.Random) -> bytes:
    at = rng.randrange(len(raw) + 1)
    return raw[:at] + rng.randbytes(rng.choice((1, 3, 8, 100))) + raw[at:]


def doubled(raw: bytes, rng: random.Random) -> bytes:
    at, count = rng.randrange(len(raw) + 1), rng.choice((1, 8, 80, 500))
    return raw[: at + count] + raw[at : at + count] * rng.choice((1, 1, 50)) + raw[at + count :]


def swapped(raw: bytes, rng: random.Random) -> bytes:
    a, b, c, d = sorted(rng.randrange(len(raw) + 1) for _ in range(4))
    return raw[:a] + raw[c:d] + raw[b:c] + raw[a:b] + raw[d:]


def lines(raw: bytes, rng: random.Random) -> bytes:
    """Lines lost, doubled, swapped, shifted."""
    found = raw.split(b"\n")
    i, j = rng.randrange(len(found)), rng.randrange(len(found))
    how = rng.randrange(4)
    if how == 0:
        del found[i]
    elif how == 1:
        found.insert(i, found[j])
    elif how == 2:
        found[i], found[j] = found[j], found[i]
    else:
        found[i] = b" " * rng.randrange(1, 9) + found[i]
    return b"\n".join(found)


def numbers(raw: bytes, rng: random.Random) -> bytes:
    """A number as text, or four or eight bytes that may be one, replaced by what no number should be."""
    found = list(NUMBER.finditer(raw))
    if found and rng.random() < 0.7:
        one = rng.choice(found)
        return raw[: one.start()] + rng.choice(WORDS) + raw[one.end() :]
    word = rng.choice(BINARY)
    at = rng.randrange(len(raw) + 1) // 4 * 4
    return raw[:at] + word + raw[at + len(word) :]


def encoded(raw: bytes, rng: random.Random) -> bytes:
    """Other encodings and line ends."""
    how = rng.randrange(6)
    if how == 0:
        return raw.decode("latin-1").encode(rng.choice(("utf-16", "utf-16-be", "utf-32")))
    if how == 1:
        return b"\xef\xbb\xbf" * rng.choice((1, 2)) + raw
    if how == 2:
        return raw.replace(b"\n", rng.choice(ENDS))
    if how == 3:
        return raw.replace(b" ", rng.choice((b"\0", b"\t", b"\xa0", b"\xc2\xa0")), rng.choice((1, -1)))
    if how == 4:
        return rng.choice((b"", b"\0", b"\n", b" ", b"-1\n")) * rng.choice((1, 300))
    return rng.randbytes(rng.choice((1, 50, 2000)))


ACCIDENTS = (flip, flip, flip_head, cut, hole, insert, doubled, swapped, lines, numbers, numbers, numbers, encoded)

"""Decks, and a seal on their truths: SHA-256 of a salt and the truths as JSON, which are made again when answers are opened."""

import hashlib
import json
import secrets
from dataclasses import dataclass
from pathlib import Path

from benchmarks.trials.draw import Trial, trials
from benchmarks.trials.test_data import section

EDITION = 4  # raised whenever a seed gives other truths than before
SEAL, DECKS = "seal.txt", "decks"


class BrokenSeal(RuntimeError):
    """Truths, decks or seed are not those that were sealed."""


@dataclass(frozen=True)
class Seal:
    """What seal.txt says. seed: None where it was withheld; truths, decks: SHA-256."""

    edition: int
    seed: int | None
    cases: int
    kinds: list[str]
    salt: str
    truths: str
    decks: str

    def text(self) -> str:
        """One `key: value` a line, as JSON."""
        return "".join(f"{key}: {json.dumps(value)}\n" for key, value in vars(self).items())


def seal(folder: Path, seed: int, cases: int, kinds: list[str], secret: bool = False) -> Seal:
    """Decks and seal.txt in `folder`, which must not have them yet; `secret`: the seed is not written down."""
    if (folder / SEAL).exists():
        raise BrokenSeal(f"{folder / SEAL} exists: choose another folder")
    (folder / DECKS).mkdir(parents=True, exist_ok=True)
    salt, made = secrets.token_hex(16), list(trials(seed, cases, kinds))
    for name, one in sorted(named(made, salt).items()):
        write(folder / DECKS, name, one)
    truths = truths_hash(named(made, salt), salt)
    found = Seal(EDITION, None if secret else seed, cases, kinds, salt, truths, decks_hash(folder))
    (folder / SEAL).write_text(found.text())
    return found


def read(folder: Path) -> Seal:
    """The seal of a folder whose decks are as they were sealed."""
    lines = (line.partition(": ") for line in (folder / SEAL).read_text().splitlines())
    found = Seal(**{key: json.loads(value) for key, _, value in lines})
    if decks_hash(folder) != found.decks:
        raise BrokenSeal(f"the decks in {folder / DECKS} are not those that were sealed")
    return found


def opened(folder: Path, seed: int | None = None) -> dict[str, Trial]:
    """The trials of a folder by the names of their decks, made again and checked against the seal."""
    found = read(folder)
    if found.edition != EDITION:
        raise BrokenSeal(f"sealed by edition {found.edition} of the generator, this is {EDITION}")
    seed = found.seed if seed is None else seed
    if seed is None:
        raise BrokenSeal("the seed was withheld from the seal: give it with --seed")
    made = named(list(trials(seed, found.cases, found.kinds)), found.salt)
    if truths_hash(made, found.salt) != found.truths:
        raise BrokenSeal("the truths made from this seed are not those that were sealed")
    return made


def named(made: list[Trial], salt: str) -> dict[str, Trial]:
    """Trials by names that say nothing, neither of the kind nor of the order."""
    return {hashlib.sha256(f"{salt} {i}".encode()).hexdigest()[:10]: one for i, one in enumerate(made)}


def write(folder: Path, name: str, one: Trial) -> Path:
    """A deck, and the files that it refers to."""
    path = folder / f"{name}.yaml"
    for end, text in one.blank.files.items():
        (folder / f"{name}-{end}").write_text(text)
    model = one.blank.model.replace("NAME-", f"{name}-")
    path.write_text(f"mouse: 1\ntitle: {name}\n\n{model}\n{section(one.blank, one.test)}")
    return path


def truths_hash(made: dict[str, Trial], salt: str) -> str:
    """SHA-256 of the salt and of all truths, sorted by name."""
    text = json.dumps({name: one.truth() for name, one in made.items()}, sort_keys=True)
    return hashlib.sha256(f"{salt}\n{text}".encode()).hexdigest()


def decks_hash(folder: Path) -> str:
    """SHA-256 of names and contents of all files of the decks."""
    whole = hashlib.sha256()
    for path in sorted((folder / DECKS).iterdir()):
        whole.update(path.name.encode() + b"\0" + hashlib.sha256(path.read_bytes()).digest())
    return whole.hexdigest()

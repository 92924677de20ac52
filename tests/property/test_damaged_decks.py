"""Three thousand damaged decks, cards and YAML, through one `mouse check`: an answer for each, never a traceback or a hang."""

import random
import re
import subprocess
import sys
import warnings
from pathlib import Path

import pytest
from proofs import proofs

from mouse_cli import report
from mouse_cli._errors import MouseError
from mouse_cli.formats import read_deck
from mouse_cli.updating import run

DECKS = Path(__file__).resolve().parents[2] / "decks"
SOURCES = sorted([*DECKS.glob("*.dat"), *DECKS.glob("*.yaml")])
COUNT = 3000


def damaged(data: bytes, rng: random.Random) -> bytes:
    """`data` after one to twenty accidents: bytes changed, cut, typed in; lines lost, doubled, swapped."""
    deck = bytearray(data)
    for _ in range(rng.choice([1, 1, 2, 5, 20])):
        at, accident = rng.randrange(max(len(deck), 1)), rng.randrange(7)
        lines = deck.split(b"\n")
        i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
        if accident == 0:
            deck[at : at + 1] = bytes([rng.randrange(256)])
        elif accident == 1:
            del deck[at : at + rng.randrange(1, 100)]
        elif accident == 2:
            deck[at:at] = bytes(rng.choice(b" 0123456789.-+EeD,\t\n{}[]:") for _ in range(rng.randrange(1, 10)))
        elif accident == 3:
            deck[at : at + 1] = bytes([rng.choice(b"0123456789")])
        else:
            if accident == 4:
                del lines[i]
            elif accident == 5:
                lines.insert(i, lines[j])
            else:
                lines[i], lines[j] = lines[j], lines[i]
            deck = bytearray(b"\n".join(lines))
    return bytes(deck)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The damaged decks, the same at every run."""
    rng, folder = random.Random(1972), tmp_path_factory.mktemp("damaged")
    for i in range(COUNT):
        source = rng.choice(SOURCES)
        (folder / f"{i:04d}{source.suffix}").write_bytes(damaged(source.read_bytes(), rng))
    return folder


EVERY = pytest.mark.parametrize("every", proofs([5, 1], 5))


@EVERY
def test_check_answers_for_each(folder, every):
    decks = sorted(folder.iterdir())[::every]
    command = [sys.executable, "-m", "mouse_cli", "check", *map(str, decks)]
    done = subprocess.run(command, capture_output=True, timeout=600)
    assert done.returncode in (0, 4)
    assert b"Traceback" not in done.stderr
    counted = re.fullmatch(rb"(\d+) decks checked: (\d+) sound, (\d+) rejected, \d+ with warnings\n", done.stdout)
    checked, sound, rejected = (int(n) for n in counted.groups())
    assert checked == len(decks) == sound + rejected
    assert min(sound, rejected) > 50  # the damage is neither trivial nor total


@EVERY
def test_whatever_passes_the_check_runs_to_an_end(folder, every):
    """Decks that are still legal, with whatever numbers, end in a status or a diagnostic, and can be printed."""
    ended = 0
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for path in sorted(folder.iterdir())[::every]:
            try:
                result = run(read_deck(path))
            except MouseError as error:
                assert error.diagnostics
                continue
            assert report.printout(result) and report.document(result)
            ended += 1
    assert ended > 50

"""Decks and recordings are data: what they can make mouse read, and how much of the machine they can take."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from mouse_cli.cli.main import _run

DECKS = Path(__file__).resolve().parents[2] / "decks"
DECK = """\
mouse: 1
model: {{stiffness: {{order: 1, entries: [[1, 1, 100]]}}, mass: {{file: {name}}}}}
parameters: [{{name: k, sd: 10, stiffness: [[1, 1, 1]]}}]
test: {{modes: {{frequency: [1.6], frequency_sd: 0.01}}}}
"""
FUNCTIONS = "mouse: 1\nmodel: {{stiffness: {{diagonal: [1]}}, mass: {{identity: 1}}}}\ntest: {{recordings: [{{file: {name}, sample_rate: 10, outputs: {{1: 1}}}}]}}\n"
COUPLED = "mouse: 1\ncouple: {{substructures: {{a: {{deck: {name}}}}}, connections: [{{mass: 1, at: {{a: 1}}}}], modes: {{count: 1}}}}\n"
MODIFIED = "mouse: 1\nmodify: {{deck: {name}, changes: [{{mass: 1, at: 1}}]}}\n"
MANIFEST = "mouse: 1\nbatch: [{{decks: {name}}}]\n"
SOUND = DECK.format(name="m.mtx").replace("{file: m.mtx}", "{diagonal: [1]}")
MASS = "%%MatrixMarket matrix coordinate real symmetric\n1 1 1\n1 1 1.0\n"
# What each command reads, and a sound file of the kind that its deck names.
READERS = {
    "run": (DECK, "m.mtx", MASS),
    "check": (DECK, "m.mtx", MASS),
    "show": (DECK, "m.mtx", MASS),
    "convert": (DECK, "m.mtx", MASS),
    "modes": (DECK, "m.mtx", MASS),
    "correlate": (DECK, "m.mtx", MASS),
    "compare": (DECK, "m.mtx", MASS),
    "diagnose": (DECK, "m.mtx", MASS),
    "batch": (DECK, "m.mtx", MASS),
    "spectra": (FUNCTIONS, "r.csv", "1\n2\n4\n3\n"),
    "identify": (FUNCTIONS, "r.csv", "1\n2\n4\n3\n"),
    "couple": (COUPLED, "part.yaml", SOUND),
    "modify": (MODIFIED, "part.yaml", SOUND),
    "manifest": (MANIFEST, "part.yaml", SOUND),
}
posix = pytest.mark.skipif(os.name != "posix", reason="links and pipes are made as POSIX makes them")


def mouse(capfd, *arguments: object) -> tuple[int, str]:
    """Exit code, and all that was printed."""
    status = _run([str(each) for each in arguments])
    return status, "".join(capfd.readouterr())


@pytest.fixture
def place(tmp_path, monkeypatch, no_hang):
    """A folder for decks, a sibling of files that they must not read."""
    for name in ("decks", "decks/sub", "secret"):
        (tmp_path / name).mkdir()
    monkeypatch.chdir(tmp_path)
    return tmp_path


def asked(reader: str, place: Path, name: str) -> list[object]:
    """Arguments by which a command meets a deck that names the file `name`."""
    (place / "decks" / "deck.yaml").write_text(READERS[reader][0].format(name=json.dumps(name)))
    command = {"manifest": "batch"}.get(reader, reader)
    options = {"batch": ["-j", 1, "-o", place / "answers"], "convert": ["-o", place / "decks" / "new.yaml"]}.get(
        command, []
    )
    return [command, place / "decks" / "deck.yaml", *options]


def ways_out(place: Path, file: str, content: str) -> dict[str, str]:
    """Names of a file in a folder beside that of the decks."""
    (place / "secret" / file).write_text(content)
    (place / "decks" / f"link_{file}").symlink_to(place / "secret" / file)
    (place / "decks" / "elsewhere").symlink_to(place / "secret")
    return {
        "up": f"../secret/{file}",
        "down and up": f"sub/../../secret/{file}",
        "absolute": str(place / "secret" / file),
        "link": f"link_{file}",
        "linked folder": f"elsewhere/{file}",
    }


@posix
@pytest.mark.parametrize("reader", READERS)
def test_no_name_leads_out_of_the_folder(reader, place, capfd):
    _, file, content = READERS[reader]
    for name in ways_out(place, file, content).values():
        status, out = mouse(capfd, *asked(reader, place, name))
        assert status == 4 and "MD231" in out, (name, out)
        assert reader == "batch" or "--allow-outside" in out


@posix
@pytest.mark.parametrize("reader", READERS)
def test_unless_it_is_allowed(reader, place, capfd):
    _, file, content = READERS[reader]
    for name in ways_out(place, file, content).values():
        status, out = mouse(capfd, *asked(reader, place, name), "--allow-outside")
        assert status in (0, 1, 5) or reader in ("spectra", "identify"), (name, out)
        assert "MD231" not in out and "MD250" not in out, (name, out)


@posix
@pytest.mark.parametrize("reader", READERS)
def test_pipes_folders_and_devices_are_not_read(reader, place, capfd):
    suffix = os.path.splitext(READERS[reader][1])[1]
    os.mkfifo(place / "decks" / f"pipe{suffix}")
    (place / "decks" / f"folder{suffix}").mkdir()
    for name in (f"pipe{suffix}", f"folder{suffix}"):
        for allowed in ((), ("--allow-outside",)):
            if reader == "manifest" and name.startswith("folder"):
                continue  # a folder of decks
            status, out = mouse(capfd, *asked(reader, place, name), *allowed)
            assert status == 4 and "MD250" in out, out
    for name in ("/dev/zero", "/etc/passwd", "/proc/self/environ"):
        status, out = mouse(capfd, *asked(reader, place, name))
        assert status == 4 and "MD231" in out and "root:" not in out
    status, out = mouse(capfd, *asked(reader, place, "/dev/zero"), "--allow-outside")
    assert status == 4 and "MD250" in out


@posix
def test_folders_are_searched_within(place, capfd):
    """Decks found in a folder: a link out of it is refused, a pipe is not waited for."""
    (place / "secret" / "s.yaml").write_text("password: hunter2\n")
    (place / "decks" / "good.yaml").write_text(SOUND)
    (place / "decks" / "link.yaml").symlink_to(place / "secret" / "s.yaml")
    os.mkfifo(place / "decks" / "pipe.yaml")
    status, out = mouse(capfd, "check", "decks")
    assert status == 4 and "3 decks checked: 1 sound, 2 rejected" in out and "hunter2" not in out
    status, out = mouse(capfd, "batch", "-j", 1, "decks")
    assert status == 4 and out.count("MD231") == out.count("MD250") == 1 and "hunter2" not in out
    (place / "decks" / "pipe.yaml").unlink()
    (place / "decks" / "link.yaml").unlink()
    (place / "decks" / "link.yaml").symlink_to("good.yaml")
    assert mouse(capfd, "check", "decks")[0] == 0


@posix
def test_manifests_do_not_search_outside(place, capfd):
    for name in ("/**/*.yaml", "../**", "..", "sub/../../*", "elsewhere/*.yaml", ""):
        ways_out(place, "part.yaml", SOUND) if not (place / "decks" / "elsewhere").exists() else None
        status, out = mouse(capfd, *asked("manifest", place, name))
        assert status == 4 and "MD231" in out, (name, out)


@posix
def test_answers_depend_on_files_outside_where_they_are_allowed(place, capfd):
    """A batch resumes: a mass that changed outside of the folder is an answer that is sought again."""
    (place / "secret" / "m.mtx").write_text(MASS)
    arguments = asked("batch", place, "../secret/m.mtx")
    assert mouse(capfd, *arguments)[0] == 4
    first = mouse(capfd, *arguments, "--allow-outside")
    assert first[0] in (0, 1) and "done before" not in first[1]
    assert "1 done before" in mouse(capfd, *arguments, "--allow-outside")[1]
    (place / "secret" / "m.mtx").write_text(MASS.replace("1.0", "1.1"))
    assert "done before" not in mouse(capfd, *arguments, "--allow-outside")[1]
    assert mouse(capfd, *arguments)[0] == 4


def test_no_deck_names_what_is_written(place, capfd):
    """Titles, labels and names of parameters find no way into the names of files."""
    shutil.copy(DECKS / "plate_calculix.yaml", place / "decks" / "deck.yaml")
    shutil.copytree(DECKS / "plate_calculix", place / "decks" / "plate_calculix")
    text = (place / "decks" / "deck.yaml").read_text()
    hostile = text.replace("name: ", "name: ../../up/", 1).replace("title: ", "title: ../../", 1)
    assert hostile.count("../../") == 2
    (place / "decks" / "deck.yaml").write_text(hostile)
    (place / "out").mkdir()
    before = {path for path in place.rglob("*") if "out" not in path.parts}
    mouse(capfd, "convert", "decks/deck.yaml", "-o", "out/new.yaml")
    assert {path for path in place.rglob("*") if "out" not in path.parts} == before
    assert len(list((place / "out").iterdir())) > 1

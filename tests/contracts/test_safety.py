"""Decks and recordings are data: what they can make mouse read, and how much of the machine they can take."""

import json
import os
import shutil
import subprocess
import sys
import warnings
from pathlib import Path

import hostile
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
FUNCTIONS = """\
mouse: 1
model: {{stiffness: {{diagonal: [1]}}, mass: {{identity: 1}}}}
test: {{recordings: [{{file: {name}, sample_rate: 10, outputs: {{1: 1}}}}]}}
"""
COUPLED = """\
mouse: 1
couple: {{substructures: {{a: {{deck: {name}}}}}, connections: [{{mass: 1, at: {{a: 1}}}}], modes: {{count: 1}}}}
"""
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


def ways(reader: str, *given: object) -> list[str]:
    """All of them; of batches, which start processes each time, a name that leads up and a link."""
    found = ways_out(*given)
    return [found["up"], found["link"]] if reader == "batch" else list(found.values())


@posix
@pytest.mark.parametrize("reader", READERS)
def test_no_name_leads_out_of_the_folder(reader, place, capfd):
    _, file, content = READERS[reader]
    for name in ways(reader, place, file, content):
        status, out = mouse(capfd, *asked(reader, place, name))
        assert status == 4 and "MD231" in out, (name, out)
        assert reader == "batch" or "--allow-outside" in out


@posix
@pytest.mark.parametrize("reader", READERS)
def test_unless_it_is_allowed(reader, place, capfd):
    _, file, content = READERS[reader]
    for name in ways(reader, place, file, content):
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


MEMORY = 1_200_000_000  # bytes of address space: Python with NumPy, SciPy and h5py, and not much more
# Reads the files it is told of under limits, each with its own time, and says what came of them.
READER = """
import json, resource, signal, sys
resource.setrlimit(resource.RLIMIT_AS, ({memory}, {memory}))
sys.path[:0] = {path}
from mouse_cli._errors import MouseError
from mouse_cli.batch.decks import is_manifest
from mouse_cli.formats import read_deck
from mouse_cli.formats.matrix_files import read_matrix
from mouse_cli.formats.recording_files import read_contents
from mouse_cli.formats.yaml_deck import coupled

def late(*_):
    raise SystemExit("no answer within 20 s of " + name)

signal.signal(signal.SIGALRM, late)
kind, *names = sys.argv[1:]
read = {{"matrices": read_matrix, "recordings": read_contents, "decks": read_deck}}[kind]
for name in names:
    signal.alarm(20)
    try:
        read(name)
        found = []
    except MouseError as error:
        found = [[d.code, str(d.span), d.message, d.help] for d in error.diagnostics]
    signal.alarm(0)
    print(json.dumps([name, found]))
"""
# Those that are sound in the end: a number beyond all numbers; a segment that a logger never ended.
ANSWERED = {"cell.csv", "units.csv", "values.tdms"}


@posix
@pytest.mark.parametrize("kind", ["matrices", "recordings", "decks"])
def test_promises_are_refused_before_they_are_believed(kind, tmp_path):
    """In little time and memory: a diagnostic that names the file, and says what to do."""
    pytest.importorskip("h5py")
    pytest.importorskip("nptdms")
    files = getattr(hostile, kind.upper())
    for name, content in files.items():
        hostile.write(tmp_path / name, content)
    script = READER.format(memory=MEMORY, path=[path for path in sys.path if path])
    paths = [str(tmp_path / name) for name in files]
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run(
        [sys.executable, "-c", script, kind, *paths],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env=environment,
        timeout=300,
    )
    assert done.returncode == 0 and not done.stderr, done.stderr[-2000:]
    answers = dict(map(json.loads, done.stdout.splitlines()))
    assert set(answers) == set(paths)
    for path, found in answers.items():
        if os.path.basename(path) in ANSWERED:
            continue
        assert found and all(
            code.startswith("MD") and message and span.startswith(path) for code, span, message, _ in found
        ), path
        assert any(help for *_, help in found), path
    assert not (tmp_path / "pwned").exists()


def test_what_matlab_writes_is_let_through():
    """Files by MATLAB 5 to 7.4 itself, which SciPy is tested with: whatever it reads is not refused before."""
    import scipy.io.matlab

    from mouse_cli.formats.matrix_files.matlab_elements import checked

    files = sorted((Path(scipy.io.matlab.__file__).parent / "tests" / "data").glob("*.mat"))
    if not files:
        pytest.skip("this SciPy brings no files of its tests")
    read = 0
    for path in files:
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                scipy.io.loadmat(path)
        except Exception:  # damaged on purpose, or of version 7.3
            continue
        checked(str(path))
        read += 1
    assert read > 80


@pytest.mark.parametrize("how", ["link", "link by link", "virtual", "external"])
def test_data_sets_lie_in_the_file_that_is_read(how, tmp_path, monkeypatch):
    """An HDF5 file beside the deck must not read another file, by whatever HDF5 has for that."""
    h5py = pytest.importorskip("h5py")
    from mouse_cli._errors import DeckError
    from mouse_cli.formats.matrix_files import read_matrix
    from mouse_cli.formats.recording_files import read_contents

    monkeypatch.chdir(tmp_path)
    with h5py.File("secret.h5", "w") as file:
        file["K"] = np.eye(2)
    Path("secret.bin").write_bytes(np.eye(2).tobytes())
    hostile.hdf5(tmp_path / "k.h5", how)
    with h5py.File("k.h5") as file:
        assert np.array_equal(file["K"][()], np.eye(2))  # h5py itself follows it
    with pytest.raises(DeckError, match=r"MD252.*another file"):
        read_matrix("k.h5", variable="K")
    with pytest.raises(DeckError, match=r"MD252.*another file|MD601"):
        read_contents("k.h5")


def test_links_within_a_file_are_followed(tmp_path):
    h5py = pytest.importorskip("h5py")
    from mouse_cli.formats.matrix_files import read_matrix

    with h5py.File(tmp_path / "k.h5", "w") as file:
        file["model/K"] = np.eye(2)
        file["near"], file["K"] = h5py.SoftLink("/model"), h5py.SoftLink("near/K")
    assert np.array_equal(read_matrix(str(tmp_path / "k.h5"), variable="K"), np.eye(2))


HOSTILE = "\x1b]0;owned\x07\x1b[2J\u202egnp\u2066"
NAMED = """\
mouse: 1
title: "T\\e[2J\\u202e"
model: {stiffness: {order: 1, entries: [[1, 1, 100]]}, mass: {diagonal: [1]}, labels: ["L\\e[31m\\u202e"]}
parameters: [{name: "k\\e]0;owned\\a\\u2066", sd: 10, stiffness: [[1, 1, 1]]}]
test: {modes: {frequency: [1.6], frequency_sd: 0.01}}
"""


@pytest.mark.parametrize("command", ["run", "run --markdown", "run --json", "show", "modes", "diagnose", "check"])
def test_names_do_not_command_the_terminal(command, tmp_path, capfd):
    """Escape sequences and marks that turn the writing round stand in names; they are shown, not obeyed."""
    (tmp_path / "deck.yaml").write_text(NAMED)
    name, *options = command.split()
    status, out = mouse(capfd, name, tmp_path / "deck.yaml", *options)
    assert status in (0, 1) and out
    assert not set(out) & {"\x1b", "\x07", "\u202e", "\u2066"}


def test_findings_do_not_command_the_terminal(tmp_path, capfd):
    """Excerpts of lines, names of files and of channels, words that were read."""
    (tmp_path / "deck.yaml").write_text(f"mouse: 1\ntitle: {HOSTILE[14:]}\nmodel: x\n", "utf-8")
    (tmp_path / "cards.dat").write_text(f"TITLE\n{HOSTILE}\n")
    (tmp_path / "r.csv").write_text(f"t,{HOSTILE}\n1,2\n2,x{HOSTILE}\n")
    (tmp_path / "g.csv").write_text(f"t,{HOSTILE},b\n1,2,3\n2,3,1\n3,5,4\n4,5,2\n")
    (tmp_path / "names.yaml").write_text('mouse: 1\n"a\\e[2J\\nb": 1\nmodel: {stiffness: {order: "\\e[2J\\u202e"}}\n')
    for arguments in (
        ["check", tmp_path / "deck.yaml"],
        ["check", "--brief", tmp_path / "names.yaml"],
        ["show", tmp_path / "cards.dat"],
        ["spectra", tmp_path / "r.csv", "--force", "1"],
        ["spectra", tmp_path / "g.csv", "--force", "2", "--sample-rate", "1", "--lines", "2"],
        ["spectra", tmp_path / f"no{HOSTILE[1:]}.csv"],
        ["run", tmp_path / f"no{HOSTILE}.yaml"],
    ):
        _, out = mouse(capfd, *arguments)
        assert out and not set(out) & {"\x1b", "\x07", "\u202e", "\u2066"}, arguments


@posix
def test_progress_does_not_command_the_terminal(monkeypatch, capfd):
    from mouse_cli.cli._terminal import progress

    monkeypatch.setattr("sys.stderr.isatty", lambda: True, raising=False)
    with progress() as (_, say):
        say(f"mode of {HOSTILE}")
    told = capfd.readouterr().err.replace("\r\x1b[K", "")
    assert "mode of" in told and not set(told) & {"\x1b", "\u202e"}


def test_every_table_of_csv_goes_through_one_cell():
    """No module but that one writes CSV: a name that begins with = would be computed by a spreadsheet."""
    package = Path(__file__).resolve().parents[2] / "mouse_cli"
    writers = {str(path.relative_to(package)) for path in package.rglob("*.py") if "csv.writer" in path.read_text()}
    assert writers == {"_texts.py"}


def test_every_command_that_reads_decks_may_be_allowed_outside():
    """What takes a deck, a source or a manifest by name has the one option; results and topics name no files."""
    from mouse_cli import _registry
    from mouse_cli.cli.main import cli

    for name in _registry.names("mouse_cli.cli.commands"):
        command = cli.get_command(None, name)
        reads = any(
            each.param_type_name == "argument" and each.name in ("deck", "decks", "job", "source", "sources")
            for each in command.params
        )
        assert reads == any("--allow-outside" in each.opts for each in command.params), name

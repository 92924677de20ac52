"""The command line as a user meets it: exit codes, streams, files written whole or not at all."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from click.testing import CliRunner

from mouse_cli.cli.main import _run, cli

DECKS = Path(__file__).resolve().parents[2] / "decks"
SOUND, FALSE_FORM = str(DECKS / "sound_chain.yaml"), str(DECKS / "ground_spring.yaml")
CARDS = str(DECKS / "table_5_2.dat")
ENVIRONMENT = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}


def mouse(*arguments: str, stdin: str | None = None) -> subprocess.CompletedProcess:
    """`mouse` as a process of its own."""
    command = [sys.executable, "-m", "mouse_cli", *arguments]
    return subprocess.run(command, input=stdin, capture_output=True, text=True, env=ENVIRONMENT, timeout=120)


def code(capsys, *arguments: str) -> tuple[int, str, str]:
    """Exit code, standard output and standard error of `mouse` in this process."""
    status = _run(list(arguments))
    captured = capsys.readouterr()
    return status, captured.out, captured.err


@pytest.mark.parametrize(
    ("arguments", "status"),
    [
        (("run", SOUND), 0),
        (("run", FALSE_FORM), 1),
        (("run", CARDS), 0),
        (("run", str(DECKS / "table_5_3.yaml")), 1),
        (("run", str(DECKS / "table_5_3.yaml"), "--recursion", "anchored"), 0),
        (("run", SOUND, "--estimator", "nonsense"), 2),
        (("run",), 2),
        (("rum", SOUND), 2),
        (("run", "no-such-deck.yaml"), 4),
        (("run", str(DECKS / "single_frequency.yaml"), "--estimator", "least-squares"), 5),
        (("check", SOUND, CARDS), 0),
        (("modes", SOUND), 0),
        (("show", CARDS), 0),
        (("explain", "MD104"), 0),
        (("explain", "MD999"), 2),
        (("list",), 0),
        (("completion", "zsh"), 0),
    ],
)
def test_exit_codes(capsys, arguments, status):
    assert code(capsys, *arguments)[0] == status


def test_json_keeps_the_contract(capsys):
    status, out, _ = code(capsys, "run", FALSE_FORM, "--json")
    answer = json.loads(out)
    assert status == answer["exit_code"] == 1
    assert answer["schema"] == "mouse.result/1" and answer["model_form"] == "rejected"
    contract = (
        "title status recursion estimator cycles parameters covariance stiffness mass modes exceedances confidence"
    )
    assert set(contract.split()) | {"innovation", "warnings", "version"} <= set(answer)
    assert set(answer["cycles"][0]) >= {"theta", "chi2", "exceedances", "allowed"}
    assert set(answer["parameters"][0]) >= {"name", "prior", "prior_sd", "posterior", "posterior_sd"}
    assert set(answer["modes"][0]) >= {"mode", "test_hz", "prior_hz", "revised_hz", "sd_hz", "mac"}
    assert set(answer["innovation"]) == {"chi2", "dof", "p"}


def test_every_option_that_changes_a_number_is_echoed(capsys):
    options = ["--recursion", "replaced", "--scale", "unit", "--confidence", "90", "--partials", "7", "--passes", "2"]
    options += ["--convergence", "fraction", "--step", "second-order", "--limit-sd", "2.5", "--pairing", "number"]
    _, printout, _ = code(capsys, "run", SOUND, *options, "--full")
    _, out, _ = code(capsys, "run", SOUND, *options, "--json")
    echoed = json.loads(out)["options"]
    for name, value in zip(options[::2], options[1::2], strict=True):
        key = name.removeprefix("--").replace("-", "_")
        assert str(echoed[key]) == value
        assert value in printout


def test_standard_input_and_output():
    done = mouse("run", "-", "--json", stdin=Path(SOUND).read_text())
    assert done.returncode == 0 and done.stderr == "" and json.loads(done.stdout)["status"] == "converged"
    cards = mouse("convert", "-", stdin=Path(CARDS).read_text())
    assert cards.returncode == 0 and cards.stdout.startswith("mouse: 1")
    again = mouse("run", "-", "--json", "--scale", "none", "--cycles", "2", stdin=cards.stdout)
    assert f"{json.loads(again.stdout)['stiffness'][0][0]:.5e}" == "2.25103e+05"  # Table 5-2


def test_a_bad_deck_leaves_what_stood_there(tmp_path):
    bad, output = tmp_path / "bad.yaml", tmp_path / "answer.json"
    bad.write_text(Path(SOUND).read_text().replace("sd: 150.0", "sd: -150.0", 1))
    output.write_text("what stood there before")
    done = mouse("run", str(bad), "--json", "-o", str(output))
    assert done.returncode == 4 and output.read_text() == "what stood there before"
    assert "error[MD311]" in done.stderr and "-150" in done.stderr and "^" in done.stderr
    assert sorted(p.name for p in tmp_path.iterdir()) == ["answer.json", "bad.yaml"]


def test_an_output_that_cannot_be_written_is_said(tmp_path):
    done = mouse("run", SOUND, "-o", str(tmp_path / "no" / "such" / "folder.txt"))
    assert done.returncode == 5 and "error[MD290]" in done.stderr and "Traceback" not in done.stderr


def _until_it_has_computed(pid: int, seconds: float) -> None:
    """Wait until a process has had so much processor time, however busy the machine is; so long where that cannot be read."""
    stat = Path(f"/proc/{pid}/stat")
    if not stat.exists():
        time.sleep(seconds)
        return
    tick = os.sysconf("SC_CLK_TCK")
    while sum(map(int, stat.read_text().rpartition(")")[2].split()[11:13])) / tick < seconds:
        time.sleep(0.05)


def test_interruption_leaves_nothing_half_written(tmp_path):
    """Ctrl-C while a run of many cycles goes on."""
    output = tmp_path / "answer.json"
    arguments = ["run", str(DECKS / "beam_58.yaml"), "--cycles", "2000000", "--json", "-o", str(output)]
    listening = lambda: signal.signal(signal.SIGINT, signal.SIG_DFL)  # shells start jobs in the background deaf to it
    command = [sys.executable, "-m", "mouse_cli", *arguments]
    process = subprocess.Popen(command, env=ENVIRONMENT, stderr=subprocess.PIPE, preexec_fn=listening)
    _until_it_has_computed(process.pid, 2.0)
    process.send_signal(signal.SIGINT)
    _, stderr = process.communicate(timeout=120)
    assert process.returncode == 130 and b"interrupted" in stderr and b"Traceback" not in stderr
    assert list(tmp_path.iterdir()) == []


def test_no_colour_and_no_progress_off_a_terminal(tmp_path):
    bad = tmp_path / "bad.dat"
    bad.write_text("")
    done = mouse("check", str(bad))
    assert "\033" not in done.stdout + done.stderr and done.returncode == 4


def test_check_counts_and_goes_on(tmp_path, capsys):
    (tmp_path / "a.dat").write_text(Path(CARDS).read_text())
    (tmp_path / "b.dat").write_text("nonsense")
    (tmp_path / "c.yaml").write_text(Path(SOUND).read_text())
    status, out, err = code(capsys, "check", str(tmp_path))
    assert status == 4 and out == "3 decks checked: 2 sound, 1 rejected, 0 with warnings\n"
    assert "b.dat" in err and "a.dat" not in err


def test_rigid_body_mode_named_as_measured(tmp_path, capsys):
    deck = tmp_path / "rigid.yaml"
    deck.write_text((DECKS / "rigid_body.yaml").read_text().replace("number: [2, 3]", "number: [1, 2]"))
    for command in ("check", "run"):
        status, _, err = code(capsys, command, str(deck))
        assert status == 4 and "MD330" in err


def test_stacked_cases(tmp_path, capsys):
    stack = tmp_path / "stack.dat"
    stack.write_text(Path(CARDS).read_text() + (DECKS / "single_frequency.dat").read_text())
    assert code(capsys, "run", str(stack))[0] == 4
    status, out, _ = code(capsys, "run", str(stack), "--stacked", "--json")
    titles = [case["title"] for case in json.loads(out)["cases"]]
    assert status == 0 and len(titles) == 2 and titles[1].startswith("ONE FREQUENCY")


def test_sequence_numbers_can_be_stripped(tmp_path, capsys):
    deck = tmp_path / "numbered.dat"
    short = (DECKS / "single_frequency.dat").read_text().splitlines()
    deck.write_text("".join(f"{line:80}"[:72] + f"{10 * k:08d}\n" for k, line in enumerate(short, 1)))
    status, _, err = code(capsys, "check", str(deck))
    assert status == 4 and "MD105" in err
    status, _, err = code(capsys, "check", str(deck), "--strip-73-80", "--set", "NPARD=5")
    assert "MD105" not in err


def test_completion_knows_the_commands():
    environment = {"_MOUSE_COMPLETE": "bash_complete", "COMP_WORDS": "mouse c", "COMP_CWORD": "1"}
    shown = CliRunner().invoke(cli, [], env=environment, prog_name="mouse").output
    assert {"check", "completion", "convert"} <= {line.partition(",")[2] for line in shown.splitlines()}


def altered(tmp_path: Path, deck: str, *changes: tuple[str, str]) -> str:
    """A copy of `deck` with texts replaced."""
    text = Path(deck).read_text()
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    copy = tmp_path / Path(deck).name
    copy.write_text(text)
    return str(copy)


def test_an_unknown_estimator_is_a_fault_of_the_deck(tmp_path, capsys):
    deck = altered(tmp_path, SOUND, ("recursion: anchored", "estimator: bays"))
    line = 1 + Path(deck).read_text()[: Path(deck).read_text().index("bays")].count("\n")
    for command in ("check", "run"):
        status, _, err = code(capsys, command, deck)
        assert status == 4 and f"{deck}:{line}:" in err and "error[MD334]" in err and "maximum-likelihood" in err


@pytest.mark.parametrize("key", ["partials: 0", "passes: 0"])
def test_no_cycles_at_all_is_refused(tmp_path, capsys, key):
    deck = altered(tmp_path, SOUND, ("recursion: anchored", f"recursion: anchored, {key}"))
    assert code(capsys, "check", deck)[0] == 4


def test_what_the_eigensolution_shows_has_a_place(tmp_path, capsys):
    deck = altered(tmp_path, str(DECKS / "rigid_body.yaml"), ("number: [2, 3]", "number: [1, 3]"))
    row = Path(deck).read_text().splitlines().index("    number: [1, 3]") + 1
    assert f"{deck}:{row}:14: error[MD330]" in code(capsys, "check", deck)[2]
    negative = altered(tmp_path, str(DECKS / "table_5_2.dat"), ("  1  1       250000.", "  1  1      -250000."))
    status, _, err = code(capsys, "check", negative)
    assert status == 4 and f"{negative}:2:1: error[MD501]" in err


def test_options_that_cannot_act_are_refused(tmp_path, capsys):
    assert code(capsys, "run", SOUND, "--set", "NPARD=4")[0] == 2
    assert code(capsys, "run", SOUND, "--limit-sd", "nan")[0] == 2
    deck = altered(tmp_path, SOUND)
    before = Path(deck).read_text()
    assert code(capsys, "run", deck, "-o", deck)[0] == 2 and Path(deck).read_text() == before


def test_stacked_decks_can_be_checked(tmp_path, capsys):
    stack = tmp_path / "stack.dat"
    stack.write_text(Path(CARDS).read_text() * 2)
    assert code(capsys, "check", str(stack))[0] == 4
    assert code(capsys, "check", "--stacked", str(stack))[0] == 0


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="the system has no /dev/full")
@pytest.mark.parametrize("arguments", [("run", CARDS), ("list",)])
def test_a_full_disk_behind_standard_output_is_said(arguments):
    with open("/dev/full", "w") as full:
        command = [sys.executable, "-m", "mouse_cli", *arguments]
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, env=ENVIRONMENT, timeout=60)
    assert done.returncode == 5 and b"MD290" in done.stderr and b"Traceback" not in done.stderr


@pytest.mark.parametrize("target", ["toy_plugin", "toy_plugin:ABSENT", "no_such_module:ESTIMATOR"])
def test_a_plugin_that_cannot_be_used_is_named(tmp_path, target):
    (tmp_path / "toy_plugin.py").write_text("")
    told = tmp_path / "toy-1.0.dist-info"
    told.mkdir()
    (told / "METADATA").write_text("Metadata-Version: 2.1\nName: toy\nVersion: 1.0\n")
    (told / "entry_points.txt").write_text(f"[mouse_cli.estimators]\ntoy = {target}\n")
    command = [sys.executable, "-m", "mouse_cli", "list", "estimators"]
    paths = os.pathsep.join([str(tmp_path), str(DECKS.parent)])
    done = subprocess.run(command, capture_output=True, text=True, env={**ENVIRONMENT, "PYTHONPATH": paths}, timeout=60)
    assert done.returncode == 5 and "MD511" in done.stderr and target in done.stderr


def test_a_third_party_estimator_serves(tmp_path):
    (tmp_path / "toy_plugin.py").write_text(
        "from dataclasses import replace\n"
        "from mouse_cli.estimators.bayes import ESTIMATOR as BAYES\n"
        "ESTIMATOR = replace(BAYES, key='toy', title='Toy')\n"
    )
    told = tmp_path / "toy-1.0.dist-info"
    told.mkdir()
    (told / "METADATA").write_text("Metadata-Version: 2.1\nName: toy\nVersion: 1.0\n")
    (told / "entry_points.txt").write_text("[mouse_cli.estimators]\ntoy = toy_plugin:ESTIMATOR\n")
    command = [sys.executable, "-m", "mouse_cli", "run", SOUND, "--estimator", "toy", "--json"]
    paths = os.pathsep.join([str(tmp_path), str(DECKS.parent)])
    done = subprocess.run(command, capture_output=True, text=True, env={**ENVIRONMENT, "PYTHONPATH": paths}, timeout=60)
    assert done.returncode == 0 and json.loads(done.stdout)["estimator"] == "toy"


def test_correlate_answers_in_every_form(capsys):
    for form in ([], ["--markdown"], ["--numbers", "legacy"]):
        status, out, _ = code(capsys, "correlate", CARDS, "-q", *form)
        assert (
            status == 0
            and "MAC" in out
            and max(map(len, out.splitlines())) <= (10**6 if form == ["--markdown"] else 132)
        )
    status, out, _ = code(capsys, "correlate", SOUND, "--json", "--expand", "least-squares", "--exact")
    assert status == 0 and json.loads(out)["expansion"]["exact"] is True


@pytest.mark.parametrize(
    ("arguments", "status"),
    [
        (("--expand", "nonsense"), 2),
        (("--exact",), 2),
        (("--expand", "serep", "--exact"), 2),
        (("--expand", "serep"), 0),
    ],
)
def test_correlate_refuses_what_cannot_act(capsys, arguments, status):
    assert code(capsys, "correlate", SOUND, "-q", *arguments)[0] == status


def test_correlate_needs_a_test(tmp_path, capsys):
    deck = tmp_path / "plan.yaml"
    deck.write_text("mouse: 1\nmodel: {stiffness: {dense: [[2, -1], [-1, 1]]}, mass: {identity: 2}}\n")
    status, _, err = code(capsys, "correlate", str(deck))
    assert status == 4 and "MD333" in err


RECORDED = "t,hammer (N),acc (g)\n" + "\n".join(
    f"{i / 100:.2f},{i * 7919 % 101 / 50 - 1},{i * 104729 % 103 / 50 - 1}" for i in range(600)
)


@pytest.mark.parametrize(
    ("arguments", "status", "told"),
    [
        (("--force", "hammer", "--lines", "20", "-o", "frf.npz"), 0, "independent averages"),
        (("--force", "hammer", "--lines", "20", "--json"), 0, "mouse.spectra/1"),
        (
            ("--force", "hammer", "--lines", "20", "--period", "101", "--markdown", "--full"),
            0,
            "over periods of 101 samples",
        ),
        (("--force", "hammer", "--lines", "4000"), 4, "MD620"),
        (("--force", "hammer", "--period", "50"), 4, "does not repeat itself after 50 samples"),
        (("--force", "nothing"), 4, "MD600"),
        (("--response", "acc"), 4, "MD618"),
        ((), 4, "MD600"),
        (("--force", "hammer", "--unit", "hammer=g"), 4, "MD610"),
        (("--force", "hammer", "--unit", "hammer"), 2, "CHANNEL=UNIT"),
        (("--force", "hammer", "--window", "nonsense"), 2, "nonsense"),
        (("--force", "hammer", "--recording", "a"), 2, "--recording"),
        (("--force", "hammer", "--lines", "20", "-o", "frf.xls"), 5, "MD290"),
        (("--force", "hammer", "--lines", "20", "-o", "no/such/folder/frf.npz"), 5, "MD290"),
    ],
)
def test_spectra(capsys, tmp_path, monkeypatch, arguments, status, told):
    monkeypatch.chdir(tmp_path)
    Path("run.csv").write_text(RECORDED)
    found, out, err = code(capsys, "spectra", "run.csv", *arguments)
    assert (found, told in out + err) == (status, True), out + err
    assert Path("frf.npz").exists() == ("frf.npz" in arguments)

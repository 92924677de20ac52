"""The fuzzer: some inputs of every command, again as often as one likes, and what it counts as a fault."""

import os
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))
if not hasattr(os, "fork"):
    pytest.skip("forks its inputs", allow_module_level=True)
from benchmarks.fuzz import __main__ as fuzz
from benchmarks.fuzz import play
from benchmarks.fuzz.commands import COMMANDS
from mouse_cli import _registry

QUICK = "check,show,convert,modes,correlate,run,couple,modify,spectra,identify,report,prior,explain,list"


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    return fuzz.seeds(tmp_path_factory.mktemp("seeds"))


def test_no_faults_and_nothing_twice(tmp_path, capfd):
    asked = ["--commands", QUICK, "--seed", "5", "--out", str(tmp_path)]
    assert fuzz.main([*asked, "--inputs", "2"]) == 0, capfd.readouterr().out
    log = next(tmp_path.glob("log-*"))
    before = log.read_text()
    assert fuzz.main([*asked, "--inputs", "3"]) == 0, capfd.readouterr().out
    assert log.read_text().startswith(before)
    assert len(log.read_text().splitlines()) == sum(3 if COMMANDS[name].cost == 1 else 1 for name in QUICK.split(","))


def test_one_after_another_is_as_alone(tmp_path, sound):
    """Inputs in one child end as each in a child of its own; the one that writes elsewhere ends the chain."""
    jobs = [("check", 3), ("modify", 0), ("explain", 1), ("list", 0)]
    make = lambda job, folder: fuzz.made(*job, 1, sound, folder)
    together = [one.exit for one in play.chained(jobs, make, play.Limits())]
    alone = []
    for number, job in enumerate(jobs):
        (tmp_path / str(number)).mkdir()
        words = make(job, tmp_path / str(number))
        alone.append(play.play(words, tmp_path / str(number), play.Limits()).exit)
    assert together == alone


def test_a_fault_ends_the_chain(tmp_path, monkeypatch):
    does = {"a": lambda: 0, "b": lambda: [][1], "c": lambda: 0}
    monkeypatch.setattr("mouse_cli.cli.main._run", lambda arguments: does[arguments[0]]())
    assert len(list(play.chained(["a", "b", "c"], lambda job, folder: [job], play.Limits()))) == 1


def test_an_input_is_the_same_again(tmp_path, sound):
    found = []
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        words = fuzz.made("run", 7, 1, sound, tmp_path / name)
        found.append((words, {path.name: path.read_bytes() for path in (tmp_path / name / "in").iterdir()}))
    assert found[0] == found[1]


def test_every_command_is_asked():
    assert set(_registry.names("mouse_cli.cli.commands")) <= {*COMMANDS, "completion"}


@pytest.mark.parametrize(
    "fault, does",
    [
        ("traceback", lambda arguments: [][1]),
        ("outside", lambda arguments: Path("beside").write_text("x") and 0),
        ("memory", lambda arguments: len(bytearray(300 * 2**20)) * 0),
        ("slow", lambda arguments: sum(k * k for k in range(10**9))),
        ("silent", lambda arguments: 4),
        ("document", lambda arguments: print('{"a": NaN}') or 0),
        ("", lambda arguments: Path("out/x").write_text("x") * 0),
    ],
)
def test_what_counts(tmp_path, monkeypatch, fault, does):
    monkeypatch.setattr("mouse_cli.cli.main._run", does)
    outcome = play.play(["run", "--json"] if fault == "document" else ["run"], tmp_path, play.Limits(cpu=1, memory=200))
    assert outcome.fault == fault

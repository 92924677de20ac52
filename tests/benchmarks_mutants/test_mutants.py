"""The benchmark of mutants: one is killed, one that changes nothing is alive, and every fault still has its place."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))
from benchmarks.mutants import __main__ as mutants
from benchmarks.mutants.__main__ import MUTANTS
from benchmarks.mutants.faults import Mutant

TEST = ("tests/reference/test_noise.py::test_more_than_all_degrees_of_freedom_is_none",)


def test_one_is_killed(capsys):
    assert mutants.main(["noise-negative-dof"]) == 0
    assert "killed noise-negative-dof" in capsys.readouterr().out


def test_one_that_changes_nothing_is_alive(monkeypatch, capsys):
    monkeypatch.setattr(
        mutants, "MUTANTS", (Mutant("same", "diagnosis/noise.py", "RATE = 6.0", "RATE = 12.0 / 2", TEST),)
    )
    assert mutants.main(["--unchecked"]) == 1
    assert "ALIVE" in capsys.readouterr().out


def test_tests_that_do_not_run_kill_nothing(monkeypatch):
    monkeypatch.setattr(mutants, "MUTANTS", (Mutant("broken", "diagnosis/noise.py", "RATE = 6.0", "RATE = (", TEST),))
    with pytest.raises(SystemExit, match="did not run"):
        mutants.main(["--unchecked"])


@pytest.mark.parametrize("one", MUTANTS, ids=lambda one: one.name)
def test_every_fault_has_its_place_and_its_tests(one):
    """Its text stands once in its file, and its tests are there."""
    assert (mutants.ROOT / "mouse_cli" / one.file).read_text().count(one.old) == 1 and one.old != one.new
    for test in one.tests:
        path, name = test.split("[")[0].split("::")
        assert f"def {name}(" in (mutants.ROOT / path).read_text()


def test_names_are_apart():
    assert len({one.name for one in MUTANTS}) == len(MUTANTS)

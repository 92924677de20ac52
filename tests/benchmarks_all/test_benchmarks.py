"""Every benchmark runs at its smallest size: figures are taken by hand, but never from a file that does not run."""

from pathlib import Path

import pytest

from benchmarks.__main__ import SMALL, main, ran

FOLDER = Path(__file__).parents[2] / "benchmarks"
SUPPORT = {"element_matrices", "fast_factor", "scale_models"}  # imported by others


def test_all_are_listed(capsys):
    there = {path.stem for path in FOLDER.glob("[a-z]*.py")} - SUPPORT
    assert there == set(SMALL)
    assert main([]) == 0
    told = capsys.readouterr().out
    assert all(any(line.startswith(f"{name} ") for line in told.splitlines()) for name in there)


@pytest.mark.parametrize("name", SMALL)
def test_it_runs_at_its_smallest_size(name):
    outcome = ran(name, SMALL[name])
    assert outcome.code == 0 and outcome.told.strip(), outcome.told
    assert outcome.seconds > 0.01

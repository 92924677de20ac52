"""The Python API as editors, type checkers and notebooks see it."""

import pkgutil
import re
import subprocess
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pytest
from report_examples import chain

import mouse_cli
from mouse_cli import model
from mouse_cli._notebook import Shown
from mouse_cli.report.kinds import KINDS

TOP = Path(__file__).resolve().parents[2]
USES = """\
import mouse_cli

problem = mouse_cli.read_deck("deck.yaml")
reveal_type(problem)  # mouse_cli.model.problem.Problem
reveal_type(mouse_cli.run(problem))  # mouse_cli.model.result.Result
reveal_type(mouse_cli.diagnose(problem))  # mouse_cli.model.diagnosis.Diagnosis
reveal_type(mouse_cli.correlate(problem))  # mouse_cli.model.correlation.Correlation
reveal_type(mouse_cli.compare(problem))  # mouse_cli.model.updated.Compared
reveal_type(mouse_cli.modes(problem, 3))  # mouse_cli.model.result.Forecast
recording = mouse_cli.read_recording("a.csv", forces=["f"], units={"f": "N"})
reveal_type(recording)  # mouse_cli.model.recording.Recording
reveal_type(mouse_cli.read_frf("a.unv"))  # mouse_cli.model.frf_test.FrfTest
reveal_type(mouse_cli.spectra(recording, lines=400))  # mouse_cli.model.spectra.SpectraResult
reveal_type(mouse_cli.identify(problem.frf, band=(1, 9)))  # mouse_cli.model.identification.Identification
reveal_type(mouse_cli.couple("whole.yaml"))  # mouse_cli.model.coupled.Coupled
reveal_type(mouse_cli.modify("changed.yaml"))  # mouse_cli.model.modified.Modified
reveal_type(mouse_cli.sweep("deck.yaml", {"k": [1, 2]}, "answers"))  # mouse_cli.model.campaign.Sweep
reveal_type(mouse_cli.written(problem, "markdown"))  # str
reveal_type(mouse_cli.document("result.json"))  # dict[str, Any]
"""


def below(base: type) -> Iterator[type]:
    """All classes that derive from `base`."""
    for each in base.__subclasses__():
        yield from (each, *below(each))


def test_every_kind_of_answer_shows_itself_in_notebooks():
    for each in pkgutil.iter_modules(model.__path__, "mouse_cli.model."):
        import_module(each.name)
    assert {each.__name__ for each in below(Shown)} == set(KINDS)


def test_what_a_notebook_shows():
    result = mouse_cli.run(chain())
    shown = result._repr_markdown_()
    assert shown.startswith("## Verdict") and "| k2 | N/m |" in shown
    assert len(shown) < len(mouse_cli.written(result, "markdown"))


def test_type_checkers_know_every_answer(tmp_path):
    """A script that uses each function, and the functions of their own, are clean under `mypy --strict`."""
    pytest.importorskip("mypy", reason="mypy is not installed")
    script = tmp_path / "uses.py"
    script.write_text(USES, "utf-8")
    command = [
        sys.executable,
        "-m",
        "mypy",
        "--strict",
        "--follow-imports=silent",
        "--cache-dir",
        str(tmp_path / "cache"),
    ]
    package = TOP / "mouse_cli"
    files = [str(path) for path in (script, package / "__init__.py", *(package / "api").glob("*.py"))]
    done = subprocess.run([*command, *files], cwd=TOP, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    revealed = re.findall(r'Revealed type is "([^"]+)"', done.stdout)
    assert revealed == re.findall(r"  # ([\w.\[\], ]+)$", USES, re.M), done.stdout
    used = set(re.findall(r"mouse_cli\.(\w+)\(", USES))
    functions = {name for name in mouse_cli.__all__ if name.islower() and not name.startswith("_")}
    assert functions - used == {"dataset", "frames", "write_deck"}  # two give frames of optional packages

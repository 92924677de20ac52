"""The example repository: its jobs for GitHub and GitLab are run as written, as long as all is well and when it is not."""

import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import pytest
import yaml
from pages import DOCS, TOP

EXAMPLE = DOCS / "example-repository"
INSTALL = "pip install mouse-cli"
BASH = shutil.which("bash")

pytestmark = pytest.mark.skipif(not BASH, reason="no bash on this system")


@dataclass(frozen=True)
class Step:
    """What a step of a job ended with, and what it printed."""

    code: int
    printed: str


@pytest.fixture
def repository(tmp_path) -> Path:
    """A copy of the example, and beside it a folder with the installed `mouse` alone."""
    shutil.copytree(EXAMPLE, tmp_path / "example")
    (tmp_path / "bin").mkdir()
    mouse = tmp_path / "bin" / "mouse"
    mouse.write_text(f"#!/bin/sh\nexec '{sys.executable}' -m mouse_cli \"$@\"\n")
    mouse.chmod(0o755)
    return tmp_path / "example"


def run(repository: Path, script: str, *flags: str) -> Step:
    """A script run by bash in the repository."""
    beside = repository.parent
    environment = {
        **os.environ,
        "PATH": f"{beside / 'bin'}{os.pathsep}{os.environ['PATH']}",
        "PYTHONPATH": str(TOP),
        "OPENBLAS_NUM_THREADS": "1",
        "GITHUB_STEP_SUMMARY": str(beside / "summary.md"),
    }
    (beside / "step.sh").write_text(script)
    command = [BASH, *flags, str(beside / "step.sh")]
    done = subprocess.run(command, cwd=repository, env=environment, capture_output=True, text=True, timeout=120)
    return Step(done.returncode, done.stdout + done.stderr)


def github(repository: Path, until: str = "") -> dict[str, Step]:
    """The steps of the job that run something, as GitHub's runner runs them: after a failure those alone that ask for it."""
    text = (repository / ".github/workflows/mouse.yml").read_text("utf-8")
    steps = [each for each in yaml.safe_load(text)["jobs"]["decks"]["steps"] if "run" in each]
    assert [each["name"] for each in steps if each["run"] == INSTALL] == ["Install"]
    found: dict[str, Step] = {}
    names = [each["name"] for each in steps]
    for each in steps[: names.index(until) + 1 if until else None]:
        well = not any(step.code for step in found.values())
        if each["run"] != INSTALL and (well or each.get("if") == "success() || failure()"):
            found[each["name"]] = run(repository, each["run"], "-e")
    return found


def gitlab(repository: Path) -> tuple[Step, Step]:
    """The script of the job, which ends at the first failure, and what is done after it in any case."""
    job = yaml.safe_load((repository / ".gitlab-ci.yml").read_text("utf-8"))["decks"]
    assert job["script"].count(INSTALL) == 1
    script = "\n".join(line for line in job["script"] if line != INSTALL)
    return run(repository, script, "-eo", "pipefail"), run(repository, "\n".join(job["after_script"]))


def counts(repository: Path) -> tuple[int, ...]:
    """Tests, failures and errors of the JUnit file."""
    suite = ElementTree.parse(repository / "junit.xml").getroot()[0]
    return tuple(int(suite.get(name)) for name in ("tests", "failures", "errors"))


def changed(repository: Path, name: str, old: str, new: str) -> None:
    """A file of the repository with one text in it replaced."""
    path = repository / name
    text = path.read_text("utf-8")
    assert text.count(old) == 1
    path.write_text(text.replace(old, new), "utf-8")


def test_job_of_github_as_written(repository):
    steps = github(repository)
    assert {name: step.code for name, step in steps.items()} == {"Check": 0, "Run": 0, "Summary": 0, "Pages": 0}, steps
    assert counts(repository) == (4, 0, 0)
    assert "::error" not in steps["Run"].printed
    assert "0 of 4 missed" in (repository.parent / "summary.md").read_text("utf-8")
    pages = {path.name.rpartition("-")[0]: path.read_text("utf-8") for path in (repository / "pages").iterdir()}
    assert sorted(pages) == ["cantilever", "ground_spring", "table_5_2", "table_5_3"]
    assert "The model lacks a spring to the ground" in pages["ground_spring"]
    untracked = {"mouse-results/", "pages/", "junit.xml", "table.csv", "summary.md"}
    assert untracked == set((repository / ".gitignore").read_text("utf-8").split())


def test_job_of_gitlab_as_written(repository):
    script, after = gitlab(repository)
    assert (script.code, after.code) == (0, 0), (script, after)
    assert counts(repository) == (4, 0, 0)
    assert len(list((repository / "pages").iterdir())) == 4


def test_deck_that_is_broken_fails_the_job_and_is_annotated(repository):
    changed(repository, "decks/cantilever.yaml", "units: SI", "unit: SI")
    steps = github(repository, "Run")
    assert {name: step.code for name, step in steps.items()} == {"Check": 4, "Run": 3}, steps
    assert re.search(r"^::error file=decks/cantilever.yaml,line=6,col=1,.*'unit'", steps["Run"].printed, re.MULTILINE)
    assert counts(repository) == (4, 1, 0)  # not as expected: it has no answer at all
    assert "MD210" in (repository / "summary.md").read_text("utf-8")
    shutil.rmtree(repository / "mouse-results")
    script, _ = gitlab(repository)
    assert script.code == 4 and "decks/cantilever.yaml:6:1: error[MD210]" in script.printed


def test_expectation_that_is_missed_fails_the_job_and_is_annotated(repository):
    changed(repository, "jobs.yaml", "posterior clamp: 6020 +- 1 %", "posterior clamp: 20000 +- 1 %")
    steps = github(repository, "Run")
    assert {name: step.code for name, step in steps.items()} == {"Check": 0, "Run": 3}, steps
    place = "::error file=jobs.yaml,line=11,col=72,title=mouse run%3A MD906::decks/cantilever.yaml: "
    told = [line.removeprefix(place) for line in steps["Run"].printed.splitlines() if line.startswith(place)]
    assert len(told) == 1 and re.fullmatch(r"posterior clamp is 60\d\d\S*; expected 20000 \+- 1 %25", told[0])
    assert counts(repository) == (4, 1, 0)


@pytest.mark.parametrize("deck", sorted((EXAMPLE / "decks").iterdir()), ids=lambda path: path.name)
def test_decks_are_those_of_the_collection(deck):
    """Which are compared with their sources elsewhere."""
    assert deck.read_bytes() == (TOP / "decks" / deck.name).read_bytes()

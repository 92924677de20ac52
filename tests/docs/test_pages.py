"""The pages run as written: commands give what is quoted, whole decks are sound, links lead somewhere."""

import contextlib
import io
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from pages import DOCS, PAGES, TOP, blocks, commands, differs
from proofs import proofs
from scipy.io import savemat

from mouse_cli.cli.main import main

_SHELL = re.compile(r"[|><;&$*]|^(?!mouse )")


def _in_process(command: str) -> tuple[int, str]:
    """Exit code and both outputs of a plain `mouse ...` command."""
    import shlex

    told = io.StringIO()
    with contextlib.redirect_stdout(told), contextlib.redirect_stderr(told), pytest.raises(SystemExit) as end:
        main(shlex.split(command)[1:])
    return int(end.value.code or 0), told.getvalue()


def _in_shell(command: str, folder: Path, shims: Path) -> tuple[int, str]:
    """Exit code and both outputs of a command with pipes and the like."""
    environment = {**os.environ, "PATH": f"{shims}{os.pathsep}{os.environ['PATH']}", "PYTHONPATH": str(TOP)}
    done = subprocess.run(
        ["sh", "-c", command],
        cwd=folder,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=60,
        check=False,
    )
    return done.returncode, done.stdout


@pytest.fixture(scope="session")
def shims(tmp_path_factory) -> Path:
    """A folder with `mouse` and `python` as a shell finds them."""
    folder = tmp_path_factory.mktemp("bin")
    for name, words in {"mouse": f"'{sys.executable}' -m mouse_cli", "python": f"'{sys.executable}'"}.items():
        path = folder / name
        path.write_text(f'#!/bin/sh\nexec {words} "$@"\n')
        path.chmod(0o755)
    return folder


def _name(page: Path) -> str:
    return str(page.relative_to(DOCS))


def _silverbox(path: Path) -> None:
    """Noise by the names and of the length of a recording that the reader fetches; `tests/field` has the recording itself."""
    rng = np.random.default_rng(1)
    savemat(path, {name: rng.standard_normal((1, 131072)) for name in ("V1", "V2")})


FETCHED = {"SNLS80mV.mat": _silverbox}  # files that decks of pages read and nobody ships


LONG = ("how-to/base-excitation.md",)  # a minute or more


@pytest.mark.parametrize("page", proofs(PAGES, *(page for page in PAGES if _name(page) not in LONG)), ids=_name)
def test_page_runs_as_written(page, tmp_path, monkeypatch, shims):
    shutil.copytree(TOP / "decks", tmp_path / "decks")
    monkeypatch.chdir(tmp_path)
    for name, made in FETCHED.items():
        if name in page.read_text("utf-8"):
            made(tmp_path / name)
    for block in blocks(page):
        where = f"{page.relative_to(TOP)}:{block.line}"
        if block.file:
            Path(block.file).write_text(block.text, "utf-8")
        if block.language == "yaml" and re.search(r"^mouse: 1$", block.text, re.MULTILINE):
            name = block.file or f"deck_of_line_{block.line}.yaml"
            Path(name).write_text(block.text, "utf-8")
            code, told = _in_process(f"mouse check {name}")
            assert code == 0, f"{where}: the deck is rejected\n{told}"
        if block.language == "console":
            for step in commands(block):
                if "jq" in step.command and not shutil.which("jq"):
                    continue
                plain = not _SHELL.search(step.command)
                code, told = _in_process(step.command) if plain else _in_shell(step.command, tmp_path, shims)
                assert code == step.exit_code, f"{where}: $ {step.command}\nexit {code}\n{told}"
                difference = differs(step.expected, told)
                assert not difference, f"{where}: $ {step.command}\n{difference}"


@pytest.mark.parametrize("page", PAGES, ids=_name)
def test_links_resolve(page):
    text = re.sub(r"^```.*?^```", "", page.read_text("utf-8"), flags=re.MULTILINE | re.DOTALL)
    for target in re.findall(r"\]\(([^)\s]+)\)", text):
        if re.match(r"[a-z]+:", target):
            continue
        file, _, anchor = target.partition("#")
        there = (page.parent / file).resolve() if file else page
        assert there.exists(), f"{page.name}: nothing at {target}"
        if anchor:
            assert anchor in _anchors(there), f"{page.name}: no heading {target}"


def _anchors(page: Path) -> set[str]:
    headings = re.findall(r"^#+ (.+)$", page.read_text("utf-8"), flags=re.MULTILINE)
    return {re.sub(r"[^\w -]", "", h.lower()).strip().replace(" ", "-") for h in headings}


def test_index_names_every_page():
    index = (DOCS / "README.md").read_text("utf-8")
    for page in PAGES:
        if page.name != "README.md":
            assert f"({page.relative_to(DOCS)})" in index, f"{page.relative_to(DOCS)} is not in the index"

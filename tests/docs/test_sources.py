"""Every row of docs/explanation/sources.md: its command runs, its test and its page are there."""

import re
import shlex
from pathlib import Path

import pytest

from mouse_cli.cli.main import _run

TOP = Path(__file__).resolve().parents[2]
PAGE = TOP / "docs" / "explanation" / "sources.md"
ROWS = [
    [cell.strip() for cell in line.strip("|").split("|")]
    for line in PAGE.read_text(encoding="utf-8").splitlines()
    if line.startswith("|") and not line.startswith(("|---", "| source"))
]
COMMANDS = sorted({found[1] for row in ROWS if (found := re.fullmatch(r"`mouse ([^`]*)`", row[1]))})


def test_rows_are_whole():
    assert len(ROWS) > 90
    for source, answer, test, page in ROWS:
        assert source and (re.fullmatch(r"`mouse [^`]*`", answer) or answer.startswith("refused: ")), source
        path, _, name = test.strip("`").partition("::")
        assert not name or f"def {name}(" in (TOP / path).read_text(encoding="utf-8"), test
        assert (TOP / path).is_file(), test
        link = re.fullmatch(r"\[[^]]+\]\(([^)#]+)[^)]*\)", page)
        assert link and (PAGE.parent / link[1]).is_file(), page


def test_every_table_of_both_sources_has_a_row():
    text = " ".join(row[0] for row in ROWS)
    for name in ("3-1", "5-1", "5-2", "5-3", "5-4", "5-5", "5-6"):
        assert f"Table {name}" in text
    for name in ("Figure 4-1", "Figure 5-1", *(f"I-{k}" for k in range(1, 6)), *(f"A.2, {k}:" for k in range(1, 13))):
        assert name in text
    for name in [
        "JFLAG",
        "KONF",
        "IROW",
        "ITERMX",
        "INTR",
        "NRS",
        "NPARD",
        "NVEC",
        "MODE",
        "RS",
        "INDIC",
        "COV",
        "LAMTST",
        "VAR",
    ]:
        assert name in text


@pytest.mark.parametrize("command", COMMANDS)
def test_commands_run(command, monkeypatch, capsys):
    """Exit 0 or 1, and something said; a diagnosis, which its own test runs, is checked alone."""
    monkeypatch.chdir(TOP)
    words = shlex.split(command)
    assert _run(["check", *words[1:]] if words[0] == "diagnose" else words) in (0, 1)
    assert capsys.readouterr().out

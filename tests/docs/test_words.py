"""Retired words stay out of what users read: docs, help, printouts, diagnostics, pages and figures. CONTRIBUTING says why."""

import ast
import json
import re
from collections.abc import Iterator
from pathlib import Path

import click
import pytest
from click.testing import CliRunner
from pages import PAGES, TOP

from mouse_cli.cli.main import cli

RETIRED = {
    r"foresees?|foreseen|foresaw|foretells?|foretold": "predict, prediction",
    r"is told|are told|was told|were told|told by|told apart|hardly told|not told": "reported, given, distinguished",
    r"heard": "reported",
    r"gives? way|gave way|giving way": "flexible, softer",
    r"by chance": "p-value, or by noise",
    r"held against": "ratio of ... to ..., compared with",
    r"lets? expect": "expected from",
    r"put together|taken apart|takes? apart": "coupling, decoupling, substructuring",
    r"anew": "again, resampled, recomputed",
    r"gone on with|broken off|breaks? off|broke off": "resumed, interrupted",
    r"nats": "log evidence",
    r"likeness": "correlation, MAC",
    r"less than once in|times in 100\b|practically always": "p < 1e-6, p = 0.66, p > 0.999",
    r"is it true": "validation",
    r"what is left": "residual, remainder",
    r"arrangements?": "configuration",
    r"tells? (?:\w+ ){1,4}apart": "distinguish, separate",
    r"speaks? (?:for|against)|spoke (?:for|against)": "support, contradict",
    r"held likely|held possible|held to be": "probable, possible",
    r"in place of": "instead of",
    r"weighed by|weighs data": "weighted by",
    r"bears? (?:the|one|a) names?|bears? names": "have the name",
    r"makes? up for": "compensate for",
    r"nobody knows": "unknown",
    r"no wonder": "consistent with",
    r"what (?:\w+ )?accuracies": "stated accuracies, uncertainty",
    r"misses (?:of )?the measured": "frequency error",
}
_PATTERN = re.compile("|".join(rf"(?P<w{i}>\b(?:{words})\b)" for i, words in enumerate(RETIRED)), re.IGNORECASE)
_PACKAGE = TOP / "mouse_cli"


def found(text: str) -> list[str]:
    """Retired words of a text, each with what to say; names in code spans, links and keys are none."""
    plain = re.sub(r"\]\([^)\s]*\)|`[^`\n]*`|\w+[_/.]\w+", " ", text)
    return [f"'{each[0]}': say {list(RETIRED.values())[int(each.lastgroup[1:])]}" for each in _PATTERN.finditer(plain)]


def _prose(page: Path) -> str:
    """A page without its programs and decks: text, and what commands print."""
    return re.sub(r"^```(?!console|text).*?^```", "", page.read_text("utf-8"), flags=re.MULTILINE | re.DOTALL)


def _literals(path: Path) -> Iterator[tuple[int, str]]:
    """Strings of a module that hold words, with their lines; docstrings are not printed."""
    tree = ast.parse(path.read_text("utf-8"))
    holders = (ast.Module, ast.ClassDef, ast.FunctionDef)
    docs = {id(node.body[0].value) for node in ast.walk(tree) if isinstance(node, holders) and ast.get_docstring(node)}
    for node in ast.walk(tree):
        if (
            isinstance(node, ast.Constant)
            and isinstance(node.value, str)
            and " " in node.value
            and id(node) not in docs
        ):
            yield node.lineno, node.value


@pytest.mark.parametrize(
    "text",
    [
        "It foresees the modes.",
        "a support that\ngives way",
        "Nothing speaks against it.",
        "the data tell the two springs apart",
    ],
)
def test_a_retired_word_is_found(text):
    assert found(" ".join(text.split()))


def test_names_in_code_are_no_words():
    assert not found("The key `foretold_sd`, [configurations](how-to/arrangements.md) and parameters.foretold stay.")


@pytest.mark.parametrize("page", [*PAGES, TOP / "README.md"], ids=lambda page: str(page.relative_to(TOP)))
def test_page_has_none(page):
    assert not found(" ".join(_prose(page).split()))


def test_notebook_has_none():
    cells = json.loads((TOP / "docs" / "notebook.ipynb").read_text("utf-8"))["cells"]
    assert not found(" ".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown"))


@pytest.mark.parametrize("name", sorted(cli.list_commands(click.Context(cli))))
def test_help_has_none(name):
    told = CliRunner().invoke(cli, [name, "--help"], prog_name="mouse")
    assert told.exit_code == 0 and not found(" ".join(told.output.split()))


@pytest.mark.parametrize("folder", sorted(each.name for each in _PACKAGE.iterdir() if (each / "__init__.py").exists()))
def test_strings_of_the_program_have_none(folder):
    wrong = [
        f"{path.relative_to(TOP)}:{line}: {word}"
        for path in sorted((_PACKAGE / folder).rglob("*.py"))
        for line, text in _literals(path)
        for word in found(text)
    ]
    assert not wrong, "\n".join(wrong)

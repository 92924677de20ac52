"""The short report, which commands print without `--full`: verdict first, one screen, nothing folded without its count."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import report_examples
from diagnosis_examples import DIAGNOSES

from mouse_cli import report
from mouse_cli.cli.main import _run
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.report.blocks import Column, Heading, Table, Text
from mouse_cli.report.renderers.screen import WIDEST
from mouse_cli.report.section import APPENDIX, RESULT, VERDICT, Options, blocks, folded, sections
from mouse_cli.updating import run

DECKS = Path(__file__).resolve().parents[2] / "decks"
SCREEN = 45  # lines of a screen


@pytest.fixture
def printed(capsys):
    """What a command prints, as lines."""

    def lines(*arguments: str) -> list[str]:
        assert _run(list(arguments)) in (0, 1)
        return capsys.readouterr().out.splitlines()

    return lines


def five_by_six(softer: float):
    """Five springs of a chain of twelve masses may vary; its lowest six modes are those of one `softer` all over."""
    problem = report_examples.long_chain(12, 5)
    values, shapes = np.linalg.eigh(softer * problem.structure.K)
    hz = np.sqrt(values[:6]) / (2 * np.pi)
    return replace(
        problem,
        test=ModalTest(
            np.arange(1, 7), hz, 0.002 * hz, np.arange(12), shapes[:, :6], np.full((12, 6), 0.01), "least-squares"
        ),
    )


@pytest.mark.parametrize("softer", [1.0, 0.8])
def test_a_run_of_five_parameters_and_six_modes_is_a_screen(softer: float) -> None:
    """Whether the model explains the data or not."""
    lines = report.written(run(five_by_six(softer)), "screen").splitlines()
    assert len(lines) <= SCREEN and max(map(len, lines)) <= WIDEST
    assert lines[0] == "VERDICT" and ("rejected" in lines[1]) == (softer < 1)
    for wanted in ("spring 5", "FROM", "MEASURED", "MORE", "--full"):
        assert any(wanted in line for line in lines)


@pytest.mark.parametrize("name", report_examples.PROBLEMS)
def test_short_report_of_a_run(name: str) -> None:
    """The verdict leads; the rest is named, and is in the whole report."""
    found = report_examples.result(name)
    lines = report.written(found, "screen").splitlines()
    assert lines[0] == "VERDICT" and max(map(len, lines)) <= WIDEST
    more = " ".join(lines[lines.index("MORE") + 1 :])
    whole = report.printout(found)
    for title in more.removesuffix(".").partition("adds: ")[2].split("; "):
        assert title.upper() in whole


@pytest.mark.parametrize("name", DIAGNOSES)
def test_short_report_of_a_diagnosis(name: str) -> None:
    lines = report.written(DIAGNOSES[name](), "screen").splitlines()
    assert lines[0] == "DIAGNOSIS" and lines[1] and max(map(len, lines)) <= WIDEST


@pytest.mark.parametrize("form", ["screen", "printout", "markdown"])
def test_every_form_has_the_same_order(form: str) -> None:
    """Place by place, whatever the form: no result stands before a verdict."""
    found = report_examples.result("noisy")
    titles = [s.title.upper() for s in sections(type(found))]
    text = report.written(found, form, options=Options(level=APPENDIX)).upper()
    lines = [line.strip("# ") for line in text.splitlines()]
    places = [lines.index(title) for title in titles if title in lines]
    assert places == sorted(places) and len(places) > 8


def test_what_is_folded_is_counted() -> None:
    table = Table((Column("x"),), tuple((i,) for i in range(30)), kept=4, rest="below 1 %")
    shown, told = folded([table], Options(level=RESULT))
    assert [row[0] for row in shown.rows] == [0, 1, 2, 3] and told.text == "and 26 more below 1 %; `--full`"
    assert list(folded([replace(table, kept=30)], Options(level=RESULT, rows=40))) == [replace(table, kept=30)]


def test_places_up_to_a_level() -> None:
    found = report_examples.result("noisy")
    verdict = [block.text for block in blocks(found, Options(level=VERDICT)) if isinstance(block, Heading)]
    whole = [block for block in blocks(found, Options(level=APPENDIX)) if isinstance(block, Text)]
    assert verdict == ["Verdict", "More"]
    assert not any("--full" in block.text for block in whole)


@pytest.mark.parametrize(
    ("command", "deck", "title"),
    [
        ("run", "ground_spring.yaml", "VERDICT"),
        ("correlate", "tube_frame.yaml", "CORRELATION OF TEST AND MODEL"),
        ("compare", "ground_spring.yaml", "COMPARISON OF METHODS OF UPDATING"),
        ("couple", "coupled/portal.yaml", "COUPLED STRUCTURES"),
        ("modify", "coupled/portal_calmed.yaml", "MODIFIED STRUCTURE"),
    ],
)
def test_commands_begin_with_the_verdict_and_fit_a_screen(command: str, deck: str, title: str, printed) -> None:
    short = printed(command, str(DECKS / deck), "-q")
    assert short[0] == title and len(short[1]) > 20 and len(short) <= SCREEN
    whole = printed(command, str(DECKS / deck), "-q", "--full")
    assert len(whole) > len(short) and whole[1] == title and whole[4]


def test_decks_of_cards_and_legacy_print_the_whole(printed) -> None:
    cards = printed("run", str(DECKS / "table_5_2.dat"), "--scale", "none", "--cycles", "2")
    assert any("ECHO OF THE CARDS" in line for line in cards)
    assert any("COVARIANCE S*" in line for line in printed("run", str(DECKS / "ground_spring.yaml"), "--legacy", "-q"))


def test_the_document_is_that_of_the_whole_answer(printed) -> None:
    deck = str(DECKS / "ground_spring.yaml")
    assert printed("run", deck, "--json") == printed("run", deck, "--json", "--full")

"""Every section by itself, and every form of the report as a whole, for results of every kind."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
import report_examples

from mouse_cli import _registry, report
from mouse_cli.formats import read_deck
from mouse_cli.model.correlation import Correlation
from mouse_cli.model.result import Forecast, Result
from mouse_cli.report.blocks import Heading, Lines, Matrix, Table, Text
from mouse_cli.report.numbers import Numbers
from mouse_cli.report.renderers import renderer
from mouse_cli.report.renderers.printout import WIDTH
from mouse_cli.report.section import Options, registry, sections
from mouse_cli.updating import run
from mouse_cli.updating.correlate import correlate

DECKS = Path(__file__).resolve().parents[2] / "decks"
SECTIONS = registry()
FORMS = tuple(_registry.discover("mouse_cli.report.renderers", "RENDERER"))
CELL = int | float | str | None | np.integer


def valid(block) -> bool:
    """Whether a block holds what renderers may rely on."""
    match block:
        case Heading(text, level):
            return bool(text) and level == 2
        case Text():
            filled = block.filled(Numbers("modern"))
            return bool(filled.strip()) and "nan" not in filled.split() and filled.endswith((".", ":"))
        case Table(columns, rows, keys):
            return 0 < keys <= len(columns) and all(isinstance(c, CELL) for row in rows for c in row)
        case Matrix(array=array):
            return array.dtype == float and array.size > 0
        case Lines(lines):
            return all(isinstance(line, str) for line in lines)
    return False


def speaking_of(subject: type) -> list[str]:
    return [section.key for section in sections(subject)]


@pytest.mark.parametrize("name", report_examples.PROBLEMS)
@pytest.mark.parametrize("key", speaking_of(Result))
def test_section_of_a_result(key: str, name: str) -> None:
    for block in SECTIONS[key].blocks(report_examples.result(name), Options()):
        assert valid(block), block


@pytest.mark.parametrize("name", report_examples.FORECASTS)
@pytest.mark.parametrize("key", speaking_of(Forecast))
def test_section_of_a_forecast(key: str, name: str) -> None:
    for block in SECTIONS[key].blocks(report_examples.FORECASTS[name](), Options()):
        assert valid(block), block


@pytest.mark.parametrize("name", report_examples.PROBLEMS)
def test_sections_of_a_correlation(name: str) -> None:
    """Every problem that can be run can be compared, in every section and form."""
    found = correlate(report_examples.result(name).problem, "residual-energy")
    for key in speaking_of(Correlation):
        for block in SECTIONS[key].blocks(found, Options()):
            assert valid(block), block
    assert max(map(len, report.printout(found, "modern").split("\n"))) <= WIDTH
    assert report.markdown(found).startswith("## ")
    assert plain_python(report.document(found))


def test_order() -> None:
    """Verdict, results and evidence, then the printout of 1972 in the order that the manual gives."""
    assert [s.key for s in sections(Result)] == [
        "verdict",
        "properties",
        "alternatives",
        "before-after",
        "frf-before-after",
        "held-out",
        "frf-held-out",
        "warnings",
        "next",
        "innovation",
        "conditioning",
        "heading",
        "cards",
        "prior",
        "matrices-before",
        "cycles",
        "partials",
        "matrices",
        "modes",
        "comparison",
        "covariance",
    ]
    for subject in (Result, Forecast, Correlation):
        orders = [(s.place, s.order) for s in sections(subject)]
        assert len(set(orders)) == len(orders)


@pytest.mark.parametrize("numbers", ["legacy", "modern"])
@pytest.mark.parametrize("name", report_examples.PROBLEMS)
def test_no_line_is_longer_than_the_printer(name: str, numbers: str) -> None:
    lines = report.printout(report_examples.result(name), numbers).split("\n")
    assert max(map(len, lines)) <= WIDTH
    assert all(line == line.rstrip() and line.isprintable() for line in lines)


@pytest.mark.parametrize("width", [40, 72, 80, 131])
@pytest.mark.parametrize("name", ["noisy", "thirty", "logarithmic", "cards"])
def test_narrower_pages(name: str, width: int) -> None:
    from mouse_cli.report.renderers.printout import render
    from mouse_cli.report.section import blocks

    text = render(blocks(report_examples.result(name)), Numbers("legacy"), width)
    assert max(map(len, text.split("\n"))) <= width


@pytest.mark.parametrize("name", report_examples.FORECASTS)
def test_forecasts_in_every_form(name: str) -> None:
    forecast = report_examples.FORECASTS[name]()
    assert max(map(len, report.printout(forecast).split("\n"))) <= WIDTH
    assert report.markdown(forecast).startswith("## ")
    document = report.document(forecast)
    json.dumps(document, allow_nan=False)
    assert document["schema"] == "mouse.modes/1"
    assert [m["mode"] for m in document["modes"]] == list(range(1, len(document["modes"]) + 1))


@pytest.mark.parametrize("name", report_examples.PROBLEMS)
def test_markdown_tables_are_whole(name: str) -> None:
    """Every row of a table has as many cells as its rule, whatever a name is made of."""
    text = report.markdown(report_examples.result(name))
    inside, cells = False, 0
    for line in text.split("\n"):
        if line.startswith("```"):
            inside = not inside
        if inside or not line.startswith("|"):
            cells = 0
            continue
        found = line.replace("\\|", "").count("|")
        assert cells in (0, found), line
        cells = found


@pytest.mark.parametrize("name", report_examples.PROBLEMS)
def test_document(name: str) -> None:
    result = report_examples.result(name)
    document = report.document(result)
    assert json.loads(json.dumps(document, allow_nan=False)) == document
    assert document["schema"] == "mouse.result/1"
    assert document["exit_code"] == result.exit_code
    assert len(document["modes"]) == result.problem.test.m
    assert len(document["shapes"]) + np.isfinite(result.problem.test.frequency_hz).sum() == len(result.y)
    assert sum(m["exceeds"] for m in document["modes"]) + sum(s["exceeds"] for s in document["shapes"]) == len(
        document["exceedances"]
    )
    assert ("stiffness" in document) == (result.problem.structure.n <= 140)
    assert plain_python(document)


def plain_python(value) -> bool:
    """Whether nothing of numpy and nothing infinite is left in `value`."""
    if isinstance(value, dict):
        return all(type(k) is str and plain_python(v) for k, v in value.items())
    if isinstance(value, list):
        return all(map(plain_python, value))
    return value is None or (type(value) in (int, str, bool)) or (type(value) is float and math.isfinite(value))


def test_data_are_where_they_belong() -> None:
    """Each datum's label, value and mark agree between the result, the tables and the document, gaps included."""
    result = report_examples.result("missing")
    shapes = {f"x({s['mode']},{s['dof']})": s for s in report.document(result)["shapes"]}
    for label, y, predicted, out in zip(
        result.labels, result.y, result.revised.predicted, result.exceeding, strict=True
    ):
        if label.startswith("x("):
            assert shapes[label]["test"] == y
            assert shapes[label]["revised"] == predicted
            assert shapes[label]["exceeds"] == out
    modes = {m["mode"]: m for m in report.document(result)["modes"]}
    assert modes[2]["test_hz"] is None and modes[2]["sd_hz"] is None and modes[2]["revised_hz"] > 0
    assert modes[3]["mac"] is None
    assert (2 * math.pi * modes[4]["test_hz"]) ** 2 == pytest.approx(result.y[result.labels.index("lambda 4")])


def test_no_answer_gives_no_values() -> None:
    document = report.document(report_examples.result("unobservable"))
    assert [p["posterior"] for p in document["parameters"]] == [None, None]
    assert document["covariance"] is None
    assert document["model_form"] == "untested"


def test_limit_leaves_no_standard_deviation() -> None:
    free, limited = report.document(report_examples.result("logarithmic"))["parameters"]
    assert free["posterior_sd"] > 0 and not free["at_limit"]
    assert limited["posterior_sd"] is None and limited["at_limit"]


@pytest.mark.parametrize(
    ("name", "form", "words"),
    [
        ("anchored", "accepted", "The model explains the data."),
        ("rejected", "rejected", "The form of the model is rejected: the data show"),
        ("sparse", "rejected", "The form of the model is rejected: it fits the data only with values"),
        ("unobservable", "untested", "The form of the model is not tested: the run gave no answer."),
        ("noisy", "accepted", "the run has not come to its end"),
    ],
)
def test_plain_statement_on_the_form_of_the_model(name: str, form: str, words: str) -> None:
    result = report_examples.result(name)
    assert report.document(result)["model_form"] == form
    assert words in " ".join(report.markdown(result).split())


def test_table_5_3_is_printed() -> None:
    """Table 5-3 (7): k11, k12, k22 after optimization, to the digits that were printed in 1972."""
    text = report.printout(report_examples.result("noisy"))
    for printed in ("2.30524+05", "-1.48385+05", "2.63385+05"):
        assert printed in text


def test_table_5_2_is_printed() -> None:
    """Table 5-2, items (1), (2), (4) to (6): K before, M, covariance, [A], K after, in the printout and the document."""
    result = run(read_deck(DECKS / "table_5_2.yaml"))
    before, after = report.printout(result).split("EIGENVALUES AND EIGENVECTORS")[0].split("CYCLES")
    for item in ("STIFFNESS MATRIX BEFORE", "2.50000+05  -1.50000+05", "MASS MATRIX BEFORE", "7.20000+07  0.00000+00"):
        assert item in before
    assert "k(1,1)  1.00000+00   1.00000+00" in before and "k(1,2)  0.00000+00  -1.00000+00" in before
    for printed in ("2.25103+05", "-1.40084+05", "2.55084+05"):
        assert printed in after
    told = report.document(result)
    assert told["before"]["A"] == [[1, 1], [0, -1], [0, 1]] and told["before"]["mass"] == np.eye(4).tolist()
    assert told["before"]["elements"] == ["k(1,1)", "k(1,2)", "k(2,2)"]
    assert told["prior_covariance"] == [[pytest.approx(7.2e7), 0], [0, 1e8]]


def test_unknown_form() -> None:
    with pytest.raises(ValueError, match=", ".join(FORMS)):
        renderer("papyrus")

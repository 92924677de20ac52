"""YAML decks: what good ones say, and where each fault of a bad one is found (file, line, column, caret)."""

import ast
import re
from pathlib import Path

import numpy as np
import pytest

import mouse_cli
from mouse_cli._errors import DeckError, frame
from mouse_cli.codes import catalogue
from mouse_cli.codes.yaml import CODES
from mouse_cli.formats import read_deck, read_draft, write_deck, yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.formats.draft import Draft
from mouse_cli.formats.yaml_deck.nodes import MAX_DEPTH, MAX_FINDINGS

# DESIGN section 4, completed with the data of Table 5-3 of the report.
CHAIN = """\
mouse: 1
title: Four-mass chain, imperfect test data (Table 5-3)
source: NASA CR, Table 5-3
model:
  stiffness: {order: 4, entries: [[1,1,2.5e5],[1,2,-1.5e5],[2,2,2.65e5],
    [2,3,-1.15e5],[3,3,3.15e5],[3,4,-2.0e5],[4,4,2.0e5]]}
  mass: {diagonal: [1, 1, 1, 1]}
parameters:
  - {name: k1, sd: 8485.2814, stiffness: [[1,1,1]]}
  - {name: k2, sd: 1.0e4, stiffness: [[1,1,1],[1,2,-1],[2,2,1]]}
test:
  modes:
    number: [1, 2, 3, 4]
    dofs: [1, 2, 3, 4]
    frequency: [17.9415, 54.6245, 95.5183, 115.25]
    frequency_sd: [0.182125696, 0.546256567, 0.932136357, 1.12660245]
    shapes:
      - [0.320877, -0.597509,  0.655247, -0.29832]
      - [0.483715, -0.560864, -0.570894,  0.466466]
      - [0.558403,  0.192409, -0.298186, -0.756338]
      - [0.652936,  0.500780,  0.383446,  0.355445]
    shape_sd: 0.05
    scale: none
run: {estimator: bayes, recursion: replaced, confidence: 95, partials: 5, passes: 1, print_partials: false}
"""
SMALL = """\
mouse: 1
model:
  stiffness: {order: 2, entries: [[1,1,3.0],[1,2,-1.0],[2,2,1.0]]}
  mass: {identity: 2}
parameters:
  - {name: a, nominal: 2.0, sd: 5 %, stiffness: [[1,1,1]]}
  - {name: b, sd: 0.5, stiffness: [[1,2,-1],[2,2,1]], mass: [[2,2,1]]}
test:
  modes: {frequency: [1, 2], frequency_sd: 1 %, dofs: [1, 2], shapes: [[1, 1], [2, -1]], shape_sd: 2 %}
run: {partials: 5}
"""


def problem(text: str):
    return assemble(yaml_deck.read(text, "deck.yaml"))


def swapped(old: str, new: str, text: str = SMALL) -> str:
    assert text.count(old) == 1, f"{old!r} must stand once"
    return text.replace(old, new)


def findings(text: str | bytes):
    """Errors and warnings of a deck, whoever found them."""
    try:
        draft = yaml_deck.read(text, "deck.yaml")
        assert isinstance(draft, Draft)
        return assemble(draft).warnings
    except DeckError as error:
        return error.diagnostics


def test_chain_of_table_5_3():
    chain = problem(CHAIN)
    K = (
        np.diag([2.5e5, 2.65e5, 3.15e5, 2e5])
        + np.diag([-1.5e5, -1.15e5, -2e5], 1)
        + np.diag([-1.5e5, -1.15e5, -2e5], -1)
    )
    np.testing.assert_array_equal(chain.structure.K, K)
    np.testing.assert_array_equal(chain.structure.M, np.eye(4))
    np.testing.assert_array_equal(chain.A, [[1, 1], [0, -1], [0, 1]])
    assert chain.elements.labels() == ("k(1,1)", "k(1,2)", "k(2,2)")
    assert [p.name for p in chain.parameters] == ["k1", "k2"]
    np.testing.assert_array_equal(chain.prior.sd, [8485.2814, 1e4])
    np.testing.assert_array_equal(chain.test.dofs, [0, 1, 2, 3])
    assert chain.test.shapes[1, 2] == -0.570894 and chain.test.frequency_hz[3] == 115.25
    assert (chain.test.shape_sd == 0.05).all() and chain.test.scale == "none"
    assert (chain.run.recursion, chain.run.partials, chain.run.pairing) == ("replaced", 5, "mac")
    assert chain.title == "Four-mass chain, imperfect test data (Table 5-3)" and not chain.warnings
    assert chain.source.lines[1] == CHAIN.splitlines()[1]


def test_defaults_and_percentages():
    small = problem(SMALL)
    assert small.parameters[0].sd == 0.1  # 5 % of 2.0
    np.testing.assert_array_equal(small.test.number, [1, 2])
    np.testing.assert_allclose(small.test.frequency_sd_hz, [0.01, 0.02], rtol=1e-15)
    np.testing.assert_allclose(small.test.shape_sd, [[0.04, 0.02], [0.04, 0.02]], rtol=1e-15)  # of each largest
    assert small.test.scale == "fitted" and small.run.recursion == "anchored"
    assert small.elements.labels() == ("k(1,1)", "k(1,2)", "k(2,2)", "m(2,2)")


@pytest.mark.parametrize(
    ("written", "value"),
    [
        ("1e5", 1e5),
        ("2.5e5", 2.5e5),
        ("1.e3", 1e3),
        (".5", 0.5),
        ("-3", -3),
        ("+4.25E-2", 0.0425),
        ("010", 10),
        ("1.5e+05", 1.5e5),
    ],
)
def test_numbers_are_decimal_whatever_yaml_1_1_thinks(written, value):
    draft = yaml_deck.read(swapped("[1,1,3.0]", f"[1,1,{written}]"), "deck.yaml")
    assert draft.K.values[0] == value
    assert draft.K.values[1] == -1.0


@pytest.mark.parametrize(
    "form",
    [
        "{dense: [[3, -1], [-1, 1]]}",
        "{order: 2, entries: [[2,1,-1],[2,2,1],[1,1,3]]}",
        "{file: k.mtx}",
        "{file: k.csv}",
    ],
)
def test_forms_of_a_matrix_agree(form, tmp_path):
    (tmp_path / "k.mtx").write_text("%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 3\n2 1 -1\n2 2 1\n")
    (tmp_path / "k.csv").write_text("3,-1\n-1,1\n")
    deck = tmp_path / "deck.yaml"
    deck.write_text(swapped("{order: 2, entries: [[1,1,3.0],[1,2,-1.0],[2,2,1.0]]}", form))
    np.testing.assert_array_equal(read_deck(deck).structure.K, [[3, -1], [-1, 1]])


def test_a_parameter_may_move_a_whole_matrix(tmp_path):
    (tmp_path / "g.mtx").write_text("%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 7\n2 1 -5\n2 2 4\n")
    deck = tmp_path / "deck.yaml"
    deck.write_text(swapped("stiffness: [[1,1,1]]", "stiffness: {file: g.mtx}"))
    read = read_deck(deck)
    assert read.elements.labels() == ("k(1,1)", "k(1,2)", "k(2,2)", "m(2,2)")
    np.testing.assert_array_equal(read.A, [[7, 0], [-5, -1], [4, 1], [0, 1]])


def test_elements_give_the_order_of_partials():
    text = SMALL + "elements: {stiffness: [[2,2],[1,2],[1,1]]}\n"
    read = problem(text)
    assert read.elements.labels() == ("k(2,2)", "k(1,2)", "k(1,1)", "m(2,2)")
    np.testing.assert_array_equal(read.A, [[0, 1], [0, -1], [1, 0], [0, 1]])


@pytest.mark.parametrize(
    "prior",
    [
        "{correlation: [[1, 0.5], [0.5, 1]]}",
        "{correlations: [[b, a, 0.5]]}",
        "{covariance: [[0.01, 0.025], [0.025, 0.25]]}",
    ],
)
def test_forms_of_the_prior_agree(prior):
    read = problem(SMALL + f"prior: {prior}\n")
    np.testing.assert_allclose(read.prior.cov, [[0.01, 0.025], [0.025, 0.25]], rtol=1e-14)


def test_covariance_replaces_sd():
    text = swapped("sd: 0.5, ", "") + "prior: {covariance: [[4, 1], [1, 9]]}\n"
    draft = yaml_deck.read(text, "deck.yaml")
    assert [p.sd for p in draft.parameters] == [2.0, 3.0]
    assert [(d.code, d.severity) for d in draft.diagnostics] == [("MD224", "warning")]  # a says 5 %, which is 0.1


def test_labels_name_degrees_of_freedom():
    text = swapped("{identity: 2}", "{identity: 2}\n  labels: [base, tip]")
    text = swapped("dofs: [1, 2]", "dofs: [tip, 1]", text)
    text = swapped("partials: 5", "fix_total_mass: {dofs: [tip]}", text)
    read = problem(text)
    assert read.structure.labels == ("base", "tip")
    np.testing.assert_array_equal(read.test.dofs, [1, 0])
    assert read.run.fix_total_mass and read.run.total_mass_dofs == (1,)


def test_missing_measurements():
    text = swapped("frequency: [1, 2]", "frequency: [1, null]")
    read = problem(swapped("[[1, 1], [2, -1]]", "[[1, ~], [.nan, -1]]", text)).test
    np.testing.assert_array_equal(np.isnan(read.shapes), [[False, True], [True, False]])
    np.testing.assert_array_equal(np.isnan(read.shape_sd), [[False, True], [True, False]])
    assert read.shape_sd[1, 1] == 0.02 and np.isnan(read.frequency_sd_hz[1])


def test_shapes_may_be_left_out():
    text = swapped(", dofs: [1, 2], shapes: [[1, 1], [2, -1]], shape_sd: 2 %", "")
    assert problem(text).test.shapes.shape == (0, 2)


def test_shapes_may_be_in_a_file(tmp_path):
    (tmp_path / "x.csv").write_text("mode1,mode2\n1,\n2,-1\n")
    deck = tmp_path / "deck.yaml"
    deck.write_text(swapped("[[1, 1], [2, -1]]", "{file: x.csv}"))
    np.testing.assert_array_equal(read_deck(deck).test.shapes, [[1, np.nan], [2, -1]])


def test_shapes_by_rows_of_modes_are_turned_with_a_warning():
    text = swapped("dofs: [1, 2], shapes: [[1, 1], [2, -1]]", "dofs: [2], shapes: [[3, 4]]")
    turned = swapped("[[3, 4]]", "[[3], [4]]", text)
    straight, warned = problem(text), problem(turned)
    np.testing.assert_array_equal(straight.test.shapes, [[3, 4]])
    np.testing.assert_array_equal(warned.test.shapes, [[3, 4]])
    assert not straight.warnings
    assert [(d.code, d.span.line, d.span.column) for d in warned.warnings] == [("MD227", *place(turned, "[[3], [4]]"))]


def place(text: str, fault: str) -> tuple[int, int]:
    """Line and column at which `fault` stands first."""
    before = text[: text.index(fault)]
    return before.count("\n") + 1, len(before) - before.rfind("\n")


def test_a_misspelt_key_is_one_error():
    with pytest.raises(DeckError) as caught:
        yaml_deck.read(SMALL.replace("mass: {identity", "mas: {identity"), "deck.yaml")
    assert [one.code for one in caught.value.diagnostics] == ["MD210"]


# code, text of SMALL, what stands in its place, what the caret is under, its width, a word of message or help
FAULTS = [
    ("MD210", "mass: {identity", "mas: {identity", "mas:", 3, "write 'mass'"),
    ("MD210", "run: {partials", "run: {partial", "partial:", 7, "write 'partials'"),
    ("MD210", "sd: 5 %,", "sd: 5 %, colour: red,", "colour", 6, "keys of parameters[1] are name"),
    ("MD210", "sd: 5 %,", "sd: 5 %, dofs: [1],", "dofs", 4, "'dofs' is a key of "),
    ("MD207", "{partials: 5}", "{partials: 5, partials: 6}", "partials: 6", 8, "given twice"),
    ("MD211", "  mass: {identity: 2}\n", "", "stiffness: {order", None, "model.mass is missing"),
    ("MD211", "name: b, ", "", "{sd: 0.5", None, "parameters[2].name is missing"),
    ("MD211", "frequency_sd: 1 %, ", "", "[1, 2], dofs", 6, "no frequency_sd"),
    ("MD211", "dofs: [1, 2], ", "", "[[1, 1], [2, -1]]", 17, "no dofs"),
    ("MD211", ", shape_sd: 2 %", "", "[[1, 1], [2, -1]]", 17, "no shape_sd"),
    ("MD211", "shapes: [[1, 1], [2, -1]], shape_sd: 2 %", "", "[1, 2], }", 6, "no shapes"),
    ("MD213", "partials: 5", "partials: five", "five", 4, "'five'"),
    ("MD213", "partials: 5", "partials: 5.5", "5.5", 3, "a whole number"),
    ("MD213", "partials: 5", "extra_update: 1", "1}\n", 1, "true or false"),
    ("MD213", "[1,1,3.0]", "[1,1,3.0d5]", "3.0d5", 5, "write the exponent with e: 3.0e5"),
    ("MD213", "[1,1,3.0]", "[1,1,'3.0']", "'3.0'", 5, "without quotes"),
    ("MD213", "[1,1,3.0]", "[1,1]", "[1,1]", 5, "[row, column, value]"),
    ("MD213", "[1,1,3.0]", "[1,1.5,3.0]", "1.5", 3, "a whole number"),
    ("MD213", "[1,1,3.0]", "[1,1,12:30]", "12:30", 5, "a number"),
    ("MD213", "nominal: 2.0", "nominal: [2]", "[2]", 3, "a list of 1"),
    ("MD213", "sd: 5 %", "sd: 5 percent", "5 percent", 9, "percentage"),
    ("MD213", "{identity: 2}", "7", "7\n", 1, "a mapping"),
    ("MD203", "partials: 5", "partials: !!python/name:os.system 5", "!!python", 25, "the tag !!python"),
    ("MD214", "partials: 5", "recursion: anchord", "anchord", 7, "write anchored"),
    ("MD214", "partials: 5", "confidence: 97", "97", 2, "90, 95, 99"),
    ("MD215", "mouse: 1", "mouse: 2", "2\n", 1, "must be 1"),
    ("MD215", "order: 2", "order: 0", "0, entries", 1, "from 1 to 1000000"),
    ("MD215", "identity: 2", "identity: 1000000000", "1000000000", 10, "from 1 to 1000000"),
    ("MD215", "partials: 5", "cycles: -1", "-1}", 2, "at least 0"),
    ("MD216", "frequency_sd: 1 %", "frequency_sd: [1, 2, 3]", "[1, 2, 3]", 9, "has 3 values"),
    ("MD216", "[[1, 1], [2, -1]]", "[[1, 1], [2]]", "[2]", 3, "has 1 values; expected 2"),
    ("MD216", "[[1, 1], [2, -1]]", "[[1, 1]]", "[[1, 1]]", 8, "expected 2 rows of 2"),
    (
        "MD216",
        "frequency: [1, 2]",
        "number: [1], frequency: [1, 2]",
        "[1],",
        3,
        "one value for each of the 2 modes",
    ),
    ("MD216", "frequency: [1, 2]", "frequency: []", "[]", 2, "empty"),
    ("MD216", "{identity: 2}", "{identity: 2}\n  labels: [a]", "[a]", 3, "1 names"),
    ("MD217", "{identity: 2}", "{identity: 2, diagonal: [1, 1]}", "{identity", 31, "exactly one form"),
    ("MD217", "{identity: 2}", "{}", "{}", 2, "order with entries"),
    ("MD220", "{identity: 2}", "{identity: 3}", "3}", 1, "has order 3, but model.stiffness has order 2"),
    (
        "MD221",
        "{identity: 2}",
        "{dense: [[1, 0], [0.5, 1]]}",
        "0.5, 1",
        3,
        "is 0.5, but its mirror image (1,2) is 0",
    ),
    ("MD222", "run:", "elements: {stiffness: [[1,1],[1,2]]}\nrun:", "[2,2,1]], mass", 7, "add [2, 2]"),
    ("MD223", "nominal: 2.0, ", "", "5 %", 3, "which is 0"),
    ("MD224", "sd: 0.5, ", "", "{name: b", None, "parameters[2] has no sd"),
    ("MD225", "dofs: [1, 2]", "dofs: [1, tip]", "tip", 3, "no labels"),
    ("MD226", "{identity: 2}", "{identity: 2}\n  labels: [a, a]", "a]\nparam", 1, "label 'a' is given twice"),
    ("MD229", "run:", "prior: {correlations: [[a, c, 0.1]]}\nrun:", "c, 0.1", 1, "no parameter"),
    ("MD230", "run:", "prior: {correlations: [[a, b, 1.5]]}\nrun:", "1.5", 3, "within -1 to 1"),
    ("MD230", "run:", "prior: {correlation: [[2, 0], [0, 1]]}\nrun:", "2, 0]", 1, "must be 1"),
    ("MD229", "sd: 0.5, ", "power_of: [c, 2], ", "c, 2], st", 1, "no parameter"),
    ("MD213", "sd: 0.5, ", "power_of: a, ", "a, st", 1, "[parameter, exponent]"),
    ("MD232", "sd: 0.5, ", "power_of: [a, 2], ", "a, 2], st", 1, "no transform log"),
    ("MD232", "sd: 0.5, ", "sd: 0.5, power_of: [a, 2], ", "0.5, pow", 3, "sd of its own"),
    (
        "MD232",
        "sd: 5 %, stiffness: [[1,1,1]]}\n  - {name: b, sd: 0.5, ",
        "sd: 5 %, transform: log, stiffness: [[1,1,1]]}\n  - {name: b, power_of: [a, 0], ",
        "0], st",
        1,
        "not 0",
    ),
    ("MD231", "{identity: 2}", "{file: /etc/passwd}", "/etc/passwd", 11, "not below"),
    ("MD231", "{identity: 2}", "{file: ../m.mtx}", "../m.mtx", 8, "not below"),
    ("MD301", "[1,1,3.0]", "[1,7,3.0]", "[1,7,3.0]", 9, "outside 2 x 2"),
    ("MD303", "[2,2,1.0]", "[2,2,1.0],[2,1,9.0]", "[2,1,9.0]", 9, "given twice"),
    ("MD320", "frequency: [1, 2]", "number: [1, 5], frequency: [1, 2]", "5]", 1, "5"),
    ("MD322", "frequency: [1, 2]", "frequency: [3, 2]", "2], freq", 1, "ascending"),
    ("MD323", "dofs: [1, 2]", "dofs: [1, 3]", "3], sh", 1, "outside 1 to 2"),
    ("MD324", "dofs: [1, 2]", "dofs: [1, 1]", "1], sh", 1, "measured twice"),
    ("MD325", "frequency_sd: 1 %", "frequency_sd: 1e-310", "1e-310", 6, "above 1e-30"),
    ("MD326", "shape_sd: 2 %", "shape_sd: 0", "0}", 1, "must be positive"),
    ("MD326", "shape_sd: 2 %", "shape_sd: 1e-310", "1e-310", 6, "above 1e-30"),
]


@pytest.mark.parametrize(("code", "old", "new", "caret", "width", "word"), FAULTS, ids=lambda v: str(v)[:24])
def test_each_fault_has_its_code_and_place(code, old, new, caret, width, word):
    text = swapped(old, new)
    found = [d for d in findings(text) if d.code == code]
    assert found, f"{code} expected, found {[d.headline for d in findings(text)]}"
    first = found[0]
    assert (first.span.file, first.span.line, first.span.column) == ("deck.yaml", *place(text, caret))
    assert first.span.text == text.splitlines()[first.span.line - 1]
    assert width is None or first.span.width == width
    assert word in f"{first.message} {first.help}"
    assert first.help, "every error ends with a remedy"
    assert "^" * first.span.width in frame(first)


SYNTAX = [
    ("MD200", "mouse: 1\ntitle: a\x07b\n", 2, 9),
    ("MD200", b"mouse: 1\ntitle: caf\xe9\n", 2, 11),
    ("MD201", "mouse: 1\nmodel: {a: [1, 2\n", 3, 1),
    ("MD201", "mouse: 1\nmodel:\n\ta: 1\n", 3, 1),
    ("MD201", "mouse: 1\ntitle: a: b\n", 2, 9),
    ("MD201", "mouse: 1\nmodel: *missing\n", 2, 8),
    ("MD202", "mouse: 1\nmodel: " + "[" * 100 + "]" * 100, 2, 8 + MAX_DEPTH - 2),
    (
        "MD202",
        "a: &a [1,1,1,1,1,1,1,1,1,1]\n"
        + "".join(f"{chr(98 + i)}: &{chr(98 + i)} [{','.join(['*' + chr(97 + i)] * 10)}]\n" for i in range(9)),
        1,
        1,
    ),
    ("MD202", "mouse: &a [*a]\n", 1, 1),
    ("MD204", "mouse: 1\n---\nmouse: 1\n", 2, 1),
    ("MD205", "", 1, 1),
    ("MD205", "# nothing\n", 1, 1),
    ("MD205", "- 1\n- 2\n", 1, 1),
]


@pytest.mark.parametrize(("code", "text", "line", "column"), SYNTAX, ids=range(len(SYNTAX)))
def test_text_that_is_no_deck(code, text, line, column):
    with pytest.raises(DeckError) as caught:
        yaml_deck.read(text, "deck.yaml")
    first = caught.value.diagnostics[0]
    assert (first.code, first.span.line, first.span.column) == (code, line, column)


def test_all_faults_are_reported_at_once_in_the_order_of_the_file():
    text = swapped("mouse: 1", "mouse: 9")
    text = swapped("identity: 2", "identty: 2", text)
    text = swapped("sd: 0.5", "sd: half", text)
    text = swapped("frequency_sd: 1 %", "frequency_sd: [1]", text)
    text = swapped("partials: 5", "pairing: mak", text)
    found = findings(text)
    assert [d.code for d in found] == ["MD215", "MD217", "MD210", "MD213", "MD216", "MD214"]
    assert [d.span.line for d in found] == [1, 4, 4, 7, 9, 10]


def test_many_faults_of_one_list_do_not_flood():
    entries = ",".join("[x,y,z]" for _ in range(5000))
    found = findings(swapped("[1,1,3.0]", entries))
    assert 3 <= len(found) <= 60
    assert len(findings("mouse: 1\n" + "".join(f"k{i}: 1\n" for i in range(5000)))) == MAX_FINDINGS


def test_one_fault_is_one_finding():
    assert len(findings(swapped("frequency_sd: 1 %", "frequency_sd: small"))) == 1
    assert len(findings(swapped("shape_sd: 2 %", "shape_sd: small"))) == 1
    assert len(findings(swapped("sd: 5 %", "sd: small"))) == 1


def test_a_byte_order_mark_and_carriage_returns_are_no_fault():
    windows = b"\xef\xbb\xbf" + SMALL.replace("\n", "\r\n").encode()
    np.testing.assert_array_equal(problem(windows).A, problem(SMALL).A)
    assert findings(windows.replace(b"partials: 5", b"partials: x"))[0].span.line == 10


def test_a_link_that_leads_out_of_the_folder_is_refused(tmp_path):
    (tmp_path / "secret.csv").write_text("1,0\n0,1\n")
    folder = tmp_path / "decks"
    folder.mkdir()
    (folder / "m.csv").symlink_to(tmp_path / "secret.csv")
    (folder / "deck.yaml").write_text(swapped("{identity: 2}", "{file: m.csv}"))
    with pytest.raises(DeckError, match="MD231"):
        read_deck(folder / "deck.yaml")


def test_format_is_told_by_content_or_suffix():
    assert read_draft("# a deck\n\n" + SMALL, "-").source.format == "yaml"
    with pytest.raises(DeckError, match="MD205"):
        read_draft("", "empty.yml")
    with pytest.raises(DeckError) as caught:
        read_draft("MOUSE: A CASE HEADING\n", "-")
    assert all(d.code < "MD200" for d in caught.value.diagnostics), "upper-case headings are cards"


def test_legacy_is_a_run_option_of_both_formats():
    assert read_draft(SMALL, "deck.yaml", legacy=True).run.legacy
    assert not read_draft(SMALL, "deck.yaml").run.legacy


def test_written_deck_keeps_source_and_is_whole(tmp_path):
    path = tmp_path / "chain.yaml"
    path.write_text("what stood there before")
    assert write_deck(problem(CHAIN), path) == [str(path)]
    assert [p.name for p in tmp_path.iterdir()] == ["chain.yaml"]
    text = path.read_text()
    assert "source: NASA CR, Table 5-3" in text and "2.5e+05" in text
    again = read_deck(path)
    np.testing.assert_array_equal(again.structure.K, problem(CHAIN).structure.K)
    write_deck(again, path)
    assert path.read_text() == text


def test_each_code_is_explained_and_emitted():
    package = Path(mouse_cli.__file__).parent
    sources = [*package.glob("formats/yaml_deck/*.py"), *package.glob("formats/matrix_files/*.py")]
    sources += [package / "_atomic.py", package / "formats" / "__init__.py"]
    constants = [
        node.value
        for path in sources
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.Constant)
    ]
    emitted = {value for value in constants if isinstance(value, str) and re.fullmatch(r"MD\d\d\d", value)}
    assert emitted <= set(catalogue())
    assert all(code.title and code.meaning and code.remedy for code in CODES.values())


def test_faults_of_reading_do_not_hide_faults_of_meaning():
    deck = """\
mouse: 1
title: faults of both kinds
model:
  stiffness: {order: 2, entries: [[1,1,2.0],[1,2,-1.0],[2,2,2.0],[3,3,1.0]]}
  mass: {diagonal: [1, x]}
parameters:
  - {name: k, sd: -1, nominal: 1.0, stiffness: [[1,1,1]]}
test:
  modes: {number: [1, 5], dofs: [1, 7], frequency: [0.1, -0.2], frequency_sd: 0.01, shapes: [[1, 1],[1, -1]], shape_sd: 1}
run: {partials: 0}
"""
    told = [(found.code, found.span.line) for found in findings(deck)]
    expected = [("MD301", 4), ("MD213", 5), ("MD311", 7), ("MD320", 9), ("MD323", 9), ("MD321", 9), ("MD215", 10)]
    assert told == expected


@pytest.mark.parametrize(
    ("frequency", "code"),
    [("1e-150", "MD321"), ("1e300", "MD321"), ("-3", "MD321"), ("1e-8", None)],
)
def test_frequencies_that_no_structure_has(frequency, code):
    """One error each: squares of their misfits are no numbers, and what follows from them is no mistake of its own."""
    deck = f"""mouse: 1
model: {{stiffness: {{diagonal: [1.0e+3, 2.0e+3]}}, mass: {{diagonal: [1.0, 1.0]}}}}
parameters: [{{name: k, nominal: 1, sd: 10 %, stiffness: [[1, 1, 1.0e+3]]}}]
test: {{modes: {{frequency: [{frequency}, 7.0], frequency_sd: 1 %}}}}
"""
    assert [found.code for found in findings(deck) if found.severity == "error"] == ([code] if code else [])


def test_a_power_of_a_parameter_follows_it(tmp_path):
    """A strip of thickness t = 2: k = t^3 and m = t on a mode of omega = t, so that a test at omega = 2.2 says t and its cube."""
    text = """mouse: 1
model: {stiffness: {dense: [[8]]}, mass: {diagonal: [2]}}
parameters:
  - {name: cube, power_of: [t, 3], stiffness: [[1, 1, 1]]}
  - {name: t, nominal: 2, unit: mm, sd: 10 %, lower: 1, transform: log, mass: [[1, 1, 1]]}
test: {modes: {frequency: [0.350140875], frequency_sd: 0.0001 %}}
"""
    found = problem(text)
    cube = found.parameters[0]
    assert (cube.nominal, cube.unit, cube.lower, cube.transform) == (8.0, "(mm)^3", 1.0, "log")
    assert np.allclose(found.prior.cov, [[2.4**2, 2.4 * 0.2], [2.4 * 0.2, 0.2**2]])
    assert np.allclose(mouse_cli.run(found).revised.theta, [2.2**3, 2.2], rtol=1e-6)
    write_deck(found, tmp_path / "again.yaml")
    assert np.allclose(mouse_cli.run(read_deck(tmp_path / "again.yaml")).revised.theta, [2.2**3, 2.2], rtol=1e-6)

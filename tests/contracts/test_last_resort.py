"""What no check foresaw ends in one finding, and findings without number end in few lines."""

import time
from pathlib import Path

import numpy as np
import pytest

from mouse_cli._errors import Diagnostic, frame
from mouse_cli._span import Span
from mouse_cli.cli.main import _run
from mouse_cli.methods import equation_error

DECKS = Path(__file__).resolve().parents[2] / "decks"
ENTRY = "mouse: 1\nmodel: {{stiffness: {{order: 2, entries: [{}]}}, mass: {{diagonal: [1.0, 1.0]}}}}\n"


def test_a_fault_of_mouse_is_one_finding(capsys, monkeypatch):
    """Whatever is raised, where it was, what to send, exit 5; the account of Python for those who want it."""
    monkeypatch.setattr("mouse_cli.cli.commands.run.command.callback", lambda **given: [][1])
    deck = str(DECKS / "sound_chain.yaml")
    assert _run(["run", deck]) == 5
    said = capsys.readouterr().err
    assert "error[MD903]: IndexError" in said and "report it with the deck" in said and "Traceback" not in said
    monkeypatch.setenv("MOUSE_TRACEBACK", "1")
    with pytest.raises(IndexError):
        _run(["run", deck])


def test_a_method_whose_algebra_fails_gives_no_answer(capsys, monkeypatch):
    def fails(*given: object) -> None:
        raise np.linalg.LinAlgError("Eigenvalues did not converge")

    monkeypatch.setattr(equation_error, "least_error", fails)
    assert _run(["compare", str(DECKS / "sound_chain.yaml"), "--method", "equation-error"]) == 5
    assert "MD570" in capsys.readouterr().err


@pytest.mark.parametrize(
    "change, code",
    [
        ("sd: 1.0e+200", "MD311"),
        ("sd: 5, stiffness: [[1, 2, -1.0e+300]]", "MD302"),
        ("sd: 5, nominal: 1.0e+300", "MD302"),
    ],
)
def test_numbers_of_which_no_products_can_be_made(capsys, tmp_path, change, code):
    deck = tmp_path / "deck.yaml"
    own = {"nominal": "100", "stiffness": "[[1, 1, 1]]"}
    rest = ", ".join(f"{key}: {value}" for key, value in own.items() if f"{key}:" not in change)
    text = ENTRY.format("[1, 1, 100.0], [2, 2, 100.0]") + f"parameters: [{{name: k, {change}, {rest}}}]\n"
    deck.write_text(text + "test: {modes: {frequency: [1.6], frequency_sd: 1 %}}\n")
    assert _run(["run", str(deck)]) == 4
    said = capsys.readouterr()
    assert f"error[{code}]" in said.err and "1e+150" in said.err + "1e+150" * (code == "MD302") and not said.out


def test_a_mass_beside_which_stiffnesses_are_no_numbers(capsys, tmp_path):
    deck = tmp_path / "deck.yaml"
    deck.write_text(ENTRY.replace("[1.0, 1.0]", "[1.0, 5.0e-324]").format("[1, 1, 1.0e+5], [2, 2, 1.0e+5]"))
    assert _run(["modes", str(deck)]) == 5
    assert "error[MD501]" in (said := capsys.readouterr()).err and "4.94e-324" in said.err and not said.out


def test_many_findings_of_one_kind_are_counted(capsys, tmp_path):
    """Messages do not grow with the file, and twenty thousand entries in one line are read in seconds."""
    deck, begun = tmp_path / "deck.yaml", time.process_time()
    deck.write_text(ENTRY.format(", ".join(f"[1, 1, {i}.0]" for i in range(1, 20_001))))
    assert _run(["check", str(deck)]) == 4
    said = capsys.readouterr().err
    assert said.count("[MD303]") == 19 and "19999 elements of K in all are given twice" in said and len(said) < 20_000
    assert time.process_time() - begun < 30


def test_the_place_is_shown_however_far_to_the_right():
    text = " ".join(str(i) for i in range(100_000))
    column = text.index(" 77777 ") + 2
    shown = frame(Diagnostic("MD303", "error", "twice", Span("deck.yaml", 2, column, 5, text))).splitlines()
    caret = shown[2].index("^")
    assert shown[1][caret : caret + 5] == "77777" and shown[2].count("^") == 5 and max(map(len, shown)) <= 160


UNRELATED = """\
mouse: 1
model: {stiffness: {order: 2, entries: [[1, 1, 100.3], [2, 2, 250.0]]}, mass: {diagonal: [1, 2.0]}}
parameters: [{name: k, nominal: 4.0, sd: 10 %, lower: 0, stiffness: [[1, 1, 150]]}]
test: {modes: {frequency: [1.6, 1.75], frequency_sd: 1 %, dofs: [1, 2], shapes: [[1, 0], [0, ~]], shape_sd: 0.1}}
run: {recursion: anchored, cycles: 2}
"""


def test_a_mode_that_no_fit_holds_has_a_line_all_the_same(capsys, tmp_path):
    """Mode 2 is related to none of the model: its frequency of the test stands alone."""
    (tmp_path / "deck.yaml").write_text(UNRELATED)
    assert _run(["diagnose", str(tmp_path / "deck.yaml"), "--causes", "1"]) in (0, 1)
    table = capsys.readouterr().out.partition("FITTED DATA")[2].split("\n")
    assert any(line.split() == ["2", "1.7500"] for line in table)


def test_no_modes_are_kept_of_parts(tmp_path):
    """A part without boundary that keeps no mode has no coordinates."""
    for path in (DECKS / "coupled").glob("*.yaml"):
        text = path.read_text().replace("keep: [3, 6, 10]", "keep: [0, 6]")
        (tmp_path / path.name).write_text(text)
    assert _run(["couple", str(tmp_path / "portal.yaml"), "-o", str(tmp_path / "out.txt")]) == 0


def test_a_mechanism_may_have_no_site_where_parameters_end(tmp_path):
    """Ties the second property to nothing but the ground, so that no link is left where the parameters end."""
    text = (
        (DECKS / "table_5_1.yaml").read_text().replace("[1, 2, -1]", "[1, 2, 0]").replace("54.62878867", "59.62878867")
    )
    text = text.replace("[1.0, 1.0, 1.0, 1.0]", "[1.0, 1.7, 1.0, 1.0]").replace("-0.584744", "-6.584744")
    (tmp_path / "deck.yaml").write_text(text.replace("225000.0", "225800.0"))
    assert _run(["diagnose", str(tmp_path / "deck.yaml"), "--causes", "1"]) in (0, 1)


@pytest.mark.filterwarnings("error")
def test_values_that_nothing_measures_are_not_measured(capsys, tmp_path):
    """Of 400 lines of a resonance one is 1e200: fourth powers of it are no numbers."""
    hz = np.linspace(1, 9, 400)
    H = 1 / (25 - hz**2 + 0.1j * hz)
    H[33] = 1e200
    rows = [f"{x:.6g},{h.real:.9g}{h.imag:+.9g}j\n" for x, h in zip(hz, H, strict=True)]
    (tmp_path / "deck.yaml").write_text(FUNCTION)
    (tmp_path / "run.csv").write_text("f,a\n" + "".join(rows))
    assert _run(["identify", str(tmp_path / "deck.yaml")]) in (0, 1)
    assert "MODE" in capsys.readouterr().out


FUNCTION = """\
mouse: 1
model: {stiffness: {order: 1, entries: [[1, 1, 987.0]]}, mass: {diagonal: [1]}}
parameters: [{name: k, sd: 10, stiffness: [[1, 1, 1]]}]
test: {frf: [{file: run.csv, kind: receptance, input: 1, outputs: {1: a}, sd: 1 %}]}
"""


@pytest.mark.filterwarnings("error")
def test_an_accuracy_beyond_all_numbers(capsys, tmp_path):
    (tmp_path / "deck.yaml").write_text(FUNCTION.replace("1 %", "1e+200"))
    (tmp_path / "run.csv").write_text("f,a\n" + "".join(f"{k},1+0j\n" for k in range(1, 50)))
    assert _run(["run", str(tmp_path / "deck.yaml")]) in (4, 5)
    said = capsys.readouterr().err
    assert "error[MD" in said and "MD903" not in said


@pytest.mark.filterwarnings("ignore:overflow")
def test_dashpots_of_masses_that_hardly_are(capsys, tmp_path):
    """c/m is beyond all numbers, though k/m is none of those that are looked for."""
    model = "{stiffness: {order: 2, entries: [[1, 1, 5.0e+4], [1, 2, -3.0e+4], [2, 2, 3.0e+4]]}, mass: {diagonal: [5.0e-324, 1]},"
    model += " damping: {order: 2, entries: [[1, 1, 1.0e+9], [2, 2, 3.6]]}}"
    (tmp_path / "deck.yaml").write_text(
        f"mouse: 1\nmodel: {model}\nparameters: [{{name: k, sd: 10, stiffness: [[1, 1, 1]]}}]\n"
    )
    assert _run(["modes", str(tmp_path / "deck.yaml")]) in (4, 5)
    said = capsys.readouterr().err
    assert "error[MD" in said and "MD903" not in said


def test_a_bootstrap_of_what_hardly_varies(capsys, tmp_path):
    """The variance of the property is no floating-point number but 0, so that it is held."""
    text = (
        "mouse: 1\nmodel: {stiffness: {order: 2, entries: [[1, 1, 100.0], [2, 2, 400.0]]}, mass: {diagonal: [1, 1]}}\n"
    )
    text += "parameters: [{name: k, nominal: 1e-308, sd: 10 %, stiffness: [[1, 1, 1]]}]\n"
    (tmp_path / "deck.yaml").write_text(text + "test: {modes: {frequency: [1.6, 3.2], frequency_sd: 1 %}}\n")
    asked = ["--replicates", "2", "-j", "1", "-o", str(tmp_path / "out")]
    assert _run(["bootstrap", str(tmp_path / "deck.yaml"), *asked]) in (0, 1, 4, 5)
    assert "MD903" not in capsys.readouterr().err


def test_a_bootstrap_by_an_estimator_that_there_is_not(capsys, tmp_path):
    """It asks the estimator whether data may count twice before a cycle does."""
    deck = tmp_path / "deck.yaml"
    deck.write_text((DECKS / "sound_chain.yaml").read_text().replace("run: {", "run: {estimator: replaced, "))
    assert _run(["bootstrap", str(deck), "--replicates", "2", "-o", str(tmp_path / "out")]) == 4
    assert "error[MD334]" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("deck", "old", "new"),
    [
        ("ground_spring_proved", "[[3, 3, 1], [3, 4, -1], [4, 4, 1]]", "[[3, 3, 1e9], [3, 4, -1], [4, 4, 1]]"),
        ("four_storey_frame", "[-0.37813, -1.0, 1.0, -0.16876]", "[-0.37813, -1.0, 1.0, 99999999]"),
    ],
)
def test_samples_where_the_data_outweigh_the_prior_beyond_rounding(capsys, tmp_path, deck, old, new):
    text = (DECKS / f"{deck}.yaml").read_text()
    assert old in text
    (tmp_path / "deck.yaml").write_text(text.replace(old, new))
    assert _run(["sample", str(tmp_path / "deck.yaml"), "--steps", "100"]) in (0, 1, 4, 5)
    assert "MD903" not in capsys.readouterr().err


def test_a_block_that_is_shorter_than_what_stands_before_a_stroke(capsys, tmp_path):
    """Four samples a block, ten before the stroke."""
    t = np.arange(400) / 100
    force = np.where(np.arange(400) % 100 == 50, 10.0, 0.0)
    rows = np.column_stack([t, force, np.sin(9 * t)])
    np.savetxt(tmp_path / "run.csv", rows, delimiter=",", header="t,f,a", comments="")
    asked = ["--force", "1=f", "--response", "2=a", "--unit", "f=N", "--unit", "a=m/s2", "--impact", "--lines", "2"]
    assert _run(["spectra", str(tmp_path / "run.csv"), *asked]) in (4, 5)
    said = capsys.readouterr().err
    assert "error[MD" in said and "MD903" not in said


@pytest.mark.filterwarnings("ignore")
def test_a_diagnosis_of_values_beyond_any_algebra(capsys, tmp_path):
    (tmp_path / "deck.yaml").write_text((DECKS / "ruler_tower.yaml").read_text().replace("E: 2.1e+11", "E: 2.1e+81"))
    assert _run(["diagnose", str(tmp_path / "deck.yaml"), "--causes", "1"]) in (1, 2, 4, 5)
    assert "MD903" not in capsys.readouterr().err

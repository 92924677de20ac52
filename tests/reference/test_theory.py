"""Errors of theory: one statement in the deck, allowed for and printed by every kind of diagnosis."""

import contextlib
import io
import json
import shutil
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pytest
from two_masses import linear, record

from mouse_cli._errors import DeckError
from mouse_cli.cli.main import _run
from mouse_cli.diagnosis.likelihoods.frf.data import lines
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.data import Data
from mouse_cli.formats import read_deck, write_deck
from mouse_cli.formats.cards.losses import losses
from mouse_cli.model.theory import Theory
from mouse_cli.page import page, read
from mouse_cli.updating.recordings.uncertain import uncertain

DECKS = Path(__file__).resolve().parents[2] / "decks"
N, K, MASS = 8, 2.0e5, 1.0
WRONG = np.array([0.8, -1.1, 0.4, 1.3, -0.7, -1.2, 0.9, -0.4]) / 100  # of each mass, which the model has all alike
GIVEN = "theory: {frequency: 0.1 %, shape: 0.005, mechanism: 2 %, configurations: 3 %, link_stiffness: 10 %, link_damping: 1}"
STATED = Theory(0.001, 0.005, 0.02, 0.03, 0.1, 1.0)


def chain(folder: Path, more: str = "", name: str = "chain") -> str:
    """Eight equal masses and springs to the model; those tested scatter by about 1 %, measured to 0.02 % and 0.2 %."""
    stiffness = K * (np.diag([2.0] * (N - 1) + [1.0]) - np.eye(N, k=1) - np.eye(N, k=-1))
    root = np.sqrt(MASS * (1 + WRONG))
    values, shapes = np.linalg.eigh(stiffness / np.outer(root, root))
    shapes = (shapes / root[:, None])[:, :5]
    path = folder / f"{name}.yaml"
    path.write_text(f"""mouse: 1
units: SI
model:
  structure:
    nodes: {{line: {{from: 0, to: {N}, start: [0, 0, 0], end: [{N}, 0, 0]}}}}
    elements:
      - {{id: 1-{N}, type: spring, nodes: 0-{N}, TX: {K}}}
      - {{id: 11-{10 + N}, type: mass, nodes: 1-{N}, mass: {MASS}}}
    supports: {{0: all}}
    directions: [TX]
parameters:
  - {{name: k, elements: 1-{N}, property: TX, sd: 3 %}}
test:
  modes:
    frequency: {(np.sqrt(values[:5]) / 2 / np.pi).tolist()}
    frequency_sd: 0.02 %
    dofs: {[f"{i}TX" for i in range(1, N + 1)]}
    shapes: {(shapes / np.abs(shapes).max(axis=0)).tolist()}
    shape_sd: 0.02
{more}
""")
    return str(path)


def asked(*arguments: str) -> tuple[str, dict]:
    """The printout and the document of a diagnosis."""
    out = Path(arguments[0]).with_suffix(".json")
    told = io.StringIO()
    with contextlib.redirect_stdout(told):
        assert _run(["diagnose", *arguments, "-q", "--full", "--report", str(out)]) in (0, 1)
    return " ".join(told.getvalue().split()), json.loads(out.read_text())


def test_a_deck_states_it_and_keeps_it(tmp_path):
    problem = read_deck(chain(tmp_path, GIVEN))
    assert problem.theory == STATED
    again = read_deck(write_deck(problem, str(tmp_path / "again.yaml"))[-1])
    assert again.theory == STATED
    assert read_deck(chain(tmp_path)).theory == Theory()
    assert read_deck(chain(tmp_path, "theory: {shape: 1 %}")).theory == replace(Theory(), shape=0.01)


@pytest.mark.parametrize(
    ("value", "code", "told"),
    [
        ("{frequency: 0}", "MD215", "theory.frequency is 0"),
        ("{frequency: -0.1}", "MD215", "theory.frequency is -0.1"),
        ("{shape: 150 %}", "MD215", "theory.shape is 1.5"),
        ("{mechanism: .nan}", "MD215", "theory.mechanism is nan"),
        ("{configurations: .inf}", "MD215", "theory.configurations is inf"),
        ("{link_damping: much}", "MD213", "theory.link_damping is 'much'"),
        ("{link_stiffness: [0.1]}", "MD213", "theory.link_stiffness is a list"),
        ("{frequencies: 1 %}", "MD210", "'frequencies' is not a key of theory"),
        ("1 %", "MD213", "theory is '1 %'"),
    ],
)
def test_what_cannot_be_meant_is_refused(tmp_path, value, code, told):
    path = chain(tmp_path, f"theory: {value}")
    with pytest.raises(DeckError) as caught:
        read_deck(path)
    (found,) = caught.value.diagnostics
    assert (found.code, found.span.line) == (code, Path(path).read_text().splitlines().index(f"theory: {value}") + 1)
    assert found.span.column > 1 and told in found.message


@pytest.mark.parametrize("value", [0.0, -1.0, 1.1, np.nan, np.inf])
def test_no_theory_is_exact(value):
    with pytest.raises(ValueError, match="above 0 and at most 1"):
        Theory(frequency=value)


def test_cards_say_that_they_do_not_hold_it():
    problem = read_deck(str(DECKS / "table_5_3.yaml"))
    lost = lambda one: [each.message for each in losses(one, lossy=True).warnings if "errors of theory" in each.message]
    assert not lost(problem)
    assert lost(replace(problem, theory=STATED))


def test_errors_of_theory_and_of_the_test_add(tmp_path):
    """Variances of ln f and of shapes; and an update is given only what exceeds the defaults."""
    problem = read_deck(chain(tmp_path, GIVEN))
    data, test = reduced(problem, problem.prior.mean).data, problem.test
    assert data.sd_log == pytest.approx(np.sqrt(0.0002**2 + 0.001**2))
    assert data.theory == pytest.approx(0.001)
    assert 1 / data._w == pytest.approx(np.sqrt(0.02**2 + 0.005**2))
    wider = STATED.beyond_default(test)
    assert wider.frequency_sd_hz / test.frequency_hz == pytest.approx(np.sqrt(0.0002**2 + 0.001**2 - 0.0004**2))
    assert wider.shape_sd == pytest.approx(np.sqrt(0.02**2 + 0.005**2 - 0.002**2))
    assert Theory().beyond_default(test) is test
    assert Theory(frequency=1e-5, shape=1e-5).beyond_default(test) is test
    assert Data(test, Theory(frequency=1e-9)).sd_log == pytest.approx(0.0002)


def test_a_model_that_is_slightly_wrong_is_accepted_with_its_error_of_theory(tmp_path):
    """Masses that scatter by 1 % move frequencies by up to 0.4 %, which a test of 0.02 % takes for missing physics."""
    _, strict = asked(chain(tmp_path))
    _, allowed = asked(chain(tmp_path, "theory: {frequency: 0.4 %}"))
    assert strict["verdict"]["kind"] != "nothing-missing" and strict["exit_code"] == 1
    assert strict["innovation"]["p"] < 1e-3 < allowed["innovation"]["p"]
    assert allowed["verdict"]["kind"] == "nothing-missing" and allowed["exit_code"] == 0


def test_a_mechanism_is_right_to_the_stated_share(tmp_path):
    """What a named spring to the ground leaves weighs less the less its theory is believed; no cause at all weighs the same."""
    source = (DECKS / "ground_spring.yaml").read_text()
    found = []
    for i, share in enumerate(("1 %", "20 %")):
        path = tmp_path / f"spring{i}.yaml"
        path.write_text(f"{source}\ntheory: {{mechanism: {share}}}\n")
        found.append({one["physics"]: one["chi2"] for one in asked(str(path))[1]["candidates"]})
    assert found[1]["ground-spring"] < 0.9 * found[0]["ground-spring"]
    assert found[1]["none"] == pytest.approx(found[0]["none"], rel=1e-6)


def test_functions_are_as_uncertain_as_stated():
    """Real and imaginary part share the variance of the largest response at a line."""
    (test,) = read_deck(str(DECKS / "chain_functions.yaml")).frf
    none, usual, stated = (lines(test, each) for each in (Theory(shape=1e-12), Theory(), STATED))
    added = [np.sqrt((one.sd**2 - none.sd**2)[one.has]) for one in (usual, stated)]
    assert added[1] == pytest.approx(added[0] * 0.005 / 0.002, rel=1e-6)


def test_links_of_recordings_are_as_uncertain_as_stated(tmp_path):
    """k1 is a parameter of the deck; the spring between the masses, and all damping, no parameter reaches."""
    path = Path(record(tmp_path, linear))
    path.write_text("".join(line for line in path.read_text().splitlines(True) if "name: k2" not in line))
    problem = read_deck(str(path))
    usual, stated = (uncertain(replace(problem, theory=each), 60.0, np.eye(2)) for each in (Theory(), STATED))
    links = [i for i, name in enumerate(usual.linear.names) if "between" in name]
    (_, dC, dK), (_, more_C, more_K) = (np.array(each.linear.slopes)[:, links] for each in (usual, stated))
    assert np.abs(dK).max() == pytest.approx(0.05 * 3e4)
    assert more_K == pytest.approx(2 * dK) and more_C == pytest.approx(2 * dC)
    assert np.abs(more_C).max() == pytest.approx(3.6)
    assert "stiffness (sd 10 %) and damping (sd 100 %)" in stated.remarks[0]


def given(path: Path, folder: Path) -> str:
    """A copy of a deck, with GIVEN in it, beside the files that it names."""
    copy = folder / f"{path.stem}_with_theory.yaml"
    copy.write_text(path.read_text() + "\n" + GIVEN + "\n")
    return str(copy)


OF_MODES = "0.1 % of each frequency, 0.5 % of the largest component of each shape"


def kinds(folder: Path) -> dict[str, tuple[list[str], str, set[str]]]:
    """Of each kind of test: decks, what is printed, and the keys of its document."""
    functions = folder / "functions"
    functions.mkdir()
    source = DECKS / "chain_functions.yaml"
    shutil.copytree(DECKS / "chain_functions", functions / "chain_functions")
    return {
        "modes": ([chain(folder, GIVEN)], f"{OF_MODES}, 2 % of what a mechanism does", {"mechanism"}),
        "functions": (
            [given(source, functions)],
            f"{OF_MODES}, and of the largest response at each line, 2 % of what a mechanism does",
            {"mechanism"},
        ),
        "configurations": (
            [chain(folder, GIVEN, "one"), chain(folder, GIVEN, "two")],
            f"{OF_MODES}, 3 % of each frequency in all configurations alike.",
            {"configurations"},
        ),
        "recordings": (
            [given(Path(record(folder, linear)), folder)],
            "10 % of the stiffness of each part that no parameter of the deck reaches, 100 % of its damping",
            {"link_stiffness", "link_damping"},
        ),
    }


@pytest.mark.parametrize("kind", ["modes", "functions", "configurations", "recordings"])
def test_every_kind_of_diagnosis_states_it(tmp_path, kind):
    decks, words, keys = kinds(tmp_path)[kind]
    printed, found = asked(*decks)
    assert f"Errors of theory allowed for (sd): {words}" in printed
    used = keys if kind == "recordings" else keys | {"frequency", "shape"}
    assert found["theory"] == {key: value if key in used else None for key, value in asdict(STATED).items()}
    shown = page(read(json.dumps(found).encode(), "answer.json"))
    assert "Errors of theory allowed for" in shown and shown.count("data-value") >= len(used)


def test_the_common_sd_of_the_command_line_is_used_in_place_of_that_of_the_decks(tmp_path):
    decks = [chain(tmp_path, GIVEN, "one"), chain(tmp_path, GIVEN, "two")]
    printed, found = asked(*decks, "--common-sd", "0.5")
    assert found["common_sd"] == found["theory"]["configurations"] == 0.005
    assert "0.5 % of each frequency in all configurations alike" in printed
    assert asked(*decks)[1]["common_sd"] == 0.03


def test_configurations_are_models_of_one_theory(tmp_path, capsys):
    decks = [chain(tmp_path, GIVEN, "one"), chain(tmp_path, "theory: {shape: 1 %}", "two")]
    assert _run(["diagnose", *decks]) == 4
    told = capsys.readouterr().err
    assert "MD690" in told and "errors of theory" in told and "two.yaml:20:" in told

"""`mouse compare` and `--method` as a user meets them: exit codes, documents, refusals with their place and a remedy."""

import json
from pathlib import Path

import pytest

from mouse_cli import report
from mouse_cli.cli.main import _run
from mouse_cli.formats import read_deck, yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.methods import method, registry
from mouse_cli.methods.update import compare, update
from mouse_cli.model.updated import ASPECTS, KEPT, LOST, PARTLY, Compared, Updated
from mouse_cli.report.renderers.printout import WIDTH
from mouse_cli.report.section import Options, sections
from mouse_cli.report.section import registry as every_section

DECKS = Path(__file__).resolve().parents[2] / "decks"
FRAME, CHAIN, FUNCTIONS = (str(DECKS / f"{name}.yaml") for name in ("tube_frame", "table_5_2", "chain_functions"))
BEAMS = """\
mouse: 1
model:
  structure:
    nodes: {1: [0, 0], 2: [1, 0], 3: [2, 0]}
    elements:
      - {id: 1-2, type: beam, nodes: 1-3, E: 2.0e+11, A: 2.0e-4, Iz: 2.0e-9, density: 7800}
      - {id: 3, type: mass, nodes: [3], mass: 0.5}
    supports: {1: [TX, TY, RZ]}
    plane: XY
    generic:
      - {name: both, elements: 1-2}
test:
  modes: {frequency: [1.2, 9.0], frequency_sd: 1 %, dofs: [2TY, 3TY], shapes: [[0.3, 1], [1, -0.2]], shape_sd: 0.05}
"""


def code(capsys, *arguments: str) -> tuple[int, str, str]:
    status = _run(list(arguments))
    captured = capsys.readouterr()
    return status, captured.out, captured.err


@pytest.mark.parametrize(
    ("arguments", "status"),
    [
        (("run", FRAME, "--method", "baruch"), 1),
        (("run", CHAIN, "--method", "equation-error"), 0),
        (("run", CHAIN, "--method", "inverse-eigensensitivity"), 0),
        (("run", FUNCTIONS, "--method", "response-function"), 1),
        (("run", CHAIN, "--method", "generic"), 4),
        (("run", CHAIN, "--method", "response-function"), 4),
        (("run", CHAIN, "--method", "nonsense"), 2),
        (("run", CHAIN, "--expand", "guyan"), 2),
        (("run", CHAIN, "--method", "baruch", "--expand", "nonsense"), 2),
        (("run", CHAIN, "--method", "baruch", "--plot", "a.png"), 2),
        (("compare", CHAIN, "--method", "baruch", "--method", "generic"), 0),
        (("compare", CHAIN, "--method", "generic"), 4),
        (("compare", CHAIN, "--method", "nonsense"), 2),
        (("list", "methods"), 0),
        (("explain", "kabe-rigid"), 0),
        (("explain", "methods"), 0),
    ],
)
def test_exit_codes(capsys, arguments, status):
    assert code(capsys, *arguments)[0] == status


@pytest.mark.parametrize("key", registry())
def test_every_method_says_what_it_guarantees(key):
    told = method(key).about
    assert [g.aspect for g in told.guarantees] == list(ASPECTS)
    assert {g.given for g in told.guarantees} <= {KEPT, LOST, PARTLY}
    assert all(g.why and not g.why.endswith(".") for g in told.guarantees)
    assert told.equation and told.source


@pytest.mark.parametrize("key", ["baruch", "berman", "gravitz", "kabe", "kabe-rigid"])
def test_matrices_without_physics_are_warned_of(capsys, key):
    status, out, _ = code(capsys, "run", CHAIN, "--method", key, "-q")
    assert status == 1 and "MD562" in out
    assert "without a physical model" in " ".join(out.split())


@pytest.mark.parametrize("subject", [Updated, Compared])
def test_reports_in_every_form(subject):
    problem = read_deck(DECKS / "table_5_2.yaml")
    found = update(problem, "kabe") if subject is Updated else compare(problem)
    assert isinstance(found, subject)
    every = every_section().values()
    assert {s.key for s in sections(subject)} == {s.key for s in every if subject in s.subjects}
    for numbers in ("legacy", "modern"):
        lines = report.printout(found, numbers).split("\n")
        assert max(map(len, lines)) <= WIDTH and all(line == line.rstrip() for line in lines)
    assert report.markdown(found).startswith("## ")
    json.dumps(report.document(found), allow_nan=False)
    assert list(sections(subject)[0].blocks(found, Options()))


def test_json(capsys):
    status, out, _ = code(capsys, "run", CHAIN, "--method", "baruch", "--json", "-q")
    document = json.loads(out)
    assert status == document["exit_code"] == 1
    assert document["schema"] == "mouse.update/1" and document["physical"] is False
    assert len(document["stiffness"]) == len(document["dofs"]) == 4
    document = json.loads(code(capsys, "compare", CHAIN, "--json", "-q")[1])
    assert document["schema"] == "mouse.comparison/1"
    keys = {one["method"] for one in document["methods"]} | set(document["refused"])
    assert keys == set(registry())


@pytest.mark.parametrize(
    ("before", "after", "expected"),
    [
        ("elements: 1-2}", "elements: 1-2, couplings: [k14]}", "MD460"),
        ("elements: 1-2}", "elements: [1, 7]}", "MD403"),
        ("elements: 1-2}", "elements: [1, 3]}", "MD462"),
        ("elements: 1-2}", "elements: 1-2}\n      - {name: again, elements: 2}", "MD461"),
        ("type: beam,", "type: beam, theory: timoshenko,", "MD462"),
    ],
)
def test_generic_groups_that_cannot_be(capsys, tmp_path, before, after, expected):
    path = tmp_path / "deck.yaml"
    path.write_text(BEAMS.replace(before, after))
    status, _, err = code(capsys, "run", str(path), "--method", "generic")
    assert status == 4 and f"error[{expected}]" in err
    assert "deck.yaml:" in err and "^" in err and "= help:" in err


def test_mode_without_a_shape(capsys, tmp_path):
    path = tmp_path / "deck.yaml"
    path.write_text(BEAMS.replace("[[0.3, 1], [1, -0.2]]", "[[0.3, null], [1, null]]"))
    status, _, err = code(capsys, "run", str(path), "--method", "baruch")
    assert status == 4 and "MD560" in err and "mode 2" in err


def test_large_models_are_refused_before_they_are_made_full(capsys, tmp_path):
    """2001 masses in a row: K of Baruch would be full."""
    path, n = tmp_path / "deck.yaml", 2001
    springs = "\n".join(f"      - [{i}, {i + 1}, -1.0]" for i in range(1, n))
    diagonal = "\n".join(f"      - [{i}, {i}, 2.5]" for i in range(1, n + 1))
    path.write_text(
        f"mouse: 1\nmodel:\n  stiffness:\n    order: {n}\n    entries:\n{diagonal}\n{springs}\n"
        f"  mass: {{identity: {n}}}\ntest:\n  modes: {{frequency: [0.12], frequency_sd: 1 %, dofs: [1, 2], shapes: [[1], [1]], "
        "shape_sd: 0.1}\n"
    )
    status, _, err = code(capsys, "run", str(path), "--method", "baruch")
    assert status == 5 and "MD561" in err and "2001" in err


def test_properties_that_are_not_determined(capsys, tmp_path):
    """One mode of two masses cannot tell four stiffnesses apart."""
    path = tmp_path / "deck.yaml"
    parameters = "\n".join(
        f"  - {{name: k{i}, nominal: 100, sd: 30 %, stiffness: [[{1 + i % 2}, {1 + i % 2}, 1]]}}" for i in range(4)
    )
    path.write_text(
        "mouse: 1\nmodel:\n  stiffness: {dense: [[400, -100], [-100, 300]]}\n  mass: {identity: 2}\n"
        f"parameters:\n{parameters}\n"
        "test:\n  modes: {frequency: [2.5], frequency_sd: 1 %, dofs: [1, 2], shapes: [[0.6], [1]], shape_sd: 0.01}\n"
    )
    status, _, err = code(capsys, "run", str(path), "--method", "equation-error")
    assert status == 5 and "MD567" in err and "k0" in err


@pytest.mark.parametrize(
    ("element", "name"),
    [("type: cracked_beam, depth: 1.2,", "depth"), ("type: thin_layer, nu: 0.5, thickness: 1.0e-4,", "nu")],
)
def test_properties_beyond_what_can_be(capsys, tmp_path, element, name):
    path = tmp_path / "deck.yaml"
    path.write_text(BEAMS.replace("type: beam,", element).split("    generic:")[0])
    status, _, err = code(capsys, "modes", str(path))
    assert status == 4 and "error[MD425]" in err and f"{name} of element 1" in err and "must be below" in err


def test_generic_groups_survive_writing():
    problem = assemble(yaml_deck.read(BEAMS.replace("elements: 1-2}", "elements: 1-2, couplings: [k12]}"), "deck.yaml"))
    again = assemble(yaml_deck.read(yaml_deck.write(problem)[0], "deck.yaml"))
    (one,), (other,) = problem.mesh.generic, again.mesh.generic
    assert (one.name, one.couplings, one.elements.tolist()) == (other.name, other.couplings, other.elements.tolist())

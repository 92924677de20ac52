"""The reference is current and complete: commands, options, deck keys, codes, statuses, JSON keys."""

import contextlib
import importlib.util
import io
import json
import re
import shutil
from collections.abc import Iterator

import click
import pytest
from diagnosis_examples import DIAGNOSES
from pages import DOCS, TOP

from mouse_cli._registry import discover
from mouse_cli.cli.main import cli, main
from mouse_cli.codes import catalogue
from mouse_cli.report import document
from mouse_cli.updating.statuses import STATUSES

REFERENCE = DOCS / "reference"


def _page(name: str) -> str:
    return (REFERENCE / name).read_text("utf-8")


def _told(*arguments: object) -> str:
    told = io.StringIO()
    with contextlib.redirect_stdout(told), contextlib.redirect_stderr(io.StringIO()), pytest.raises(SystemExit):
        main([str(a) for a in arguments])
    return told.getvalue()


def test_generated_pages_are_current():
    spec = importlib.util.spec_from_file_location("generate", DOCS / "generate.py")
    generate = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(generate)
    for path, text in generate.pages().items():
        assert path.read_text("utf-8") == text, f"{path.relative_to(TOP)} is not current: run python docs/generate.py"


def test_commands_and_options():
    page = _page("cli.md")
    context = click.Context(cli)
    for name in cli.list_commands(context):
        _, found, section = page.partition(f"## mouse {name}\n")
        assert found, f"mouse {name} is not documented"
        section = section.partition("\n## ")[0]
        for parameter in cli.get_command(context, name).params:
            for option in (*parameter.opts, *parameter.secondary_opts):
                if option.startswith("-"):
                    assert re.search(rf"(?<![\w-]){re.escape(option)}(?![\w-])", section), f"mouse {name} {option}"


def _keys(schema: object) -> Iterator[str]:
    """Every property name of a JSON Schema."""
    if isinstance(schema, dict):
        yield from schema.get("properties", {})
        for value in schema.values():
            yield from _keys(value)
    elif isinstance(schema, list):
        for value in schema:
            yield from _keys(value)


def test_deck_keys():
    page = _page("yaml.md")
    keys = set(_keys(json.loads(_told("explain", "schema"))))
    assert {"mouse", "model", "frequency_sd", "recursion"} <= keys
    assert not [key for key in sorted(keys) if f"| `{key}` |" not in page]


def test_codes():
    page = _page("codes.md")
    literals = {
        code
        for path in (TOP / "mouse_cli").rglob("*.py")
        if path.parent.name != "codes"
        for code in re.findall(r"\bMD\d{3}\b", path.read_text("utf-8"))
    }
    known = set(catalogue())
    assert literals - known == set(), "codes that the catalogue does not explain"
    assert known - literals == set(), "codes that nothing raises"
    for code in known:
        assert f"### {code}\n" in page


def test_statuses():
    page, recipe = _page("statuses.md"), (DOCS / "how-to" / "not-converged.md").read_text("utf-8")
    for status in STATUSES.values():
        assert f"| `{status.key}` |" in page
        if status.exit_code:
            assert f"`{status.key}`" in recipe, f"no advice on {status.key}"


def test_estimators():
    page, text = _page("estimators.md"), (DOCS / "explanation" / "estimators.md").read_text("utf-8")
    for key in discover("mouse_cli.estimators", "ESTIMATOR"):
        assert f"`{key}`" in page
        assert f"`{key}`" in text


def _paths(value: object, path: str = "") -> Iterator[str]:
    """Every key of a document, as `cycles[].theta`."""
    if isinstance(value, dict):
        for key, below in value.items():
            yield f"{path}.{key}".lstrip(".")
            yield from _paths(below, f"{path}.{key}".lstrip("."))
    elif isinstance(value, list):
        for below in value:
            yield from _paths(below, f"{path}[]")


def _documented(heading: str) -> set[str]:
    """First column of the tables below `## heading` of json.md."""
    section = _page("json.md").partition(f"## {heading}\n")[2].partition("\n## ")[0]
    return set(re.findall(r"^\| `([^`]+)` \|", section, flags=re.MULTILINE))


def test_json_of_run():
    decks = [[name] for name in ("table_5_2.yaml", "ground_spring.yaml", "twin_springs.yaml")]
    decks += [["single_frequency.yaml", "--estimator", "least-squares"]]
    emitted: set[str] = set()
    for deck, *more in decks:
        emitted.update(_paths(json.loads(_told("run", TOP / "decks" / deck, "--json", *more))))
    assert emitted == _documented("mouse.result/1")


def test_json_of_geometry():
    """A plane frame with sensors of modes has every key; those of other documents are among them."""
    told = json.loads(_told("run", TOP / "decks" / "cantilever.yaml", "--json"))
    assert set(_paths(told["geometry"])) == _documented("geometry")


def test_json_of_modes():
    emitted = set(_paths(json.loads(_told("modes", TOP / "decks" / "table_5_1.yaml", "--json"))))
    assert emitted == _documented("mouse.modes/1")


def test_json_of_spectra(tmp_path):
    path = tmp_path / "run.csv"
    t = [i / 100 for i in range(400)]
    rows = [f"{x:.2f},{((i * 7919) % 101) / 50 - 1},{((i * 104729) % 103) / 50 - 1}" for i, x in enumerate(t)]
    path.write_text("t,force (N),acc (g)\n" + "\n".join(rows))
    emitted = set(_paths(json.loads(_told("spectra", path, "--force", "force", "--lines", "20", "--json"))))
    assert emitted == _documented("mouse.spectra/1")


def test_json_of_correlate(tmp_path):
    """A deck with two close modes and a reversed sensor, so that every part of the document has an entry."""
    deck = tmp_path / "square.yaml"
    deck.write_text(CLOSE_AND_REVERSED)
    emitted = set(_paths(json.loads(_told("correlate", deck, "--expand", "dynamic", "--json"))))
    assert emitted == _documented("mouse.correlation/1")


def test_json_of_methods():
    """An update, and a comparison in which a method is refused; bounds and K where there are any."""
    decks = [("table_5_2.yaml", "equation-error"), ("table_5_2.yaml", "baruch"), ("tube_frame.yaml", "baruch")]
    emitted: set[str] = set()
    for deck, key in decks:
        emitted.update(_paths(json.loads(_told("run", TOP / "decks" / deck, "--method", key, "-q", "--json"))))
    assert emitted == _documented("mouse.update/1")
    told = json.loads(_told("compare", TOP / "decks" / "table_5_2.yaml", "-q", "--json"))
    own = {path for path in _paths(told) if not path.startswith(("methods[].", "refused."))}
    assert own == _documented("mouse.comparison/1")
    assert {path.removeprefix("methods[].") for path in _paths(told) if path.startswith("methods[].")} <= emitted


def test_methods():
    """Every method has its section in the reference, its line in the list and its place in the explanation."""
    page, listed, told = _page("methods.md"), _told("list", "methods"), _told("explain", "methods")
    text = (DOCS / "explanation" / "updating-methods.md").read_text("utf-8")
    for key, method in discover("mouse_cli.methods", "METHOD").items():
        assert f"\n## {key}\n" in page and f"\n## {key}\n" in told
        assert method.equation in page
        assert re.search(rf"^{key} ", listed, re.MULTILINE)
        assert f"methods/{key.replace('-', '_')}.py" in text or f"--method {key}" in text


def test_json_of_diagnose():
    """Examples of every kind have all keys between them; the command adds what became of `-o`."""
    fixed = lambda of: {path for path in _paths(of) if not path.startswith("verdict.members.")}  # keys are physics
    emitted = {path for make in DIAGNOSES.values() for path in fixed(document(make()))}
    told = fixed(json.loads(_told("diagnose", TOP / "decks" / "ground_spring.yaml", "--json")))
    assert emitted | {"revised_deck"} == _documented("mouse.diagnosis/1")
    assert told <= emitted | {"revised_deck"}
    assert "revised_deck" in told


def test_json_of_arrangements(tmp_path):
    """Parts that are those of a diagnosis of one deck are documented there."""
    decks = [TOP / "decks" / "arrangements" / f"layout{i}.yaml" for i in range(1, 7)]
    told = json.loads(_told("diagnose", *decks[:5], "--held-out", decks[5], "--common-sd", "0.3", "-q", "--json"))
    like = {"turns[].candidates[]": "candidates[]", "rest[]": "candidates[]", "verdict.causes[].site": "verdict.site"}
    like |= {f"{at}.sites[]": "verdict.site" for at in ("verdict", "verdict.causes[]")} | {
        "verdict.site": "verdict.site"
    }
    like |= dict.fromkeys(("turns[].held_out", "held_out.baseline", "held_out.revised"), "held_out.baseline")
    again = shutil.copy(decks[0], tmp_path / "again.yaml")
    unchanged = json.loads(_told("diagnose", decks[0], "--changed", again, "-q", "--json"))
    emitted, known = set(_paths({"tests": unchanged["tests"]})), _documented("mouse.diagnosis/1")
    assert set(_paths(told.pop("geometry"))) <= _documented("geometry")
    for path in _paths(told | {"geometry": None}):
        if ".members." in path:
            continue  # keys are physics
        root = next((root for root in like if path.startswith(f"{root}.")), None)
        if root is None:
            emitted.add(path)
        else:
            assert like[root] + path.removeprefix(root) in known
    assert emitted == _documented("mouse.arrangements/1")


def test_candidates():
    """Every candidate has its section in the reference, its line in the list and its explanation."""
    page, listed = _page("candidates.md"), _told("list", "candidates")
    for key, candidate in discover("mouse_cli.diagnosis.mechanisms", "CANDIDATE").items():
        assert f"\n## {key}\n" in page
        assert f"| {candidate.group} |" in page
        assert re.search(rf"^{key} ", listed, re.MULTILINE)
        assert candidate.meaning.rstrip(".") in _told("explain", key)


def test_rivals_without_a_name():
    """Every rival without a name has its section in the reference, its line in the list and its explanation, with its property."""
    page, listed = _page("candidates.md"), _told("list", "nameless")
    for key, rival in discover("mouse_cli.diagnosis.nameless", "NAMELESS").items():
        told = _told("explain", key)
        assert f"\n### {key}\n" in page
        assert f"| [{key}](#{key}) | {rival.title} | `{rival.property}` |" in page
        assert re.search(rf"^{key} +{rival.title}", listed, re.MULTILINE)
        for part in (rival.meaning.rstrip("."), *(f"{spread:g}" for spread in rival.spreads)):
            assert part in told and part in page


CLOSE_AND_REVERSED = """\
mouse: 1
model: {stiffness: {order: 6, entries: [[1,1,2],[1,2,-1],[2,2,2],[2,3,-1],[3,3,1],[4,4,2.02],[4,5,-1.01],[5,5,2.02],
  [5,6,-1.01],[6,6,1.01]]}, mass: {identity: 6}}
test:
  modes:
    dofs: [1, 2, 3, 4, 5, 6]
    frequency: [0.07083, 0.07118, 0.1985]
    frequency_sd: 1 %
    shapes: [[0.445, 0.01, 0.802], [-0.802, 0.0, -0.356], [1.0, 0.01, -0.643], [0.0, 0.445, 0], [0.01, 0.802, 0], [0, 1.0, 0]]
    shape_sd: 0.01
"""


def test_json_of_campaigns(tmp_path, monkeypatch):
    """What a deck, a mode or a point is called stands in no table: keys below these are names."""
    monkeypatch.chdir(tmp_path)
    named = r"\.(values|posterior|posterior_sd|hz|shares|influence)\..*"
    deck, emitted = TOP / "decks" / "table_5_3.yaml", set()
    for command in (("sweep", deck, "--vary", "k1.sd=4000,8000"), ("bootstrap", deck, "--replicates", "2")):
        document = json.loads(_told(*command, "-j", "1", "-q", "--json"))
        emitted |= {path for path in _paths(document) if not re.search(named, path)}
    assert emitted == _documented("mouse.campaign/1")


def test_json_of_samples():
    pytest.importorskip("emcee", reason="samples need emcee")
    emitted = _paths(json.loads(_told("sample", TOP / "decks" / "table_5_3.yaml", "--steps", "100", "-q", "--json")))
    assert set(emitted) == _documented("mouse.sample/1")

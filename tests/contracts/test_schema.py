"""The shipped JSON Schema: generated from the reader's own definitions, and agreeing with the reader."""

import copy
import json
from dataclasses import fields
from pathlib import Path

import jsonschema
import pytest
import yaml

import mouse_cli
from mouse_cli._errors import DeckError
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.reference import reference, schema
from mouse_cli.formats.yaml_deck.schema import SECTIONS
from mouse_cli.model.problem import RunOptions
from mouse_cli.model.theory import Theory

PACKAGE = Path(mouse_cli.__file__).parent
DECKS = sorted((PACKAGE.parent / "decks").rglob("*.yaml"))
VALIDATOR = jsonschema.Draft202012Validator(schema())

DECK = {
    "mouse": 1,
    "title": "a deck",
    "model": {
        "stiffness": {"order": 2, "entries": [[1, 1, 3.0], [1, 2, -1.0], [2, 2, 1.0]]},
        "mass": {"diagonal": [1, 1]},
        "labels": ["base", "tip"],
    },
    "elements": {"stiffness": [[1, 1], [1, 2], [2, 2]], "mass": []},
    "parameters": [
        {"name": "a", "nominal": 2.0, "sd": "5 %", "lower": 0, "transform": "log", "stiffness": [[1, 1, 1]]},
        {"name": "b", "sd": 0.5, "unit": "N/m", "stiffness": [[1, 2, -1], [2, 2, 1]]},
    ],
    "prior": {"correlations": [["a", "b", 0.5]]},
    "test": {
        "modes": {
            "number": [1, 2],
            "frequency": [1.0, None],
            "frequency_sd": "1 %",
            "dofs": ["base", 2],
            "shapes": [[1, None], [2, -1]],
            "shape_sd": 0.1,
            "scale": "unit",
        }
    },
    "theory": {"frequency": "0.1 %", "shape": 0.005, "configurations": None},
    "run": {
        "recursion": "replaced",
        "confidence": 99,
        "cycles": None,
        "fix_total_mass": False,
        "limit_sd": 2,
    },
}

# Where, and what there; ... deletes the key. Each makes a deck that reader and schema must both refuse.
MUTATIONS = [
    (["mouse"], 2),
    (["mouse"], ...),
    (["model"], ...),
    (["colour"], "red"),
    (["title"], ["a"]),
    (["model", "stiffness"], ...),
    (["model", "stiffness", "order"], ...),
    (["model", "stiffness", "order"], 0),
    (["model", "stiffness", "dense"], [[1]]),
    (["model", "stiffness", "entries"], [[1, 1]]),
    (["model", "stiffness", "entries"], [[1, 1, "x"]]),
    (["model", "stiffness", "entries"], [[1, 1.5, 1]]),
    (["model", "mass"], {}),
    (["model", "mass", "diagonal"], []),
    (["model", "mass", "diagonal"], 1),
    (["model", "structure"], {}),
    (["model", "labels"], "base"),
    (["elements", "stiffness"], [[1]]),
    (["parameters"], {"name": "a"}),
    (["parameters", 0, "name"], ...),
    (["parameters", 0, "sd"], "5 percent"),
    (["parameters", 0, "sd"], [5]),
    (["parameters", 0, "nominal"], "two"),
    (["parameters", 0, "transform"], "logarithm"),
    (["parameters", 0, "stiffness"], {"path": "k.mtx"}),
    (["parameters", 0, "stifness"], []),
    (["prior"], {}),
    (["prior", "covariance"], [[1, 0], [0, 1]]),
    (["prior", "correlations"], [["a", "b"]]),
    (["test", "modes"], ...),
    (["test", "modes", "frequency"], ...),
    (["test", "modes", "frequency"], "1 Hz"),
    (["test", "modes", "frequency"], []),
    (["test", "modes", "number"], ["x", "y"]),
    (["test", "modes", "dofs"], 2),
    (["test", "modes", "shapes"], [1, 2]),
    (["test", "modes", "shape_sd"], "small"),
    (["test", "modes", "scale"], "mass"),
    (["theory"], "1 %"),
    (["theory", "frequency"], "0.1 percent"),
    (["theory", "frequency"], -0.001),
    (["theory", "shape"], 2),
    (["theory", "mechanisms"], 0.01),
    (["run", "confidence"], 97),
    (["run", "recursion"], "anchord"),
    (["run", "partials"], 2.5),
    (["run", "partials"], True),
    (["run", "cycles"], -1),
    (["run", "limit_sd"], 0),
    (["run", "extra_update"], "perhaps"),
    (["run", "fix_total_mass"], {"dof": [1]}),
]


def mutated(path: list, value: object) -> dict:
    deck = copy.deepcopy(DECK)
    below = deck
    for key in path[:-1]:
        below = below[key]
    if value is ...:
        del below[path[-1]]
    else:
        below[path[-1]] = value
    return deck


def test_the_shipped_file_is_the_generated_one():
    shipped = (PACKAGE / "formats" / "yaml_deck" / "deck.schema.json").read_text(encoding="utf-8")
    assert json.loads(shipped) == schema(), "write the file again by mouse explain schema"
    jsonschema.Draft202012Validator.check_schema(schema())


def test_the_example_is_good_for_schema_and_reader():
    VALIDATOR.validate(DECK)
    yaml_deck.read(yaml.safe_dump(DECK), "deck.yaml")
    VALIDATOR.validate(yaml.safe_load(yaml.safe_dump(DECK)))


@pytest.mark.parametrize(
    ("path", "value"), MUTATIONS, ids=lambda v: "/".join(map(str, v)) if isinstance(v, list) else str(v)[:20]
)
def test_schema_and_reader_refuse_the_same(path, value):
    deck = mutated(path, value)
    assert not VALIDATOR.is_valid(deck)
    with pytest.raises(DeckError):
        yaml_deck.read(yaml.safe_dump(deck), "deck.yaml")


@pytest.mark.parametrize("path", DECKS, ids=lambda p: p.name)
def test_all_decks_validate(path):
    from mouse_cli.formats import file_bytes, holds, read_deck
    from mouse_cli.formats.yaml_deck import coupled, modified

    VALIDATOR.validate(yaml.safe_load(path.read_text(encoding="utf-8")))
    reader = {"couple": coupled.read, "modify": modified.read}.get(holds(file_bytes(str(path)), str(path)))
    reader(file_bytes(str(path)), str(path)) if reader else read_deck(path)


def test_written_decks_validate():
    from mouse_cli.formats.assemble import assemble

    text, _ = yaml_deck.write(assemble(yaml_deck.read(yaml.safe_dump(DECK), "deck.yaml")))
    VALIDATOR.validate(yaml.safe_load(text))


def test_run_keys_are_the_run_options():
    options = {field.name for field in fields(RunOptions)} - {"total_mass_dofs"}
    assert set(SECTIONS["run"].keys) == options
    for name, key in SECTIONS["run"].keys.items():
        default = getattr(RunOptions(), name)
        assert yaml.safe_load(key.default) == default, name


def test_theory_keys_are_the_errors_of_theory():
    """Each stated default is read as the very number that holds without it."""
    defaults = {name: key.default for name, key in SECTIONS["theory"].keys.items()}
    assert yaml_deck.read(yaml.safe_dump(DECK | {"theory": defaults}), "deck.yaml").theory == Theory()
    assert list(defaults) == [field.name for field in fields(Theory)]


def test_every_kind_is_used_and_defined():
    used = {key.kind for section in SECTIONS.values() for key in section.keys.values()}
    plain = {kind for kind in used if not kind.startswith(("section ", "list ", "map "))}
    assert plain == set(KINDS)
    assert {kind.split()[1] for kind in used - plain} <= set(SECTIONS)


def test_the_reference_names_every_key():
    text = reference()
    for name, section in SECTIONS.items():
        assert f"## {name}\n" in text
        for key, definition in section.keys.items():
            assert f"| `{key}` | " in text and definition.meaning in text
    assert text.count("\n|---|---|---|---|---|\n") == sum(not section.variants for section in SECTIONS.values())

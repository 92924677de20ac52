"""Words of the report of 1972 and names of its cards are found by `mouse explain`."""

import pytest

from mouse_cli.cli.main import _run
from mouse_cli.formats.cards.layout import GROUPS

OPERATIONS = [f"O-{i}" for i in range(1, 13)] + [f"I-{i}" for i in range(1, 6)]


@pytest.mark.parametrize("topic", [*OPERATIONS, "table-3-1", "VIDAP", "o-7"])
def test_the_report_is_explained(topic, capsys):
    assert _run(["explain", topic]) == 0
    head, _, told = capsys.readouterr().out.partition("\n\n")
    assert head.lower().startswith(f"{topic.lower()}: ") and "1972" in head and len(told) > 30


@pytest.mark.parametrize(
    "field", next(group for group in GROUPS if group.number == 2).fields, ids=lambda field: field.row.name
)
def test_fields_of_the_control_card_are_explained(field, capsys):
    assert _run(["explain", field.row.name]) == 0
    assert f"columns {field.columns}, FORMAT I8" in capsys.readouterr().out


@pytest.mark.parametrize(
    "topic, words",
    [
        ("shape_sd", ["deck key shape_sd, in section modes", "standard deviations"]),
        ("test.modes.frequency", ["deck key frequency, in section modes", "unit: Hz"]),
        ("hold_out", ["section hold_out", "| `sensors` |"]),
        ("mass", ["Point mass", "candidate mass", "deck key mass, in section model"]),
    ],
)
def test_keys_of_decks_are_explained(topic, words, capsys):
    assert _run(["explain", topic]) == 0
    told = capsys.readouterr().out
    assert all(word in told for word in words) and "](#" not in told

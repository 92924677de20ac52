"""A girder all of whose steel is warmer after than before, frequencies by the closed form: a parameter of the deck has changed."""

import json

import pytest
from click.testing import CliRunner
from test_narrow_priors import deck

from mouse_cli.cli.main import cli


def test_what_changed_is_a_parameter_of_the_deck(tmp_path):
    """It had no name, and three bars of sixteen that were said to be softer."""
    for name, share in (("before", 1.0), ("after", 0.97)):
        (tmp_path / f"{name}.yaml").write_text(deck(share, "3 %"))
    decks = ["--changed", str(tmp_path / "after.yaml"), str(tmp_path / "before.yaml")]
    done = CliRunner().invoke(cli, ["diagnose", *decks, "--json", "-q", "--candidates", "parameter,mass,crack,tension"])
    found = json.loads(done.stdout)
    verdict, first = found["verdict"], found["turns"][0]["candidates"][0]
    assert (verdict["kind"], verdict["physics"], verdict["site"]["text"]) == ("named", "parameter", "parameter 'E'")
    (factor,) = first["parameters"]
    assert factor["value"] == pytest.approx(0.97, abs=3 * factor["sd"]) and factor["sd"] < 0.01

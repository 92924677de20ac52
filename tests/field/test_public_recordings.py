"""The how-to on a public recording: its deck, as printed, on the measured file where that is beside the project."""

import json
import re
import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner

from mouse_cli.cli.main import cli

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT.parent / "shared" / "data" / "silverbox" / "SNLS80mV.mat"
pytestmark = pytest.mark.skipif(not DATA.exists(), reason="the measured data are not beside the project")


def test_the_page_leads_to_the_law_that_the_makers_state(tmp_path):
    page = (ROOT / "docs" / "how-to" / "public-recordings.md").read_text("utf-8")
    deck = tmp_path / "silverbox.yaml"
    deck.write_text(re.search(r"```yaml\n(.*?)```", page, re.DOTALL)[1], "utf-8")
    shutil.copy(DATA, tmp_path)
    said = lambda *command: CliRunner().invoke(cli, [*command, "-q"], standalone_mode=False)
    assert said("check", str(deck)).return_value == 0
    found = json.loads(said("diagnose", str(deck), "--json").stdout)
    assert (found["verdict"]["kind"], found["verdict"]["physics"]) == ("named", "cubic")
    arrow = found["held_out"]["records"][0]["error_of_whole_record"]
    assert arrow["as it is"][0] > 13e-3 and arrow["with the cause"][0] < 1e-3


def test_a_run_leaves_a_prior_that_is_far_off_and_ends_at_the_truth(tmp_path):
    """From its nominal values, 1 % of damping for 5 %, it ended at k = 0.81 and k3 = 18, with 2,689 times the variance."""
    page = (ROOT / "docs" / "how-to" / "public-recordings.md").read_text("utf-8")
    deck = tmp_path / "hardening.yaml"
    law = "laws: [{law: cubic, at: [1], values: {cubic_stiffness: 3.9}}]\n"
    deck.write_text(re.search(r"```yaml\n(.*?)```", page, re.DOTALL)[1] + law, "utf-8")
    shutil.copy(DATA, tmp_path)
    done = CliRunner().invoke(cli, ["run", str(deck), "-q", "--json"], standalone_mode=False)
    found = json.loads(done.stdout)
    k, size = found["parameters"][0]["posterior"], found["laws"][0]["parameters"][0]["value"]
    assert done.return_value == 0 and size / k == pytest.approx(3.98, rel=0.01)  # an output-error fit of their equation

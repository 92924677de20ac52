"""Silverbox (Wigren and Schoukens, ECC 2013): a real circuit that moves like a mass on a hardening spring."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from mouse_cli.cli.main import cli

DATA = Path(__file__).resolve().parents[2].parent / "shared" / "data" / "silverbox" / "SNLS80mV.mat"
pytestmark = pytest.mark.skipif(not DATA.exists(), reason="the measured data are not beside the project")
# The linear model was fitted to samples 0-4000, the quiet beginning: 68.3 Hz, 4.8 % of critical.
DECK = """mouse: 1
title: Silverbox
model:
  stiffness: {{order: 1, entries: [[1, 1, 0.98741]]}}
  mass: {{diagonal: [5.3667e-6]}}
  damping: {{order: 1, entries: [[1, 1, 2.1961e-4]]}}
parameters:
  - {{name: k, nominal: 0.98741, sd: 5 %, stiffness: [[1, 1, 1]]}}
  - {{name: m, nominal: 5.3667e-6, sd: 5 %, mass: [[1, 1, 1]]}}
test:
  recordings:
{recordings}
  hold_out: {{recordings: [{held}]}}
"""
RECORD = """    - {{title: {title}, file: {file}, sample_rate: 610.3515625, segment: [{span}],
       inputs: [{{sensor: 1, channel: {u}, quantity: force}}], outputs: [{{sensor: 1, channel: {y}, quantity: displacement}}]}}
"""


def diagnosed(folder: Path, records: list[dict], held: str) -> dict:
    (folder / "deck.yaml").write_text(
        DECK.format(recordings="".join(RECORD.format(**one) for one in records), held=held)
    )
    done = CliRunner().invoke(cli, ["diagnose", str(folder / "deck.yaml"), "--json", "-q"])
    assert done.exit_code in (0, 1), done.output
    return json.loads(done.stdout)


def test_the_hardening_spring_is_named_and_predicts_the_arrow(tmp_path):
    shutil.copy(DATA, tmp_path / "s.mat")
    spans = {"training": "41000, 71000", "multisines": "71000, 127000", "arrow": "0, 40500"}
    records = [{"title": title, "file": "s.mat", "span": span, "u": "V1", "y": "V2"} for title, span in spans.items()]
    found = diagnosed(tmp_path, records, "multisines, arrow")
    assert (found["verdict"]["kind"], found["verdict"]["physics"]) == ("named", "cubic")
    assert "hardening" in found["candidates"][0]["title"]
    ratio = found["candidates"][0]["parameters"][0]["value"] / 0.98741
    assert ratio == pytest.approx(
        3.98, rel=0.03
    )  # k3/k of an independent output-error fit of the makers' equation, 1/V^2
    error = {one["title"]: one["error_of_whole_record"] for one in found["held_out"]["records"]}
    assert error["arrow"]["as it is"][0] > 13e-3
    assert error["arrow"]["with the cause"][0] < 0.95e-3
    assert error["multisines"]["with the cause"][0] < 0.95e-3


def test_a_linear_circuit_under_the_same_input_lacks_nothing(tmp_path):
    from scipy.io import loadmat
    from scipy.signal import lsim, resample

    u = loadmat(DATA)["V1"].ravel()[41000:61000]
    fine = resample(u, 8 * len(u))
    _, y, _ = lsim(([1], [5.45e-6, 2.4e-4, 1.02]), fine, np.arange(len(fine)) * 2**14 / 1e7 / 8)
    y = y[::8] + 0.01 * y.std() * np.random.default_rng(3).standard_normal(len(u))
    np.savez(tmp_path / "l.npz", u=u, y=y)
    spans = {"linear": "0, 14000", "its end": "14000, 20000"}
    records = [{"title": title, "file": "l.npz", "span": span, "u": "u", "y": "y"} for title, span in spans.items()]
    found = diagnosed(tmp_path, records, "its end")
    assert found["verdict"]["kind"] == "nothing-missing"


@pytest.mark.proof
def test_the_quiet_beginning_is_linear_but_for_noise(tmp_path):
    """It leaves 5 times the variance of 1 % of the channel: a force of 5 uV/sqrt(Hz) that nobody measured, at all levels."""
    shutil.copy(DATA, tmp_path / "s.mat")
    spans = {"quiet": "0, 4200", "its end": "4200, 6000"}
    records = [{"title": title, "file": "s.mat", "span": span, "u": "V1", "y": "V2"} for title, span in spans.items()]
    found = diagnosed(tmp_path, records, "its end")
    assert found["verdict"]["kind"] == "nothing-missing" and found["exit_code"] == 0
    assert found["noise"]["size"][0] == pytest.approx(0.19e-3, rel=0.1)  # of an independent output-error fit
    assert found["noise"]["explained"] < 0.1


@pytest.mark.proof
def test_the_spring_is_named_from_a_stretch_six_times_quieter_than_the_loudest(tmp_path):
    shutil.copy(DATA, tmp_path / "s.mat")
    spans = {"rising": "4000, 8200", "its end": "8200, 10000"}
    records = [{"title": title, "file": "s.mat", "span": span, "u": "V1", "y": "V2"} for title, span in spans.items()]
    found = diagnosed(tmp_path, records, "its end")
    assert (found["verdict"]["kind"], found["verdict"]["physics"]) == ("named", "cubic")

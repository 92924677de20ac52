"""`mouse run` on recordings alone: parameters of the deck and of its laws against truths that scipy integrated."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from two_masses import linear, record

from mouse_cli.cli.main import cli
from mouse_cli.page import Part, page
from mouse_cli.plots.records import lines

LAW = "laws:\n  - {law: cubic, variant: hardening, at: [1, 2], values: {cubic_stiffness: 1.2e8}}\n"


def hardening(u, v):
    F = 2e8 * (u[1] - u[0]) ** 3
    return np.array([-F, F])


def run(deck: str, code: int, *options: str) -> dict:
    done = CliRunner().invoke(cli, ["run", deck, "--json", "-q", *options], standalone_mode=False)
    assert done.return_value == code, done.output
    return json.loads(done.stdout)


def test_linear_parameters_are_those_of_the_truth(tmp_path):
    found = run(record(tmp_path, linear), 0)
    for one, true in zip(found["parameters"], (2.04e4, 3.06e4), strict=True):
        assert abs(one["posterior"] - true) < 4 * one["posterior_sd"] + 1e-3 * true
        assert one["posterior_sd"] < 0.1 * one["prior_sd"]
    (held,) = found["held_out"]["records"]
    assert max(held["error"]["with the cause"]) < 0.2 * max(held["error"]["as it is"])


def test_json_is_documented(tmp_path):
    """Every key is in the table of runs of recordings, or named before it as that of any run."""
    page = (Path(__file__).parents[2] / "docs" / "reference" / "json.md").read_text("utf-8")
    section = page.partition("## mouse.result/1, of recordings\n")[2].partition("\n## ")[0]
    named = {key.partition("[")[0].partition(".")[0] for key in re.findall(r"`([a-z_.\[\]]+)`", section)}
    assert set(run(record(tmp_path, linear), 0)) <= named


def test_the_size_of_a_law_is_revised_and_the_answer_is_a_prior(tmp_path):
    deck = record(tmp_path, hardening)
    with open(deck, "a", encoding="utf-8") as file:
        file.write(LAW)
    found = run(deck, 0)
    (size,) = found["laws"][0]["parameters"]
    assert abs(size["value"] - 2e8) < 4 * size["sd"] + 0.01 * 2e8
    on_the_page(found)
    (tmp_path / "result.json").write_text(json.dumps(found))
    again = run(deck, 0, "--prior", str(tmp_path / "result.json"))
    assert again["parameters"][0]["prior"] == pytest.approx(found["parameters"][0]["posterior"])


def on_the_page(found: dict) -> None:
    """Errors of the held-out record, a stretch of it, the force that the record asks for and the revised law."""
    text = page(Part(found, "result.json"))
    (held,) = found["held_out"]["records"]
    for values in (held["rms"], *held["error"].values(), *held["error_of_whole_record"].values()):
        assert all(f'data-value="{value:.12g}"' in text for value in values)
    (size,) = found["laws"][0]["parameters"]
    assert f'data-value="{size["value"]:.12g}"' in text
    assert "A stretch of a record held out" in text and "Restoring force over motion" in text
    force = found["restoring_force"]
    x, f, law = (np.array(force[key]) for key in ("motion", "force", "law"))
    assert len(x) <= 500 and np.corrcoef(f, x**3)[0, 1] > 0.9
    assert np.abs(law - 2e8 * x**3).max() < 0.02 * np.abs(law).max()
    assert all(len(curve) <= 600 for curve in found["held_out"]["trace"]["simulated"].values())


def test_figures_show_records_and_the_law(tmp_path):
    pytest.importorskip("matplotlib")
    deck, figures = record(tmp_path, hardening), tmp_path / "figures"
    with open(deck, "a", encoding="utf-8") as file:
        file.write(LAW)
    run(deck, 0, "--plot", str(figures))
    assert {path.stem for path in figures.iterdir()} == {"record-held-out", "record-residual", "restoring-force"}


def test_lines_of_a_spectrum_are_worth_what_they_say():
    """A sine of amplitude 3 has the mean square 4.5; white noise of sd 2 has 2 sqrt(2/t) in each line."""
    rng, t = np.random.default_rng(1), 4096
    sine = 3 * np.sin(2 * np.pi * 200 * np.arange(t) / t)
    assert np.sum(lines(sine) ** 2) == pytest.approx(4.5, rel=1e-6) and np.argmax(lines(sine)) == 199
    assert np.mean(lines(2 * rng.standard_normal(t)) ** 2) == pytest.approx(4 * 2 / t, rel=0.05)


def test_options_without_meaning_are_told(tmp_path):
    deck = record(tmp_path, linear)
    with open(deck, "a", encoding="utf-8") as file:
        file.write("run: {partials: 7}\n")
    found = run(deck, 0, "--pairing", "number", "--scale", "none")
    (told,) = [text for text in found["warnings"] if "MD643" in text]
    assert "pairing, partials, scale" in told
    assert not any("MD643" in text for text in run(record(tmp_path, linear), 0)["warnings"])


def test_a_record_that_the_model_cannot_explain_is_said(tmp_path):
    found = run(record(tmp_path, hardening), 1)
    assert found["model_form"] == "rejected" and "mouse diagnose" in found["message"]


def test_modes_say_that_laws_are_left_out(tmp_path):
    deck = record(tmp_path, linear)
    with open(deck, "a", encoding="utf-8") as file:
        file.write(LAW)
    done = CliRunner().invoke(cli, ["modes", deck])
    assert done.exit_code == 0 and "MD642" in done.stderr and "cubic" in done.stderr

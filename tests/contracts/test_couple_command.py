"""`mouse couple` and `mouse modify` as users call them: exit codes, streams, files, diagnostics with their places."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest

from mouse_cli.cli.main import _run

DECKS = Path(__file__).resolve().parents[2] / "decks"
COUPLED = """mouse: 1
title: Two halves
couple:
  substructures:
    left: {deck: portal_left.yaml}
    right: {deck: portal_right.yaml}
  interfaces:
    - {left: [11TX, 11TY, 11RZ], right: [11TX, 11TY, 11RZ]}
  connections:
    - {name: lump, mass: 2.0, at: {left: 7TX}}
  responses: {left: [7TX], right: [15TX]}
  lines: {band: [2, 20], step: 2}
"""
MODIFY = """mouse: 1
modify:
  deck: portal_whole.yaml
  changes:
    - {mass: 3.0, at: 7TX}
  targets:
    - {mode: 1, below: 6, place: 7TX}
"""


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    for path in (DECKS / "coupled").glob("*.yaml"):
        shutil.copy(path, tmp_path)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "deck.yaml").write_text(COUPLED)
    (tmp_path / "changes.yaml").write_text(MODIFY)
    return tmp_path


def said(capsys, *arguments: str) -> tuple[int, str, str]:
    status = _run(list(arguments))
    captured = capsys.readouterr()
    return status, captured.out, captured.err


@pytest.mark.parametrize("name", ["portal.yaml", "portal_without_left.yaml"])
def test_decks_of_the_collection_couple(folder, capsys, name):
    status, out, err = said(capsys, "couple", name, "--json")
    found = json.loads(out)
    assert status == 0 and err == "" and found["schema"] == "mouse.coupling/1"
    assert len(found["functions"]["hz"]) == 237 and len(found["interface"]["condition_number"]) == 237


def test_what_is_left_without_the_left_half_is_the_right_half(folder, capsys):
    """Decoupled functions of the collection against those of the right half by itself."""
    _, out, _ = said(capsys, "couple", "portal_without_left.yaml", "--json")
    alone = "mouse: 1\ncouple:\n  substructures: {right: {deck: portal_right.yaml}}\n  responses: {right: [15TX]}\n"
    (folder / "alone.yaml").write_text(alone + "  lines: {band: [1, 60], step: 0.25}\n")
    _, other, _ = said(capsys, "couple", "alone.yaml", "--json")
    one, two = (
        np.array(each["functions"]["each"][0]["real"]) + 1j * np.array(each["functions"]["each"][0]["imag"])
        for each in (json.loads(out), json.loads(other))
    )
    np.testing.assert_allclose(one, two, atol=1e-9 * np.abs(two).max())


def test_answers_go_to_files_whole(folder, capsys):
    status, out, _ = said(
        capsys, "couple", "deck.yaml", "--functions", "whole.npz", "-o", "answer.md", "--markdown", "-q"
    )
    assert status == 0 and out == "" and (folder / "answer.md").read_text().startswith("## Coupled structures")
    held = np.load(folder / "whole.npz")
    assert held["H"].shape == (10, 2, 2) and list(held["output_names"]) == ["left 7TX", "right 15TX"]
    assert said(capsys, "couple", "deck.yaml", "-o", "deck.yaml")[0] == 2
    assert said(capsys, "couple", "deck.yaml", "--functions", "whole.txt", "-q")[0] == 5


def test_functions_written_are_a_part_of_the_next_deck(folder, capsys):
    """The lump taken away from the functions with it: what the halves are without."""
    said(capsys, "couple", "deck.yaml", "--functions", "heavy.npz", "-o", "x.txt")
    back = "mouse: 1\ncouple:\n  substructures: {heavy: {functions: heavy.npz}}\n"
    back += "  connections: [{mass: -2.0, at: {heavy: left 7TX}}]\n  responses: {heavy: [left 7TX, right 15TX]}\n"
    (folder / "back.yaml").write_text(back)
    (folder / "bare.yaml").write_text(
        COUPLED.replace("    - {name: lump, mass: 2.0, at: {left: 7TX}}\n", "").replace("  connections:\n", "")
    )
    _, one, _ = said(capsys, "couple", "back.yaml", "--json", "-q")
    _, two, _ = said(capsys, "couple", "bare.yaml", "--json", "-q")
    for a, b in zip(json.loads(one)["functions"]["each"], json.loads(two)["functions"]["each"], strict=True):
        np.testing.assert_allclose(a["real"], b["real"], atol=1e-9 * np.abs(b["real"]).max())


@pytest.mark.parametrize(
    ("old", "new", "code", "place", "words"),
    [
        ("right: [11TX, 11TY, 11RZ]}", "middle: [11TX, 11TY, 11RZ]}", "MD701", "8:34", "no substructure"),
        ("right: [11TX, 11TY, 11RZ]}", "right: [11TX, 11TY]}", "MD702", "8:7", "3 of left and 2 of right"),
        ("{left: 7TX}", "{left: 7TW}", "MD703", "10:42", "no degree of freedom of left"),
        ("mass: 2.0", "mass: 0", "MD215", "10:26", "is 0"),
        ("mass: 2.0", "loss_factor: 0.1, mass: 2.0", "MD708", "10:33", "mass and loss_factor"),
        ("mass: 2.0", "weight: 2.0", "MD210", "10:20", "'weight' is not a key"),
        ("  lines: {band: [2, 20], step: 2}\n", "", "MD707", "4:3", "no lines"),
        ("step: 2", "step: 0", "MD614", "12:10", "0 Hz apart"),
        ("step: 2", "step: 1.0e-9", "MD614", "12:10", "Hz apart"),
        ("deck: portal_right.yaml", "deck: portal_rigth.yaml", "MD250", "", "cannot be read"),
        ("deck: portal_right.yaml", "deck: ../portal_right.yaml", "MD231", "6:19", "not below the folder"),
        ("deck: portal_right.yaml", "deck: portal_right.yaml, measured: true", "MD704", "6:19", "0 measurements"),
        ("{deck: portal_right.yaml}", "{}", "MD211", "6:12", "deck is missing"),
        ("title: Two halves\n", "title: Two halves\nrun: {partials: 3}\n", "MD700", "3:6", "run stands beside couple"),
        ("title: Two halves\n", "title: Two halves\nunits: mm-t-N\n", "MD705", "5:3", "different units"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_told_with_its_place(folder, capsys, old, new, code, place, words):
    text = COUPLED.replace(old, new, 1)
    assert text != COUPLED
    (folder / "deck.yaml").write_text(text)
    status, out, err = said(capsys, "couple", "deck.yaml", "-o", "answer.txt")
    assert status == 4 and out == "" and not (folder / "answer.txt").exists()
    assert f"error[{code}]" in err and words in err and "= help:" in err
    if place:
        assert f"deck.yaml:{place}: error[{code}]" in err


def test_every_part_taken_away(folder, capsys):
    text = COUPLED.replace("left.yaml}", "left.yaml, remove: true}").replace("right.yaml}", "right.yaml, remove: true}")
    (folder / "deck.yaml").write_text(text)
    status, _, err = said(capsys, "couple", "deck.yaml")
    assert status == 4 and "MD706" in err


def test_reductions_that_there_are_not(folder, capsys):
    (folder / "deck.yaml").write_text(COUPLED + "  modes: {keep: [4], methods: [guyan]}\n")
    status, _, err = said(capsys, "couple", "deck.yaml")
    assert status == 4 and "MD716" in err and "craig-bampton" in err


@pytest.mark.parametrize(
    ("command", "deck"),
    [
        ("run", "deck.yaml"),
        ("modify", "deck.yaml"),
        ("couple", "changes.yaml"),
        ("modes", "changes.yaml"),
        ("couple", "portal_left.yaml"),
    ],
)
def test_decks_of_other_commands_say_whose_they_are(folder, capsys, command, deck):
    status, _, err = said(capsys, command, deck)
    assert status == 4 and "MD700" in err and "mouse" in err


def test_check_reads_them_too(folder, capsys):
    (folder / "bad.yaml").write_text(COUPLED.replace("7TX}", "70TX}", 1))
    status, out, err = said(capsys, "check", "deck.yaml", "changes.yaml", "bad.yaml")
    assert status == 4 and out == "3 decks checked: 2 sound, 1 rejected, 0 with warnings\n" and "bad.yaml:10" in err


def test_damping_of_connections_is_said_not_to_count_in_modes(folder, capsys):
    text = COUPLED.replace("mass: 2.0", "dashpot: 20")
    (folder / "deck.yaml").write_text(text)
    status, out, err = said(capsys, "couple", "deck.yaml")
    assert status == 0 and "warning[MD721]" in err and "MD721" in out


def noisy(folder: Path, sd: float) -> None:
    """Functions of the right half, with a standard deviation that is stated."""
    alone = "mouse: 1\ncouple:\n  substructures: {right: {deck: portal_right.yaml}}\n"
    alone += "  responses: {right: [11TX, 11TY, 11RZ, 15TX]}\n  lines: {band: [2, 20], step: 2}\n"
    (folder / "alone.yaml").write_text(alone)
    assert _run(["couple", "alone.yaml", "--functions", "right.npz", "-o", "x.txt", "-q"]) == 0
    held = dict(np.load(folder / "right.npz"))
    held["output_names"] = held["input_names"] = np.array([name.split()[1] for name in held["output_names"]])
    held["variance"] = (sd * np.abs(held["H"]).max()) ** 2 * np.ones(held["H"].shape)
    np.savez(folder / "right.npz", **held)
    (folder / "deck.yaml").write_text(COUPLED.replace("{deck: portal_right.yaml}", "{functions: right.npz}"))


def test_noise_is_told_line_by_line_and_decides_the_exit(folder, capsys):
    noisy(folder, 1e-6)
    status, out, _ = said(capsys, "couple", "deck.yaml", "--json")
    found = json.loads(out)
    assert status == 0 and min(found["interface"]["noise"]) > 0 and max(found["interface"]["kept"]) == 4
    assert all(v > 0 for each in found["functions"]["each"] for v in each["variance"])
    noisy(folder, 3.0)
    status, out, err = said(capsys, "couple", "deck.yaml")
    assert status == 1 and "warning[MD713]" in err
    status, out, _ = said(capsys, "couple", "deck.yaml", "--truncate", "0.3", "--json", "-q")
    assert min(json.loads(out)["interface"]["kept"]) < 4 and json.loads(out)["truncate"] == 0.3


def test_lines_that_were_not_measured(folder, capsys):
    noisy(folder, 1e-6)
    text = (folder / "deck.yaml").read_text()
    (folder / "deck.yaml").write_text(text.replace("step: 2", "step: 1"))
    status, _, err = said(capsys, "couple", "deck.yaml")
    assert status == 4 and "MD711" in err and "3 Hz" in err
    (folder / "deck.yaml").write_text(text.replace(", step: 2", ""))
    assert said(capsys, "couple", "deck.yaml", "-q")[0] == 0


def test_windows_that_differ(folder, capsys):
    noisy(folder, 0.01)
    held = dict(np.load(folder / "right.npz"))
    np.savez(folder / "left.npz", **held | {"decay_rate": 3.0})
    text = "mouse: 1\ncouple:\n  substructures: {a: {functions: left.npz}, b: {functions: right.npz}}\n"
    (folder / "deck.yaml").write_text(text + "  responses: {a: 15TX}\n  interfaces: [{a: 11TX, b: 11TX}]\n")
    status, _, err = said(capsys, "couple", "deck.yaml")
    assert status == 4 and "MD712" in err and "a 3 1/s" in err


def test_modify_by_a_deck_and_by_options_is_one(folder, capsys):
    status, out, _ = said(capsys, "modify", "changes.yaml", "--json")
    other, same, _ = said(
        capsys, "modify", "portal_whole.yaml", "--mass", "7TX=3", "--target", "1<6", "--place", "7TX", "--json"
    )
    one, two = json.loads(out), json.loads(same)
    assert status == other == 0
    assert one["modes"] == two["modes"] and one["targets"] == two["targets"] and one["model"] == two["model"]


def test_a_target_out_of_reach_is_exit_1(folder, capsys):
    status, out, _ = said(capsys, "modify", "portal_whole.yaml", "--target", "2<5", "--place", "11TY", "-q")
    assert status == 1 and "MD718" in out and "stays above 6.4" in out


@pytest.mark.parametrize(
    ("options", "status", "words"),
    [
        (["--mass", "7TX"], 2, "is not DOF=NUMBER"),
        (["--mass", "7TX=heavy"], 2, "finite number"),
        (["--mass", "7TX=nan"], 2, "finite number"),
        (["--absorber", "7TX=1"], 2, "KG,HZ"),
        (["--target", "first<2"], 2, "MODE<HZ"),
        (["--sweep", "mass=2"], 2, "MODE:mass"),
        (["--mass", "7TX', x: '1=2"], 4, "error[MD703]"),
        (["--mass", "777TX=2"], 4, "error[MD703]"),
        (["--spring", "7TX,7TX=2"], 4, "error[MD708]"),
        (["--target", "99<2"], 4, "error[MD719]"),
        (["--mass", "11TY=-400"], 5, "error[MD720]"),
    ],
)
def test_options_that_are_wrong(folder, capsys, options, status, words):
    found, out, err = said(capsys, "modify", "portal_whole.yaml", *options)
    assert found == status and words in err and out == ""


def test_options_and_a_deck_of_changes_are_not_mixed(folder, capsys):
    status, _, err = said(capsys, "modify", "changes.yaml", "--mass", "7TX=1")
    assert status == 2 and "write them there" in err


def test_the_result_of_a_run_is_what_is_modified(capsys, tmp_path):
    """The posterior of the very deck: values and sd of its properties, as `mouse run` prints the revised frequencies."""
    deck, result = str(DECKS / "cantilever.yaml"), str(tmp_path / "result.json")
    assert said(capsys, "run", deck, "--json", "-o", result, "-q")[0] == 0
    status, out, _ = said(capsys, "modify", deck, "--prior", result, "--mass", "7TY=0.2", "-n", "3", "--json", "-q")
    before = json.loads(out)["before"]
    run = json.loads(Path(result).read_text())["modes"]
    assert status == 0
    for mode, revised in zip(before, run, strict=False):
        assert mode["hz"] == pytest.approx(revised["revised_hz"], rel=1e-9)
        assert mode["sd_hz"] == pytest.approx(revised["sd_hz"], rel=1e-6)


def test_the_posterior_of_a_part_narrows_the_whole(folder, capsys):
    """A result of another test with a tenth of the uncertainty, and a part that is no model."""
    _, out, _ = said(capsys, "couple", "deck.yaml", "--json", "-q")
    before = json.loads(out)["functions"]["each"][0]["variance"]
    test = "test: {modes: {number: [1], frequency: [3.745], frequency_sd: 0.01 %}}\n"
    (folder / "tested.yaml").write_text((folder / "portal_right.yaml").read_text() + test)
    assert said(capsys, "run", "tested.yaml", "--json", "-o", "right.json", "-q")[0] in (0, 1)
    status, out, _ = said(capsys, "couple", "deck.yaml", "--prior", "right=right.json", "--json", "-q")
    after = json.loads(out)["functions"]["each"][0]["variance"]
    assert status == 0 and all(0 < a < b for a, b in zip(after, before, strict=True))
    assert said(capsys, "couple", "deck.yaml", "--prior", "middle=right.json")[0] == 2


def test_modify_takes_card_decks(capsys):
    status, out, _ = said(capsys, "modify", str(DECKS / "table_5_2.dat"), "--mass", "2=0.1", "--json", "-q")
    assert status == 0 and json.loads(out)["changes"][0]["at"] == "2"


def test_reductions_are_listed(capsys):
    _, out, _ = said(capsys, "list", "reductions")
    assert [line.split()[0] for line in out.splitlines()] == ["craig-bampton", "macneal", "modal", "rubin"]


def test_figures(folder, capsys):
    pytest.importorskip("matplotlib")
    assert said(capsys, "couple", "portal.yaml", "--plot", "figures", "-q")[0] == 0
    assert said(capsys, "modify", "portal_calmed.yaml", "--plot", "figures", "-q")[0] == 0
    drawn = {path.name for path in (folder / "figures").iterdir()}
    assert drawn == {"coupled-functions.png", "coupled-reductions.png", "modified-functions.png"}
    assert said(capsys, "couple", "portal.yaml", "--plot", "figures.txt", "-q")[0] == 5

"""Hammer tests as they are made: one stroke soon after the beginning of a file, a hammer that goes from place to place, a channel
that is clipped. Two masses, all integrated by scipy.
"""

import json

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.signal import lsim
from two_masses import DECK, K

from mouse_cli._errors import RecordError
from mouse_cli.cli.main import cli
from mouse_cli.formats import read_deck
from mouse_cli.updating.recordings.records import records

RATE, FINER, SECONDS = 512, 8, 6.0
MODEL = DECK.format(rate=0, outputs="").partition("test:")[0]
BETWEEN = np.array([[1.0, -1.0], [-1.0, 1.0]])


def struck(folder, name: str, at: int, begin_s: float, stiffer: float = 0.0, clipped: float = np.inf) -> None:
    """A file of one stroke of 8 ms on a mass, that begins so late, with noise of 0.2 % of its peak and 1 % of the motion."""
    rng, t = np.random.default_rng([at, int(1e4 * begin_s)]), np.arange(int(SECONDS * RATE * FINER)) / (RATE * FINER)
    x = (t - begin_s) / 8e-3
    f = 200 * np.where((x > 0) & (x < 1), np.sin(np.pi * x) ** 2, 0)
    A = np.block([[np.zeros((2, 2)), np.eye(2)], [-1.02 * K - stiffer * BETWEEN, -1.2e-4 * K]])
    B = np.zeros((4, 1))
    B[1 + at] = 1.0
    _, a, _ = lsim((A, B, A[2:], B[2:]), f, t)
    f, a = f[::FINER], a[::FINER]
    f = f + 0.4 * rng.standard_normal(len(f))
    a = a + 0.01 * a.std(axis=0) * rng.standard_normal(a.shape)
    a[:, 1] = np.clip(a[:, 1], -clipped, clipped)
    head = f"Time (s),Hammer{at} (N),Acc1 (m/s2),Acc2 (m/s2)"
    rows = np.column_stack([np.arange(len(f)) / RATE, f, a])
    np.savetxt(folder / f"{name}.csv", rows, delimiter=",", header=head, comments="", fmt="%.9g")


def said(folder, *options: str) -> dict:
    (folder / "model.yaml").write_text(MODEL)
    words = ["diagnose", str(folder / "model.yaml"), "--recordings", str(folder / "raw"), *options, "--json", "-q"]
    done = CliRunner().invoke(cli, words)
    assert done.exit_code in (0, 1), done.output
    return json.loads(done.stdout)


RESPONSES = ("--response", "1=Acc1", "--response", "2=Acc2")


@pytest.mark.parametrize("begin", [0.02, 0.3, 5.8])
def test_a_sound_structure_lacks_nothing_wherever_its_strokes_are(tmp_path, begin):
    """A stroke 40 ms after the beginning of 8 s was taken for noise: 214 times the variance, or a wrong gain of the force."""
    (tmp_path / "raw").mkdir()
    for i in range(3):
        struck(tmp_path / "raw", f"hit{i}", 2, begin + 0.01 * i)
    found = said(tmp_path, "--force", "2=Hammer2", *RESPONSES)
    assert found["verdict"]["kind"] == "nothing-missing"


def test_a_hammer_that_goes_from_place_to_place_is_read_and_used(tmp_path):
    """Files with another force were passed over, all of them where both were named; of a deck the others were left out."""
    (tmp_path / "raw").mkdir()
    for i, at in enumerate((2, 2, 2, 1, 1)):
        struck(tmp_path / "raw", f"hit{i}", at, 0.05 + 0.01 * i, stiffer=2e4)
    forces = ("--force", "1=Hammer1", "--force", "2=Hammer2")
    found = said(tmp_path, *forces, *RESPONSES, "-o", str(tmp_path / "more.yaml"))
    assert found["verdict"]["physics"] == "spring" and found["verdict"]["sites"][0]["ids"] == [1, 2]
    assert len(found["recordings"]["fitted"]) == 4 and "left out" not in " ".join(found["remarks"])
    deck = read_deck(tmp_path / "more.yaml")
    whole = records(deck)
    assert len(whole.fitted) == 4 and [one.name for one in whole.inputs] == ["Hammer2", "Hammer1"]
    assert [[bool(column.any()) for column in one.force.T] for one in whole.fitted] == [[True, False]] * 2 + [[False, True]] * 2


def test_a_file_without_any_of_the_forces_is_told(tmp_path):
    (tmp_path / "raw").mkdir()
    struck(tmp_path / "raw", "hit", 2, 0.05)
    (tmp_path / "model.yaml").write_text(MODEL)
    words = ["diagnose", str(tmp_path / "model.yaml"), "--recordings", str(tmp_path / "raw"), "--force", "2=Hammer3"]
    with pytest.raises(RecordError, match="MD626") as refused:
        CliRunner().invoke(cli, words, catch_exceptions=False)
    assert "no channels 'Hammer3'" in str(refused.value)


@pytest.mark.parametrize("whole", [0, 2])
def test_what_is_clipped_is_asked_of_no_fit(tmp_path, whole):
    """Of recordings some of which are whole the others go; where all are clipped, that output. It was *something is missing*."""
    (tmp_path / "raw").mkdir()
    for i in range(3):
        struck(tmp_path / "raw", f"hit{i}", 2, 0.05 + 0.01 * i, clipped=np.inf if i < whole else 40.0)
    found = said(tmp_path, "--force", "2=Hammer2", *RESPONSES)
    assert found["verdict"]["kind"] == "nothing-missing"
    told = " ".join(found["remarks"])
    assert ("channel Acc2, which is clipped" in told) == (not whole)

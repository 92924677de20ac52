"""Measured modes of a four-storey laboratory frame (Georgia Tech), typed into a deck."""

from pathlib import Path

import numpy as np
import pytest

from mouse_cli.formats import read_deck
from mouse_cli.updating import run

ROOT = Path(__file__).resolve().parents[2]
MEASURED = ROOT.parent / "shared" / "data" / "smu_four_story" / "four_story_modal.csv"


@pytest.fixture(scope="module")
def problem():
    """The deck."""
    return read_deck(ROOT / "decks" / "four_storey_frame.yaml")


@pytest.mark.skipif(not MEASURED.exists(), reason="the measured data are not beside the project")
def test_the_deck_holds_what_was_measured(problem):
    data = np.loadtxt(MEASURED, delimiter=",", skiprows=1)
    np.testing.assert_allclose(problem.test.frequency_hz, data[:, 0], atol=5e-5)
    np.testing.assert_allclose(problem.test.shapes, data[:, 1:].T, atol=6e-6)  # one line of the file is one mode


def test_revised_storeys_and_the_verdict(problem):
    """Published answers stiffen upwards (about 7.2, 8.0, 8.9, 14.8 lbf/in) although the storeys are built alike."""
    result = run(problem)
    np.testing.assert_allclose(result.revised.theta, [7.2, 8.0, 8.9, 14.8], rtol=0.03)
    assert result.rejected and result.exit_code == 1
    assert np.abs(result.revised.mac - 1).max() < 0.01

"""Names given to causes that are concealed: a few structures of the blind benchmark, truths by CalculiX."""

import shutil
import sys
from pathlib import Path

import pytest
from proofs import proofs

sys.path.insert(0, str(Path(__file__).parents[2]))
from benchmarks.blind import beams, decks
from benchmarks.blind.test_data import CONFIGS, measured
from mouse_cli.diagnosis import diagnose
from mouse_cli.formats import read_deck
from mouse_cli.model.diagnosis import NAMED, NOTHING

pytestmark = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
SEED = 11
CAUSES = ("thick", "root", "crack", "mass", "absorber", "tension", "soft", "sensor")


def diagnosed(truth: str, tmp_path, config: str = "A", k: int = 0):
    """The case, and what mouse makes of its deck."""
    case = next(c for c in beams.cases("fresh", SEED, 4) if c.name == f"beam-{truth}-{k}")
    test = measured(case, case.make(case.inputs), CONFIGS[config], (0,))
    return case, diagnose(read_deck(decks.write(tmp_path, "concealed", case, test, CONFIGS[config])))


@pytest.mark.parametrize("truth", proofs(CAUSES, "mass"))
def test_the_concealed_cause_is_named_at_its_place(truth, tmp_path):
    """Its group with P of at least 0.9, a local one within 5 % of the span; the extended model predicts what was held out."""
    case, found = diagnosed(truth, tmp_path)
    assert found.kind == NAMED
    assert set(found.best.group.split(" + ")) - set(case.tolerated) == set(case.groups)
    places = [cause.site.position[0] for cause in found.best.causes if cause.site.position]
    for place in case.places:
        assert min(abs(place[0] - x) for x in places) < 0.05 * case.span
    assert found.extended is not None
    held = found.held_out
    if truth != "sensor":
        assert held.revised.log_predictive_density > held.baseline.log_predictive_density + 3
        assert held.revised.rms_frequency_error < 0.7 * held.baseline.rms_frequency_error


@pytest.mark.parametrize("k", proofs(range(3), 1))
def test_nothing_is_missing_in_controls(k, tmp_path):
    _, found = diagnosed("control", tmp_path, k=k)
    assert found.kind == NOTHING
    assert found.exit_code == 0


@pytest.mark.parametrize("truth", proofs(["wavy", "half foundation"], "half foundation"))
def test_what_no_candidate_explains_is_not_named(truth, tmp_path):
    _, found = diagnosed(truth, tmp_path)
    assert found.kind != NAMED

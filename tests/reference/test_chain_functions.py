"""The chain of decks/chain_functions.yaml: its functions, what a diagnosis makes of them, and the deck that comes of it."""

import importlib.util
import json
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mouse_cli import report
from mouse_cli.diagnosis import diagnose
from mouse_cli.formats import read_deck, write_deck
from mouse_cli.model.diagnosis import NAMED
from mouse_cli.plots import draw
from mouse_cli.report.renderers.printout import WIDTH
from mouse_cli.updating import run

DECK = Path(__file__).resolve().parents[2] / "decks" / "chain_functions.yaml"
_spec = importlib.util.spec_from_file_location("make", DECK.with_suffix("") / "make.py")
make = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(make)


def test_closed_form_is_the_inverse_of_the_dynamic_stiffness():
    hz, n = np.linspace(1.0, 70.0, 40), make.N
    K = 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    K[-1, -1] = 1.0
    K = make.STIFFNESS * (1 + 1j * make.LOSS) * K
    K[make.AT - 1, make.AT - 1] += make.SPRING * (1 + 1j * make.OWN_LOSS)
    exact = np.linalg.inv(K - (2 * np.pi * hz[:, None, None]) ** 2 * make.MASS * np.eye(n))
    np.testing.assert_allclose(make.receptance(hz), exact, rtol=1e-9, atol=1e-12 * np.abs(exact).max())


@pytest.fixture(scope="module")
def found():
    return diagnose(read_deck(DECK))


@pytest.fixture(scope="module")
def revised(found, tmp_path_factory):
    """The run of the deck that the diagnosis writes."""
    folder = tmp_path_factory.mktemp("revised")
    shutil.copytree(DECK.with_suffix(""), folder / "chain_functions")
    own = found.extended
    own = replace(own, source=replace(own.source, path=str(folder / "deck.yaml")))
    return run(read_deck(write_deck(own, str(folder / "revised.yaml"))[-1]))


def test_the_spring_is_named_with_its_size_and_its_loss(found):
    (cause,) = found.best.causes
    assert (found.kind, found.best.group, cause.law) == (NAMED, "ground-spring", "structural")
    assert cause.site.ids == ("3TX",)
    size, loss = cause.sizes
    assert abs(size.value - make.SPRING) < 4 * size.sd and size.sd < 0.02 * make.SPRING
    assert abs(loss.value - make.OWN_LOSS) < 4 * loss.sd and loss.sd < 0.1 * make.OWN_LOSS


def test_damping_of_the_structure_is_found(found):
    eta, by_mass, by_stiffness, ratio = found.damping
    assert eta.determined and abs(eta.value - make.LOSS) < 4 * eta.sd and eta.sd < 0.05 * make.LOSS
    assert not (by_mass.determined or by_stiffness.determined or ratio.determined)  # there is none


def test_functions_are_met_to_their_noise_and_foreseen_where_they_were_held_out(found):
    (fit,), (held,) = found.frf, found.held_frf
    assert [model.key for model in fit.models] == ["baseline", "revised"]
    assert fit.rms_sd(fit.revised) == pytest.approx(1.0, abs=0.06) and fit.rms_sd(fit.prior) > 5
    assert held.rms_sd(held.revised) == pytest.approx(1.0, abs=0.2) and held.rms_sd(held.prior) > 5
    truth = (
        -((2 * np.pi * held.test.frequency_hz) ** 2)[:, None]
        * make.receptance(held.test.frequency_hz)[:, [j - 1 for j in make.RESPONSES], make.FORCE - 1]
    )
    off = np.log(np.abs(held.revised[:, :, 0] / truth)) / held.models[-1].sd[:, :, 0]
    assert np.abs(off).max() < 5
    assert not ((fit.test.frequency_hz >= 30) & (fit.test.frequency_hz <= 36)).any()


def test_sd_of_functions_is_that_of_the_unknowns(found):
    """The sd of ln|H| at a resonance of a chain whose damping is known to s is about s; far below, that of 1 / stiffness."""
    (fit,) = found.frf
    sd = fit.models[-1].sd
    assert np.isfinite(sd).all() and (sd > 0).all() and sd.max() < 0.05


def test_report_document_and_figures(found, tmp_path):
    for form in ("printout", "markdown"):
        text = " ".join(report.written(found, form, "modern").split()).upper()
        for words in (
            "FREQUENCY RESPONSE FUNCTIONS, BEFORE AND AFTER",
            "LOSS FACTOR: STRUCTURAL",
            "FUNCTIONS HELD OUT",
        ):
            assert words in text
    assert max(map(len, report.printout(found, "modern").split("\n"))) <= WIDTH
    document = report.document(found)
    assert json.loads(json.dumps(document, allow_nan=False)) == document
    assert document["frf"][0]["revised_rms_sd"] < 1.1 and document["held_out_frf"][0]["revised_covered"] > 0.7
    pytest.importorskip("matplotlib")
    drawn = {Path(path).stem for path in draw(found, str(tmp_path / "figures"))}
    assert {"frf-overlay", "frf-detail", "frf-misfit", "frf-held-out"} <= drawn


def test_the_deck_that_is_written_runs_and_fits_as_well(found, revised):
    """Its parameters are those of the closed form, its cause's loss and the structure's among them; nothing is left but noise."""
    assert revised.status.key == "converged" and revised.exit_code == 0
    truth = [make.STIFFNESS, make.MASS, make.SPRING, make.LOSS, make.OWN_LOSS]
    assert len(revised.problem.parameters) == len(truth)
    assert np.abs((revised.revised.theta - truth) / revised.sd_theta).max() < 4
    (fit,), (own,) = revised.frf, found.frf
    assert fit.rms_sd(fit.revised) < 1.01 * own.rms_sd(own.revised)
    (held,) = revised.held_frf
    assert held.covered(held.models[-1]) == pytest.approx(0.9, abs=4 * np.sqrt(0.09 / held.have.sum()))


def test_a_deck_of_matrices_has_the_damping_as_it_was_found(tmp_path):
    """The same chain as K and M: damping is no parameter there, and yet the run is as good but for what its sd leaves."""
    text = DECK.read_text()
    n, k = make.N, make.STIFFNESS
    K = k * (2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1))
    K[-1, -1] = k
    model = f"model:\n  stiffness: {{dense: {K.tolist()}}}\n  mass: {{diagonal: {[make.MASS] * n}}}\n"
    parameters = f"parameters:\n  - {{name: k1, nominal: {k}, sd: 5 %, transform: log, stiffness: [[1, 1, 1.0]]}}\n"
    test = text[text.index("test:") :].replace("1TX", "1").replace("3TX", "3").replace("5TX", "5")
    shutil.copytree(DECK.with_suffix(""), tmp_path / "chain_functions")
    (tmp_path / "deck.yaml").write_text(text[: text.index("model:")] + model + parameters + test)
    found = diagnose(read_deck(tmp_path / "deck.yaml"))
    assert (found.kind, found.best.group) == (NAMED, "ground-spring")
    result = run(read_deck(write_deck(found.extended, str(tmp_path / "revised.yaml"))[-1]))
    assert result.status.key == "converged" and not result.rejected
    (fit,), (own,) = result.frf, found.frf
    assert fit.rms_sd(fit.revised) < 1.03 * own.rms_sd(own.revised)

"""Runs with functions: gains of the chains, lines and functions that are held out, models without damping."""

from dataclasses import replace

import numpy as np
import pytest
from test_frf_updating import K0, chain, deck, measured, problem

from mouse_cli import report
from mouse_cli._errors import DeckError
from mouse_cli.formats import read_deck
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.hold_out import HeldRecords
from mouse_cli.report.renderers.printout import WIDTH
from mouse_cli.updating import run

SPRINGS = K0 * np.array([1.1, 0.93, 1.04])


def _scaled(test: FrfTest, response: np.ndarray, force: float, gain_sd: float) -> FrfTest:
    """The measurement of chains that are off by these factors."""
    factor = force * response[:, None]
    return replace(
        test, H=test.H * factor, variance=test.variance * factor**2, gain_sd=gain_sd, output_names=("a", "b")
    )


@pytest.mark.parametrize("form", ["complex", "log"])
def test_gains_are_found_beside_the_parameters(form):
    """Chains off by 6 and -4 %; ratio of gains and stiffness over mass are known, and the truth lies within its sd."""
    rng = np.random.default_rng(3)
    clean = measured(rng, SPRINGS, 0.01, [0, 2], form)
    result = run(problem(3, _scaled(clean, np.array([1.06, 0.96]), 1.0, 0.1)))
    assert [p.name for p in result.problem.parameters[-3:]] == [
        "gain of response a",
        "gain of response b",
        "gain of force 1",
    ]
    truth = np.concatenate([SPRINGS, [0.01, 1.06, 0.96, 1.0]])
    assert np.abs((result.revised.theta - truth) / result.sd_theta).max() < 4
    assert result.revised.theta[4] / result.revised.theta[5] == pytest.approx(1.06 / 0.96, rel=0.005)
    assert result.status.key == "converged" and not result.rejected
    without = run(problem(3, _scaled(clean, np.array([1.06, 0.96]), 1.0, 0.0)))
    assert without.rejected


def test_sds_of_gains_cover():
    """Gains drawn from their prior: (answer - truth) / sd has unit variance over 40 measurements, of gains too."""
    off = []
    for seed in range(40):
        rng = np.random.default_rng(seed)
        clean = measured(rng, SPRINGS, 0.02, [0, 2], noise=0.05, lines=60)
        gains = np.exp(0.05 * rng.standard_normal(3))
        result = run(problem(3, _scaled(clean, gains[:2], gains[2], 0.05)))
        truth = np.concatenate([SPRINGS, [0.02], gains])
        off.append((result.revised.theta - truth) / result.sd_theta)
    assert 0.75 < np.sqrt(np.mean(np.square(off))) < 1.3


def test_a_response_has_one_gain_in_all_measurements_and_each_hammer_its_own():
    rng = np.random.default_rng(4)
    tests = tuple(
        replace(
            measured(rng, SPRINGS, 0.01, [0, 2]), gain_sd=0.05, output_names=("a", "b"), input_names=("h",), title=title
        )
        for title in ("first", "second")
    )
    result = run(problem(3, *tests))
    names = [p.name for p in result.problem.parameters[4:]]
    assert names == [
        "gain of response a", "gain of response b", "gain of force h of first", "gain of force h of second"
    ]  # fmt: skip


def test_sensitivities_of_gains_are_derivatives():
    """T of the run against differences of predicted functions of the independent chain: d ln|H| / d ln g = 1."""
    rng = np.random.default_rng(6)
    test = _scaled(measured(rng, SPRINGS, 0.01, [0, 2], "log", lines=20), np.ones(2), 1.0, 0.1)
    given = problem(3, test)
    result = run(replace(given, run=replace(given.run, print_partials=True)))
    rows = np.array([label.startswith("ln H(a") for label in result.labels])
    assert result.T[rows, 4] == pytest.approx(1.0)  # by the logarithm of the gain
    assert result.T[~rows, 4] == pytest.approx(0.0)
    assert result.T[:, 6] == pytest.approx(1.0)


def test_lines_held_out_are_foreseen_and_not_fitted():
    """A model without errors foresees what it has not seen: 90 % of the magnitudes lie within 90 % intervals."""
    rng = np.random.default_rng(7)
    whole = measured(rng, SPRINGS, 0.01, [0, 2], noise=0.05)
    at = np.arange(len(whole.frequency_hz)) % 4 == 0
    part = lambda keep: replace(
        whole, frequency_hz=whole.frequency_hz[keep], H=whole.H[keep], variance=whole.variance[keep]
    )
    given = problem(3, part(~at))
    without, result = run(given), run(replace(given, held_records=HeldRecords(frf=(part(at),))))
    assert result.revised.theta.tolist() == without.revised.theta.tolist()
    (fit,) = result.held_frf
    assert not len(fit.lines) and len(fit.test.frequency_hz) == at.sum()
    truth = chain(SPRINGS, 0.01, fit.test.frequency_hz)[:, [0, 2]][:, :, [0]]
    assert np.abs(np.log(np.abs(fit.revised / truth))).max() < 0.05
    count = fit.have.sum()
    assert abs(fit.covered(fit.models[-1]) - 0.9) < 4 * np.sqrt(0.09 / count)
    assert fit.rms_sd(fit.revised) == pytest.approx(1.0, abs=0.1) and fit.rms_sd(fit.prior) > 5
    text = report.printout(result, "modern")
    assert "FREQUENCY RESPONSE FUNCTIONS HELD OUT" in text and "none was fitted" in text
    assert max(map(len, text.split("\n"))) <= WIDTH
    (entry,) = report.document(result)["held_out_frf"]
    assert entry["revised_covered"] == pytest.approx(fit.covered(fit.models[-1]))


def test_functions_may_be_held_out_from_a_run_of_modes():
    """Modes are fitted; the functions of the same chain are foreseen by them."""
    rng = np.random.default_rng(8)
    whole = measured(rng, SPRINGS, 0.01, [0, 2])
    K = np.diag(SPRINGS) + np.diag(np.append(SPRINGS[1:], 0)) - np.diag(SPRINGS[1:], 1) - np.diag(SPRINGS[1:], -1)
    hz = np.sqrt(np.linalg.eigvalsh(K) / 2.0) / (2 * np.pi)
    given = problem(3)
    from mouse_cli.model.modal_test import ModalTest

    none = np.zeros((0, 3))
    modes = ModalTest(np.arange(1, 4), hz, 1e-4 * hz, np.zeros(0, int), none, none)
    result = run(replace(given, test=modes, held_records=HeldRecords(frf=(whole,))))
    assert not result.frf
    (fit,) = result.held_frf
    assert fit.median_db(fit.revised) < 0.15 < 1 < fit.median_db(fit.prior)


def test_a_model_without_damping_is_told_so():
    rng = np.random.default_rng(9)
    test = measured(rng, SPRINGS, 0.01, [0, 2], "log")
    codes = [remark.code for remark in run(problem(3, test)).warnings]
    assert "MD518" not in codes
    bare = deck(3).replace(", loss_factor: 0.01", "").split("  - {name: eta")[0]
    from mouse_cli.formats.assemble import assemble
    from mouse_cli.formats.yaml_deck.reader import read

    given = assemble(read(bare + "test: {modes: {frequency: [1.0], frequency_sd: [1.0]}}", "x.yaml"))
    result = run(replace(given, test=None, frf=(test,)))
    (remark,) = [remark for remark in result.warnings if remark.code == "MD518"]
    assert "loss_factor" in remark.help


@pytest.mark.parametrize(("written", "read"), [("2 %", 0.02), ("0.15", 0.15)])
def test_gain_sd_of_a_deck(tmp_path, written, read):
    (tmp_path / "deck.yaml").write_text(_given(f"gain_sd: {written}"))
    assert read_deck(tmp_path / "deck.yaml").frf[0].gain_sd == read


@pytest.mark.parametrize("written", ["0", "-1 %", "120 %", "much"])
def test_gain_sd_that_is_none(tmp_path, written):
    (tmp_path / "deck.yaml").write_text(_given(f"gain_sd: {written}"))
    with pytest.raises(DeckError) as caught:
        read_deck(tmp_path / "deck.yaml")
    assert "gain_sd" in str(caught.value)


def _given(more: str) -> str:
    return deck(1) + (
        f"test:\n  frf: [{{title: a, kind: receptance, unit: m/N, input: 1TX, frequency: [1, 2], {more},\n"
        "    outputs: {1TX: {real: [1.0, 2.0], imag: [0.1, 0.2]}}}]\n"
    )

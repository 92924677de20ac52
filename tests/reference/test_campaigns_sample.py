"""Samples of posteriors against closed forms and quadrature, and the diagnostics of the normal density against known answers."""

import json
from math import pi
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import genpareto, norm, truncnorm

from mouse_cli.campaigns.sampling import chains, pareto
from mouse_cli.formats import read_deck
from mouse_cli.model.sampled import Sampling
from mouse_cli.updating import run

pytest.importorskip("emcee", reason="samples need emcee")
from mouse_cli.campaigns.sampling.sample import sample

DECKS = Path(__file__).resolve().parents[2] / "decks"
SHARES = (0.025, 0.16, 0.5, 0.84, 0.975)
ONE_MASS = """\
mouse: 1
model: {{stiffness: {{order: 1, entries: [[1, 1, 1000.0]]}}, mass: {{diagonal: [1.0]}}}}
parameters:
  - {{name: it, {parameter}}}
test: {{modes: {{number: [1], frequency: [{hz}], frequency_sd: {sd}}}}}
"""


def one_mass(folder: Path, parameter: str, hz: float, sd: float):
    """One mass on one spring, of which one property varies; the datum is lambda = (2 pi f)^2 with sd 8 pi^2 f sd_f."""
    path = folder / "one.yaml"
    path.write_text(ONE_MASS.format(parameter=parameter, hz=hz, sd=sd))
    return read_deck(path), (2 * pi * hz) ** 2, 8 * pi**2 * hz * sd


def agrees(found, exact: np.ndarray) -> None:
    """Quantiles of the samples are those of the posterior, within five Monte-Carlo standard errors (of the empirical cdf)."""
    error = np.sqrt(np.array(SHARES) * (1 - np.array(SHARES)) / found.size)
    reached = np.interp(found.quantiles, *exact)
    assert np.all(np.abs(reached - SHARES) < 5 * error)


def curve(density, low: float, high: float) -> tuple[np.ndarray, np.ndarray]:
    """Places and cumulative distribution of a density that is known up to a factor, by quadrature."""
    from scipy.integrate import cumulative_simpson

    x = np.linspace(low, high, 20_001)
    total = cumulative_simpson(density(x), x=x, initial=0.0)
    return x, total / total[-1]


def test_a_linear_problem_has_the_normal_posterior_of_the_closed_form(tmp_path):
    """lambda = k / m is linear in k: precision and mean add up (conjugate normal)."""
    problem, measured, sd = one_mass(tmp_path, "nominal: 1000.0, sd: 100.0, stiffness: [[1, 1, 1]]", 5.2, 0.2)
    precision = 1 / 100.0**2 + 1 / sd**2
    mean = (1000.0 / 100.0**2 + measured / sd**2) / precision
    exact = norm(mean, precision**-0.5)
    found = sample(problem, Sampling())
    assert found.long_enough and not found.doubtful and not found.warnings
    assert found.k_hat == 0.0
    assert found.parameters[0].normal_sd == pytest.approx(precision**-0.5, rel=1e-9)
    x = np.linspace(mean - 600, mean + 600, 4001)
    agrees(found.parameters[0], (x, exact.cdf(x)))


def test_a_correlated_prior_carries_what_is_measured_over(tmp_path):
    """One of two separate springs is measured; of the other the conditional normal distribution tells: both closed forms."""
    path = tmp_path / "two.yaml"
    path.write_text(
        "mouse: 1\nmodel: {stiffness: {order: 2, entries: [[1, 1, 1000.0], [2, 2, 5000.0]]}, mass: {identity: 2}}\n"
        "parameters: [{name: a, nominal: 1000.0, sd: 100.0, stiffness: [[1, 1, 1]]},"
        " {name: b, nominal: 5000.0, sd: 300.0, stiffness: [[2, 2, 1]]}]\nprior: {correlations: [[a, b, 0.8]]}\n"
        "test: {modes: {number: [1], frequency: [5.3], frequency_sd: 0.1}}\n"
    )
    measured, sd = (2 * pi * 5.3) ** 2, 8 * pi**2 * 5.3 * 0.1
    gain = np.array([100.0**2, 0.8 * 100.0 * 300.0]) / (100.0**2 + sd**2)
    mean = np.array([1000.0, 5000.0]) + gain * (measured - 1000.0)
    spread = np.sqrt(np.array([100.0**2, 300.0**2]) - gain**2 * (100.0**2 + sd**2))
    found = sample(read_deck(path), Sampling())
    for each, m, s in zip(found.parameters, mean, spread, strict=True):
        x = np.linspace(m - 6 * s, m + 6 * s, 2001)
        agrees(each, (x, norm(m, s).cdf(x)))


def test_a_limit_cuts_the_posterior_off(tmp_path):
    problem, measured, sd = one_mass(
        tmp_path, "nominal: 1000.0, sd: 100.0, lower: 980.0, stiffness: [[1, 1, 1]]", 5.0, 0.2
    )
    precision = 1 / 100.0**2 + 1 / sd**2
    mean = (1000.0 / 100.0**2 + measured / sd**2) / precision
    cut = truncnorm((980.0 - mean) * precision**0.5, np.inf, mean, precision**-0.5)
    found = sample(problem, Sampling())
    x = np.linspace(980.0, mean + 600, 4001)
    agrees(found.parameters[0], (x, cut.cdf(x)))
    assert found.chain.theta.min() >= 980.0


def test_a_mass_by_quadrature_and_the_warning_of_the_run(tmp_path):
    """lambda = k / m, m from 1 to a third: the posterior is skew; quantiles by quadrature."""
    problem, measured, sd = one_mass(tmp_path, "nominal: 1.0, sd: 1.0, lower: 0.05, mass: [[1, 1, 1]]", 4.0, 1.0)
    found = sample(problem, Sampling())

    def density(m):
        return np.exp(-0.5 * ((measured - 1000.0 / m) / sd) ** 2 - 0.5 * (m - 1.0) ** 2)

    agrees(found.parameters[0], curve(density, 0.05, 7.0))
    assert "MD550" in [each.code for each in found.warnings]
    assert "MD550" in [each.code for each in run(problem).warnings]


def test_a_normal_density_that_cannot_be_corrected_is_told(tmp_path):
    """A mass that the test hardly determines: its samples by quadrature have another mean and sd than the run says."""
    problem, measured, sd = one_mass(tmp_path, "nominal: 1.0, sd: 2.0, lower: 0.05, mass: [[1, 1, 1]]", 5.0, 2.0)
    found = sample(problem, Sampling())

    def density(m):
        return np.exp(-0.5 * ((measured - 1000.0 / m) / sd) ** 2 - 0.5 * ((m - 1.0) / 2.0) ** 2)

    agrees(found.parameters[0], curve(density, 0.05, 12.0))
    assert found.k_hat > pareto.DOUBTFUL and found.doubtful
    assert {"MD550", "MD942", "MD945"} <= {each.code for each in found.warnings}


def test_logarithms_are_sampled_as_the_prior_says(tmp_path):
    """u = ln k is normal before the test, with sd 0.5 by the deck's 500 of 1000."""
    problem, measured, sd = one_mass(
        tmp_path, "nominal: 1000.0, sd: 500.0, transform: log, stiffness: [[1, 1, 1]]", 4.5, 0.9
    )
    found = sample(problem, Sampling())

    def density(k):
        return np.exp(-0.5 * ((measured - k) / sd) ** 2 - 0.5 * (np.log(k / 1000.0) / 0.5) ** 2) / k

    agrees(found.parameters[0], curve(density, 20.0, 6000.0))


def test_two_springs_that_can_be_exchanged():
    """Both orders have half of the posterior; the margin of one by quadrature over the other. lambda: roots of 2 x 2 matrices."""
    problem = read_deck(DECKS / "twin_springs.yaml")
    found = sample(problem, Sampling(seed=3))
    assert found.long_enough and found.doubtful
    assert {"MD550", "MD943"} <= {each.code for each in found.warnings}
    assert run(problem).alternatives.doubtful
    left, right = (found.chain.theta[:, :, i].ravel() for i in (0, 1))
    assert np.mean(left > right) == pytest.approx(0.5, abs=5 * 0.5 / found.parameters[0].size ** 0.5)
    assert [each.share for each in found.modes] == pytest.approx([0.5, 0.5], abs=0.09)
    k = np.linspace(300.0, 1900.0, 801)
    a, b = k[:, None], k[None, :]
    middle, half = (a + b) / 2 + 500.0, np.hypot((a - b) / 2, 500.0)
    misfit = (a - 1000.0) ** 2 / 300.0**2 + (b - 1000.0) ** 2 / 300.0**2
    for value, hz in ((middle - half, 4.92), (middle + half, 7.2)):
        misfit = misfit + ((value - (2 * pi * hz) ** 2) / (8 * pi**2 * hz * 0.01 * hz)) ** 2
    margin = np.exp(-0.5 * misfit).sum(axis=1)
    total = np.concatenate([[0.0], np.cumsum((margin[1:] + margin[:-1]) / 2)])
    agrees(found.parameters[0], (k, total / total[-1]))


@pytest.mark.parametrize("k", [0.0, 0.3, 0.7, 1.2])
def test_k_hat_of_weights_whose_tail_is_known(k):
    """Weights drawn from a generalised Pareto distribution: its tail has the same k; drawn to 0.5 as by ten draws of 134."""
    rng = np.random.default_rng(5)
    weights = genpareto.rvs(k, size=(200, 2000), random_state=rng)
    found = [pareto.k_hat(np.log(each)) for each in weights]
    expected = (134 * k + 5) / 144
    assert np.mean(found) == pytest.approx(expected, abs=0.05)


@pytest.mark.parametrize("ratio", [0.9, 0.5, 0.2])
def test_k_hat_of_normal_draws_for_a_wider_normal(ratio):
    """w = exp(n^2 (1 - r^2) / 2) with n normal has a tail of index 1 / (1 - r^2): k = 1 - r^2, for r = sd of draws / sd."""
    n = np.random.default_rng(6).standard_normal(200_000)
    assert pareto.k_hat(0.5 * n**2 * (1 - ratio**2)) == pytest.approx(1 - ratio**2, abs=0.15)
    assert pareto.k_hat(np.where(n > 4.2, 0.0, -np.inf)) == np.inf


def test_r_hat_knows_walkers_that_do_not_agree():
    rng = np.random.default_rng(7)
    same = rng.standard_normal((400, 16, 1))
    assert chains.r_hat(same)[0] < 1.01
    apart = same + np.where(np.arange(16) < 8, 0.0, 6.0)[None, :, None]
    assert chains.r_hat(apart)[0] > 1.5


def test_autocorrelation_time_of_a_process_whose_time_is_known():
    """x' = a x + e: tau = (1 + a) / (1 - a)."""
    rng = np.random.default_rng(8)
    x = np.zeros((20_000, 16, 1))
    for i in range(1, len(x)):
        x[i] = 0.8 * x[i - 1] + rng.standard_normal((16, 1))
    assert chains.times(x)[0] == pytest.approx(9.0, rel=0.1)


def test_command_writes_samples_without_pickles_the_same_by_processes(tmp_path, capsys):
    from mouse_cli.cli.main import main

    def told(name: str, *more: str) -> dict:
        with pytest.raises(SystemExit):
            arguments = ["sample", str(DECKS / "table_5_3.yaml"), "--steps", "250", "--chain", str(tmp_path / name)]
            main([*arguments, "--json", *more])
        return json.loads(capsys.readouterr().out)

    one, two = told("one"), told("two.npz", "--jobs", "2")
    assert one == two
    assert one["schema"] == "mouse.sample/1" and one["exit_code"] == 1  # 250 steps are too few
    assert any(each.startswith("MD944") for each in one["warnings"])
    with np.load(tmp_path / "one.npz", allow_pickle=False) as kept:
        assert kept["names"].tolist() == ["k1", "k2"]
        assert kept["theta"].shape == (*kept["log_posterior"].shape, 2)
        assert kept["theta"][:, :, 0].mean() == pytest.approx(one["parameters"][0]["mean"], rel=1e-12)


def test_a_walk_that_is_killed_goes_on_and_ends_like_an_unbroken_one(tmp_path):
    """Killed whenever its file has grown; at the end the same samples, bit by bit, and no file of the walk."""
    import signal
    import subprocess
    import sys
    import time

    steps = ["--steps", "1000", "-q", "--json"]
    deck = str(DECKS / "twin_springs.yaml")
    command = lambda name: [sys.executable, "-m", "mouse_cli", "sample", deck, "--chain", str(tmp_path / name), *steps]
    whole = subprocess.run(command("whole"), capture_output=True, check=False, timeout=300)
    part, seen = tmp_path / "broken.npz.part", []
    for _ in range(2):
        process = subprocess.Popen(command("broken"), stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        before = part.stat().st_mtime_ns if part.exists() else 0
        while process.poll() is None and not (part.exists() and part.stat().st_mtime_ns > before):
            time.sleep(0.01)
        process.send_signal(signal.SIGKILL)
        process.communicate()
        if not part.exists():
            break
        with np.load(part) as held:
            seen.append(len(held["chain"]))
    assert seen and seen == sorted(set(seen)), "each begins where the last was killed"
    end = subprocess.run(command("broken"), capture_output=True, check=False, timeout=300)
    assert end.stdout == whole.stdout and end.returncode == whole.returncode
    with np.load(tmp_path / "whole.npz") as one, np.load(tmp_path / "broken.npz") as other:
        assert all(np.array_equal(one[name], other[name]) for name in one.files)
    assert not part.exists()


def test_a_walk_of_another_deck_or_a_damaged_one_is_not_gone_on_with(tmp_path):
    problem = read_deck(DECKS / "twin_springs.yaml")
    (tmp_path / "chain.npz.part").write_bytes(b"PK\x03\x04 nothing")
    found = sample(problem, Sampling(steps=250), keep=str(tmp_path / "chain"))
    alone = sample(problem, Sampling(steps=250))
    np.testing.assert_array_equal(found.chain.theta, alone.chain.theta)


def test_nothing_to_sample_and_no_package(tmp_path, monkeypatch):
    import sys

    from mouse_cli._errors import MouseError

    problem, _, _ = one_mass(tmp_path, "nominal: 1000.0, sd: 0.0, stiffness: [[1, 1, 1]]", 5.0, 0.2)
    with pytest.raises(MouseError, match="MD941"):
        sample(problem, Sampling())
    monkeypatch.setitem(sys.modules, "emcee", None)
    with pytest.raises(MouseError, match="MD940"):
        sample(problem, Sampling())

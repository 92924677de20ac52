"""Parameters revised by FRFs: truths from independent matrices, statistics of the data forms, starts far from the answer."""

from dataclasses import replace

import numpy as np
import pytest

from mouse_cli.formats.assemble import assemble
from mouse_cli.formats.yaml_deck.reader import read
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.observables.frf import ASSUMED_OF_MAGNITUDE, ASSUMED_OF_MEDIAN, accuracy, chosen, observe
from mouse_cli.observables.frf_smoothing import smoothed
from mouse_cli.updating import run

K0, M0 = 1.0e5, 2.0


def deck(n: int, more: str = "") -> str:
    """A chain of n masses from the ground, a parameter for each spring and one for all loss factors."""
    springs = "\n".join(
        f"      - {{id: {i + 1}, type: spring, nodes: [{i}, {i + 1}], TX: {K0}, loss_factor: 0.01}}" for i in range(n)
    )
    return f"""mouse: 1
model:
  structure:
    nodes: {{line: {{from: 0, to: {n}, start: [0, 0, 0], end: [0, 0, 1]}}}}
    elements:
{springs}
      - {{id: 101-{100 + n}, type: mass, nodes: 1-{n}, mass: {M0}}}
    supports: {{0: all}}
    directions: [TX]
parameters:
  - {{name: k, elements: 1-{n}, property: TX, each: 1, sd: 30 %, transform: log}}
  - {{name: eta, elements: 1-{n}, property: loss_factor, sd: 100 %, transform: log}}
{more}"""  # fmt: skip


def chain(k: np.ndarray, eta: float, f: np.ndarray) -> np.ndarray:
    """Accelerance (f, n, n) of a chain of equal masses, by its matrices and numpy alone."""
    n = len(k)
    K = np.diag(k) + np.diag(np.append(k[1:], 0.0)) - np.diag(k[1:], 1) - np.diag(k[1:], -1)
    w2 = (2 * np.pi * f) ** 2
    return -w2[:, None, None] * np.linalg.inv(K * (1 + 1j * eta) - w2[:, None, None] * M0 * np.eye(n))


def measured(rng, k, eta, outputs, form="complex", noise=0.01, **more) -> FrfTest:
    """Its FRFs for a force on the first mass, with noise of known variance."""
    top = np.sqrt(
        np.linalg.eigvalsh(np.diag(k) + np.diag(np.append(k[1:], 0)) - np.diag(k[1:], 1) - np.diag(k[1:], -1))[-1] / M0
    )
    f = np.linspace(0.05, 1.1, 1200) * top / (2 * np.pi)
    H = chain(k, eta, f)[:, outputs][:, :, [0]]
    sd = noise * np.abs(H) + 0.002 * np.median(np.abs(H))
    H = H + sd * (rng.standard_normal(H.shape) + 1j * rng.standard_normal(H.shape))
    return FrfTest(f, H, "accelerance", np.array(outputs), np.array([0]), 2 * sd**2, form=form, **more)


def problem(n: int, *tests: FrfTest):
    """The deck with these measurements."""
    return replace(
        assemble(read(deck(n, "test: {modes: {frequency: [1.0], frequency_sd: [1.0]}}"), "x.yaml")),
        test=None,
        frf=tests,
    )


@pytest.mark.parametrize("form", ["complex", "log", "log-phase"])
@pytest.mark.parametrize(("bias", "eta"), [(-0.28, 0.003), (0.25, 0.003), (0.25, 0.02)])
def test_start_with_frequencies_wrong_by_an_eighth(form, bias, eta):
    """All frequencies 13 to 15 % wrong, resonances 0.15 to 1 % wide: far beyond where FRFs line by line lead anywhere."""
    rng = np.random.default_rng(5)
    k = K0 * np.exp(bias + 0.12 * rng.standard_normal(5))
    result = run(problem(5, measured(rng, k, eta, [0, 4], form)))
    assert result.status.key == "converged"
    assert not result.rejected
    off = (result.revised.theta[:5] - k) / result.sd_theta[:5]
    assert np.abs(off).max() < 4
    assert abs(result.revised.theta[5] / eta - 1) < 0.05
    assert np.abs(result.revised.theta[:5] / k - 1).max() < 0.01
    assert result.frf[0].median_db(result.frf[0].revised) < 0.15 < 3 < result.frf[0].median_db(result.frf[0].prior)


@pytest.mark.proof
def test_standard_deviations_cover():
    """Over 40 measurements, (answer - truth) / sd of every parameter has unit variance, whichever form is fitted."""
    k, off = K0 * np.array([1.1, 0.93, 1.04]), {"complex": [], "log": []}
    for seed in range(40):
        for form in off:
            rng = np.random.default_rng(seed)
            result = run(problem(3, measured(rng, k, 0.02, [0, 2], form, noise=0.05, lines=60)))
            off[form].append((result.revised.theta - np.append(k, 0.02)) / result.sd_theta)
    for values in off.values():
        assert (
            0.75 < np.sqrt(np.mean(np.square(values))) < 1.3
        )  # chi of 160 values: 1 +- 0.06, correlated between parameters


def test_missing_functions_and_lines():
    """NaN are left out; what is left gives the answer."""
    rng = np.random.default_rng(2)
    k = K0 * np.array([0.9, 1.1, 1.05])
    test = measured(rng, k, 0.01, [0, 1, 2])
    H = np.array(test.H)
    H[::3, 1] = np.nan
    H[:, 2] = np.nan
    variance = np.array(test.variance)
    variance[:50] = np.inf  # coherence 0
    result = run(problem(3, replace(test, H=H, variance=variance)))
    assert np.abs(result.revised.theta[:3] / k - 1).max() < 0.01
    assert not any("H(3," in label for label in result.labels)
    assert result.frf[0].lines.min() >= 50


def test_beside_modes():
    """Modal data and FRFs in one fit: both are in y, and the sd is that of both."""
    rng = np.random.default_rng(3)
    k = K0 * np.array([1.05, 0.97, 1.1])
    test = measured(rng, k, 0.01, [0])
    alone = run(problem(3, test))
    both = assemble(
        read(deck(3, f"test: {{modes: {{frequency: [{_frequency(k):.9f}], frequency_sd: [1.0e-4]}}}}"), "x.yaml")
    )
    result = run(replace(both, frf=(test,)))
    assert len(result.y) == len(alone.y) + 1
    assert result.labels[0] == "lambda 1"
    assert result.labels[1].startswith("Re H(1,1) at ")
    assert np.abs(result.revised.theta[:3] / k - 1).max() < 0.01
    assert (result.sd_theta <= alone.sd_theta * (1 + 1e-6)).all()


def _frequency(k: np.ndarray) -> float:
    K = np.diag(k) + np.diag(np.append(k[1:], 0)) - np.diag(k[1:], 1) - np.diag(k[1:], -1)
    return float(np.sqrt(np.linalg.eigvalsh(K)[0] / M0) / (2 * np.pi))


def test_spread_of_logarithms_is_that_of_the_delta_method():
    """ln|H| and the phase of noisy values scatter as their sd say, by simulation."""
    rng = np.random.default_rng(0)
    h, variance = 2.0 - 1.0j, 0.02
    noise = np.sqrt(variance / 2) * (rng.standard_normal(40000) + 1j * rng.standard_normal(40000))
    test = FrfTest(
        np.array([5.0]), np.full((1, 1, 1), h), "receptance", np.array([0]), np.array([0]), np.full((1, 1, 1), variance)
    )
    y, sd = observe(test, "log-phase").measured()
    assert np.allclose(y, [np.log(abs(h)), np.angle(h)])
    assert np.allclose(sd, [np.log(np.abs(h + noise)).std(), np.angle(h + noise).std()], rtol=0.02)
    y, sd = observe(test, "complex").measured()
    assert np.allclose(sd, [noise.real.std(), noise.imag.std()], rtol=0.02)


def test_what_is_no_larger_than_its_noise_has_no_logarithm():
    H = np.array([1.0, 0.1, 0.05]).reshape(3, 1, 1) + 0j
    test = FrfTest(np.array([1.0, 2.0, 3.0]), H, "receptance", np.array([0]), np.array([0]), np.full((3, 1, 1), 0.005))
    assert observe(test, "log").lines.tolist() == [0, 1]
    assert observe(test, "complex").lines.tolist() == [0, 1, 2]


def test_assumed_accuracy():
    rng = np.random.default_rng(1)
    H = rng.standard_normal((50, 1, 1)) + 1j * rng.standard_normal((50, 1, 1))
    test = FrfTest(np.arange(1.0, 51.0), H, "mobility", np.array([0]), np.array([0]), np.full(H.shape, np.nan))
    sd, assumed = accuracy(test)
    assert assumed
    assert np.allclose(sd, np.hypot(ASSUMED_OF_MAGNITUDE * np.abs(H), ASSUMED_OF_MEDIAN * np.median(np.abs(H))))


def test_lines_lie_where_resonances_are():
    """Of 20000 lines 100 are taken: evenly over the band, and a good number within the half width of the only resonance."""
    f = np.linspace(1.0, 100.0, 20000)
    H = (1 / (1 - (f / 40) ** 2 + 0.004j)).reshape(-1, 1, 1)
    test = FrfTest(f, H, "receptance", np.array([0]), np.array([0]), np.full(H.shape, 1e-6))
    lines = chosen(test, np.isfinite(H), 100)
    assert len(lines) == len(set(lines.tolist())) == 100
    within = np.abs(f[lines] / 40 - 1) < 0.002
    assert within.sum() >= 5  # 0.16 would be if they were even
    assert np.diff(f[lines]).max() < 2.5
    assert (chosen(test, np.isfinite(H), 30000) == np.arange(20000)).all()


def test_widened_resonances_are_those_of_more_damping():
    """Poisson's integral of 1 / (s^2 + c s + k) on the axis is its value off the axis, in closed form."""
    f = np.linspace(0.01, 400.0, 80000)
    w = 2 * np.pi * f

    def H(s):
        return s**2 / (s**2 + 2.0 * s + (2 * np.pi * 20) ** 2)

    test = FrfTest(
        f, H(1j * w).reshape(-1, 1, 1), "accelerance", np.array([0]), np.array([0]), np.full((80000, 1, 1), 1e-9)
    )
    wide = smoothed(test, 0.1)
    kept = wide.have[:, 0, 0] & (f[wide.lines] < 100) & (f[wide.lines] > 2)
    assert kept.sum() > 20
    assert np.abs(wide.H[kept, 0, 0] / H(wide.s[kept]) - 1).max() < 0.1  # the band ends
    peak = np.abs(wide.H[kept, 0, 0]).max()
    assert 4 < peak < 6  # about 1 / (2 * 0.1), where 63 was measured


def test_what_lies_in_a_gap_of_the_lines_is_not_made_up():
    """A resonance at 10 Hz in a gap from 8 to 13 Hz: what is kept is near the analytic continuation, near the gap nothing is."""
    w0 = 2 * np.pi * 10.0
    H = lambda s: 1 / (s**2 + 2 * 0.008 * w0 * s + w0**2)
    f = np.arange(0.0, 200.0, 0.05)
    f = f[(f < 8) | (f > 13)]
    value = H(2j * np.pi * f)[:, None, None]
    test = FrfTest(f, value, "receptance", np.array([0]), np.array([0]), np.full(value.shape, 1e-12))
    wide = smoothed(test, 0.1)
    kept = wide.have[:, 0, 0] & (f[wide.lines] < 100) & (f[wide.lines] > 1)
    assert kept.sum() > 20
    assert not (kept & (f[wide.lines] > 7.5) & (f[wide.lines] < 13.5)).any()
    near = (f[wide.lines] > 4) & (f[wide.lines] < 20)
    assert np.abs(wide.H[kept & ~near, 0, 0] / H(wide.s[kept & ~near]) - 1).max() < 0.25


def test_large_model_by_its_basis():
    """A sparse beam revised by FRFs that a dense solution line by line gave: E of both halves, loss factor, a dashpot."""
    from scipy import sparse

    from mouse_cli.terms.assembly import assembly

    beam = """mouse: 1
model:
  structure:
    nodes: {line: {from: 0, to: 180, start: [0, 0, 0], end: [1, 0, 0]}}
    materials: {steel: {E: 2.1e+11, nu: 0.3, density: 7850}}
    sections: {bar: {A: 3.0e-4, Iz: 9.0e-9, Iy: 9.0e-9}}
    elements:
      - {id: 1-180, type: beam, nodes: 0-180, material: steel, section: bar, loss_factor: 0.02}
      - {id: 500, type: dashpot, nodes: [60], TY: 20.0}
    supports: {0: all}
    plane: XY
parameters:
  - {name: E1, elements: 1-90, property: E, sd: 20 %, transform: log}
  - {name: E2, elements: 91-180, property: E, sd: 20 %, transform: log}
  - {name: eta, elements: 1-180, property: loss_factor, sd: 60 %, transform: log}
  - {name: c, elements: 500, property: TY, sd: 60 %, transform: log}
test: {modes: {frequency: [1.0], frequency_sd: [1.0]}}
"""
    found = assemble(read(beam, "x.yaml"))
    truth = np.array([1.75e11, 2.3e11, 0.03, 32.0])
    made = assembly(found)
    K, M, C, D = (m.toarray() for m in (*made.matrices(truth), *made.damping(truth)))
    assert sparse.issparse(made.matrices(truth)[0])
    labels = found.structure.labels
    out, force = np.array([labels.index("90TY"), labels.index("180TY")]), np.array([labels.index("180TY")])
    f = np.linspace(10.0, 500.0, 120)
    s = 2j * np.pi * f
    load = np.eye(len(K))[:, force]
    H = np.array([x**2 * np.linalg.solve(K + 1j * D + x * C + x**2 * M, load)[out] for x in s])
    rng = np.random.default_rng(4)
    sd = 0.01 * np.abs(H)
    H = H + sd * (rng.standard_normal(H.shape) + 1j * rng.standard_normal(H.shape))
    test = FrfTest(f, H, "accelerance", out, force, 2 * sd**2)
    result = run(replace(found, test=None, frf=(test,)))
    assert result.status.key == "converged" and not result.rejected
    assert np.abs((result.revised.theta - truth) / result.sd_theta).max() < 4
    assert np.abs(result.revised.theta / truth - 1).max() < 0.02
    assert result.frf[0].basis > 0 and result.frf[0].basis_error < 1e-6

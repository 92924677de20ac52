"""Frequency response functions of recordings against scipy.signal, closed forms, textbook bias, and repetition."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.signal
from click.testing import CliRunner

from mouse_cli._errors import RecordError
from mouse_cli.cli.main import cli
from mouse_cli.formats import read_deck
from mouse_cli.formats.frf_files import write_frf
from mouse_cli.formats.recording_files import read_contents
from mouse_cli.model.recording import Channel, Recording
from mouse_cli.model.spectra import SpectraOptions
from mouse_cli.records.blocks import effective_averages
from mouse_cli.records.spectra import functions
from mouse_cli.records.strokes import strokes

FS = 1000.0
HZ, ZETA, MASS = 80.0, 0.02, 2.5


def recorded(x: np.ndarray, y: np.ndarray, quantity: str = "acceleration") -> Recording:
    """Forces x (t, i) and responses y (t, o)."""
    x, y = (np.reshape(each, (len(each), -1)) for each in (x, y))
    forces = [Channel(f"f{j}", "input", "force", "N", f"{j + 1}") for j in range(x.shape[1])]
    responses = [Channel(f"y{j}", "output", quantity, "", f"{j + 1}") for j in range(y.shape[1])]
    return Recording("run", 1 / FS, (*forces, *responses), np.hstack([x, y]))


def measured(x, y, quantity="acceleration", **options):
    return functions([recorded(x, y, quantity)], SpectraOptions(**options))[0]


@pytest.fixture
def rng():
    return np.random.default_rng(5)


def coloured(rng, n: int) -> tuple[np.ndarray, np.ndarray]:
    """A force and a response of a resonance with noise."""
    x = rng.standard_normal(n)
    return x, scipy.signal.lfilter(*scipy.signal.iirpeak(100, 20, fs=FS), x) + 0.1 * rng.standard_normal(n)


@pytest.mark.parametrize("window", ["hann", "hamming", "blackmanharris", "flattop"])
@pytest.mark.parametrize("overlap", [0.0, 0.5, 0.75])
def test_estimators_are_those_of_scipy(rng, window, overlap):
    x, y = coloured(rng, 20000)
    how = {"fs": FS, "window": window, "nperseg": 512, "noverlap": int(512 * overlap)}
    Gxy = scipy.signal.csd(x, y, **how)[1][1:]
    Gxx, Gyy = (scipy.signal.welch(each, **how)[1][1:] for each in (x, y))
    expected = {"h1": Gxy / Gxx, "h2": Gyy / Gxy.conj(), "hv": Gxy / np.abs(Gxy) * np.sqrt(Gyy / Gxx)}
    for key, H in expected.items():
        found = measured(x, y, estimator=key, window=window, lines=256, overlap=overlap).frf
        assert found.H[:, 0, 0] == pytest.approx(H, rel=1e-9)
        assert found.coherence[:, 0] == pytest.approx(scipy.signal.coherence(x, y, **how)[1][1:], rel=1e-9)
        assert found.frequency_hz == pytest.approx(np.arange(1, 257) * FS / 512)


def _discrete():
    """The exact discretisation of one mass for a force that is held from one sample to the next."""
    w = 2 * np.pi * HZ
    A, B = np.array([[0, 1], [-(w**2), -2 * ZETA * w]]), np.array([[0], [1 / MASS]])
    return scipy.signal.cont2discrete((A, B, np.array([[1.0, 0]]), np.zeros((1, 1))), 1 / FS, "zoh")


def sdof(n: int, rng) -> tuple[np.ndarray, np.ndarray]:
    """A random force and the displacement."""
    x = rng.standard_normal(n)
    return x, scipy.signal.dlsim(_discrete(), x)[1][:, 0]


def receptance(s: np.ndarray) -> np.ndarray:
    """1 / (m (s^2 + 2 zeta w s + w^2)), the closed form, of a force that is held from one sample to the next."""
    w = 2 * np.pi * HZ
    held = (1 - np.exp(-s / FS)) / (s / FS)
    return held / (MASS * (s**2 + 2 * ZETA * w * s + w**2))


def test_closed_form_of_one_mass(rng):
    x, y = sdof(2**16, rng)
    frf = measured(x, y, "displacement", lines=2048).frf
    near = np.abs(frf.frequency_hz / HZ - 1) < 0.5
    error = np.abs(frf.H[near, 0, 0] / receptance(frf.laplace[near]) - 1)
    assert np.median(error) < 0.01 and frf.kind == "receptance"
    peak = frf.frequency_hz[np.argmax(np.abs(frf.H[:, 0, 0]))]
    assert peak == pytest.approx(HZ * np.sqrt(1 - 2 * ZETA**2), abs=2 * FS / 4096)


def test_exponential_window_moves_the_axis():
    """Force and response of one stroke times e^(-a t): exactly H at s = a + i omega, but for what has not died out."""
    x = np.zeros(1100)
    x[20:24] = [1, 3, 2.5, 0.5]
    y = scipy.signal.dlsim(_discrete(), x)[1][:, 0]
    found = measured(x, y, "displacement", window="exponential", final=1e-4, impact=True, lines=512)
    a = -np.log(1e-4) * FS / 1024
    assert found.frf.decay_rate == pytest.approx(a) and found.frf.laplace[0] == pytest.approx(
        a + 2j * np.pi * FS / 1024
    )
    low = found.frf.frequency_hz < 200
    A, B, C, *_ = _discrete()  # at z = e^(s/fs)
    exact = [(C @ np.linalg.solve(z * np.eye(2) - A, B))[0, 0] for z in np.exp(found.frf.laplace[low] / FS)]
    assert found.frf.H[low, 0, 0] == pytest.approx(np.array(exact), rel=1e-6)
    plain = receptance(2j * np.pi * found.frf.frequency_hz[low])
    assert np.abs(found.frf.H[low, 0, 0]).max() < 0.8 * np.abs(plain).max()  # it is not H on the axis


GAIN = 2.0


def noisy(rng, force: float, response: float, n: int = 8192) -> tuple[np.ndarray, np.ndarray]:
    """A gain of 2, noise of these standard deviations on force and response."""
    x = rng.standard_normal(n)
    return x + force * rng.standard_normal(n), GAIN * x + response * rng.standard_normal(n)


@pytest.mark.parametrize(("force", "response"), [(0.0, 1.5), (0.7, 0.0), (0.6, 1.2)])
def test_bias_is_that_of_textbooks(rng, force, response):
    """H1 = H / (1 + Gmm/Gxx), H2 = H (1 + Gnn/Gyy), Bendat & Piersol, ch. 6; Hv, their mean, is right where ratios are equal."""
    x, y = noisy(rng, force, response, 2**20)
    means = {key: np.mean(measured(x, y, estimator=key, lines=64).frf.H.real) for key in ("h1", "h2", "hv")}
    assert means["h1"] == pytest.approx(GAIN / (1 + force**2), rel=0.003)
    assert means["h2"] == pytest.approx(GAIN * (1 + (response / GAIN) ** 2), rel=0.003)
    assert means["hv"] == pytest.approx(np.sqrt(means["h1"] * means["h2"]), rel=0.003)
    if force == response / GAIN:
        assert means["hv"] == pytest.approx(GAIN, rel=0.003)


@pytest.mark.parametrize(
    ("key", "force", "response", "truth"), [("h1", 0, 2, 2.0), ("h2", 0.7, 0, 2.0), ("hv", 0.5, 1, 2.0)]
)
@pytest.mark.parametrize("overlap", [0.0, 0.5])
def test_variance_covers(rng, key, force, response, truth, overlap):
    """Of 200 measurements at 64 lines, 95 % lie within 1.96 sd, for each estimator where its noise is."""
    score = []
    for _ in range(100):
        frf = measured(*noisy(rng, force, response), estimator=key, lines=64, overlap=overlap).frf
        score.append((frf.H - truth) / np.sqrt(frf.variance / 2))
    parts = np.concatenate([np.ravel(score).real, np.ravel(score).imag])
    assert parts.std() == pytest.approx(1, abs=0.06)
    assert np.mean(np.abs(parts) < 1.96) == pytest.approx(0.95, abs=0.015)


def test_several_correlated_forces(rng):
    gains, score = np.array([[1, 2.0], [3, -1], [0.5, 0.5]]), []
    for _ in range(60):
        x = rng.standard_normal((8192, 2))
        x[:, 1] += 0.6 * x[:, 0]
        frf = measured(x, x @ gains.T + rng.standard_normal((8192, 3)), lines=64).frf
        score.append((frf.H - gains) / np.sqrt(frf.variance / 2))
    parts = np.concatenate([np.ravel(score).real, np.ravel(score).imag])
    assert parts.std() == pytest.approx(1, abs=0.06)
    assert np.mean(np.abs(parts) < 1.96) == pytest.approx(0.95, abs=0.015)
    noise = np.ones(3)
    power = np.einsum("oi,ij,oj->o", gains, np.array([[1, 0.6], [0.6, 1.36]]), gains)
    assert np.median(frf.coherence, axis=0) == pytest.approx(power / (power + noise), abs=0.03)  # of independent noise


def test_hv_of_several_forces(rng):
    """Without noise every estimator gives the gains."""
    gains, x = np.array([[1, 2.0], [3, -1]]), rng.standard_normal((4096, 2))
    for key in ("h1", "hv"):
        found = measured(x, x @ gains.T, estimator=key, lines=32).frf.H
        assert found == pytest.approx(np.broadcast_to(gains, found.shape), abs=1e-6)
    with pytest.raises(RecordError, match="MD619"):
        measured(x, x @ gains.T, estimator="h2", lines=32)


def test_dependent_forces_are_refused(rng):
    x = rng.standard_normal(4096)
    with pytest.raises(RecordError, match="not independent"):
        measured(np.column_stack([x, 2 * x]), x, lines=32)


def test_periodic_excitation(rng):
    """Means over 32 periods: exact without noise; with it 95 % coverage, NaN at lines that are not excited."""
    P, filter = 256, scipy.signal.iirpeak(100, 5, fs=FS)
    spectrum = np.zeros(P // 2 + 1, complex)
    spectrum[2:100:2] = np.exp(2j * np.pi * rng.random(49)) * P / 8
    u = np.tile(np.fft.irfft(spectrum), 64)
    y = scipy.signal.lfilter(*filter, u)[len(u) // 2 :]
    u = u[len(u) // 2 :]
    exact = measured(u, y, period=P).frf
    excited = np.isfinite(exact.H[:, 0, 0])
    assert (np.flatnonzero(excited) + 1).tolist() == list(range(2, 100, 2))
    H = scipy.signal.freqz(*filter, exact.frequency_hz, fs=FS)[1]
    assert exact.H[excited, 0, 0] == pytest.approx(H[excited], abs=1e-6)
    score = []
    for _ in range(150):
        frf = measured(*(each + 0.2 * rng.standard_normal(len(u)) for each in (u, y)), period=P).frf
        score.append((frf.H[excited, 0, 0] - H[excited]) / np.sqrt(frf.variance[excited, 0, 0] / 2))
    parts = np.concatenate([np.ravel(score).real, np.ravel(score).imag])
    assert np.mean(np.abs(parts) < 1.96) == pytest.approx(0.945, abs=0.015)  # Student with 62 degrees of freedom: 0.945


def test_effective_averages(rng):
    """Welch's number against the scatter of power spectra of white noise: var G / G^2 = 1 / n."""
    w = scipy.signal.get_window("hann", 64)
    for overlap in (0.0, 0.5, 0.75):
        step = 64 - round(64 * overlap)
        power = []
        for _ in range(3000):
            x = rng.standard_normal(64 + 9 * step)
            blocks = np.lib.stride_tricks.sliding_window_view(x, 64)[::step] * w
            power.append(np.mean(np.abs(np.fft.rfft(blocks, axis=1)[:, 10:20:5]) ** 2, axis=0))
        scatter = np.mean(np.var(power, axis=0) / np.mean(power, axis=0) ** 2)
        assert 1 / scatter == pytest.approx(effective_averages(w, 10, overlap), rel=0.08)


def test_recordings_are_averaged_together(rng):
    x, y = coloured(rng, 8192)
    halves = [recorded(x[:4096], y[:4096]), recorded(x[4096:], y[4096:])]
    whole = measured(x, y, lines=512, overlap=0, window="uniform").frf
    found = functions(halves, SpectraOptions(lines=512, overlap=0, window="uniform"))[0]
    assert pytest.approx(whole.H) == found.frf.H and found.blocks == 8


def test_kinds_are_powers_of_i_omega(rng):
    x, y = sdof(2**15, rng)
    frf = measured(x, y, "displacement", lines=512).frf
    for kind, power in (("mobility", 1), ("accelerance", 2)):
        found = measured(x, y, "displacement", lines=512, kind=kind).frf
        by = (2j * np.pi * frf.frequency_hz) ** power
        assert found.H[:, 0, 0] == pytest.approx(by * frf.H[:, 0, 0])
        assert found.variance[:, 0, 0] == pytest.approx(np.abs(by) ** 2 * frf.variance[:, 0, 0])


def test_strokes_of_a_hammer():
    force = np.zeros(5000)
    for at in (500, 1700, 3000):
        force[at : at + 5] = [1, 4, 6, 4, 1]
    force[3040:3045] = [1, 3, 4, 3, 1]  # it bounced
    force[4900:4905] = 6  # its block was not recorded to the end
    begin, double = strokes(force, 1000, 20)
    assert begin.tolist() == [481, 1681, 2981] and double.tolist() == [False, False, True]


def strokes_of_noise(rng, noise: float) -> tuple[np.ndarray, np.ndarray]:
    """Six half-sine strokes of 20 samples on one mass, the force read with noise and an offset."""
    x = np.zeros(6 * 2048)
    for at in range(50, len(x), 2048):
        x[at : at + 20] = (1 + rng.random()) * np.sin(np.pi * np.arange(20) / 20)
    y = scipy.signal.dlsim(_discrete(), x)[1][:, 0]
    return x + 0.1 + noise * rng.standard_normal(len(x)), y


def test_a_force_window_takes_off_noise_between_strokes(rng):
    """Noise of a force cell makes H1 too small and uncertain; 0 after the stroke leaves what noise of the stroke alone makes."""
    options = {"impact": True, "window": "uniform", "lines": 700}
    x, y = strokes_of_noise(rng, 0.02)
    plain, cut = (measured(x, y, "displacement", force_window=length, **options) for length in (None, -1))
    assert plain.force_window == 0 and 30 < cut.force_window < 60
    low = (plain.frf.frequency_hz > 20) & (plain.frf.frequency_hz < 200)
    A, B, C, *_ = _discrete()
    exact = np.array([(C @ np.linalg.solve(z * np.eye(2) - A, B))[0, 0] for z in np.exp(cut.frf.laplace[low] / FS)])
    wrong = [np.median(np.abs(each.frf.H[low, 0, 0] / exact - 1)) for each in (plain, cut)]
    assert wrong[1] < 0.25 * wrong[0]  # the window keeps 47 of 1400 samples of noise
    assert wrong[1] < 3 * np.median(np.sqrt(cut.frf.variance[low, 0, 0]) / np.abs(exact))


def test_a_force_window_that_cuts_strokes_is_said_to(rng):
    x, y = strokes_of_noise(rng, 0.0)
    options = SpectraOptions(impact=True, window="uniform", lines=700, force_window=15)
    _, remarks = functions([recorded(x, y, "displacement")], options)
    assert "MD625" in [each.code for each in remarks]
    _, remarks = functions([recorded(x, y, "displacement")], replace(options, force_window=40))
    assert "MD625" not in [each.code for each in remarks]


def test_files_read_back(rng, tmp_path):
    x, y = coloured(rng, 8192)
    frf = measured(x, np.column_stack([y, x]), lines=300).frf
    write_frf(frf, str(tmp_path / "frf.npz"))
    deck = "mouse: 1\nmodel: {stiffness: {diagonal: [1, 1]}, mass: {identity: 2}}\nparameters: []\ntest: {frf: [{file: frf.npz}]}\n"
    (tmp_path / "deck.yaml").write_text(deck)
    again = read_deck(tmp_path / "deck.yaml").frf[0]
    for key in ("frequency_hz", "H", "variance", "coherence", "outputs", "inputs"):
        assert (getattr(again, key) == getattr(frf, key)).all()
    assert (again.kind, again.output_names) == (frf.kind, frf.output_names)


def test_decay_rate_goes_along(tmp_path):
    """From the window through the file and the deck to the axis on which the model is evaluated."""
    x = np.zeros(1100)
    x[20:24] = [1, 3, 2.5, 0.5]
    y = scipy.signal.dlsim(_discrete(), x)[1][:, 0]
    frf = measured(x, y, "displacement", window="exponential", impact=True, lines=512).frf
    write_frf(frf, str(tmp_path / "frf.npz"))
    deck = "mouse: 1\nmodel: {stiffness: {diagonal: [1]}, mass: {identity: 1}}\nparameters: []\ntest: {frf: [{file: frf.npz%s}]}\n"
    for given, rate in (("", -np.log(0.01) * FS / 1024), (", decay_rate: 7", 7.0)):
        (tmp_path / "deck.yaml").write_text(deck % given)
        assert read_deck(tmp_path / "deck.yaml").frf[0].laplace.real == pytest.approx(rate)


def test_universal_files_are_those_of_pyuff(rng, tmp_path):
    pyuff = pytest.importorskip("pyuff")
    x, y = coloured(rng, 8192)
    frf = measured(x, y, lines=333).frf
    write_frf(frf, str(tmp_path / "frf.unv"))
    function, coherence = pyuff.UFF(str(tmp_path / "frf.unv")).read_sets()
    assert function["data"] == pytest.approx(frf.H[:, 0, 0], rel=1e-11) and function["x"] == pytest.approx(
        frf.frequency_hz
    )
    assert coherence["data"] == pytest.approx(frf.coherence[:, 0], rel=1e-11) and coherence["func_type"] == 6
    own = read_contents(str(tmp_path / "frf.unv")).functions
    assert len(own) == 1 and own[0].coherence == pytest.approx(frf.coherence[:, 0]) and own[0].unit == "(m/s2)/N"


def run(*arguments):
    return CliRunner().invoke(cli, ["spectra", *map(str, arguments)], standalone_mode=False)


def test_command(rng, tmp_path):
    """A file becomes functions that a deck reads; a deck that names the file gives the same."""
    x, y = coloured(rng, 8192)
    path = tmp_path / "run.csv"
    np.savetxt(
        path, np.column_stack([np.arange(8192) / FS, x, y]), delimiter=",", header="t,hammer (N),acc (g)", comments=""
    )
    told = run(path, "--full", "--force", "1=hammer", "--response", "2=acc", "--lines", 256, "-o", tmp_path / "frf.npz")
    assert told.exception is None and "h1: noise on the responses" in told.output
    deck = tmp_path / "deck.yaml"
    deck.write_text(
        "mouse: 1\nmodel: {stiffness: {diagonal: [1, 1]}, mass: {identity: 2}}\nparameters: []\ntest:\n"
        "  frf: [{file: frf.npz}]\n  recordings: [{file: run.csv, inputs: {1: hammer}, outputs: {2: acc}}]\n"
    )
    assert run(deck, "--lines", 256, "-o", tmp_path / "again.npz").exception is None
    first, second = (np.load(tmp_path / name) for name in ("frf.npz", "again.npz"))
    assert (first["H"] == second["H"]).all() and first["output_names"].tolist() == ["2"]
    assert read_deck(deck).frf[0].outputs.tolist() == [1]
    assert abs(first["H"]).max() == pytest.approx(9.80665, rel=0.2)  # the filter has gain 1 at its narrow peak, in g

"""Modal identification against closed forms, measured data, and independent libraries where they are installed."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "property"))
import vibrating

from mouse_cli._errors import RecordError
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.recording import OUTPUT, Channel, Recording
from mouse_cli.records.identify import identify_frf, identify_recordings

HZ = np.arange(2.0, 80.0, 0.2)
SHARED = Path(__file__).resolve().parents[3] / "shared" / "data"


def measured(seed: int = 1, inputs=(0, 2), zeta=0.01, omega=None, share=0.01, hz=HZ) -> FrfTest:
    """Functions of the chain, forces at masses 1 and 3."""
    own, damping, shapes = vibrating.modes(zeta)
    H = vibrating.accelerance(hz, own if omega is None else omega, damping, shapes, list(inputs))
    H, variance = vibrating.disturbed(H, share, np.random.default_rng(seed))
    names = tuple(str(k + 1) for k in inputs)
    return FrfTest(hz, H, "accelerance", np.arange(3), np.array(inputs), variance, ("1", "2", "3"), names)


def force_alone(test: FrfTest, k: int) -> FrfTest:
    """The functions of one of the forces."""
    names = (test.input_names[k],)
    return replace(
        test, H=test.H[:, :, [k]], variance=test.variance[:, :, [k]], inputs=test.inputs[[k]], input_names=names
    )


def codes(found) -> list[str]:
    return [each.code for each in (*found.doubts, *found.remarks)]


def test_exact_functions_give_exact_modes():
    omega, zeta, shapes = vibrating.modes([0.01, 0.05, 0.02])
    test = measured(zeta=[0.01, 0.05, 0.02], share=0.0)
    modes = identify_frf([replace(test, variance=np.full(test.H.shape, np.nan))]).modes
    assert modes.frequency_hz == pytest.approx(omega / 2 / np.pi, rel=1e-6)
    assert modes.damping == pytest.approx(zeta, rel=1e-5)
    signs = np.sign((shapes * modes.shapes.real).sum(axis=0))
    assert modes.shapes.real == pytest.approx(shapes * signs, abs=1e-4)
    assert set(modes.scale) == {"unit modal mass"}


def test_modes_one_per_cent_apart_are_two():
    omega = vibrating.modes()[0].copy()
    omega[2] = 1.01 * omega[1]
    for seed in range(5):
        found = identify_frf([measured(seed, omega=omega)])
        assert found.modes.m == 3
        away = (found.modes.frequency_hz - omega / 2 / np.pi) / found.modes.frequency_sd_hz
        assert np.abs(away).max() < 4.5


def test_noise_alone_has_no_modes():
    shape = measured().H.shape
    for seed in range(10):
        noise = np.random.default_rng(seed).standard_normal((2, *shape))
        known = replace(measured(), H=noise[0] + 1j * noise[1], variance=np.full(shape, 2.0))
        for test in (known, replace(known, variance=np.full(shape, np.nan))):
            found = identify_frf([test])
            assert found.modes.m == 0 and found.exit_code == 1 and "MD650" in codes(found)


@pytest.mark.parametrize(("band", "code"), [((5, 6), "MD651"), ((17, 30), "MD650"), ((5, 37.9), "MD652")])
def test_bands_that_hold_no_whole_answer_are_said_to(band, code):
    found = identify_frf([measured()], band)
    assert found.exit_code == 1 and code in codes(found)


@pytest.mark.parametrize("zeta", [0.0005, 0.0015])
def test_a_resonance_narrower_than_the_lines_is_doubted(zeta):
    found = identify_frf([measured(zeta=zeta)])
    assert found.exit_code == 1 and "MD653" in codes(found)


def test_functions_of_another_kind_are_told():
    assert "MD656" in codes(identify_frf([replace(measured(), kind="mobility")]))


def test_a_reversed_driving_point_gives_no_mass_unless_its_name_says_so():
    test = measured(inputs=(2,))
    turned = replace(test, H=-test.H)
    assert "MD657" in codes(identify_frf([turned]))
    named = replace(turned, output_names=("1-TX", "2-TX", "3-TX"), input_names=("3TX",))
    assert set(identify_frf([named]).modes.scale) == {"unit modal mass"}


def test_repeats_give_the_noise():
    repeats = [replace(measured(seed), variance=np.full(measured().H.shape, np.nan)) for seed in range(6)]
    one, mean = identify_frf([measured()]).modes, identify_frf(repeats)
    assert mean.noise == "scatter of 6 repeats"
    ratio = mean.modes.frequency_sd_hz / one.frequency_sd_hz
    assert ratio == pytest.approx(6**-0.5, rel=0.25)


def test_forces_in_turn_are_one_test():
    both = measured()
    turns = [force_alone(both, k) for k in (0, 1)]
    assert identify_frf(turns).modes.frequency_hz == pytest.approx(identify_frf([both]).modes.frequency_hz, rel=1e-12)


def test_an_exponential_window_is_taken_off():
    omega, zeta, shapes = vibrating.modes(0.01)
    s = 2.0 + 2j * np.pi * HZ[:, None]
    H = np.einsum("or,ir,fr->foi", shapes, shapes[[0, 2]], s**2 / (s**2 + 2 * zeta * omega * s + omega**2))
    modes = identify_frf([replace(measured(), H=H, variance=np.full(H.shape, 1e-10), decay_rate=2.0)]).modes
    assert modes.damping == pytest.approx(zeta, rel=1e-5)


def recorded(seed: int = 0, count: int = 30000) -> Recording:
    samples = vibrating.responses(150.0, count, 0.01, 0.01, np.random.default_rng(seed))
    return Recording("chain", 1 / 150.0, tuple(Channel(str(k + 1), OUTPUT, "acceleration") for k in range(3)), samples)


def test_outputs_alone():
    omega, zeta, _ = vibrating.modes(0.01)
    modes = identify_recordings([recorded()], (4.0, 70.0)).modes
    assert np.abs((modes.frequency_hz - omega / 2 / np.pi) / modes.frequency_sd_hz).max() < 4
    assert np.abs((modes.damping - zeta) / modes.damping_sd).max() < 4


def near(found) -> np.ndarray:
    """Of each mode found the true one it is, by frequency, within 5 %; fails where one is spurious."""
    hz = vibrating.modes(0.01)[0] / 2 / np.pi
    away = np.abs(found.modes.frequency_hz[:, None] / hz - 1)
    assert (away.min(axis=1) < 0.05).all()
    return away.argmin(axis=1)


def test_a_short_record_says_what_is_lost():
    """7.5 s of modes at 13, 38 and 50 Hz: what is found lies within what is stated, and nothing else is found."""
    omega, _, _ = vibrating.modes(0.01)
    found = identify_recordings([recorded(count=1125)], (4.0, 70.0))
    assert [each.code for each in found.remarks] == ["MD682"]
    assert "1125 samples at 150 Hz are few: 20 blocks of 28 lags instead of 40 of 60" in found.remarks[0].message
    z = (found.modes.frequency_hz - omega[near(found)] / 2 / np.pi) / found.modes.frequency_sd_hz
    assert found.modes.m >= 1 and np.abs(z).max() < 4


def test_a_record_of_no_length_is_said_to_be_short():
    found = identify_recordings([recorded(count=300)], (4.0, 70.0))
    assert found.exit_code == 1 and codes(found) == ["MD651"] and "at least 320 are needed" in found.doubts[0].message


def test_repeats_of_outputs_are_averaged():
    """Eleven short records, one of ten times the level: all modes, within what is stated, better known than by one record."""
    omega, _, _ = vibrating.modes(0.01)
    records = [recorded(seed, 1125) for seed in range(11)]
    plain = identify_recordings(records, (4.0, 70.0))
    records[3] = replace(records[3], samples=10 * records[3].samples)
    found, one = identify_recordings(records, (4.0, 70.0)), identify_recordings(records[:1], (4.0, 70.0))
    assert found.modes.frequency_hz == pytest.approx(plain.modes.frequency_hz, rel=1e-9)
    assert near(found).tolist() == [0, 1, 2] and not found.remarks
    assert np.abs((found.modes.frequency_hz - omega / 2 / np.pi) / found.modes.frequency_sd_hz).max() < 4
    assert (found.modes.frequency_sd_hz[near(one)] < 0.6 * one.modes.frequency_sd_hz).all()
    assert found.noise.endswith("blocks of 11 records")


def test_records_of_other_sensors_are_no_repeats():
    other = replace(recorded(1), title="other", channels=recorded().channels[::-1])
    with pytest.raises(RecordError, match="different responses"):
        identify_recordings([recorded(), other], (4.0, 70.0))


def three_storeys() -> FrfTest:
    folder = SHARED / "three_storey_uk"
    if not folder.exists():
        pytest.skip("needs ../shared/data/three_storey_uk")
    names = ("frf_Experimental.csv", "frf_test_2.csv", "frf_test_3.csv")
    tables = [np.loadtxt(folder / name, delimiter=";", dtype=complex) for name in names]
    H = np.stack([table[:, 1:] for table in tables], axis=2)
    floors = ("1", "2", "3")
    return FrfTest(
        tables[0][:, 0].real, H, "accelerance", np.arange(3), np.arange(3), np.full(H.shape, np.nan), floors, floors
    )


def test_three_storey_building():
    """Its makers state 6.50, 17.47 and 26.50 Hz; its storeys weigh 5.2 kg, which the modal masses of floor motion must show."""
    found = identify_frf([three_storeys()], (2.0, 40.0))
    for hz in (6.50, 17.47, 26.50):
        assert np.abs(found.modes.frequency_hz / hz - 1).min() < 0.003
    whole = [int(np.abs(found.modes.frequency_hz - hz).argmin()) for hz in (6.50, 17.47, 26.50)]
    shapes = found.modes.shapes.real[:, whole]
    masses = np.diag(np.linalg.inv(shapes @ shapes.T))
    assert masses == pytest.approx(np.full(3, 5.201), rel=0.25)
    assert (found.modes.mpc[whole] > 0.999).all()


def test_the_three_forces_agree_within_what_is_stated():
    """Forces on floors 1, 2 and 3 are tests of one structure: frequencies and dampings of its three modes scatter as the sd say."""
    whole, scores = three_storeys(), []
    answers = [identify_frf([force_alone(whole, k)], (2.0, 40.0)).modes for k in range(3)]
    for hz in (6.51, 17.46, 26.50):
        at = [int(np.abs(modes.frequency_hz - hz).argmin()) for modes in answers]
        for value, sd in (("frequency_hz", "frequency_sd_hz"), ("damping", "damping_sd")):
            x, s = (np.array([getattr(m, name)[r] for m, r in zip(answers, at, strict=True)]) for name in (value, sd))
            mean = (x / s**2).sum() / (1 / s**2).sum()
            scores.append((((x - mean) / s) ** 2).sum())
    chi2 = sum(scores)  # of 12 degrees of freedom: 2.6 to 26.2 in 99 of 100 cases; it was above 40 by noise alone
    assert 2.6 < chi2 < 26.2


# sdypy-EMA 0.31.0, functions of each force alone, 2 to 40 Hz: median over orders 10 to 59, and spread (interquartile range / 1.349)
EMA_HZ = [[6.51254, 17.45727, 26.50342], [6.51268, 17.46075, 26.50303], [6.51282, 17.46113, 26.50425]]
EMA_SPREAD = [[0.00020, 0.00347, 0.00308], [0.00054, 0.00017, 0.00206], [0.00059, 0.00060, 0.00056]]


@pytest.mark.parametrize("force", range(3))
def test_agrees_with_what_sdypy_ema_gave_on_the_three_storey_building(force):
    found = identify_frf([force_alone(three_storeys(), force)], (2.0, 40.0)).modes
    for hz, spread in zip(EMA_HZ[force], EMA_SPREAD[force], strict=True):
        r = int(np.abs(found.frequency_hz - hz).argmin())
        assert abs(found.frequency_hz[r] - hz) < 3 * np.hypot(found.frequency_sd_hz[r], spread)


def many_modes(count: int = 30, lines: int = 1500) -> tuple[FrfTest, np.ndarray]:
    """One force, six responses, modes 1 to 4 half-power bandwidths apart, some beyond the band; noise 2 % of each channel.

    Returned with the frequencies in the band that the force excites by a tenth of a unit shape or more.
    """
    rng = np.random.default_rng(11)
    omega = 2 * np.pi * (20 + np.cumsum(rng.uniform(2.0, 6.0, count + 3)))
    shapes, hz = rng.standard_normal((6, count + 3)), np.linspace(5, omega[count - 1] / 2 / np.pi + 1.5, lines)
    H, variance = vibrating.disturbed(
        vibrating.accelerance(hz, omega, np.full(count + 3, 0.008), shapes, [0]), 0.02, rng
    )
    names = tuple(str(k + 1) for k in range(6))
    test = FrfTest(hz, H, "accelerance", np.arange(6), np.array([0]), variance, names, ("1",))
    return test, omega[:count][np.abs(shapes[0, :count]) > 0.1] / 2 / np.pi


def test_many_modes_and_some_beyond_the_band():
    test, hz = many_modes()
    modes = identify_frf([test]).modes
    nearest = [int(np.abs(modes.frequency_hz - each).argmin()) for each in hz]
    assert len(set(nearest)) == len(hz) and modes.m <= 30
    nearest, hz = nearest[:-1], hz[:-1]  # the last is 1.4 bandwidths from the edge, and those beyond push it
    scores = (modes.frequency_hz[nearest] - hz) / modes.frequency_sd_hz[nearest]
    damping = (modes.damping[nearest] - 0.008) / modes.damping_sd[nearest]
    assert max(np.abs(scores).max(), np.abs(damping).max()) < 4.5
    assert 0.6 < np.sqrt(np.mean(scores**2)) < 1.5


def test_errors_that_channels_and_lines_share_make_no_modes():
    """Errors of 2 %, smoothed over lines and alike in all channels, as noise of the force makes them."""
    for seed in range(5):
        rng, exact = np.random.default_rng(seed), measured(share=0.0, inputs=(0,))
        white = rng.standard_normal((2, len(HZ) + 4))
        along = np.convolve(white[0] + 1j * white[1], np.ones(5) / 10**0.5, "valid")
        size = 0.02 * np.sqrt((np.abs(exact.H) ** 2).mean(axis=0))
        H = exact.H + size * along[:, None, None]
        found = identify_frf([replace(exact, H=H, variance=np.broadcast_to(size**2, H.shape).copy())])
        assert found.modes.m == 3


def test_agrees_with_sdypy_ema_on_the_three_storey_building():
    EMA = pytest.importorskip("sdypy.EMA", reason="needs sdypy-EMA")
    test = three_storeys()
    found = identify_frf([force_alone(test, 0)], (2.0, 40.0)).modes
    peer = EMA.Model(test.H[:, :, 0].T.copy(), test.frequency_hz, lower=2, upper=40, pol_order_high=40)
    peer.get_poles(show_progress=False)
    peer.select_closest_poles([6.50, 17.47, 26.50], f_window=5)
    for hz in peer.nat_freq:
        assert np.abs(found.frequency_hz / hz - 1).min() < 1e-3


def test_agrees_with_pyoma2_on_simulated_outputs():
    algorithms = pytest.importorskip("pyoma2.algorithms", reason="needs pyOMA-2")
    from pyoma2.setup import SingleSetup

    record = recorded()
    own = identify_recordings([record], (4.0, 70.0)).modes
    setup = SingleSetup(record.samples.copy(), fs=150.0)
    setup.add_algorithms(algorithms.SSI(name="SSIcov", method="cov", br=30, ordmax=20, calc_unc=True, nb=40))
    setup.run_by_name("SSIcov")
    setup.mpe("SSIcov", sel_freq=own.frequency_hz.tolist(), order_in=12)
    result = setup["SSIcov"].result
    assert np.abs((np.ravel(result.Fn) - own.frequency_hz) / own.frequency_sd_hz).max() < 2

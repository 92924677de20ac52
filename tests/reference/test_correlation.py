"""Correlation of test and model against figures worked by hand, exact arithmetic, an independent program and real tests."""

from collections import Counter
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import report_examples
from scipy.sparse import csr_array

from mouse_cli.dynamics import condensation
from mouse_cli.dynamics.correlation import comac, distance, ecomac, mac, match, scale_factors, subspace_cosines
from mouse_cli.dynamics.sensor_faults import sensor_faults
from mouse_cli.formats import read_deck
from mouse_cli.model.correlation import ALONE
from mouse_cli.updating.correlate import correlate

ROOT = Path(__file__).resolve().parents[2]
SDYNPY_MAC = [  # SDynPy 0.23.0
    [0.930013902184, 0.062631830907, 0.005224068622],
    [0.033438310179, 0.844060201795, 0.120802284635],
    [0.008346809368, 0.087466116242, 0.677360462964],
]
SDYNPY_GUYAN_MASS = [[3.695236658116, 1.493888637392], [1.493888637392, 7.761430511544]]


def test_mac_by_hand():
    """x = (1, 2, 2), y = (2, 1, -2): x'y = 0; z = (2, 2, 1): x'z = 8, both of length 3: MAC 64/81."""
    x, yz = np.array([[1.0], [2], [2]]), np.array([[2.0, 2], [1, 2], [-2, 1]])
    np.testing.assert_allclose(mac(x, yz), [[0, 64 / 81]], atol=1e-15)
    np.testing.assert_allclose(mac(x, np.array([[np.nan], [2.0], [1.0]])), [[36 / 40]])  # over the two points both have
    np.testing.assert_allclose(scale_factors(x, yz[:, 1:]), [8 / 9])
    np.testing.assert_array_equal(mac(2.0**700 * x, 2.0**-900 * yz), mac(x, yz))  # whatever the units


def test_comac_and_ecomac_by_hand():
    """Two modes at two sensors, (3, 4)/5 and (4, -3)/5, the second sensor of the test at half gain in mode 2 only.

    Test modes at unit length: (3, 4)/5 and (4, -1.5)/sqrt(18.25). COMAC of sensor 1: both rows are multiples mode by mode.
    """
    model = np.array([[3.0, 4], [4, -3]])
    test = np.array([[3.0, 4], [4, -1.5]])
    r = np.sqrt(18.25)
    t, x = np.array([[0.6, 4 / r], [0.8, -1.5 / r]]), np.array([[0.6, 0.8], [0.8, -0.6]])
    by_hand = [(t[k, 0] * x[k, 0] + t[k, 1] * x[k, 1]) ** 2 / ((t[k] @ t[k]) * (x[k] @ x[k])) for k in (0, 1)]
    np.testing.assert_allclose(comac(test, model), by_hand)
    np.testing.assert_allclose(ecomac(test, model), [(4 / r - 0.8) / 4, (0.6 - 1.5 / r) / 4])
    np.testing.assert_allclose(comac(-7 * model, model), 1.0)
    np.testing.assert_allclose(ecomac(-7 * model, model), 0.0, atol=1e-15)
    turned = model * [[1], [-1]]
    assert comac(turned, model).min() == pytest.approx(1.0)  # blind to signs
    np.testing.assert_allclose(ecomac(turned, model), [0.3, 0.3])  # (3, -4) against -(3, 4), (4, 3) against (4, -3)


def test_against_sdynpy():
    """MAC of three made-up shapes with those of a chain: SDynPy 0.23.0, sdynpy.shape.mac, run in an environment of its own."""
    K = chain_stiffness(np.arange(1.0, 6.0))
    test = np.array([[0.2, 0.5, -0.9], [0.4, 0.7, -0.1], [0.6, 0.1, 0.8], [0.8, -0.5, 0.3], [1.0, -0.9, -0.7]])
    np.testing.assert_allclose(mac(test, np.linalg.eigh(K)[1][:, :3]), SDYNPY_MAC, atol=1e-10)


def chain_stiffness(springs: np.ndarray) -> np.ndarray:
    """A chain of springs, the first one to ground."""
    n = len(springs)
    K = np.zeros((n, n))
    for i, k in enumerate(springs):
        K[i, i] += k
        if i:
            K[i - 1, i - 1] += k
            K[i, i - 1] -= k
            K[i - 1, i] -= k
    return K


@pytest.mark.parametrize("sparse", [False, True])
def test_static_reduction_of_a_chain_in_closed_form(sparse):
    """Springs 1, 2, 3, 4, 5 seen at masses 2 and 5: in series 1/(1/1 + 1/2) = 2/3 and 1/(1/3 + 1/4 + 1/5) = 60/47.

    Deflections go linearly with flexibility: mass 1 follows mass 2 by 2/3; masses 3 and 4 lie (1/3) and (7/12) of 47/60 on the way.
    """
    K, M = chain_stiffness(np.arange(1.0, 6.0)), np.diag(np.arange(1.0, 6.0))
    if sparse:
        K, M = csr_array(K), csr_array(M)
    a, b = 2 / 3, 60 / 47
    at3, at4 = (1 / 3) * b, (7 / 12) * b
    R = np.array([[2 / 3, 0], [1, 0], [1 - at3, at3], [1 - at4, at4], [0, 1]])
    reduced = condensation.static(K, M, np.array([1, 4]))
    np.testing.assert_allclose(reduced.K, [[a + b, -b], [-b, b]], rtol=1e-13)
    np.testing.assert_allclose(reduced.M, R.T @ np.diag(np.arange(1.0, 6.0)) @ R, rtol=1e-13)
    np.testing.assert_allclose(reduced.M, SDYNPY_GUYAN_MASS, rtol=1e-11)


def test_static_shapes_in_exact_arithmetic():
    """u_o = -K_oo^-1 K_oa by Gaussian elimination with rational numbers, for a full matrix of whole numbers."""
    rng = np.random.default_rng(5)
    root = rng.integers(-5, 6, (6, 6))
    K = root @ root.T + 3 * np.eye(6, dtype=int)
    at, rest = [1, 4], [0, 2, 3, 5]
    rows = [[Fraction(int(K[i, j])) for j in rest] + [Fraction(-int(K[i, j])) for j in at] for i in rest]
    for i in range(4):
        rows[i] = [value / rows[i][i] for value in rows[i]]
        for other in range(4):
            if other != i:
                rows[other] = [v - rows[other][i] * w for v, w in zip(rows[other], rows[i], strict=True)]
    exact = np.array([[float(v) for v in row[4:]] for row in rows])
    found = condensation.held(K.astype(float), np.array(at), np.eye(2))
    np.testing.assert_allclose(found[rest], exact, rtol=1e-12, atol=1e-13)


def test_sensors_that_do_not_hold_the_structure_are_said():
    """Two free masses on a spring, one sensor that reads their difference: a translation stays undetermined."""
    K = np.array([[1.0, -1], [-1, 1]])
    with pytest.raises(condensation.LooseError):
        condensation.held(K, csr_array([[1.0, -1.0]]), np.ones((1, 1)))


def test_modal_reduction_keeps_its_modes_orthogonal():
    """SEREP: X'M X = I and X'K X = Lambda for the modes it is made of (O'Callahan et al. 1989)."""
    w, X = np.linalg.eigh(chain_stiffness(np.ones(8)))
    at = np.array([0, 3, 5, 7])
    reduced = condensation.modal(w[:4], X[at, :4])
    np.testing.assert_allclose(X[at, :4].T @ reduced.M @ X[at, :4], np.eye(4), atol=1e-12)
    np.testing.assert_allclose(X[at, :4].T @ reduced.K @ X[at, :4], np.diag(w[:4]), atol=1e-12)


def test_noise_of_orthogonality_is_what_repeats_scatter():
    """sd of the off-diagonals against 4000 simulated tests."""
    X = np.linalg.eigh(chain_stiffness(np.ones(10)))[1]
    at = np.arange(1, 10, 2)
    mass = condensation.static(chain_stiffness(np.ones(10)), np.eye(10), at).M
    shapes, sd, rng = X[at, :3], 0.02 * np.ones((5, 3)), np.random.default_rng(0)
    draws = [shapes + sd * rng.standard_normal(shapes.shape) for _ in range(4000)]
    scatter = np.std([condensation.orthogonality(t, t, mass) for t in draws], axis=0)
    told = condensation.sd_orthogonality(shapes, sd, mass)
    off = ~np.eye(3, dtype=bool)
    np.testing.assert_allclose(told[off], scatter[off], rtol=0.05)


def test_repeated_modes_are_the_same_subspace_in_any_rotation():
    """Two shapes turned by 30 degrees within their plane: MAC 3/4 and 1/4, as a subspace the same."""
    model = np.linalg.qr(np.random.default_rng(1).standard_normal((6, 2)))[0]
    c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
    test = model @ np.array([[c, -s], [s, c]])
    np.testing.assert_allclose(mac(test, model), [[0.75, 0.25], [0.25, 0.75]])
    np.testing.assert_allclose(subspace_cosines(test, model), 1.0)
    assert np.isnan(subspace_cosines(test[:2], model[:2])).all()


def test_the_mode_of_a_hidden_oscillator_stays_alone():
    """Four masses with a small oscillator on the third, tuned near mode 2: five modes measured, four in the model."""
    K, M = np.zeros((5, 5)), np.diag([1, 1, 1, 1, 0.1])
    K[:4, :4] = chain_stiffness(np.full(4, 1000.0))
    w = np.linalg.eigvalsh(K[:4, :4])
    k = 0.1 * w[1]
    K[np.ix_([2, 4], [2, 4])] += k * np.array([[1, -1], [-1, 1]])
    half = np.diag(np.diag(M) ** -0.5)
    truth, X = np.linalg.eigh(half @ K @ half)
    hz, model = np.sqrt(w) / (2 * np.pi), np.linalg.eigh(K[:4, :4] - np.diag([0, 0, k, 0]))[1]
    test = (half @ X)[:4]
    modes = match(distance(mac(test, model), np.sqrt(truth) / (2 * np.pi), hz))
    assert sorted(modes[modes != ALONE]) == [0, 1, 2, 3]
    assert np.flatnonzero(modes == ALONE) in ([1], [2])  # one of the two that the oscillator splits mode 2 into


def test_a_model_mode_that_the_test_missed_is_told():
    """The chain of the report without one of its measured modes."""
    problem = report_examples.chain()
    kept = [i for i in range(4) if i != 1]
    t = problem.test
    part = replace(t, number=t.number[kept], frequency_hz=t.frequency_hz[kept], frequency_sd_hz=t.frequency_sd_hz[kept],
                   shapes=t.shapes[:, kept], shape_sd=t.shape_sd[:, kept])  # fmt: skip
    found = correlate(replace(problem, test=part))
    assert found.modes.tolist() == [0, 2, 3] and found.unclaimed.tolist() == [1]
    assert [d.code for d in found.warnings] == ["MD510"]


def _simulated(rng: np.random.Generator, fault: str, error: float) -> tuple[list, tuple | None]:
    """What is found in a test of a chain of 16 masses at 8 sensors, 4 modes, 3 % noise, stiffnesses wrong by `error`."""
    model = np.linalg.eigh(chain_stiffness(np.ones(16)))[1]
    truth = np.linalg.eigh(chain_stiffness(np.exp(error * rng.standard_normal(16))))[1]
    at = np.sort(rng.choice(16, 8, replace=False))
    test = truth[at, :4] / np.abs(truth[at, :4]).max(axis=0)
    test = test + 0.03 * rng.standard_normal(test.shape)
    one, other = sorted(rng.choice(8, 2, replace=False).tolist())
    planted = {"none": None, "reversed": ("reversed", (one,)), "swapped": ("swapped", (one, other)),
               "gain": ("gain", (one,))}[fault]  # fmt: skip
    if fault == "reversed":
        test[one] *= -1
    elif fault == "swapped":
        test[[one, other]] = test[[other, one]]
    elif fault == "gain":
        test[one] *= 2.5
    found = sensor_faults(test, np.full(test.shape, 0.03), model[at, :4])
    return [(f.kind, f.sensors) for f in found], planted


@pytest.mark.parametrize(
    ("fault", "error", "named"),
    [
        ("reversed", 0.1, 0.98),
        ("swapped", 0.1, 0.95),
        ("gain", 0.1, 0.93),
        ("reversed", 0.3, 0.94),
        ("swapped", 0.3, 0.88),
    ],
)
def test_faulty_sensors_are_named(fault, error, named):
    """Share of 200 simulated tests in which exactly the planted fault is named, and never another sensor alone."""
    rng = np.random.default_rng(11)
    outcomes = Counter()
    for _ in range(200):
        found, planted = _simulated(rng, fault, error)
        outcomes["named"] += found == [planted]
        outcomes["elsewhere"] += bool(found) and not any(set(sensors) & set(planted[1]) for _, sensors in found)
    assert outcomes["named"] >= named * 200 and outcomes["elsewhere"] == 0


@pytest.mark.parametrize("error", [0.0, 0.1, 0.3])
def test_sound_sensors_are_left_alone(error):
    """No false alarm in 500 simulated tests each, however wrong the model."""
    rng = np.random.default_rng(12)
    assert sum(bool(_simulated(rng, "none", error)[0]) for _ in range(500)) == 0


def test_local_damage_is_no_faulty_sensor():
    """One spring of the chain at a quarter of its stiffness: an error of the model in one place. At most 1 alarm in 100."""
    rng, alarms = np.random.default_rng(13), 0
    model = np.linalg.eigh(chain_stiffness(np.ones(16)))[1]
    for _ in range(300):
        springs = np.ones(16)
        springs[rng.integers(16)] = 0.25
        truth = np.linalg.eigh(chain_stiffness(springs))[1]
        at = np.sort(rng.choice(16, 8, replace=False))
        test = truth[at, :4] / np.abs(truth[at, :4]).max(axis=0) + 0.03 * rng.standard_normal((8, 4))
        alarms += bool(sensor_faults(test, np.full(test.shape, 0.03), model[at, :4]))
    assert alarms <= 3


def test_the_four_storey_frame_as_published():
    """Nominal model of shared/data/smu_four_story: +12.0 +3.6 +1.5 -3.2 % in frequency; lowest MACs in modes 3 and 4."""
    found = correlate(read_deck(ROOT / "decks" / "four_storey_frame.yaml"))
    test = found.problem.test
    off = 100 * (found.frequencies_hz[found.modes] / test.frequency_hz - 1)
    np.testing.assert_allclose(off, [12.0, 3.6, 1.5, -3.2], atol=0.06)
    np.testing.assert_allclose(found.mac.diagonal()[2:], [0.74, 0.70], atol=0.005)
    assert found.modes.tolist() == [0, 1, 2, 3] and not found.faults and not found.unclaimed.size


def test_a_sensor_of_the_four_storey_frame_turned_round(tmp_path):
    """Floor 2 with its sign changed in every mode, in a model as wrong as this one is."""
    text = (ROOT / "decks" / "four_storey_frame.yaml").read_text()
    turned = text.replace("[-0.71911, -0.72017, -0.99711, 0.43459]", "[0.71911, 0.72017, 0.99711, -0.43459]")
    deck = tmp_path / "turned.yaml"
    deck.write_text(turned)
    faults = correlate(read_deck(deck)).faults
    assert [(f.kind, f.sensors) for f in faults] in (
        [("reversed", (1,))],
        [],
    )  # MAC 0.7 in two modes: silence is allowed

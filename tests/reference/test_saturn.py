"""Saturn V of the 1972 report (section 5.2): decks/saturn_v.yaml and the family of vehicles in benchmarks/saturn.

Frequencies are those of exact solutions, of beams after Euler and Bernoulli and with shear.
"""

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.optimize import brentq

from benchmarks.saturn import decks, rivals
from benchmarks.saturn.of_1972 import update
from benchmarks.saturn.stack import NU, Vehicle
from benchmarks.saturn.vehicle import family, frequencies, with_shear
from mouse_cli.formats import read_deck, yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.updating import run

DECK = Path(__file__).resolve().parents[2] / "decks" / "saturn_v.yaml"
PREDICTED = np.array([1.121, 1.840, 3.051, 4.747, 8.064])  # Table 5-4, Hz
MEASURED = np.array([1.106, 1.821, 2.547, 3.443, 5.167])


@cache
def vehicles() -> tuple[Vehicle, ...]:
    return tuple(family(3, seed=1))


def exact(vehicle: Vehicle, most: float = 9.0, ratio: float = 0.0) -> np.ndarray:
    """Bending frequencies below `most` Hz of the free beam, by transfer of (w, psi, M, V) through uniform segments.

    w' = psi + V/(kappa G A), psi' = M/EI, M' = -V, V' = -mu omega^2 w; ratio: E/(kappa G). Units: 4 m, 1E11 N m2.
    """
    l, EI, mu = vehicle.length / 4, vehicle.EI / 1e11, vehicle.line_mass * 4**4 / 1e11
    soft = ratio * vehicle.radius**2 / 2 / 4**2 / EI  # 1/(kappa G A), A = 2 I/R^2

    def end(hz: np.ndarray) -> np.ndarray:
        rates = np.zeros((len(hz), len(l), 4, 4))
        rates[:, :, 0, 1], rates[:, :, 0, 3], rates[:, :, 1, 2], rates[:, :, 2, 3] = 1, soft, 1 / EI, -1
        rates[:, :, 3, 0] = -mu * (2 * np.pi * hz[:, None]) ** 2
        state = np.broadcast_to(np.eye(4)[:, :2], (len(hz), 4, 2))
        for through in np.moveaxis(expm(rates * l[:, None, None]), 1, 0):
            state = through @ state
        return np.linalg.det(state[:, 2:])

    grid = np.linspace(0.5, most, 120)
    signs = np.sign(end(grid))
    at = np.flatnonzero(signs[1:] != signs[:-1])
    return np.array([brentq(lambda hz: end(np.array([hz]))[0], grid[i], grid[i + 1], rtol=1e-7) for i in at])


@pytest.mark.parametrize("number", range(3))
def test_vehicles_have_the_frequencies_that_were_predicted(number):
    vehicle = vehicles()[number]
    assert np.abs(exact(vehicle)[:5] / PREDICTED - 1).max() < 0.01
    assert 0.9 < vehicle.mass / 2.767e6 < 1.1 and vehicle.x[-1] == pytest.approx(110.64)
    assert read(decks.segments(vehicle, MEASURED)).structure.n == 58


def test_the_deck_is_a_vehicle_of_the_family_and_its_form_is_rejected():
    deck = read_deck(DECK)
    np.testing.assert_array_equal(deck.test.frequency_hz, MEASURED)
    result = run(deck)
    before = np.sqrt(result.prior.eigenvalues[2:7]) / (2 * np.pi)
    assert np.abs(before / PREDICTED - 1).max() < 0.01
    assert result.rejected and result.innovation.p < 1e-20


@pytest.mark.parametrize("number", range(3))
def test_the_loop_of_1972_converges_on_two_modes_and_drives_stiffness_negative_on_five(number):
    vehicle = vehicles()[number]
    two, five = update(vehicle, 2), update(vehicle, 5)
    assert two.status == "converged" and np.abs(two.factors - 1).max() < 0.15
    assert five.status == "indefinite" and five.cycles == 1 and five.factors.min() < 0


@pytest.mark.parametrize("number", range(3))
def test_the_innovation_tells_from_modes_1_to_3_and_cannot_from_1_to_2(number):
    vehicle = vehicles()[number]
    assert update(vehicle, 2).p > 0.05
    assert update(vehicle, 3).p < 1e-6
    assert update(vehicle, 5).p < 1e-20


def test_shear_of_a_thin_tube_has_the_sign_and_trend_of_what_is_missing():
    """Zero fitted parameters but the scale of EI: more is removed from each higher mode."""
    for vehicle in vehicles():
        ratio = with_shear(vehicle, rotary=False) / PREDICTED
        assert ratio[0] == pytest.approx(1.106 / 1.121, rel=1e-4)
        assert 0.97 > ratio[2] > ratio[3] > ratio[4]


@cache
def candidates() -> dict[str, rivals.Rival]:
    return rivals.rivals(vehicles()[0], 5, ("shear", "rotary-inertia", "oscillator"))


def test_shear_leads_rotary_inertia_and_the_oscillator_is_not_excluded():
    found = candidates()
    assert found["shear"].gain > found["rotary-inertia"].gain + 3 > 20
    assert found["rotary-inertia"].values["times density I of the section"] > 3  # three times what the section has
    assert found["oscillator"].gain > found["shear"].gain - 3 and found["oscillator"].rms < 0.01
    assert found["oscillator"].hz[5] > 1.1 * found["shear"].hz[5]  # mode 6 tells them apart


def test_the_fit_of_shear_is_the_best_of_timoshenko_beams():
    """Elements of theory `timoshenko` with the stiffness that was found, and with each unknown moved to either side."""
    vehicle, found = vehicles()[0], candidates()["shear"]
    base, z = found.fit.model.base, found.fit.point.x[:6]
    ratio = found.values["E / (kappa G)"]

    def hz(x: np.ndarray) -> np.ndarray:
        factor = base.parameters(x[:6])[vehicle.stage]
        return frequencies(replace(vehicle, EI=vehicle.EI * factor), shearing(ratio * np.exp(x[6])))

    def misfit(x: np.ndarray) -> float:
        return float(np.sum((np.log(hz(x) / MEASURED) / 0.01) ** 2) + x[:6] @ x[:6])

    best = np.append(z, 0.0)
    np.testing.assert_allclose(hz(best), found.hz[:5], rtol=1e-4)
    assert misfit(best) == pytest.approx(found.fit.misfit, rel=0.02)
    for direction in np.eye(7):
        assert min(misfit(best + 0.3 * direction), misfit(best - 0.3 * direction)) > misfit(best)


def test_elements_with_shear_tend_to_the_exact_beam():
    """58 degrees of freedom are few for a beam that shears: 2 % in modes 4 and 5, where those of pure bending have 0.1 %."""
    vehicle = vehicles()[0]
    truth = exact(vehicle, ratio=5.32)[:5]
    errors = [np.abs(frequencies(refined(vehicle, n), shearing(5.32)) / truth - 1) for n in (1, 2, 4)]
    assert errors[0].max() < 0.03 and errors[2].max() < 0.002
    assert (errors[1] < 0.4 * errors[0]).all() and (errors[2] < 0.4 * errors[1]).all()


def refined(vehicle: Vehicle, n: int) -> Vehicle:
    """Each element as n."""
    x = np.concatenate([[0.0], np.cumsum(np.repeat(vehicle.length / n, n))])
    own = (np.repeat(a, n) for a in (vehicle.radius, vehicle.line_mass, vehicle.EI, vehicle.stage))
    return Vehicle(x, *own)


def shearing(ratio: float) -> str:
    """Keys of elements with E/(kappa G) = ratio."""
    return (
        f"\n        theory: timoshenko\n        kappa_y: {2 * (1 + NU) / ratio:.12g}\n        rotary_inertia: omitted"
    )


def read(text: str):
    return assemble(yaml_deck.read(text, "saturn.yaml"))


def test_two_modes_by_the_loop_of_1972():
    """Table 5-4, third column: 1.108 and 1.823 Hz; eigenvalues of Table 5-5: 48.4492 and 131.180."""
    result = run(read_deck(DECK.with_name("saturn_v_two_modes.yaml")))
    assert result.status.key == "converged"
    revised = result.revised.eigenvalues[result.revised.modes]
    assert np.sqrt(revised) / (2 * np.pi) == pytest.approx([1.108, 1.823], abs=0.003)
    assert revised == pytest.approx([48.4492, 131.180], rel=4e-3)
    assert (2 * np.pi * result.problem.test.frequency_hz) ** 2 == pytest.approx([48.2914, 130.912], rel=1e-4)

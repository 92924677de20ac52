"""Where one force that a model lacks would act: closed forms, dense truths of finer meshes, ties that no sensor can break."""

import numpy as np
import pytest
from scipy.linalg import eigh

from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.localise.force import locate, scores
from mouse_cli.diagnosis.localise.survey import borne
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.parameter import Gaussian, Parameter
from mouse_cli.model.problem import Problem
from mouse_cli.model.structure import ListedElements, Structure

SPRINGS, MASSES = np.array([85e3, 140e3, 115e3, 200e3]), np.ones(4)  # of the report's chain, Table 5-1


def chain() -> np.ndarray:
    """K of four masses in a row, the first one held by the first spring."""
    K = np.zeros((4, 4))
    for i, k in enumerate(SPRINGS):
        b = np.eye(4)[i] - (np.eye(4)[i - 1] if i else 0)
        K += k * np.outer(b, b)
    return K


def cantilever(elements: int) -> tuple[np.ndarray, np.ndarray]:
    """K, M with EI = line mass = length = 1: deflection and rotation at each free node (Przemieniecki 1968, ch. 5 and 11)."""
    L, n = 1.0 / elements, 2 * elements + 2
    k = np.array([[12, 6 * L, -12, 6 * L], [6 * L, 4 * L**2, -6 * L, 2 * L**2],
                  [-12, -6 * L, 12, -6 * L], [6 * L, 2 * L**2, -6 * L, 4 * L**2]]) / L**3  # fmt: skip
    m = np.array([[156, 22 * L, 54, -13 * L], [22 * L, 4 * L**2, 13 * L, -3 * L**2],
                  [54, 13 * L, 156, -22 * L], [-13 * L, -3 * L**2, -22 * L, 4 * L**2]]) * L / 420  # fmt: skip
    K, M = np.zeros((n, n)), np.zeros((n, n))
    for e in range(elements):
        at = slice(2 * e, 2 * e + 4)
        K[at, at] += k
        M[at, at] += m
    return K[2:, 2:], M[2:, 2:]


def measured(K, M, dofs, modes: int, noise: float = 0.0, seed: int = 0) -> ModalTest:
    """The lowest modes of K, M at sensors at `dofs`, with errors `noise` of the largest component and a tenth of it."""
    rng = np.random.default_rng(seed)
    lam, X = eigh(K, M)
    hz, shapes = np.sqrt(lam[:modes]) / (2 * np.pi), X[np.ix_(dofs, range(modes))]
    sd = max(noise, 1e-6) * np.abs(shapes).max(axis=0) * np.ones_like(shapes)
    hz_sd = 0.1 * max(noise, 1e-6) * hz
    shapes = shapes + (noise > 0) * sd * rng.standard_normal(shapes.shape)
    hz = hz + (noise > 0) * hz_sd * rng.standard_normal(modes)
    return ModalTest(
        np.arange(1, modes + 1), hz, hz_sd, np.array(dofs), shapes * rng.choice([-2.0, 3.0], modes), 3 * sd
    )


def problem(K, M, test, sd: float = 0.0) -> Problem:
    """A bare model; sd: of a factor of all of its stiffness."""
    parameters = (Parameter("factor", sd, 1.0),) if sd else ()
    if not sd:
        return Problem(
            "bare",
            Structure(K, M),
            ListedElements.none(),
            np.zeros((0, 0)),
            (),
            Gaussian(np.zeros(0), np.zeros(0)),
            test,
        )
    row, col = np.nonzero(np.triu(K))
    listed = ListedElements(np.zeros(len(row), bool), row, col)
    return Problem(
        "bare", Structure(K, M), listed, K[row, col][:, None], parameters, Gaussian(np.ones(1), np.array([sd**2])), test
    )


def located(K, M, test, sd: float = 0.0):
    """The places for a bare model."""
    deck = problem(K, M, test, sd)
    return locate(reduced(deck, deck.prior.mean))


def names(location, within: float) -> set[tuple[str, tuple[str, ...]]]:
    """Channel and degrees of freedom of the places at most so many nats below the best."""
    return {(place.channel, place.site.ids) for place in location.places if place.deficit < within}


@pytest.mark.parametrize("dof", range(4))
@pytest.mark.parametrize("cause", ["spring", "mass", "oscillator"])
def test_one_force_on_a_chain_is_found_whatever_its_law(dof: int, cause: str):
    """All four masses measured without error: only the force where the cause is makes the shapes, to rounding."""
    K, M = chain(), np.diag(MASSES)
    size = np.outer(np.eye(4)[dof], np.eye(4)[dof])
    if cause == "spring":
        truth = K + 30e3 * size, M
    elif cause == "mass":
        truth = K, M + 0.3 * size
    else:
        arm, inner = np.append(np.eye(4)[dof], -1.0), np.diag([0.0] * 4 + [0.2])
        truth = np.pad(K, (0, 1)) + 0.2 * 300.0**2 * np.outer(arm, arm), np.pad(M, (0, 1)) + inner
    deck = problem(K, M, measured(*truth, range(4), 3))
    found = scores(reduced(deck, deck.prior.mean))
    channel, number = found.find(int(np.argmin(found.matches.cost)))
    assert (channel.name, channel.site(number).ids) == ("force", (str(dof + 1),))
    assert found.matches.cost.min() < 1e-4  # against errors of theory of 0.2 %


@pytest.mark.parametrize("spring", [1, 2, 3])
def test_a_spring_between_two_masses_is_found_as_a_pair(spring: int):
    K, b = chain(), np.eye(4)[spring] - np.eye(4)[spring - 1]
    location = located(K, np.diag(MASSES), measured(K - 30e3 * np.outer(b, b), np.diag(MASSES), range(4), 4))
    assert location.places[0].channel == "pair"
    assert location.places[0].site.ids == (str(spring), str(spring + 1))
    assert location.single


def test_what_lies_on_one_side_of_all_sensors_ties():
    """k4 (x4 - x3) = lambda m4 x4: what sensors on masses 3 and 4 see follows from mass 4 alone, whatever acts before."""
    K, M, b = chain(), np.diag(MASSES), np.eye(4)[1] - np.eye(4)[0]
    location = located(K, M, measured(K - 30e3 * np.outer(b, b), M, [2, 3], 4))
    before = {("force", (str(i),)) for i in (1, 2, 3)} | {
        ("pair", ("1", "2")),
        ("pair", ("2", "3")),
        ("tie", ("1", "3")),
    }
    assert names(location, 1e-6) == before
    assert location.places[len(before)].deficit > 100


@pytest.mark.parametrize("seed", range(4))
def test_a_mass_on_a_beam_is_found_through_noise_and_an_uncertain_stiffness(seed: int):
    """Truth: 40 elements and 6 % of the mass; model: 20 elements; 8 sensors, 1 % noise, stiffness 5 % off, known to 5 %."""
    K, M = cantilever(40)
    node = 7 + 3 * seed  # of 20
    M[4 * node - 2, 4 * node - 2] += 0.06
    fine = [4 * (2 * i + 4) - 2 for i in range(8)]
    truth = measured(1.05 * K, M, fine, 5, 0.01, seed)
    test = ModalTest(truth.number, truth.frequency_hz, truth.frequency_sd_hz, np.array([2 * (2 * i + 4) - 2 for i in range(8)]),
                     truth.shapes, truth.shape_sd)  # fmt: skip
    location = located(*cantilever(20), test, 0.05)
    force = next(place for place in location.places if place.channel == "force" and int(place.site.ids[0]) % 2 == 1)
    assert abs((int(force.site.ids[0]) + 1) / 2 - node) <= 1
    assert location.single


def test_nothing_single_makes_what_is_spread_over_half_of_the_beam():
    """Springs in proportion to the mass under the outer half, which no force at one place stands for."""
    k, m = cantilever(20)
    half = np.zeros_like(k)
    half[20:, 20:] = 60 * m[20:, 20:]
    assert not located(k, m, measured(k + half, m, list(range(2, 40, 4)), 4, 0.001), 0.05).single


def test_missing_components_and_modes_without_shape_are_left_out():
    K, M = chain(), np.diag(MASSES)
    test = measured(K + 30e3 * np.diag(np.eye(4)[1]), M, range(4), 4)
    shapes = test.shapes.copy()
    shapes[0, 0] = shapes[:, 3] = np.nan
    test = ModalTest(test.number, test.frequency_hz, test.frequency_sd_hz, test.dofs, shapes, test.shape_sd)
    location = located(K, M, test)
    assert (location.places[0].channel, location.places[0].site.ids) == ("force", ("2",))


def test_frequencies_alone_tell_no_place():
    K, M = chain(), np.diag(MASSES)
    test = measured(K, M, range(4), 3)
    bare = ModalTest(
        test.number, test.frequency_hz, test.frequency_sd_hz, np.zeros(0, int), np.zeros((0, 3)), np.zeros((0, 3))
    )
    assert located(K, M, bare).places == ()


@pytest.mark.parametrize("factor", [1.0, 1.03])
def test_a_mass_at_a_node_of_modes_is_found(factor: float):
    """Five equal masses between two walls, more on the middle one: the antisymmetric modes 2 and 4 stay as they are."""
    K, more = factor * 100e3 * (2 * np.eye(5) - np.eye(5, k=1) - np.eye(5, k=-1)), 0.4 * np.diag(np.eye(5)[2])
    test = measured(K, np.eye(5) + more, range(5), 4)
    assert np.allclose(test.shapes[2, [1, 3]], 0.0, atol=1e-9)
    deck = problem(K / factor, np.eye(5), test, 0.05)
    found = scores(reduced(deck, deck.prior.mean))
    channel, number = found.find(int(np.argmin(found.matches.cost)))
    assert (channel.name, channel.site(number).ids) == ("force", ("3",))
    assert found.matches.cost.min() < 1.0  # with the factor 3 % off, which is 0.6 of its sd


def test_a_mode_that_a_place_does_not_make_hides_nothing():
    """Within the scatter a misfit counts as it is; far beyond it by its logarithm, so that other modes still tell."""
    assert borne(np.array([0.5]), 40) == pytest.approx(0.5, rel=0.01)
    right, wrong = [35.0, 40.0, 60_000.0], [3_000.0, 5_000.0, 20_000.0]
    assert sum(right) > sum(wrong)
    assert sum(borne(np.array(right), 40)) < sum(borne(np.array(wrong), 40))

"""Modified structures: against decks that hold the change as elements, drawn parameters, and closed forms of two masses."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.sparse import coo_array, issparse
from scipy.sparse.linalg import eigsh

from mouse_cli._errors import DeckError, NumericalError
from mouse_cli.coupling import modify
from mouse_cli.formats import read_deck
from mouse_cli.formats.yaml_deck import modified
from mouse_cli.terms.assembly import assembly
from mouse_cli.updating import forecast

DECKS = Path(__file__).resolve().parents[2] / "decks"
CANTILEVER = DECKS / "cantilever.yaml"
TWO = """mouse: 1
title: Two masses, k1 and k2 uncertain
units: SI
model:
  stiffness: {dense: [[3000.0, -1000.0], [-1000.0, 1000.0]]}
  mass: {diagonal: [2.0, 1.0]}
parameters:
  - {name: k1, nominal: 2000.0, sd: 100.0, stiffness: [[1, 1, 1]]}
  - {name: k2, nominal: 1000.0, sd: 30.0, stiffness: [[1, 1, 1], [1, 2, -1], [2, 2, 1]]}
"""


def answer(body: str, deck: Path = CANTILEVER):
    """What `modify:` with these lines gives for `deck`."""
    text = "mouse: 1\nmodify:\n  deck: model\n" + "".join(f"  {line}\n" for line in body.strip().splitlines())
    return modify(modified.read(text, "<test>", read_deck(deck)))


@pytest.fixture
def two(tmp_path) -> Path:
    (tmp_path / "two.yaml").write_text(TWO)
    return tmp_path / "two.yaml"


def roots_hz(K, M) -> np.ndarray:
    return np.sqrt(np.sort(np.linalg.eigvals(np.linalg.solve(M, K)).real)) / (2 * np.pi)


K2, M2 = np.array([[3000.0, -1000.0], [-1000.0, 1000.0]]), np.diag([2.0, 1.0])


def test_changes_are_those_of_elements_in_the_deck(tmp_path):
    """Mass, spring and dashpot as changes, and as elements of the library in a deck of their own: frequencies, sd, shapes,
    damping."""
    text = CANTILEVER.read_text()
    more = "      - {id: 31, type: mass, nodes: [7], mass: 0.4}\n"
    more += "      - {id: 32, type: spring, nodes: [10], TY: 900.0}\n      - {id: 33, type: dashpot, nodes: [10], TY: 3.0}\n"
    (tmp_path / "more.yaml").write_text(text.replace("    supports:", more + "    supports:"))
    expected = forecast(read_deck(tmp_path / "more.yaml"), 5)
    found = answer(
        """
changes:
  - {mass: 0.4, at: 7TY}
  - {mass: 0.4, at: 7TX}
  - {spring: 900, dashpot: 3, at: 10TY}
count: 5
"""
    ).after
    np.testing.assert_allclose(found.frequencies_hz, expected.frequencies_hz[: len(found.frequencies_hz)], rtol=1e-9)
    np.testing.assert_allclose(found.sd_hz, expected.sd_hz, rtol=1e-7)
    np.testing.assert_allclose(np.abs(found.shapes), np.abs(expected.shapes), atol=1e-6)
    np.testing.assert_allclose(found.shape_sd, expected.shape_sd, atol=1e-6)
    np.testing.assert_allclose(found.damped.damping, expected.damped.damping, rtol=1e-6)


def test_covariance_and_shifts_are_those_of_drawn_parameters(two):
    """A thirtieth of the stated uncertainty, where the first order is all there is: 3000 models solved by numpy."""
    small = two.with_name("small.yaml")
    small.write_text(TWO.replace("sd: 100.0", "sd: 3.0").replace("sd: 30.0", "sd: 1.0"))
    found = answer("changes: [{mass: 0.7, at: 2}, {spring: 400, at: 1, to: 2}]", small)
    rng, rows = np.random.default_rng(2), []
    for k1, k2 in rng.standard_normal((3000, 2)) * [3.0, 1.0] + np.array([2000.0, 1000.0]):
        K = np.array([[k1 + k2, -k2], [-k2, k2]])
        before, after = roots_hz(K, M2), roots_hz(K + 400 * np.array([[1, -1], [-1, 1]]), M2 + np.diag([0, 0.7]))
        rows.append([*after, *(after - before)])
    cov = np.cov(np.array(rows).T)
    np.testing.assert_allclose(found.after.root_hz @ found.after.root_hz.T, cov[:2, :2], rtol=0.1)
    np.testing.assert_allclose(found.shifts.sd_hz, np.sqrt(np.diag(cov)[2:]), rtol=0.06)
    np.testing.assert_allclose(found.shifts.shift_hz, np.mean(rows, axis=0)[2:], rtol=1e-3)


def test_functions_and_their_variance_are_those_of_drawn_parameters(two):
    small = two.with_name("small.yaml")
    small.write_text(TWO.replace("sd: 100.0", "sd: 3.0").replace("sd: 30.0", "sd: 1.0"))
    found = answer(
        "changes: [{mass: 0.7, at: 2}, {dashpot: 2, at: 1}]\nresponses: [1, 2]\nforces: [2]\nlines: {band: [1, 9], step: 1.7}",
        small,
    ).functions
    s = 2j * np.pi * found.after.frequency_hz
    rng, drawn = np.random.default_rng(3), []
    for k1, k2 in np.vstack([[0.0, 0.0], rng.standard_normal((3000, 2)) * [3.0, 1.0]]) + np.array([2000.0, 1000.0]):
        Z = (
            np.array([[k1 + k2, -k2], [-k2, k2]])
            + s[:, None, None] * np.diag([2, 0])
            + s[:, None, None] ** 2 * np.diag([2, 1.7])
        )
        drawn.append(np.linalg.inv(Z)[:, :, [1]])
    drawn = np.array(drawn)
    np.testing.assert_allclose(found.after.H, drawn[0], rtol=1e-12)
    np.testing.assert_allclose(found.after.variance, drawn[1:].var(axis=0), rtol=0.1)
    np.testing.assert_allclose(found.sd_log, np.log(np.abs(drawn[1:])).std(axis=0), rtol=0.1)


def test_absorber_is_a_mass_on_a_spring_and_splits_the_mode(two):
    """The matrices of three masses, and Den Hartog's tuning (Mechanical Vibrations, sec. 3.3) by the modal mass 1/phi^2."""
    found = answer("changes: [{absorber: {mass: 0.3, frequency: 2.5, damping_ratio: 0.1}, at: 2}]", two)
    k, c = 0.3 * (2 * np.pi * 2.5) ** 2, 2 * 0.1 * 0.3 * 2 * np.pi * 2.5
    K = np.array([[3000, -1000, 0], [-1000, 1000 + k, -k], [0, -k, k]])
    np.testing.assert_allclose(found.after.frequencies_hz, roots_hz(K, np.diag([2, 1, 0.3])), rtol=1e-10)
    assert found.after.problem.structure.labels[-1] == "absorber 1"
    np.testing.assert_allclose(found.after.problem.structure.C[1:, 1:], c * np.array([[1, -1], [-1, 1]]))
    (tuned,) = answer("changes: [{absorber: {mass: 0.3, tuned_to: 1}, at: 2}]", two).connections
    lam, X = np.linalg.eigh(_standard())
    mu = 0.3 * X[1, 0] ** 2
    assert np.sqrt(tuned.stiffness / 0.3) == pytest.approx(np.sqrt(lam[0]) / (1 + mu))
    assert tuned.damping == pytest.approx(2 * np.sqrt(3 * mu / 8 / (1 + mu)) * 0.3 * np.sqrt(lam[0]) / (1 + mu))


def _standard() -> np.ndarray:
    """M^-1/2 K M^-1/2 of the two masses; its vectors are M^1/2 phi, which at the mass of 1 kg are phi."""
    root = np.diag(np.diag(M2) ** -0.5)
    return root @ K2 @ root


def test_a_tuned_absorber_has_two_peaks_of_den_hartogs_height(two, tmp_path):
    """One mass of 1 kg: with his tuning and damping both peaks are near sqrt(1 + 2/mu), which holds exactly at the two fixed
    points."""
    deck = tmp_path / "one.yaml"
    deck.write_text("mouse: 1\nmodel: {stiffness: {dense: [[1000.0]]}, mass: {diagonal: [1.0]}}\n")
    found = answer(
        "changes: [{absorber: {mass: 0.1, tuned_to: 1}, at: 1}]\nresponses: [1]\nlines: {band: [3, 7], step: 0.002}",
        deck,
    ).functions
    height = 1000 * np.abs(found.after.H[:, 0, 0])
    assert height.max() == pytest.approx(np.sqrt(1 + 2 / 0.1), rel=0.01)
    assert len(found.peaks) in (1, 2)


@pytest.mark.parametrize(("mode", "side", "hz"), [(1, "below", 2.5), (2, "below", 6.3), (1, "at", 3.2)])
def test_mass_for_a_frequency_solves_the_closed_form(two, mode, side, hz):
    """det(K - w^2 (M + m e e')) = 0 is linear in m: worked out for two masses; and the modified model has that frequency."""
    need = answer(f"targets: [{{mode: {mode}, {side}: {hz}, by: mass, place: 2}}]", two).needs[0]
    lam = (2 * np.pi * hz) ** 2
    exact = ((3000 - 2 * lam) * (1000 - lam) - 1e6) / (lam * (3000 - 2 * lam))
    if mode == 2 and not 3000 - 2 * lam < 0:
        assert np.isnan(need.value)
        return
    assert need.value == pytest.approx(exact, rel=1e-9)
    assert need.reached_hz == pytest.approx(hz, rel=1e-9)
    assert roots_hz(K2, M2 + np.diag([0, need.value]))[mode - 1] == pytest.approx(hz, rel=1e-9)


def test_spring_for_a_frequency_and_its_sd_are_those_of_drawn_parameters(two):
    small = two.with_name("small.yaml")
    small.write_text(TWO.replace("sd: 100.0", "sd: 3.0").replace("sd: 30.0", "sd: 1.0"))
    (need,) = answer("targets: [{mode: 1, above: 3.8, by: spring, place: 2}]", small).needs
    lam = (2 * np.pi * 3.8) ** 2

    def exact(k1, k2):
        return k2**2 / (k1 + k2 - 2 * lam) - (k2 - lam)

    assert need.value == pytest.approx(exact(2000, 1000), rel=1e-9)
    draws = np.random.default_rng(4).standard_normal((20000, 2)) * [3.0, 1.0] + [2000.0, 1000.0]
    assert need.sd == pytest.approx(np.std([exact(*d) for d in draws]), rel=0.03)


def test_what_is_sure_succeeds_as_often_as_it_says(two):
    """The mass for a chance of 95 per cent, by 20000 drawn models."""
    (need,) = answer("targets: [{mode: 1, below: 2.5, by: mass, place: 2}]", two).needs
    assert need.sure > need.value
    draws = np.random.default_rng(7).standard_normal((20000, 2)) * [100.0, 30.0] + [2000.0, 1000.0]
    below = [roots_hz(np.array([[a + b, -b], [-b, b]]), M2 + np.diag([0, need.sure]))[0] <= 2.5 for a, b in draws]
    assert np.mean(below) == pytest.approx(0.95, abs=0.01)


def test_a_mode_goes_no_lower_than_with_the_place_held(two):
    """Mode 2 of the two masses with mass 2 held is sqrt(3000/2): no mass there brings it lower, and the answer says so."""
    (need,) = answer("targets: [{mode: 2, below: 6.0, by: mass, place: 2}]", two).needs
    assert np.isnan(need.value) and "stays above" in need.reason
    assert need.limit_hz == pytest.approx(np.sqrt(1500) / (2 * np.pi), rel=1e-9)
    heavy = roots_hz(K2, M2 + np.diag([0, 1e9]))
    assert heavy[1] == pytest.approx(need.limit_hz, rel=1e-6)
    (up,) = answer("targets: [{mode: 1, above: 7, by: spring, place: 2}]", two).needs
    assert np.isnan(up.value) and up.limit_hz == pytest.approx(np.sqrt(1500) / (2 * np.pi), rel=1e-9)


def test_a_higher_frequency_takes_mass_away_but_no_more_than_there_is(two):
    (need,) = answer("targets: [{mode: 1, above: 3.6, by: mass, place: 2}]", two).needs
    assert -1 < need.value < 0
    assert roots_hz(K2, M2 + np.diag([0, need.value]))[0] == pytest.approx(3.6, rel=1e-9)
    (gone,) = answer("targets: [{mode: 2, above: 400, by: mass, place: 1}]", two).needs
    assert np.isnan(gone.value) or -2 < gone.value < 0


def test_nothing_is_needed_where_the_mode_is_there_already(two):
    (need,) = answer("targets: [{mode: 1, below: 9, by: mass, place: 2}]", two).needs
    assert need.value == 0 and "as it is" in need.reason


def test_sweep_finds_what_each_place_does_when_it_is_tried():
    """Masses and springs at every place of the cantilever, each solved anew by numpy; the order is that of the effect."""
    found = answer("sweeps: [{mode: 2, by: mass, size: 0.3}, {mode: 1, by: spring, size: 2000}]")
    problem = read_deck(CANTILEVER)
    K, M = (
        np.array(x.toarray() if hasattr(x, "toarray") else x) for x in assembly(problem).matrices(problem.prior.mean)
    )
    labels = list(problem.structure.labels)
    for each, mode in zip(found.swept, (1, 0), strict=True):
        hz = [place.hz for place in each.places]
        assert hz == sorted(hz, reverse=mode == 0)
        for place in each.places[:3] + each.places[-2:]:
            unit = np.zeros(len(K))
            unit[labels.index(place.name)] = 1.0
            extra = each.sweep.size * np.outer(unit, unit)
            solved = roots_hz(K, M + extra) if each.sweep.means == "mass" else roots_hz(K + extra, M)
            assert place.hz == pytest.approx(solved[mode], rel=1e-7)


def test_sweep_of_a_large_model_meets_the_same_by_few_modes(tmp_path):
    """A sparse model: 30 modes and a residual in place of all; best places solved anew."""
    text = CANTILEVER.read_text().replace("to: 13", "to: 401").replace("1-12,", "1-400,").replace("1-13,", "1-401,")
    text = text.replace("nodes: [13]", "nodes: [401]").replace("id: 20", "id: 900").replace("id: 21", "id: 901")
    text = text.replace("elements: 20", "elements: 900").replace("elements: 21", "elements: 901")
    (tmp_path / "fine.yaml").write_text(text[: text.index("test:")])
    found = answer("sweeps: [{mode: 2, by: mass, size: 0.3}]", tmp_path / "fine.yaml")
    problem = read_deck(tmp_path / "fine.yaml")
    K, M = assembly(problem).matrices(problem.prior.mean)
    assert issparse(K)
    for place in found.swept[0].places[:2] + found.swept[0].places[200:201]:
        at = problem.structure.labels.index(place.name)
        more = coo_array(([0.3], ([at], [at])), shape=M.shape)
        lam = eigsh(K.tocsc(), 4, M=(M + more).tocsc(), sigma=0.0, return_eigenvectors=False)
        assert place.hz == pytest.approx(np.sqrt(np.sort(lam)[1]) / (2 * np.pi), rel=1e-5)


def test_an_earlier_result_carries_its_covariance(two, tmp_path):
    """The prior's covariance is what counts: with the correlation of a posterior the sd of a frequency is d'Sd."""
    problem = read_deck(two)
    cov = np.array([[1e4, -2.4e3], [-2.4e3, 900.0]])
    problem = replace(problem, prior=replace(problem.prior, cov=cov))
    text = "mouse: 1\nmodify:\n  deck: m\n  changes: [{mass: 0.5, at: 1}]\n"
    found = modify(modified.read(text, "<test>", problem)).after
    M = M2 + np.diag([0.5, 0])
    step = 1e-3
    J = [
        (roots_hz(K2 + step * d, M) - roots_hz(K2 - step * d, M)) / (2 * step)
        for d in (np.array([[1, 0], [0, 0]]), np.array([[1, -1], [-1, 1]]))
    ]
    J = np.array(J).T
    np.testing.assert_allclose(found.root_hz @ found.root_hz.T, J @ cov @ J.T, rtol=1e-5)


def test_more_than_there_is_cannot_be_taken_away(two):
    for change in ("{mass: -1.5, at: 2}", "{spring: -5000, at: 2}"):
        with pytest.raises(NumericalError, match="MD720"):
            answer(f"changes: [{change}]", two)


def test_a_mode_that_is_not_there(two):
    with pytest.raises(DeckError, match="MD719"):
        answer("targets: [{mode: 3, below: 1, place: 1}]", two)

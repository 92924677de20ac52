"""Modes of almost one frequency: an error of theory far below every accuracy turns their shapes into one another.

Held out: two masses on springs of their own, 0.1 % apart, which nothing joins in the model; in truth a random coupling does, whose
variance is half of that which `theory.frequency` gives the springs (random symmetric errors). The truth is solved here, by `eigh`.
Fitted: the same, with the evidence by Monte Carlo; rings and a tetrahedron, whose double and triple modes have closed forms.
"""

from itertools import combinations

import numpy as np
import pytest
from scipy.linalg import eigh

from mouse_cli.diagnosis.diagnose import diagnose
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.data import Data
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.turning import Turn, measured, turned
from mouse_cli.diagnosis.search import looks
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.diagnosis.validate.held_out import held_out
from mouse_cli.dynamics.solver import EigenSolver
from mouse_cli.formats import read_deck
from mouse_cli.model.diagnosis import NAMED, NOTHING
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.theory import Theory
from mouse_cli.updating.chi_square import upper_tail
from mouse_cli.updating.loop import run

THEORY, ACCURACY, SHAPE_SD = 4e-4, 3e-3, 0.02
DECK = """\
mouse: 1
model:
  stiffness: {{dense: [[1, 0, 0], [0, {second}, 0], [0, 0, 9]]}}
  mass: {{identity: 3}}
parameters:
  - {{name: k3, nominal: 9, sd: 5 %, stiffness: [[3, 3, 1.0]]}}
theory: {{frequency: 4e-4}}
test:
  modes:
    frequency: {frequency}
    frequency_sd: 0.3 %
    dofs: [1, 2, 3]
    shapes: {shapes}
    shape_sd: 0.02
  hold_out: {{modes: [1, 2]}}
"""


def predicted(second: float, rng: np.random.Generator, folder):
    """The score of a model of springs 1 and `second`, on a truth with an error of theory in it."""
    E = 2 * THEORY * rng.standard_normal((2, 2))
    K = np.diag([1.0, second, 9.0])
    K[:2, :2] += (E + E.T) / 2
    rates, X = eigh(K)
    hz = np.sqrt(rates) / (2 * np.pi) * (1 + ACCURACY * rng.standard_normal(3))
    shapes = X / X[np.abs(X).argmax(axis=0), range(3)] + SHAPE_SD * rng.standard_normal((3, 3))
    path = folder / "deck.yaml"
    path.write_text(DECK.format(second=second, frequency=hz.tolist(), shapes=shapes.tolist()))
    problem = read_deck(path)
    model = reduced(problem, problem.prior.mean, EigenSolver(lambda text: None))
    return held_out(model, fit(Model(model), np.zeros(0)), None).baseline


@pytest.mark.parametrize("second", [1.002, 1.01])
def test_close_modes_are_predicted_but_for_how_they_turn(second, tmp_path):
    """p-values of what is true are even between 0 and 1: of 40 hardly any is below 0.01."""
    rng = np.random.default_rng(11)
    p = np.array([predicted(second, rng, tmp_path).p for _ in range(40)])
    assert (p < 0.01).sum() <= 3


def test_what_close_modes_leave_has_the_covariance_of_their_angles(tmp_path):
    """Cayley's R solved as a whole, J by differences, and (I + J P^-1 J')^-1, where three of six close modes are measured."""
    rng, s, m, u = np.random.default_rng(5), 8, 3, 6
    seen, hz = rng.standard_normal((s, u)), 10 * (1 + 1e-3 * np.arange(u))
    shapes = seen[:, :m] + 0.1 * rng.standard_normal((s, m))
    shapes[2, 1] = np.nan
    test = ModalTest(np.arange(1, m + 1), hz[:m], 1e-3 * hz[:m], np.arange(s), shapes, np.full((s, m), 0.05))
    data, eigenvalues, modes = Data(test, Theory()), (2 * np.pi * hz) ** 2, np.arange(m)
    turn = turned(data, eigenvalues, seen, modes)
    one, other = zip(*(pair for pair in combinations(range(u), 2) if pair[0] < m), strict=True)
    assert len(turn.angles) == len(one)

    def shown(t: np.ndarray) -> np.ndarray:
        T = np.zeros((u, u))
        T[other, one], T[one, other] = t, -t
        return seen[:, turn.which] @ np.linalg.solve(np.eye(u) - T / 2, np.eye(u) + T / 2)[:, :m]

    t, h = turn.angles, 1e-6
    r, a = data.residual(eigenvalues[modes], shown(t))
    moved = np.stack([shown(t + h * e) - shown(t - h * e) for e in np.eye(len(t))], axis=-1) / (2 * h)
    J = data.jacobian(eigenvalues[modes], shown(t), a, np.zeros(moved.shape[1:]), moved)
    assert turn.slopes == pytest.approx(J, abs=1e-6 * np.abs(J).max())
    covariance = np.eye(len(r)) + J / turn.weights @ J.T
    left = turn.left(data.residual(eigenvalues[modes], measured(seen, modes, turn))[0])
    assert left @ left == pytest.approx((r + J @ t) @ np.linalg.solve(covariance, r + J @ t), rel=1e-4)


def test_angles_of_a_mode_that_sensors_hardly_see():
    """1/2 ln |I + J J'| is the sum of 1/2 ln (1 + s^2), s the singular values of J: here 1e10 and 3."""
    rng = np.random.default_rng(2)
    U, V = (np.linalg.qr(rng.standard_normal((n, n)))[0] for n in (7, 3))
    J = U[:, :2] * [1e10, 3.0] @ V[:, :2].T
    found = Turn(np.arange(2), np.eye(2), np.zeros(3), np.full(3, 1 - 2 / np.pi), J).nats
    assert found == pytest.approx(np.log(1e10) + 0.5 * np.log(10), rel=1e-6)


def test_modes_apart_are_predicted_as_before(tmp_path):
    """The density has no allowance where there is nothing to allow for."""
    found = predicted(1.5, np.random.default_rng(3), tmp_path)
    assert found.p > 0.01 and found.log_predictive_density > 15


def test_frequencies_alone_have_no_shapes_to_turn(tmp_path):
    path = tmp_path / "deck.yaml"
    text = DECK.format(second=1.002, frequency=(np.sqrt([1.0, 1.002, 9.0]) / (2 * np.pi)).tolist(), shapes=[])
    path.write_text("\n".join(line for line in text.splitlines() if "shape" not in line and "dofs" not in line))
    problem = read_deck(path)
    model = reduced(problem, problem.prior.mean, EigenSolver(lambda text: None))
    assert held_out(model, fit(Model(model), np.zeros(0)), None).baseline.p > 0.01


ALONE = """\
mouse: 1
model:
  stiffness: {{dense: {stiffness}}}
  mass: {{identity: {n}}}
parameters: {parameters}
theory: {{frequency: 4e-4, shape: 1e-9}}
test:
  modes: {{frequency: {frequency}, frequency_sd: 0.3 %, dofs: {dofs}, shapes: {shapes}, shape_sd: 0.02}}
"""


def deck(stiffness: np.ndarray, rates, shapes: np.ndarray, folder, parameters: str = "[]", at: tuple[int, ...] = ()):
    """A deck of unit masses, with a test of as many modes as there are shapes, `at` degrees of freedom from 1 or at all."""
    path, n = folder / "deck.yaml", len(stiffness)
    hz = (np.sqrt(rates) / (2 * np.pi)).tolist()
    test = {"frequency": hz, "dofs": list(at or range(1, n + 1)), "shapes": shapes.tolist()}
    path.write_text(ALONE.format(stiffness=stiffness.tolist(), n=n, parameters=parameters, **test))
    return read_deck(path)


def fitted(problem):
    model = reduced(problem, problem.prior.mean, EigenSolver(lambda text: None))
    return fit(Model(model), np.zeros(0))


def simulated(second: float, shapes: np.ndarray, rng: np.random.Generator) -> float:
    """ln of how probable a test of springs 1 and `second` is, by drawing what theory errs; but for (2 pi)^1/2 of each datum."""
    E = 2 * THEORY * rng.standard_normal((200_000, 2, 2))
    rates, X = np.linalg.eigh(np.diag([1.0, second]) + (E + np.swapaxes(E, 1, 2)) / 2)
    a = (X * shapes).sum(axis=1) / (X**2).sum(axis=1)
    off = 0.5 * np.log(np.array([1.0, second]) / rates) / ACCURACY
    misfit = (off**2).sum(axis=1) + (((shapes - a[:, None] * X) / SHAPE_SD) ** 2).sum(axis=(1, 2))
    return float(np.log(np.mean(np.exp(-misfit / 2))) - 2 * np.log(ACCURACY))


@pytest.mark.parametrize("angle", [0.0, 0.2, 0.6])
@pytest.mark.parametrize("second", [1.0, 1.0005, 1.002])
def test_the_evidence_is_that_of_all_errors_of_theory(second, angle, tmp_path):
    """From modes of which only the plane is known to such as keep their shapes, and whatever was measured."""
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    shapes = turn / np.abs(turn).max(axis=0)
    one = fitted(deck(np.diag([1.0, second]), [1.0, second], shapes, tmp_path))
    found = one.log_evidence - np.log(one.data.sd_log).sum()
    assert found == pytest.approx(simulated(second, shapes, np.random.default_rng(0)), abs=0.35)


def ring(n: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Unit masses in a ring, springs 1 to the ground and 4 between: K, and rates 1 + 16 sin^2(pi k / n) with cos and sin of k."""
    K = 9.0 * np.eye(n) - 4 * (np.roll(np.eye(n), 1, axis=0) + np.roll(np.eye(n), -1, axis=0))
    waves, at = np.repeat(range(n // 2 + 1), 2)[1 : n + 1], 2 * np.pi * np.arange(n) / n
    shapes = [np.cos(k * at) if i % 2 else np.sin(k * at) for i, k in enumerate(waves, 1)]
    return K, 1 + 16 * np.sin(np.pi * waves / n) ** 2, np.array(shapes).T


@pytest.mark.parametrize("angle", np.linspace(0.0, 1.5, 6))
def test_double_modes_of_a_ring_may_be_measured_in_any_basis(angle, tmp_path):
    """The noise alone is left, and no less of it: its dof are those of the data, but for an angle of each pair."""
    K, rates, shapes = ring(7)
    for i in (1, 3, 5):
        shapes[:, i : i + 2] = shapes[:, i : i + 2] @ [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    noise = np.random.default_rng(1).standard_normal((8, 7))
    rates, shapes = rates * (1 + 2 * ACCURACY * noise[7]), shapes + SHAPE_SD * noise[:7]
    one = fitted(deck(K, rates, shapes, tmp_path))
    assert one.dof == 7 + 49 - 7 - 3
    assert 0.01 < upper_tail(one.misfit, one.dof) < 0.99


def test_a_triple_mode_may_be_measured_in_any_basis(tmp_path):
    """Four masses, each joined to each by springs 2: 1, and three times 9, whose shapes have no sum."""
    K = 9.0 * np.eye(4) - 2
    for seed in range(8):
        rng = np.random.default_rng(seed)
        plane = np.linalg.qr(np.column_stack([np.ones(4), rng.standard_normal((4, 3))]))[0]
        one = fitted(deck(K, [1.0, 8.97, 9.0, 9.03], plane + 1e-3 * rng.standard_normal((4, 4)), tmp_path))
        assert one.misfit < 5 and one.dof == 4 + 16 - 4 - 3


@pytest.mark.parametrize("mass", [0.0, 0.1])
def test_a_ring_is_sound_but_for_a_mass_that_splits_its_modes(mass, tmp_path):
    """Solved here, by `eigh`; without the mass every measured pair is turned by an angle of its own."""
    K = ring(8)[0]
    M = np.eye(8) + np.diag([0, 0, 0, mass, 0, 0, 0, 0])
    rates, X = eigh(K, M)
    rng = np.random.default_rng(4)
    for i in (1, 3, 5) if not mass else ():
        c, s = np.cos(i), np.sin(i)
        X[:, i : i + 2] = X[:, i : i + 2] @ [[c, -s], [s, c]]
    X = X / np.abs(X).max(axis=0) + SHAPE_SD * rng.standard_normal((8, 8))
    rates = rates * (1 + 2 * ACCURACY * rng.standard_normal(8))
    parameter = "[{name: k, nominal: 9, sd: 5 %, stiffness: [[1, 1, 1.0]]}]"
    found = diagnose(deck(K, rates, X, tmp_path, parameter))
    assert found.kind == (NAMED if mass else NOTHING)
    if mass:
        assert found.groups[0][0] == "mass" and found.explanations[0].causes[0].site.text == "degree of freedom 4"


@pytest.mark.parametrize("name", ["mass", "ground-spring", "oscillator"])
def test_a_look_at_each_close_mode_by_itself_keeps_what_is_best(name, monkeypatch, tmp_path):
    """Of all places and sizes few are left, for whose modes angles are found together; the best of these are the best of all."""
    K, M = ring(8)[0], np.eye(8) + np.diag([0, 0, 0, 0.1, 0, 0, 0, 0])
    rates, X = eigh(K, M)
    problem = deck(K, rates, X + SHAPE_SD * np.random.default_rng(2).standard_normal((8, 8)), tmp_path)
    model = reduced(problem, problem.prior.mean, EigenSolver(lambda text: None))
    every = Study(model).looks(name, np.zeros(model.L.shape[1]), ())
    kept = len(every) // 3
    monkeypatch.setattr(looks, "KEPT", kept)
    few = Study(model).looks(name, np.zeros(model.L.shape[1]), ())
    assert len(few) <= kept
    assert [(i, *x) for _, i, x in few[:6]] == [(i, *x) for _, i, x in every[:6]]


def test_an_update_turns_double_modes_wherever_the_sensors_are(tmp_path):
    """A third of a ring: shapes are not orthogonal there."""
    K, rates, shapes = ring(9)
    for i, angle in ((1, 0.4), (3, 1.1)):
        c, s = np.cos(angle), np.sin(angle)
        shapes[:, i : i + 2] = shapes[:, i : i + 2] @ [[c, -s], [s, c]]
    noise = np.random.default_rng(2).standard_normal((4, 5))
    rates, at = rates[:5] * (1 + 2 * ACCURACY * noise[3]), (1, 2, 3)
    shapes = shapes[np.array(at) - 1, :5] + SHAPE_SD * noise[:3]
    parameter = "[{name: k, nominal: 9, sd: 5 %, stiffness: [[1, 1, 1.0]]}]"
    assert run(deck(K, rates, shapes, tmp_path, parameter, at)).innovation.p > 0.01


def test_a_mode_that_no_sensor_sees_is_compared_without_overflow(tmp_path):
    """Torsion of a mast, of which sensors on its axis see nothing: a close mode stands for its measured shape."""
    shapes = np.array([[1.0, 0.0], [0.0, 1.0]])
    data = fitted(deck(np.diag([1.0, 1.001]), [1.0, 1.001], shapes, tmp_path)).data
    seen = np.array([[1.0, 0.0], [0.0, 0.0]])
    with np.errstate(all="raise"):
        left = data.residual_beside(np.array([1.0, 1.001]), seen, np.arange(2), np.array([[0.0, 0.3], [0.3, 0.0]]))
    assert np.isfinite(left).all()

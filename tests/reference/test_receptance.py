"""Receptances in modes, and what is of low rank, against inverses and eigenvectors of whole matrices; and what is computed once."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from mouse_cli.diagnosis.likelihoods.frf import judge as judges
from mouse_cli.diagnosis.likelihoods.frf.damping import of_low_rank
from mouse_cli.diagnosis.likelihoods.frf.judge import Judge
from mouse_cli.diagnosis.likelihoods.frf.receptance import Receptance, times
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.search import fit as fits
from mouse_cli.dynamics.solver import EigenSolver
from mouse_cli.formats import read_deck

N, O, I, F = 9, 4, 2, 5


@pytest.fixture(params=[0, 1, 3])
def case(request):
    """A model with losses of rank 0, 1 or 3, and Z^-1 (f, n, n) by inversion."""
    rng = np.random.default_rng(7)
    some = lambda *shape: rng.standard_normal(shape) + 1j * rng.standard_normal(shape)
    S, B, G = (rng.standard_normal((count, N)) for count in (O, I, request.param))
    flat, W = 1 / some(N, F), some(F, request.param, request.param)
    Z = np.einsum("nf,nm->fnm", 1 / flat, np.eye(N)) + G.T @ W @ G
    return Receptance(S, B, G, flat, W), S, B, np.linalg.inv(Z), some


def test_functions_and_motion_are_those_of_the_inverse(case):
    found, S, B, inverse, _ = case
    functions = found.H
    assert functions == pytest.approx(S @ inverse @ B.T, rel=1e-10)
    assert np.moveaxis(found.right, 1, 0) == pytest.approx(inverse @ B.T, rel=1e-10)


def test_what_sensors_read_of_forces_is_that_of_the_inverse(case):
    found, S, _, inverse, some = case
    forces = some(N, 3, F, I)
    assert found.read(forces) == pytest.approx(np.einsum("on,fnm,mpfi->opfi", S, inverse, forces), rel=1e-10)
    assert found.left(4) == pytest.approx(np.moveaxis(S @ inverse, 0, 2)[:, :4], rel=1e-10)


@pytest.mark.parametrize("count", [2, 7])
def test_receptances_of_other_rows_are_those_of_the_inverse(case, count):
    """Of fewer than there are sensors, and of more."""
    found, S, B, inverse, _ = case
    rows = np.random.default_rng(3).standard_normal((count, N))
    left, right = found.across(rows)
    assert left == pytest.approx(S @ inverse @ rows.T, rel=1e-10)
    assert right == pytest.approx(rows @ inverse @ B.T, rel=1e-10)


def test_a_real_matrix_times_complex_values():
    A, Z = np.arange(6.0).reshape(2, 3), np.arange(12).reshape(3, 2, 2) * (1 - 2j)
    assert times(A, Z) == pytest.approx(np.tensordot(A, Z, 1))


@pytest.mark.parametrize("rank", [0, 1, 3, 30])
def test_factors_of_low_rank_are_the_eigenvectors_that_matter(rank):
    """Of either sign, and some a million times as large as others; of full rank too."""
    rng = np.random.default_rng(rank)
    U, _ = np.linalg.qr(rng.standard_normal((30, 30)))
    size = np.array([(-1.0) ** j * 10 ** rng.uniform(0, 5) for j in range(rank)])
    matrix = (U[:, :rank] * size) @ U[:, :rank].T
    found, vectors = of_low_rank((matrix + matrix.T) / 2)
    assert np.sort(found) == pytest.approx(np.sort(size), rel=1e-9)
    assert (vectors * found) @ vectors.T == pytest.approx(matrix, abs=1e-10 * np.abs(size).max(initial=1.0))


def test_a_fit_that_was_made_is_kept_and_one_that_was_given_up_is_made_anew(monkeypatch):
    made = []

    def fitted(self, one, law, most, damping, reach):
        made.append(reach)
        return fits.Fit(None, None, 50.0, np.zeros((0, 0)), 0.0)

    monkeypatch.setattr(Judge, "_fitted", fitted)
    judge, one = Judge(None, None), SimpleNamespace()
    first = judge.fitted(one, reach=30.0)  # ends at 50, where no fit matters
    assert judge.fitted(one, reach=20.0) is first
    assert judge.fitted(one, reach=80.0) is not first
    assert judge.fitted(one) is judge.fitted(one, reach=10.0)
    assert judge.fitted(one, law=judges.LAWS[1]) is not judge.fitted(one)
    assert made == [30.0, 80.0, np.inf]


def test_a_model_for_other_data_knows_what_it_computed():
    problem = read_deck(Path(__file__).parents[2] / "decks" / "cracked_bar.yaml")
    base = reduced(problem, problem.prior.mean, EigenSolver())
    bars, data = base.bars, object()
    other = base.judged_by(data)
    assert other.bars is bars and other.data is data and base.data is not data


class Parabola:
    """(x - 3)^2 of one unknown of a cause; slopes are counted."""

    k, t, recipes, counted = 0, 1, (), 0
    bounds, width = np.array([[-10.0, 10.0]]), np.array([20.0])
    base = SimpleNamespace(z=np.zeros(0), data=SimpleNamespace(slack=0.0, dof=1))

    def point(self, x):
        left = np.array([x[0] - 3.0])
        return SimpleNamespace(x=x, residual=-left, chi2=float(left @ left), nats=0.0)

    def jacobian(self, at):
        self.counted += 1
        return np.ones((1, 1))

    def curvature(self, at):
        return 0.0


def test_slopes_are_made_once_at_each_point_of_a_fit():
    """From the optimum on no step is made; a fit that only begins is asked for none."""
    model = Parabola()
    assert fits.fit(model, np.array([3.0])).misfit == 0.0
    assert model.counted == 1
    fits.descended(model, np.array([1.0]), most=0)
    assert model.counted == 1

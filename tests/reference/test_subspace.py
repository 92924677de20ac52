"""The reduced model of a large one beside the whole: eigenvalues, receptances at sensors, parameters, with its error bounded."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.sparse import csr_array, diags_array
from scipy.sparse.linalg import splu

from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.reduced import WHOLE
from mouse_cli.diagnosis.localise.matching import Matcher, shapes
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.model.geometry import Geometry
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.parameter import Gaussian, Parameter
from mouse_cli.model.problem import Problem
from mouse_cli.model.structure import ListedElements, Structure
from mouse_cli.terms.assembly import assembly

MODES, SENSORS = 6, 10


def membrane(side: int) -> tuple[csr_array, csr_array]:
    """K, M of side x (side + 3) unit masses on a net of springs that is held along its edges."""
    from scipy.sparse import eye_array, kron

    def line(n: int):
        return diags_array([-np.ones(n - 1), 2 * np.ones(n), -np.ones(n - 1)], offsets=[-1, 0, 1])

    K = kron(line(side), eye_array(side + 3)) + 1.3 * kron(eye_array(side), line(side + 3))
    return csr_array(K * 1e4), csr_array(eye_array(K.shape[0]))


def deck(side: int, p: int = 4) -> Problem:
    """p factors, each of the springs of a share of the rows; a mass that the model lacks at 0.62 of the way, 3 % of the whole."""
    K, M = membrane(side)
    n, entries = K.shape[0], K.tocoo()
    upper = entries.row <= entries.col
    row, col, value = entries.row[upper], entries.col[upper], entries.data[upper]
    A = np.zeros((len(row), p))
    A[np.arange(len(row)), row * p // n] = value
    heavy = M.toarray() + 0.03 * n * np.diag(np.eye(n)[hidden(n)])
    lam, X = eigh(K.toarray(), heavy, subset_by_index=[0, MODES - 1])
    dofs = np.linspace(3, n - 4, SENSORS).astype(int)
    hz, shapes = np.sqrt(lam) / (2 * np.pi), X[dofs]
    sd = 0.002 * np.abs(shapes).max(axis=0) * np.ones_like(shapes)
    test = ModalTest(np.arange(1, MODES + 1), hz, 1e-4 * hz, dofs, shapes, sd)
    parameters = tuple(Parameter(f"factor {j}", 0.02, 1.0) for j in range(p))
    listed = ListedElements(np.zeros(len(row), bool), row, col)
    return Problem("net", Structure(K, M), listed, A, parameters, Gaussian(np.ones(p), np.full(p, 0.02**2)), test)


def hidden(n: int) -> int:
    """Degree of freedom of the mass that the model lacks."""
    return int(0.62 * n)


@pytest.fixture(scope="module", params=[14, 30])
def both(request):
    problem = deck(request.param)
    return problem, reduced(problem, problem.prior.mean)


def test_it_is_smaller_and_has_the_measured_modes(both):
    """Ritz values against LAPACK's eigenvalues of the whole matrices."""
    problem, model = both
    K, M = (matrix.toarray() for matrix in assembly(problem).matrices(problem.prior.mean))
    assert len(K) > WHOLE and model.r <= 150 and model.r < len(K)
    lam = eigh(K, M, eigvals_only=True, subset_by_index=[0, MODES + 3])
    np.testing.assert_allclose(model.eigenvalues[: len(lam)], lam, rtol=1e-9)
    np.testing.assert_allclose(model.V.T @ M @ model.V, np.eye(model.r), atol=1e-8)
    np.testing.assert_allclose(
        model.project(csr_array(K)), np.diag(model.eigenvalues), atol=1e-8 * model.eigenvalues[-1]
    )


def test_a_force_anywhere_is_seen_by_sensors_as_in_the_whole_model(both):
    """S R(lambda) B at the measured eigenvalues, for B at every degree of freedom: sparse LU of K - lambda M at the sensors."""
    problem, model = both
    K, M = assembly(problem).matrices(problem.prior.mean)
    S = np.eye(K.shape[0])[:, problem.test.dofs]
    for hz in problem.test.frequency_hz:
        lam = 1.01 * (2 * np.pi * hz) ** 2  # beside the mode that the mass leaves alone
        whole = splu((K - lam * M).tocsc()).solve(S).T
        ours = (model.sensing / (model.eigenvalues - lam)) @ model.V.T
        assert np.abs(ours - whole).max() < 5e-4 * np.abs(whole).max()
        at = model.places
        assert np.abs(ours[:, at] - whole[:, at]).max() < 2e-5 * np.abs(whole).max()


def test_parameters_move_it_as_they_move_the_whole_model(both):
    """Two prior standard deviations away, in a direction of their own each: eigenvalues of the whole matrices there."""
    problem, model = both
    z = np.array([2.0, -1.0, 1.0, -2.0])
    K, M = (matrix.toarray() for matrix in assembly(problem).matrices(model.parameters(z)))
    np.testing.assert_allclose(
        eigh(*model.matrices(z), eigvals_only=True)[:MODES], eigh(K, M, eigvals_only=True)[:MODES], rtol=1e-5
    )


def test_the_place_of_a_mass_is_among_those_looked_at(both):
    """Or its neighbour, whose force the sensors cannot tell from it."""
    problem, model = both
    n = problem.structure.n
    width = int(np.sqrt(n + 2.25) - 1.5) + 3
    rows, cols = np.divmod(model.places, width)
    row, col = divmod(hidden(n), width)
    assert np.min(np.abs(rows - row) + np.abs(cols - col)) <= 1


def test_of_many_parameters_the_directions_that_data_see_are_kept():
    """80 of them: a unit step along what is kept moves the data as the whole model; what is dropped hardly moves a frequency."""
    problem = deck(14, 80)
    model = reduced(problem, problem.prior.mean)
    assert model.dK.shape[0] == model.L.shape[1] <= 40
    z = np.zeros(model.L.shape[1])
    z[0] = 1.0
    K, M = (matrix.toarray() for matrix in assembly(problem).matrices(model.parameters(z)))
    np.testing.assert_allclose(
        eigh(*model.matrices(z), eigvals_only=True)[:MODES], eigh(K, M, eigvals_only=True)[:MODES], rtol=1e-5
    )
    step = 1e-4 * np.random.default_rng(0).standard_normal(80)
    D = model.L / 0.02
    parts = (np.zeros(80), step, step - D @ (D.T @ step))
    before, moved, left = (
        eigh(*(m.toarray() for m in assembly(problem).matrices(1 + part)), eigvals_only=True)[:MODES] for part in parts
    )
    assert np.abs(left - before).max() < 0.02 * np.abs(moved - before).max()


def test_at_other_parameters_it_keeps_its_places_and_follows_the_whole_model(both):
    """The same coordinates: eigenvalues of the whole matrices."""
    problem, model = both
    theta = np.array([1.03, 0.98, 1.02, 0.97])
    there = model.at(theta)
    K, M = (matrix.toarray() for matrix in assembly(problem).matrices(theta))
    found = eigh(*there.matrices(there.z), eigvals_only=True)
    np.testing.assert_allclose(found[:MODES], eigh(K, M, eigvals_only=True)[:MODES], rtol=1e-5)
    np.testing.assert_allclose(there.V[problem.test.dofs], there.sensing, atol=1e-12)
    assert there.places is model.places


def test_a_place_that_moves_in_one_mode_alone_is_matched_by_the_better_of_two_shapes(both):
    """That of the mode in which it moves, |y|^2 sin^2 of the angle, wherever lambda is; or, at a node of the mode whose pole is
    one sd away, that mode as the model has it, at the cost of the one sd."""
    _, model = both
    measured, z = shapes(model), np.zeros(model.L.shape[1])
    pole = Matcher(model, measured, z).eigenvalues[0]
    sd = np.full(MODES, 1e-4 * pole)
    near = replace(measured, eigenvalue=pole - sd, sd=sd)
    matcher = Matcher(model, near, z)
    y, seen = matcher.y(0), matcher.seen[:, :6] * near.weight[:, 0, None]
    left = y @ y - (seen.T @ y) ** 2 / np.sum(seen**2, axis=0)
    cost = matcher.nearest(0, np.eye(model.r)[1:6])[1]
    np.testing.assert_allclose(cost, np.minimum(left[1:], left[0] + 1.0), rtol=1e-6)


def test_places_about_the_best_one_are_kept_apart(both):
    """The degree of freedom that has the mass is among the places, and what the sensors hardly tell from it."""
    problem, model = both
    assert hidden(problem.structure.n) in model.places


def lattice(side: int) -> tuple[csr_array, csr_array, Geometry]:
    """K, M of side x side unit masses in a plane, joined by springs along rows, columns and diagonals, an edge held."""
    cols, rows = np.divmod(np.arange(side * side), side)
    K = np.zeros((2 * side * side, 2 * side * side))
    for dx, dy, k in ((1, 0, 1e4), (0, 1, 1.3e4), (1, 1, 0.6e4), (1, -1, 0.6e4)):
        along = np.array([dx, dy]) / np.hypot(dx, dy)
        for i in np.flatnonzero((cols + dx < side) & (rows + dy < side) & (rows + dy >= 0)):
            j = i + dx * side + dy
            at = np.array([2 * i, 2 * i + 1, 2 * j, 2 * j + 1])
            K[np.ix_(at, at)] += k * np.outer(np.r_[along, -along], np.r_[along, -along])
    free = np.flatnonzero(np.repeat(cols > 0, 2))
    place = np.stack([cols, rows, np.zeros_like(cols)], axis=1).astype(float)
    geometry = Geometry(np.arange(1, side * side + 1), place, free // 2, free % 2, np.zeros((0, 2)))
    return csr_array(K[np.ix_(free, free)]), csr_array(np.eye(len(free))), geometry


def loaded(share: float):
    """The reduced model of a lattice whose sensors look along Y, its test with a mass of that share of the whole at a node; K and M
    (n, n) with it, the mass, and the index of the node."""
    K, M, geometry = lattice(14)
    n, node = K.shape[0], int(geometry.node[K.shape[0] // 2 + 9])
    here = np.flatnonzero(geometry.node == node)
    heavy = M.toarray()
    heavy[here, here] += share * n / 2
    lam, X = eigh(K.toarray(), heavy, subset_by_index=[0, MODES - 1])
    dofs = np.arange(9, n, n // SENSORS) // 2 * 2 + 1
    sd = 0.002 * np.abs(X[dofs]).max(axis=0) * np.ones((len(dofs), MODES))
    hz = np.sqrt(lam) / (2 * np.pi)
    test = ModalTest(np.arange(1, MODES + 1), hz, 1e-4 * hz, dofs, X[dofs], sd)
    structure = Structure(K, M, geometry=geometry, labels=geometry.labels())
    listed, A = ListedElements(np.zeros(n, bool), np.arange(n), np.arange(n)), K.diagonal()[:, None] * 1e-3
    problem = replace(deck(14, 1), structure=structure, elements=listed, A=A, test=test)
    K, _ = assembly(problem).matrices(np.ones(1))
    return reduced(problem, np.ones(1)), K.toarray(), heavy, share * n / 2, node


def test_a_mass_beside_sensors_of_one_direction_acts_along_all_of_its_node():
    """As much as the whole: eigenvalues of the whole matrices."""
    model, K, heavy, mass, node = loaded(1.0)
    recipe = next(each for each in model.recipes(registry()["mass"]) if each.site(each.grid[0]).ids == (node + 1,))
    found = eigh(np.diag(model.eigenvalues), np.eye(model.r) + recipe.change(np.array([mass])).M, eigvals_only=True)
    np.testing.assert_allclose(found[:MODES], eigh(K, heavy, eigvals_only=True)[:MODES], rtol=1e-4)


def test_nodes_around_the_one_where_a_mass_explains_most_are_places():
    """A tenth of the whole, at a node of which the survey knows one direction at a time."""
    model, _, _, _, node = loaded(0.1)
    geometry = model.problem.structure.geometry
    near = np.linalg.norm(geometry.coordinates - geometry.coordinates[node], axis=1) < 1.1
    assert near.sum() == 5 and np.isin(np.flatnonzero(near[geometry.node]), model.places).all()

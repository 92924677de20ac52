"""Expansion of mode shapes against closed forms, brute force, and modes of models; what noise does to it."""

import numpy as np
import pytest
from scipy.linalg import cholesky, solve_triangular
from scipy.sparse import csr_array

from mouse_cli.dynamics.condensation import LooseError
from mouse_cli.dynamics.expansion import Measured, expansion, registry
from mouse_cli.dynamics.solver import eigensolution

METHODS = tuple(registry())


def beam(elements: int, sparse: bool = False):
    """K, M of a cantilever of unit length and stiffness, consistent masses: deflection and rotation at each free node."""
    L = 1.0 / elements
    k = np.array([[12, 6 * L, -12, 6 * L], [6 * L, 4 * L**2, -6 * L, 2 * L**2],
                  [-12, -6 * L, 12, -6 * L], [6 * L, 2 * L**2, -6 * L, 4 * L**2]]) / L**3  # fmt: skip
    m = np.array([[156, 22 * L, 54, -13 * L], [22 * L, 4 * L**2, 13 * L, -3 * L**2],
                  [54, 13 * L, 156, -22 * L], [-13 * L, -3 * L**2, -22 * L, 4 * L**2]]) * L / 420  # fmt: skip
    n = 2 * elements + 2
    K, M = np.zeros((n, n)), np.zeros((n, n))
    for e in range(elements):
        at = slice(2 * e, 2 * e + 4)
        K[at, at] += k
        M[at, at] += m
    K, M = K[2:, 2:], M[2:, 2:]
    return (csr_array(K), csr_array(M)) if sparse else (K, M)


def measured(K, M, sensing, shapes, eigenvalues, solution, sd=1e-3, modes=6, exact=True) -> Measured:
    """A test of `shapes` (s, m)."""
    spread = np.where(np.isfinite(shapes), sd, np.nan)
    of_model = solution.eigenvalues[:modes], solution.shapes[:, :modes]
    return Measured(K, M, sensing, shapes, spread, eigenvalues, *of_model, exact)


@pytest.mark.parametrize("sparse", [False, True])
@pytest.mark.parametrize("key", [key for key in METHODS if key != "guyan"])
def test_the_models_own_modes_come_back(key, sparse):
    """Four modes seen at six deflections, one component missing: every method but the static one gives the modes exactly."""
    K, M = beam(20, sparse)
    solution = eigensolution(K, M, 8)
    at, modes = np.array([4, 12, 18, 24, 30, 38]), np.arange(4)
    shapes = solution.shapes[np.ix_(at, modes)].copy()
    shapes[2, 1] = np.nan
    found = expansion(key).expand(measured(K, M, at, shapes, solution.eigenvalues[:4], solution, modes=5))
    np.testing.assert_allclose(found, solution.shapes[:, :4], atol=1e-7 * np.abs(solution.shapes).max())


@pytest.mark.parametrize("key", [key for key in METHODS if key != "guyan"])
def test_sensors_that_combine_degrees_of_freedom(key):
    """The same with sensors that read sums, and one backwards."""
    K, M = beam(12)
    solution = eigensolution(K, M)
    sensing = csr_array(np.random.default_rng(3).standard_normal((7, 24)) * (np.arange(24) % 2 == 0))
    shapes = sensing @ solution.shapes[:, :3]
    found = expansion(key).expand(measured(K, M, sensing, shapes, solution.eigenvalues[:3], solution))
    np.testing.assert_allclose(found, solution.shapes[:, :3], atol=1e-7 * np.abs(solution.shapes).max())


def test_static_shape_of_a_cantilever_pushed_at_its_tip():
    """w = (3 x^2 - x^3) / 2 and its slope, for any mesh (beam theory)."""
    K, M = beam(10)
    given = measured(K, M, np.array([18]), np.array([[1.0]]), np.ones(1), eigensolution(K, M))
    x = np.arange(1, 11) / 10
    found = expansion("guyan").expand(given)[:, 0]
    np.testing.assert_allclose(found[::2], (3 * x**2 - x**3) / 2, atol=1e-9)
    np.testing.assert_allclose(found[1::2], (6 * x - 3 * x**2) / 2, atol=1e-9)


@pytest.mark.parametrize("sparse", [False, True])
@pytest.mark.parametrize("key", ["least-squares", "residual-energy"])
def test_least_residual_by_brute_force(key, sparse):
    """min |W (Z_o u_o + Z_a t)| by numpy's lstsq: W the unit matrix (lecture 21-1), or the inverse Cholesky factor of K."""
    K, M = beam(6)
    solution = eigensolution(K, M)
    at, rest = np.array([2, 6, 10]), np.setdiff1d(np.arange(12), [2, 6, 10])
    t = np.array([[0.1, 0.4], [0.5, -0.3], [1.1, 0.9]])
    eigenvalues = 0.8 * solution.eigenvalues[:2]
    given = (csr_array(K), csr_array(M)) if sparse else (K, M)
    found = expansion(key).expand(measured(*given, at, t, eigenvalues, solution))
    for i, eigenvalue in enumerate(eigenvalues):
        Z = K - eigenvalue * M
        if key == "residual-energy":
            Z = solve_triangular(cholesky(K, lower=True), Z, lower=True)
        free = np.linalg.lstsq(Z[:, rest], -Z[:, at] @ t[:, i], rcond=None)[0]
        np.testing.assert_allclose(found[rest, i], free, rtol=1e-6, atol=1e-8)
        np.testing.assert_allclose(found[at, i], t[:, i], rtol=1e-9)


@pytest.mark.parametrize("key", ["least-squares", "residual-energy"])
def test_smoothing_stays_within_the_noise_and_pays(key):
    """40 noisy tests: measured components are missed by one sd at most on average, and the errors fall by a third or more."""
    K, M = beam(16)
    solution, rng = eigensolution(K, M), np.random.default_rng(0)
    at, truth = np.arange(0, 32, 4), solution.shapes[:, :3]
    errors = {True: [], False: []}
    for _ in range(40):
        shapes = truth[at] + 0.05 * rng.standard_normal((8, 3))
        for exact in errors:
            found = expansion(key).expand(
                measured(K, M, at, shapes, solution.eigenvalues[:3], solution, sd=0.05, exact=exact)
            )
            errors[exact].append(np.linalg.norm((found - truth)[::2]))
            missed = np.sqrt(np.mean(((found[at] - shapes) / 0.05) ** 2, axis=0))
            assert missed.max() < (1e-6 if exact else 1 + 1e-6)
    assert np.mean(errors[False]) < 0.7 * np.mean(errors[True])


def test_serep_is_weighted_least_squares():
    """A sensor of tenfold sd counts a hundredth: compared with the normal equations."""
    K, M = beam(8)
    solution = eigensolution(K, M)
    at, sd = np.array([2, 6, 10, 14]), np.array([[0.01], [0.1], [0.01], [0.01]])
    t, X = np.array([[0.2], [0.9], [1.0], [2.1]]), solution.shapes[:, :2]
    given = Measured(K, M, at, t, sd, solution.eigenvalues[:1], solution.eigenvalues[:2], X)
    seen, W = X[at], np.diag(sd[:, 0] ** -2)
    q = np.linalg.solve(seen.T @ W @ seen, seen.T @ W @ t)
    np.testing.assert_allclose(expansion("serep").expand(given), X @ q, rtol=1e-9)


def test_dynamic_expansion_where_nothing_is_determined():
    """A beam clamped at its only sensor has a natural frequency there: the shape is not determined, and that is said."""
    K, M = beam(6)
    rest = np.setdiff1d(np.arange(12), [10])
    clamped = np.linalg.eigvals(np.linalg.solve(M[np.ix_(rest, rest)], K[np.ix_(rest, rest)])).real.min()
    given = measured(K, M, np.array([10]), np.array([[1.0]]), np.array([clamped]), eigensolution(K, M))
    with pytest.raises(LooseError):
        expansion("dynamic").expand(given)


@pytest.mark.parametrize("key", METHODS)
def test_every_method_on_a_large_sparse_model(key):
    """A chain of 20 000 masses at five sensors: modes sin((2 j - 1) pi i / (2 n + 1)) in closed form, nothing dense (n, n)."""
    n, modes = 20_000, np.arange(1, 4)
    i, d = np.arange(1, n + 1), np.full(n, 2.0)
    d[-1] = 1.0
    rows, cols = np.r_[i - 1, i[:-1] - 1, i[:-1]], np.r_[i - 1, i[:-1], i[:-1] - 1]
    K = csr_array((np.r_[d, -np.ones(2 * n - 2)], (rows, cols)), shape=(n, n))
    M = csr_array((np.ones(n), (i - 1, i - 1)), shape=(n, n))
    angle = (2 * modes - 1) * np.pi / (2 * n + 1)
    X, eigenvalues = np.sin(np.outer(i, angle)) * 2 / np.sqrt(2 * n + 1), 4 * np.sin(angle / 2) ** 2
    at = np.array([4000, 8000, 12_000, 16_000, 19_999])
    given = Measured(K, M, at, X[at], np.full((5, 3), 1e-5), eigenvalues, eigenvalues, X, True)
    found = expansion(key).expand(given)
    off = 0.25 if key == "guyan" else 1e-4
    np.testing.assert_allclose(found, X, atol=off * np.abs(X).max())


@pytest.mark.parametrize("size", [1e30, 1e170])
def test_a_reading_far_beyond_its_sd_is_kept(size):
    """Of 1e30 and more standard deviations, whose squares overflow: the expanded shape has it at the sensor."""
    K, M = beam(6)
    t = np.array([[0.1], [0.5], [-size]])
    given = measured(K, M, np.array([2, 6, 10]), t, np.array([1.0]), eigensolution(K, M), sd=0.01, exact=False)
    found = expansion("residual-energy").expand(given)
    assert found[10, 0] == pytest.approx(-size, rel=1e-9)

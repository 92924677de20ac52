"""What large models rest on: factorisations of every backend, counted modes, singular masses, memory refused in time.

References: dense LAPACK on the same matrices, the closed form of a chain, a sum over all modes.
"""

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.sparse import block_diag, csr_array, diags_array, kron

from mouse_cli._errors import NumericalError
from mouse_cli.dynamics import memory
from mouse_cli.dynamics.eigen import IndefiniteError
from mouse_cli.dynamics.factors import Analysis, registry
from mouse_cli.dynamics.forces import forces
from mouse_cli.dynamics.pencil import Pencil
from mouse_cli.dynamics.sensitivity import EXACT, FINAL, modal_partials
from mouse_cli.dynamics.solver import EigenSolver, eigensolution
from mouse_cli.model.term import Slopes

BACKENDS = [
    pytest.param(
        backend,
        id=key,
        marks=pytest.mark.skipif(not backend.available(), reason=f"the package of {key} is not installed"),
    )
    for key, backend in registry().items()
]


def net(across: int, along: int) -> csr_array:
    """Stiffness of a rectangular net of strings, held at its frame: eigenvalues are sums of two squares of sines."""

    def line(k: int):
        return diags_array([np.full(k - 1, -1.0), np.full(k, 2.0), np.full(k - 1, -1.0)], offsets=[-1, 0, 1])

    one, other = diags_array(np.ones(across)), diags_array(np.ones(along))
    return csr_array(kron(line(across), other) + kron(one, line(along)))


def net_eigenvalues(across: int, along: int) -> np.ndarray:
    a, b = (4 * np.sin(np.arange(1, k + 1) * np.pi / (2 * k + 2)) ** 2 for k in (across, along))
    return np.sort(np.add.outer(a, b).ravel())


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("shift", [0.0, 0.05, 0.5], ids=["definite", "indefinite", "far"])
def test_backends_solve_and_count(backend, shift):
    K = net(13, 17)
    A = Pencil(K, csr_array(diags_array(np.ones(221)))).shifted(K, csr_array(diags_array(np.ones(221))), shift)
    factor = Analysis(A, backend).factor(A)
    right = np.random.default_rng(1).standard_normal((221, 5))
    np.testing.assert_allclose(factor.solve(right), np.linalg.solve(A.toarray(), right), rtol=1e-9, atol=1e-9)
    assert factor.negative() in (np.count_nonzero(net_eigenvalues(13, 17) < shift), None)


@pytest.mark.parametrize("backend", BACKENDS)
def test_backends_count_alike(backend):
    """Inertia of shifted random pencils, wherever a backend says it."""
    rng, told = np.random.default_rng(7), 0
    for _ in range(40):
        n = int(rng.integers(20, 60))
        half = np.where(rng.random((n, n)) < 0.1, rng.standard_normal((n, n)), 0.0)
        dense = half + half.T + np.diag(rng.standard_normal(n))
        counted = Analysis(csr_array(dense), backend).factor(csr_array(dense)).negative()
        if counted is not None:
            told += 1
            assert counted == np.count_nonzero(np.linalg.eigvalsh(dense) < 0)
    assert told > 10 or backend.key != "rslab"


@pytest.mark.parametrize("backend", BACKENDS)
def test_eigenvalues_of_a_net(backend):
    """Closed form, pairs of equal eigenvalues included; the inertia confirms them."""
    K, M = net(60, 60), csr_array(diags_array(np.ones(3600)))
    solution = EigenSolver(backend=backend).solve(K, M, 20, verify=True)
    np.testing.assert_allclose(solution.eigenvalues, net_eigenvalues(60, 60)[:20], rtol=1e-11)
    assert solution.verified >= 18


@pytest.mark.parametrize("backend", BACKENDS)
def test_eigenvalues_of_a_net_with_many_neighbours(backend):
    """Squares of the matrix of a net have its eigenvalues squared, and twelve neighbours a node: SuperLU then dissects."""
    K, M = net(50, 61), csr_array(diags_array(np.ones(3050)))
    solution = EigenSolver(backend=backend).solve(csr_array(K @ K), M, 12, verify=True)
    np.testing.assert_allclose(solution.eigenvalues, net_eigenvalues(50, 61)[:12] ** 2, rtol=1e-8)
    assert solution.verified >= 10


def test_a_pattern_with_zeros_is_kept():
    """Zeros of K - sigma M that only one shift has do not change the pattern; an entry that appears makes a new one."""
    K, M = net(6, 6), csr_array(diags_array(np.ones(36)))
    pencil = Pencil(K, M)
    assert pencil.shifted(K, M, 4.0).nnz == pencil.shifted(K, M, 1.0).nnz == K.nnz
    np.testing.assert_array_equal(pencil.shifted(K, M, 4.0).toarray(), (K - 4.0 * M).toarray())
    assert pencil.fits(2 * K, M) and not pencil.fits(K, csr_array(np.ones((36, 36))))


@pytest.mark.parametrize("bodies", [3, 12])
def test_more_equal_modes_than_a_block_has_columns(bodies):
    """Equal chains that nothing joins: every eigenvalue as often as there are chains."""
    chain = diags_array([np.full(149, -1.0), np.full(150, 2.0), np.full(149, -1.0)], offsets=[-1, 0, 1])
    K = csr_array(block_diag([chain] * bodies))
    solution = EigenSolver().solve(K, csr_array(diags_array(np.ones(150 * bodies))), 2 * bodies + 2, verify=True)
    exact = 4 * np.sin(np.arange(1, 4) * np.pi / 302) ** 2
    np.testing.assert_allclose(solution.eigenvalues, np.repeat(exact, bodies)[: 2 * bodies + 2], rtol=1e-8)


@pytest.mark.parametrize("count", [5, 8, 14])
def test_more_free_bodies_than_modes_are_asked_for(count):
    """Twelve free chains: what parts their rigid-body modes from one another is rounding, and no sign of a mode that was missed."""
    rng = np.random.default_rng(8)
    chains = []
    for k in rng.uniform(1e5, 1e9, (12, 149)):
        chains.append(diags_array([-k, np.append(k, 0) + np.append(0, k), -k], offsets=[-1, 0, 1]))
    K, M = csr_array(block_diag(chains)), csr_array(diags_array(rng.uniform(0.1, 10, 1800)))
    masses = [np.diag(m) for m in np.split(M.diagonal(), 12)]
    each = [eigh(k.toarray(), m, eigvals_only=True)[1:] for k, m in zip(chains, masses, strict=True)]
    exact = np.sort(np.concatenate(each))
    found = EigenSolver().solve(K, M, count, verify=True).eigenvalues
    np.testing.assert_allclose(found[12:], exact[: max(count - 12, 0)], rtol=1e-7)
    assert np.abs(found[:12]).max() < 1e-6 * exact[0]


@pytest.mark.parametrize("massive", [7, 60])
def test_motions_without_mass_follow(massive):
    """Masses at some degrees of freedom alone, sparse and dense: the modes of the model condensed by hand."""
    K, rng = net(12, 25), np.random.default_rng(3)
    heavy = rng.choice(300, massive, replace=False)
    m = np.zeros(300)
    m[heavy] = rng.uniform(1, 2, massive)
    D, light = K.toarray(), np.setdiff1d(np.arange(300), heavy)
    condensed = D[np.ix_(heavy, heavy)] - D[np.ix_(heavy, light)] @ np.linalg.solve(
        D[np.ix_(light, light)], D[np.ix_(light, heavy)]
    )
    scale = 1 / np.sqrt(m[heavy])
    expected = np.linalg.eigvalsh(condensed * scale[:, None] * scale)
    sparse = eigensolution(K, csr_array(diags_array(m)), 20)
    dense = eigensolution(D, np.diag(m))
    assert dense.shapes.shape == (300, massive) and not dense.complete
    np.testing.assert_allclose(dense.eigenvalues, expected, rtol=1e-9)
    np.testing.assert_allclose(sparse.eigenvalues, expected[:20], rtol=1e-8)
    assert len(sparse.eigenvalues) == min(20, massive)


def test_motion_without_mass_or_stiffness_is_refused():
    with pytest.raises(IndefiniteError):
        eigensolution(np.diag([1.0, 0.0]), np.diag([1.0, 0.0]))


def net_slopes(K: csr_array, p: int, seed: int) -> dict[str, Slopes]:
    """p bands of the net whose strings, and masses, are scaled."""
    entries, band = K.tocoo(), K.shape[0] // p + 1
    own = entries.row // band == entries.col // band
    row, col, value = entries.row[own], entries.col[own], entries.data[own]
    at = np.arange(K.shape[0])
    return {"K": Slopes(row // band, row, col, value), "M": Slopes(p + at // band, at, at, np.ones(len(at)))}


@pytest.mark.parametrize(("accuracy", "bound"), [(FINAL, 1e-6), (EXACT, 1e-9)])
@pytest.mark.parametrize("weighted", [False, True], ids=["degrees of freedom", "weights"])
def test_adjoint_space_equals_the_sum_over_all_modes(accuracy, bound, weighted):
    """A rectangular net with pairs far apart: all modes by LAPACK against the shared space, K and M properties."""
    K, M, p = net(23, 31), csr_array(diags_array(np.linspace(1, 2, 713))), 6
    pattern = forces(713, 2 * p, net_slopes(K, p, 0))
    rng, modes = np.random.default_rng(2), np.array([0, 1, 2, 4])
    at = rng.choice(713, 9, replace=False)
    sensing = csr_array(rng.standard_normal((9, 713)) * (rng.random((9, 713)) < 0.01)) if weighted else at
    full = eigensolution(K.toarray(), M.toarray())
    part = EigenSolver().solve(K, M, 8, tolerance=1e-12)
    sign = np.sign(np.sum(part.shapes * (M @ full.shapes[:, :8]), axis=0))[modes]
    one = modal_partials(full, K.toarray(), M.toarray(), modes, sensing, pattern)
    two = modal_partials(part, K, M, modes, sensing, pattern, accuracy)
    assert two.error <= accuracy
    np.testing.assert_allclose(two.d_lambda, one.d_lambda, rtol=1e-9, atol=1e-9 * np.abs(one.d_lambda).max())
    for i, expected in enumerate(one.d_shape):
        assert two.d_shape[i] * sign[i] == pytest.approx(expected, abs=bound * np.abs(expected).max())


def test_memory_is_refused_before_it_is_taken(monkeypatch):
    monkeypatch.setattr(memory, "available", lambda: 10_000_000)
    K = net(80, 80)
    with pytest.raises(NumericalError, match=r"MD517.*6,400 degrees of freedom needs about") as refused:
        EigenSolver().solve(K, csr_array(diags_array(np.ones(6400))), 30)
    assert refused.value.exit_code == 5


def test_estimate_of_the_factor():
    """Within a factor of four of what nested dissection of a square net is known to give: 31/4 n log2 n (George 1973)."""
    n = 120 * 120
    assert 0.25 < memory.nonzeros(net(120, 120)) / (7.75 * n * np.log2(n)) < 4

"""Partial derivatives and eigensolutions against 50-digit arithmetic and against one another.

The reference is a central difference of the eigensolution in 50 digits (mpmath), step 1e-15: truncation and rounding are
both below 1e-25. Formulas: Fox and Kapoor 1968; for equal eigenvalues the projector of the subspace, whose derivative exists
(Kato, Perturbation Theory for Linear Operators, ch. 2).
"""

import numpy as np
import pytest
from mpmath import mp
from scipy.sparse import block_diag, csr_array, diags_array, eye_array

from mouse_cli.dynamics.eigen import EigenSolution, IndefiniteError, clusters
from mouse_cli.dynamics.forces import Forces, forces
from mouse_cli.dynamics.sensitivity import modal_partials
from mouse_cli.dynamics.solver import eigensolution
from mouse_cli.model.structure import ListedElements
from mouse_cli.terms.matrix_entries import MatrixEntries

STEP = mp.mpf(10) ** -15


def exact_modes(K: mp.matrix, M: mp.matrix) -> tuple[list, mp.matrix]:
    """Eigenvalues ascending and mass-normalised shapes by Cholesky reduction in the working precision of mpmath."""
    inverse = mp.inverse(mp.cholesky(M))
    lam, Y = mp.eigsy(inverse * K * inverse.T)
    order = sorted(range(len(lam)), key=lambda i: lam[i])
    X = inverse.T * Y
    return [lam[i] for i in order], mp.matrix([[X[r, i] for i in order] for r in range(X.rows)])


def moved(matrix: np.ndarray, row: int, col: int, step) -> mp.matrix:
    """`matrix` with one element, and its mirror image, moved by `step`."""
    out = mp.matrix(matrix.tolist())
    out[row, col] += step
    if row != col:
        out[col, row] += step
    return out


def differences(K, M, elements, measure) -> list:
    """d measure(lam, X) / d element for every listed element, by central differences."""
    out = []
    with mp.workdps(50):
        for mass, i, j in zip(elements.is_mass, elements.row, elements.col, strict=True):
            ends = [
                measure(
                    *exact_modes(
                        mp.matrix(K.tolist()) if mass else moved(K, i, j, h),
                        moved(M, i, j, h) if mass else mp.matrix(M.tolist()),
                    )
                )
                for h in (STEP, -STEP)
            ]
            out.append([float((a - b) / (2 * STEP)) for a, b in zip(*ends, strict=True)])
    return np.array(out).T


def chain(n: int, seed: int, free: bool = False) -> np.ndarray:
    """Stiffness of a chain with some springs across, free or held at its first mass; well separated eigenvalues."""
    rng = np.random.default_rng(seed)
    K = np.zeros((n, n))
    for i in range(n):
        for j in range(i + 1, n):
            k = rng.uniform(1, 3) * (1.0 if j == i + 1 else 0.15)
            K[[i, j, i, j], [i, j, j, i]] += [k, k, -k, -k]
    K[0, 0] += 0.0 if free else 1.5
    return K


def masses(n: int, seed: int, full: bool) -> np.ndarray:
    rng = np.random.default_rng(seed)
    M = np.diag(rng.uniform(0.5, 2.0, n))
    if full:
        coupling = rng.uniform(-0.1, 0.1, (n, n))
        M += coupling + coupling.T
    return M


def every_element(n: int) -> ListedElements:
    """The whole upper triangle of K, then of M."""
    row, col = np.triu_indices(n)
    e = len(row)
    return ListedElements([False] * e + [True] * e, np.tile(row, 2), np.tile(col, 2))


def pattern_of(n: int, elements: ListedElements, A=None) -> Forces:
    """What a change of each listed element, or with A (e, p) of each property, does to a model of order n."""
    if A is None:
        A = np.eye(len(elements))
    return forces(n, A.shape[1], MatrixEntries(elements, A, np.zeros(A.shape[1])).slopes(np.zeros(A.shape[1])))


@pytest.mark.parametrize("free", [False, True], ids=["held", "free-free"])
@pytest.mark.parametrize("full", [False, True], ids=["lumped mass", "full mass"])
def test_partials_equal_fifty_digit_differences(free, full):
    """Every stiffness and mass element, diagonal and mirrored, all elastic modes, three of five degrees of freedom."""
    n, dofs = 5, np.array([3, 0, 4])
    K, M, elements = chain(n, 3, free), masses(n, 4, full), every_element(n)
    modes = np.arange(int(free), n)[::-1]  # out of order on purpose
    solution = eigensolution(K, M)
    if free:
        assert solution.rigid(solution.eigenvalues[1]) == 1
    partials = modal_partials(solution, K, M, modes, dofs, pattern_of(n, elements))

    def measure(lam, X):
        values = [lam[i] for i in modes]
        for i in modes:
            sign = mp.sign(sum(X[r, i] * solution.shapes[r, i] for r in range(n)))
            values += [sign * X[int(s), int(i)] for s in dofs]
        return values

    expected = differences(K, M, elements, measure)
    got = np.vstack([partials.d_lambda, partials.d_shape.reshape(-1, len(elements))])
    assert got == pytest.approx(expected, rel=1e-10, abs=1e-11)
    assert np.abs(expected).min(axis=1).max() > 1e-4  # no row of zeros that would prove nothing


def test_properties_instead_of_elements():
    """With A the partials are those of the elements times A, dense or sparse."""
    K, M, elements = chain(5, 3), masses(5, 4, full=True), every_element(5)
    A = np.random.default_rng(1).standard_normal((len(elements), 3))
    given = (eigensolution(K, M), K, M, np.arange(5), np.array([0, 3]))
    one = modal_partials(*given, pattern_of(5, elements))
    for form in (A, csr_array(A)):
        two = modal_partials(*given, pattern_of(5, elements, form))
        assert two.d_lambda == pytest.approx(one.d_lambda @ A, rel=1e-12)
        assert two.d_shape == pytest.approx(one.d_shape @ A, rel=1e-11, abs=1e-12)


def plate(unequal: float = 0.0) -> np.ndarray:
    """3 x 3 masses in a square net of equal strings held at the frame: modes (1,2) and (2,1) have one frequency.

    unequal: relative change of all strings of one direction, which parts the pair.
    """
    line = 2 * np.eye(3) - np.eye(3, k=1) - np.eye(3, k=-1)
    return 10 * (np.kron(line, np.eye(3)) + (1 + unequal) * np.kron(np.eye(3), line))


@pytest.mark.parametrize("unequal", [0.0, 1e-9], ids=["repeated", "gap 1e-9"])
def test_subspace_of_equal_eigenvalues(unequal):
    """The projector on modes 2 and 3, and the sum of their eigenvalues, have the derivatives of 50-digit differences."""
    K, M, elements = plate(unequal), np.eye(9), every_element(9)
    pair = np.array([1, 2])
    solution = eigensolution(K, M)
    assert clusters(solution.eigenvalues).tolist()[:4] == [0, 1, 1, 2]
    partials = modal_partials(solution, K, M, pair, np.arange(9), pattern_of(9, elements))
    X = solution.shapes[:, pair]
    half = np.einsum("ise,ri->sre", partials.d_shape, X)
    some = [0, 1, 9, 12, 44, 45, 46, 54, 60, 89]  # springs and masses, diagonal and off
    chosen = ListedElements(elements.is_mass[some], elements.row[some], elements.col[some])

    def measure(lam, Y):
        projector = [Y[r, 1] * Y[s, 1] + Y[r, 2] * Y[s, 2] for r in range(9) for s in range(9)]
        return [lam[1] + lam[2], *projector]

    expected = differences(K, M, chosen, measure)
    got = (half + half.transpose(1, 0, 2)).reshape(81, -1)[:, some]
    assert partials.d_lambda.sum(axis=0)[some] == pytest.approx(expected[0], rel=1e-8, abs=1e-8)
    assert got == pytest.approx(expected[1:], rel=1e-7, abs=1e-8)
    assert np.abs(partials.d_shape).max() < 1.0  # the shapes themselves have components up to 0.5


@pytest.mark.parametrize("gap", [1e-2, 1e-3, 1e-4])
def test_close_eigenvalues_are_told_apart(gap):
    """Above the cluster tolerance each vector has its own, large, derivative."""
    K, M = plate(gap), np.eye(9)
    elements = ListedElements([False, False, True], [0, 0, 4], [0, 1, 5])
    solution = eigensolution(K, M)
    partials = modal_partials(solution, K, M, np.array([1]), np.arange(9), pattern_of(9, elements))

    def measure(lam, X):
        sign = mp.sign(sum(X[r, 1] * solution.shapes[r, 1] for r in range(9)))
        return [lam[1], *(sign * X[r, 1] for r in range(9))]

    expected = differences(K, M, elements, measure)
    got = np.vstack([partials.d_lambda, partials.d_shape[0]])
    assert got == pytest.approx(expected, rel=1e-9 / gap, abs=1e-12 / gap**2)


def frame(n: int) -> tuple[np.ndarray, np.ndarray]:
    """A long irregular chain with second neighbours and a banded consistent mass matrix, free at both ends."""
    rng = np.random.default_rng(11)
    K, M = np.zeros((n, n)), np.diag(rng.uniform(1, 2, n))
    for reach, size in ((1, 1e4), (2, 3e3)):
        for i in range(n - reach):
            k, j = size * rng.uniform(0.8, 1.2), i + reach
            K[[i, j, i, j], [i, j, j, i]] += [k, k, -k, -k]
            if reach == 1:
                M[[i, j], [j, i]] = rng.uniform(0.1, 0.3)
    return K, M


def test_sparse_path_equals_dense_path():
    """Lanczos and bordered solves against LAPACK and the sum over all modes: n = 300, rigid body, full mass matrix."""
    n, modes, dofs = 300, np.array([1, 2, 3, 5, 7]), np.array([0, 17, 120, 299])
    K, M = frame(n)
    rng = np.random.default_rng(5)
    row = rng.integers(0, n - 2, 40)
    elements = ListedElements(rng.random(40) < 0.5, row, row + rng.integers(0, 3, 40))
    dense, sparse = eigensolution(K, M), eigensolution(csr_array(K), csr_array(M), 12, shift=-1.0)
    assert not sparse.complete and sparse.shapes.shape == (n, 12)
    top = dense.eigenvalues[11]
    assert sparse.eigenvalues == pytest.approx(dense.eigenvalues[:12], rel=1e-9, abs=1e-10 * top)
    sign = np.sign(np.sum(sparse.shapes * (M @ dense.shapes[:, :12]), axis=0))
    assert sparse.shapes * sign == pytest.approx(dense.shapes[:, :12], abs=1e-7)
    one = modal_partials(dense, K, M, modes, dofs, pattern_of(n, elements))
    two = modal_partials(
        EigenSolution(sparse.eigenvalues, sparse.shapes * sign),
        csr_array(K),
        csr_array(M),
        modes,
        dofs,
        pattern_of(n, elements),
    )
    assert two.d_lambda == pytest.approx(one.d_lambda, rel=1e-6, abs=1e-9 * np.abs(one.d_lambda).max())
    for got, expected in zip(two.d_shape, one.d_shape, strict=True):
        assert got == pytest.approx(expected, abs=1e-6 * np.abs(expected).max())


def test_bordered_solves_of_a_repeated_pair():
    """On the square net the incomplete solution gives the same subspace derivatives as the complete one."""
    K, M, pair, dofs = plate(), np.eye(9), np.array([1, 2]), np.array([0, 4, 5])
    full = eigensolution(K, M)
    part = EigenSolution(full.eigenvalues[:5], full.shapes[:, :5])
    elements = every_element(9)
    one = modal_partials(full, K, M, pair, dofs, pattern_of(9, elements))
    two = modal_partials(part, csr_array(K), csr_array(M), pair, dofs, pattern_of(9, elements))
    assert two.d_shape == pytest.approx(one.d_shape, abs=1e-12)


@pytest.mark.parametrize("sparse", [False, True])
def test_rigid_body_modes_of_two_bodies(sparse):
    """Two chains that nothing joins: two rigid-body modes, with eigenvalues zero to rounding."""
    K = np.kron(np.eye(2), chain(60, 8, free=True))
    M = masses(120, 9, full=False)
    if sparse:
        K, M = csr_array(K), csr_array(M)
    solution = eigensolution(K, M, 8, shift=-0.1)
    assert solution.rigid(solution.eigenvalues[2]) == 2
    assert np.abs(solution.eigenvalues[:2]).max() < 1e-9 * solution.eigenvalues[2]
    assert np.allclose(solution.shapes[:, :8].T @ (M @ solution.shapes[:, :8]), np.eye(8), atol=1e-9)


@pytest.mark.parametrize(
    "change",
    [(2, 2, -1.0), (0, 1, 5.0)],
    ids=["negative mass", "coupling too strong"],
)
def test_mass_that_is_not_positive_definite(change):
    row, col, value = change
    M = masses(5, 4, full=False)
    M[row, col] = M[col, row] = value
    with pytest.raises(IndefiniteError):
        eigensolution(chain(5, 3), M)


def test_sparse_negative_mass_is_refused():
    K, M = frame(120)
    M[50, 50] = -1.0
    with pytest.raises(IndefiniteError):
        eigensolution(csr_array(K), csr_array(M), 6, shift=-1.0)


def test_sparse_negative_stiffness_is_not_overlooked():
    """An eigenvalue far below zero is nearer to no shift than the elastic modes are; it must be found all the same."""
    K, M = frame(120)
    K[50, 50] -= 1e7
    assert eigensolution(K, M).eigenvalues[0] < -1e6
    try:
        lowest = eigensolution(csr_array(K), csr_array(M), 6, shift=-1.0).eigenvalues[0]
    except IndefiniteError:
        return
    assert lowest < -1e6


@pytest.mark.parametrize("bodies", [2, 3, 6])
def test_sparse_model_of_several_free_bodies(bodies):
    """As many rigid-body modes as bodies: their span is one cluster, however rounding scatters their eigenvalues."""
    n = 60
    body = diags_array([np.r_[1.0, np.full(n - 2, 2.0), 1.0], -np.ones(n - 1), -np.ones(n - 1)], offsets=[0, 1, -1])
    K, M = csr_array(block_diag([(1 + 0.01 * i) * body for i in range(bodies)])), csr_array(eye_array(n * bodies))
    elements = ListedElements([False], [0], [0])
    sparse = eigensolution(K, M, count=bodies + 2)
    full = eigensolution(K.toarray(), M.toarray())
    assert not sparse.complete and len(set(clusters(sparse.eigenvalues, sparse.zero)[:bodies])) == 1
    modes, dofs = np.arange(bodies, bodies + 2), np.arange(0, n, 7)
    pattern = pattern_of(n * bodies, elements)
    one = modal_partials(sparse, K, M, modes, dofs, pattern)
    two = modal_partials(full, K.toarray(), M.toarray(), modes, dofs, pattern)
    np.testing.assert_allclose(one.d_lambda, two.d_lambda, rtol=1e-6, atol=1e-12)
    sign = np.sign(np.sum(sparse.shapes[:, modes] * full.shapes[:, modes], axis=0))
    np.testing.assert_allclose(one.d_shape, two.d_shape * sign[:, None, None], rtol=1e-5, atol=1e-8)

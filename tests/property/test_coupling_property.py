"""Random systems: Lagrange multipliers against assembled dynamic stiffness (the Schur complement's way), whatever is joined to
what."""

import numpy as np
from coupled_systems import assembled, coupling, drawn, model, receptance
from hypothesis import given, settings
from hypothesis import strategies as st

from mouse_cli.coupling import couple, interface
from mouse_cli.coupling.interface import solve
from mouse_cli.model.coupling import Connection, Point

SEEDS = st.integers(0, 2**32 - 1)
HZ = np.array([0.0, 0.13, 0.31, 0.7, 1.9])


@settings(max_examples=60, deadline=None)
@given(SEEDS, st.integers(2, 5), st.integers(1, 3))
def test_any_number_of_parts_is_the_assembled_whole(seed, count, joined):
    """B u = 0 between neighbours, B Y B' against Z = L' diag(Z_i) L by numpy, at 0 Hz too; places inside and at the interfaces."""
    rng = np.random.default_rng(seed)
    parts = [drawn(rng, f"p{k}", int(rng.integers(joined + 1, 7))) for k in range(count)]
    sizes = [part.weights.shape[0] for part in parts]
    pairs = []
    for k in range(count - 1):
        here, there = (rng.choice(sizes[j], joined, replace=False) for j in (k, k + 1))
        pairs += [((k, int(a)), (k + 1, int(b))) for a, b in zip(here, there, strict=True)]
    asked = [(0, 0), (count - 1, sizes[-1] - 1), (1, 0)]
    found = couple(coupling(parts, pairs, responses=asked, hz=HZ)).functions.H
    whole = assembled(parts, pairs, [], HZ, asked)
    np.testing.assert_allclose(found, whole, atol=1e-9 * np.abs(whole).max())


@settings(max_examples=60, deadline=None)
@given(SEEDS)
def test_the_block_formula_of_the_lecture(seed):
    """H_C for two parts with their own inside, H = [[aa, ac, 0], [ca, cc, 0], [0, 0, bb]] - {..}[H_cc^A + H_cc^B]^-1{..}."""
    rng = np.random.default_rng(seed)
    a, b = drawn(rng, "A", 5), drawn(rng, "B", 4)
    HA, HB = (receptance(part, HZ) for part in (a, b))
    pairs = [((0, 3), (1, 0)), ((0, 4), (1, 1))]
    asked = [(0, k) for k in range(5)] + [(1, 2), (1, 3)]
    found = couple(coupling([a, b], pairs, responses=asked, hz=HZ)).functions.H
    c, d, inner = [3, 4], [0, 1], [2, 3]
    for H, ha, hb in zip(found, HA, HB, strict=True):
        before = np.zeros((7, 7), complex)
        before[:5, :5], before[5:, 5:] = ha, hb[np.ix_(inner, inner)]
        column = np.vstack([ha[:, c], -hb[np.ix_(inner, d)]])
        expected = before - column @ np.linalg.inv(ha[np.ix_(c, c)] + hb[np.ix_(d, d)]) @ column.T
        np.testing.assert_allclose(H, expected, atol=1e-9 * np.abs(expected).max())


@settings(max_examples=60, deadline=None)
@given(SEEDS)
def test_connections_are_their_matrices(seed):
    """Mass, spring with losses, dashpot and absorber, at places and between parts, against the matrices with them added."""
    rng = np.random.default_rng(seed)
    parts = [drawn(rng, "A", 4), drawn(rng, "B", 3)]
    size = rng.uniform(0.1, 3.0, 8)
    connections = [
        Connection("m", Point(0, 1), mass=size[0]),
        Connection("k", Point(0, 3), Point(1, 0), stiffness=size[1], loss_factor=0.1, damping=0.2 * size[2]),
        Connection("c", Point(1, 2), damping=size[3]),
        Connection("a", Point(0, 1), mass=size[4], stiffness=size[5], damping=0.1 * size[6], hung=True),
    ]
    asked = [(0, 0), (0, 1), (1, 2)]
    found = couple(coupling(parts, [], connections, asked, hz=HZ)).functions.H
    whole = assembled(parts, [], connections, HZ, asked)
    np.testing.assert_allclose(found, whole, atol=1e-9 * np.abs(whole).max())


@settings(max_examples=60, deadline=None)
@given(SEEDS)
def test_whole_minus_part_is_the_rest(seed):
    rng = np.random.default_rng(seed)
    a, b = drawn(rng, "A", 4), drawn(rng, "B", 4)
    pairs = [((0, 2), (1, 0)), ((0, 3), (1, 1))]
    whole = coupling([a, b], pairs).substructures
    K, M, C, D = whole_matrices(whole, pairs)
    taken = coupling([model("AB", K, M, C, D), model("A", *matrices(a), removed=True)])
    joined = [((0, 2), (1, 2)), ((0, 3), (1, 3))]
    asked = [(0, 2), (0, 3), (0, 4), (0, 5)]
    found = couple(coupling(taken.substructures, joined, responses=asked, hz=HZ[1:])).functions.H
    expected = receptance(b, HZ[1:])
    np.testing.assert_allclose(found, expected, atol=1e-7 * np.abs(expected).max())


def matrices(part):
    structure = part.problem.structure
    return structure.K, structure.M, structure.C, structure.D


def whole_matrices(parts, pairs):
    """K, M, C, D of two parts whose degrees of freedom 2, 3 of A are 0, 1 of B; A's first."""
    L = np.zeros((8, 6))
    L[[0, 1, 2, 3], [0, 1, 2, 3]] = 1
    L[[4, 5, 6, 7], [2, 3, 4, 5]] = 1
    blocks = zip(*(matrices(part) for part in parts), strict=True)
    found = []
    for one, other in blocks:
        both = np.zeros((8, 8))
        both[:4, :4], both[4:, 4:] = one, other
        found.append(L.T @ both @ L)
    return found


@settings(max_examples=40, deadline=None)
@given(SEEDS, st.integers(1, 60))
def test_every_way_of_solving_the_interface_gives_the_same(seed, c):
    """LU of all lines at once, LAPACK line by line, singular values: right, transposed, and condition numbers that agree in
    size."""
    rng = np.random.default_rng(seed)
    G = rng.standard_normal((3, c, c)) + 1j * rng.standard_normal((3, c, c)) + 3 * np.sqrt(c) * np.eye(c)
    right, left = rng.standard_normal((3, c, 2)) + 0j, rng.standard_normal((3, 4, c)) + 0j
    exact = np.linalg.solve(G, right)
    ways = [
        way(G.copy(), right, left, 1e-14) for way in (interface._inverted, interface._factorised, interface._truncated)
    ]
    for forces, adjoint, condition, kept, _ in ways:
        np.testing.assert_allclose(forces, exact, atol=1e-10 * np.abs(exact).max())
        np.testing.assert_allclose(np.matmul(adjoint, G), left, atol=1e-9)
        assert (kept == c).all() and (condition >= 1 - 1e-12).all()
    np.testing.assert_allclose(ways[0][2], np.linalg.cond(G, 1), rtol=1e-8)
    assert (ways[1][2] <= 1.0001 * ways[0][2]).all() and (ways[1][2] > 0.2 * ways[0][2]).all()
    np.testing.assert_allclose(ways[2][2], np.linalg.cond(G), rtol=1e-8)


def test_units_change_no_condition_number():
    """Rows and columns in mm and rad, or in m: the scaled flexibility is the same."""
    rng = np.random.default_rng(0)
    G = rng.standard_normal((2, 4, 4)) + 5 * np.eye(4) + 0j
    unit = np.array([1.0, 1e3, 1e-3, 1e6])
    other = unit[:, None] * G * unit
    stiffness = np.full((2, 4), np.inf + 0j)
    one = solve(G.copy(), np.abs(np.einsum("fcc->fc", G)), stiffness, np.ones((2, 4, 1), complex))
    two = solve(other, np.abs(np.einsum("fcc->fc", other)), stiffness, unit[:, None] * np.ones((2, 4, 1), complex))
    np.testing.assert_allclose(two.condition, one.condition, rtol=1e-9)
    np.testing.assert_allclose(two.forces * unit[:, None], one.forces, rtol=1e-9)

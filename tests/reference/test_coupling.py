"""Coupled structures against what is known otherwise: textbook matrices of the whole, closed forms of beams, SDynPy and pyFBS."""

import numpy as np
import pytest
from coupled_decks import coupling, frame, measured, model, read, receptance

from mouse_cli._errors import DeckError, NumericalError
from mouse_cli.coupling import couple
from mouse_cli.model.coupling import Connection, Point

# A portal frame: a leg up, a beam across, a leg down; steel bar 20 x 30 mm.
E, A, I, RHO = 2.1e11, 6e-4, 4.5e-8, 7850.0
CORNERS = np.array([[0.0, 0.0], [0.0, 0.9], [1.4, 0.9], [1.4, 0.0]])
HALF = """mouse: 1
title: {title}
units: SI
model:
  structure:
    nodes: {{{nodes}}}
    materials: {{steel: {{E: 2.1e+11, nu: 0.3, density: 7850, loss_factor: 0.005}}}}
    sections: {{bar: {{A: 6.0e-4, Iz: 4.5e-8, Iy: 2.0e-8}}}}
    elements:
      - {{id: 1-{count}, type: beam, nodes: 1-{last}, material: steel, section: bar}}
    supports: {{{foot}: all}}
    plane: XY
"""
PORTAL = """mouse: 1
title: Portal frame, two halves
couple:
  substructures: {left: {deck: left.yaml}, right: {deck: right.yaml}}
  interfaces: [{left: [10TX, 10TY, 10RZ], right: [1TX, 1TY, 1RZ]}]
  responses: {left: [5TX, 10RZ], right: [4TY, 6TX]}
  forces: {left: 5TX, right: 6TX}
  lines: {band: [2, 400], step: 2}
  modes: {count: 8, keep: [4, 8, 16]}
"""


def portal() -> np.ndarray:
    """Its points: six bars to a leg, eight across."""
    legs = [np.linspace(a, b, k + 1) for a, b, k in zip(CORNERS[:-1], CORNERS[1:], (6, 8, 6), strict=True)]
    return np.vstack([legs[0], legs[1][1:], legs[2][1:]])


def half(title: str, points: np.ndarray, foot: int) -> str:
    nodes = ", ".join(f"{i}: [{x!r}, {y!r}]" for i, (x, y) in enumerate(points.tolist(), 1))
    return HALF.format(title=title, nodes=nodes, count=len(points) - 1, last=len(points), foot=foot)


@pytest.fixture(scope="module")
def halves(tmp_path_factory):
    """Answer for the two halves, and K, M, labels of the whole from textbook matrices, its feet clamped."""
    folder, points = tmp_path_factory.mktemp("portal"), portal()
    (folder / "left.yaml").write_text(half("left", points[:10], 1))
    (folder / "right.yaml").write_text(half("right", points[9:], len(points) - 9))
    K, M = frame(points, E, A, I, RHO)
    free = np.arange(3, len(K) - 3)
    return couple(read(folder, PORTAL)), K[np.ix_(free, free)], M[np.ix_(free, free)]


def at(node: int, direction: int) -> int:
    """Degree of freedom of the whole with its first node clamped."""
    return 3 * (node - 1) + direction - 3


def test_two_halves_are_the_whole_of_textbook_matrices_to_1e_9(halves):
    found, K, M = halves
    H = receptance(K, M, None, 0.005 * K, found.functions.frequency_hz)
    outputs = [at(5, 0), at(10, 2), at(9 + 4, 1), at(9 + 6, 0)]
    H = H[:, outputs][:, :, [at(5, 0), at(9 + 6, 0)]]
    assert np.abs(found.functions.H - H).max() < 1e-9 * np.abs(H).max()
    assert (np.abs(found.functions.H - H) / np.abs(H)).max() < 1e-8  # in every valley too
    assert found.interface.conditions == 3 and not found.warnings


def test_assembled_frequencies_are_those_of_textbook_matrices(halves):
    found, K, M = halves
    lam = np.linalg.eigvals(np.linalg.solve(M, K)).real
    np.testing.assert_allclose(found.modes.frequencies_hz, np.sqrt(np.sort(lam)[:8]) / (2 * np.pi), rtol=1e-8)


def test_reductions_converge_and_residuals_help(halves):
    """Ritz: Craig-Bampton and Rubin come from above, nearer with every mode; MacNeal is nearer than modes alone."""
    found, *_ = halves
    worst = {(r.method, r.keep): np.nanmax(np.abs(r.error)) for r in found.modes.reduced}
    for method in ("craig-bampton", "rubin"):
        errors = [r.error for r in found.modes.reduced if r.method == method]
        assert all((np.nan_to_num(e) > -1e-9).all() for e in errors)
        assert worst[method, 16] < 0.2 * worst[method, 8] < worst[method, 4]
    assert worst["rubin", 16] < 1e-4 and worst["craig-bampton", 16] < 2e-3
    assert worst["rubin", 16] < worst["macneal", 16] < 0.1 * worst["modal", 16]
    assert worst["modal", 16] > 0.01  # the modal truncation problem of lecture 22


def dynamic_stiffness(L: float, w: np.ndarray) -> np.ndarray:
    """Exact 4 x 4 (w, theta at both ends) of a uniform free beam (Clough and Penzien; Bishop and Johnson 1960), EI = rho A = 1."""
    b = np.sqrt(w)[:, None] * L
    s, c, S, C = np.sin(b), np.cos(b), np.sinh(b), np.cosh(b)
    scale = (b / L) ** 3 / (1 - c * C)
    l = L / b
    F = [s * C + c * S, l * s * S, -(s + S), l * (C - c), l**2 * (s * C - c * S), l**2 * (S - s)]
    a, d, e, g, h, k = (scale * f for f in F)
    rows = [[a, d, e, g], [d, h, -g, k], [e, -g, a, -d], [g, k, -d, h]]
    return np.moveaxis(np.array(rows)[..., 0], -1, 0)


def test_two_half_beams_of_closed_form_are_the_beam_of_closed_form():
    """Functions given, not models: the exact receptances of free beams of length 1.2 and 0.8 make those of a beam of length 2."""
    hz = np.linspace(0.31, 24.7, 170)
    parts = [np.linalg.inv(dynamic_stiffness(L, 2 * np.pi * hz)) for L in (1.2, 0.8, 2.0)]
    ends = [(0, 0), (0, 1), (1, 2), (1, 3)]
    joined = coupling(
        [measured("a", hz, parts[0]), measured("b", hz, parts[1])], [((0, 2), (1, 0)), ((0, 3), (1, 1))], responses=ends
    )  # fmt: skip
    found = couple(joined).functions.H
    assert np.abs(found - parts[2]).max() < 1e-9 * np.abs(parts[2]).max()


def test_a_closed_form_frequency_of_a_beam_clamped_at_both_ends(tmp_path):
    """Two clamped halves of 12 elements by Rubin's method: 4.73004, 7.85320, 10.99561 (Blevins 1979, table 8-1)."""
    points = np.column_stack([np.linspace(0, 2, 25), np.zeros(25)])
    (tmp_path / "left.yaml").write_text(half("left", points[:13], 1))
    (tmp_path / "right.yaml").write_text(half("right", points[12:], 13))
    text = (
        PORTAL.replace("10T", "13T")
        .replace("10RZ", "13RZ")
        .replace("count: 8, keep: [4, 8, 16]", "count: 3, keep: [14], methods: [rubin]")
    )
    found = couple(read(tmp_path, text)).modes
    beta = np.array([4.73004074, 7.85320462, 10.9956079])
    exact = beta**2 / 4 * np.sqrt(E * I / (RHO * A)) / (2 * np.pi)
    np.testing.assert_allclose(
        found.frequencies_hz / exact - 1, (beta / 24) ** 4 / 1440, rtol=0.1
    )  # the mesh's own error
    (rubin,) = [r for r in found.reduced if r.method == "rubin"]
    np.testing.assert_allclose(rubin.frequencies_hz, exact, rtol=1e-4)


def chain(n: int, k: np.ndarray, m: np.ndarray, ground: float) -> tuple[np.ndarray, np.ndarray]:
    K = np.zeros((n, n))
    for i in range(n - 1):
        K[i : i + 2, i : i + 2] += k[i] * np.array([[1, -1], [-1, 1]])
    K[0, 0] += ground
    return K, np.diag(m)


def two_chains():
    """Twelve masses from the ground and nine free ones, damped by C = 2e-5 K."""
    KA, MA = chain(12, 1e5 * (1 + 0.05 * np.arange(11)), 1 + 0.1 * np.arange(12), 1.2e5)
    KB, MB = chain(9, 0.8e5 * (1 + 0.03 * np.arange(8)), 0.7 + 0.05 * np.arange(9), 0.0)
    return model("A", KA, MA, 2e-5 * KA), model("B", KB, MB, 2e-5 * KB)


def test_functions_are_those_of_sdynpy_and_pyfbs():
    """SDynPy 0.23.0 (substructure_by_coordinate of functions); pyFBS 1.0.7 (tpinv in the equation of its examples) gives the
    same."""
    hz = np.array([3.0, 11.0, 20.0, 47.0])
    joined = coupling(two_chains(), [((0, 11), (1, 0))], responses=[(0, 4), (1, 8)], hz=hz)
    H = couple(joined).functions.H
    sdynpy = [0.00016008647756554292 - 1.8942941626762403e-07j, 7.881986716933427e-05 + 4.7063131016111796e-07j,
              -1.4739504455110727e-05 - 8.100386323796118e-08j, 1.2693892244776938e-05 + 3.2944823138142234e-07j]  # fmt: skip
    np.testing.assert_allclose(H[:, 0, 1], sdynpy, rtol=1e-11)
    own = [9.546339233121388e-05 - 9.086938924236234e-08j, -2.613790393828189e-05 - 2.890826013987058e-07j,
           -1.9356607858599026e-05 - 1.8105368348812488e-07j, 6.700853361805695e-07 - 7.876764662033212e-07j]  # fmt: skip
    np.testing.assert_allclose(H[:, 0, 0], own, rtol=1e-11)


def test_craig_bampton_is_that_of_sdynpy():
    """SDynPy 0.23.0: System.reduce_craig_bampton of both chains, joined on the kernel of the constraint."""
    found = couple(coupling(two_chains(), [((0, 11), (1, 0))], synthesis=(("craig-bampton",), (2, 4, 6), 6))).modes
    np.testing.assert_allclose(
        found.frequencies_hz, [3.68488826, 9.95003633, 17.21008368, 25.67795235, 30.3521631, 38.49257471], rtol=1e-8
    )
    sdynpy = {
        2: [3.6856785188398558, 9.953346519732179, 17.345715746979504, 25.76503040406122, 32.53388112544902],
        4: [
            3.6849828347319407,
            9.950419251521327,
            17.224007277285,
            25.685012635493617,
            30.417330375476563,
            38.64682620832986,
        ],
        6: [
            3.684903575828422,
            9.950097858741904,
            17.212272283729277,
            25.679018794846908,
            30.361540962612615,
            38.51199978186733,
        ],
    }
    for each in found.reduced:
        hz = sdynpy[each.keep]
        np.testing.assert_allclose(each.frequencies_hz[: len(hz)], hz, rtol=1e-9)
        assert np.isnan(each.frequencies_hz[len(hz) :]).all()


def test_modal_coupling_through_springs_is_that_of_the_lecture():
    """Lambda + Phi' K_CC Phi with 5 and 4 modes, worked out here line by line; with all modes the assembled whole."""
    a, b = two_chains()
    spring = Connection("k", Point(0, 11), Point(1, 0), stiffness=3e4)
    found = couple(coupling([a, b], connections=[spring], synthesis=(("modal",), (4, 12), 5))).modes
    import scipy.linalg

    Phi, Lam = [], []
    for part in (a, b):
        lam, X = scipy.linalg.eigh(part.problem.structure.K, part.problem.structure.M)
        Phi.append(X[:, :4])
        Lam.append(lam[:4])
    row = np.concatenate([Phi[0][11], -Phi[1][0]])
    lam = np.linalg.eigvalsh(np.diag(np.concatenate(Lam)) + 3e4 * np.outer(row, row))
    np.testing.assert_allclose(found.reduced[0].frequencies_hz, np.sqrt(lam[:5]) / (2 * np.pi), rtol=1e-9)
    np.testing.assert_allclose(found.reduced[1].error, 0, atol=1e-9)


def test_decoupling_gives_back_the_half():
    """Whole minus A is B: at the interface alone, and with an interface extended by a place inside A, where truncation is
    needed."""
    a, b = two_chains()
    hz = np.linspace(1.3, 58.1, 90)
    KA, KB = (part.problem.structure for part in (a, b))
    n = 12 + 9 - 1
    K, M = np.zeros((n, n)), np.zeros((n, n))
    for part, where in ((KA, slice(0, 12)), (KB, slice(11, 20))):
        K[where, where] += part.K
        M[where, where] += part.M
    whole = model("whole", K, M, 2e-5 * K)
    taken = model("A", KA.K, KA.M, KA.C, removed=True)
    H = receptance(KB.K, KB.M, KB.C, None, hz)[:, [0, 5, 8]][:, :, [0, 5, 8]]
    asked = [(0, 11), (0, 16), (0, 19)]
    for pairs, truncate in (
        ([((0, 11), (1, 11))], 0.0),
        ([((0, 11), (1, 11)), ((0, 9), (1, 9))], 1e-9),
        ([((0, 11), (1, 11)), ((0, 9), (1, 9)), ((0, 3), (1, 3))], 1e-9),
    ):
        found = couple(coupling([whole, taken], pairs, responses=asked, hz=hz, truncate=truncate))
        assert np.abs(found.functions.H - H).max() < 1e-8 * np.abs(H).max()
        assert (found.interface.kept == 1).all()


def test_functions_that_say_the_same_twice_are_refused_unless_truncated():
    a, b = two_chains()
    twice = [((0, 11), (1, 0)), ((0, 11), (1, 0))]
    with pytest.raises(NumericalError, match="MD714"):
        couple(coupling([a, b], twice, responses=[(0, 4)], hz=np.array([5.0])))
    once = couple(coupling([a, b], twice[:1], responses=[(0, 4)], hz=np.array([5.0]))).functions.H
    np.testing.assert_allclose(
        couple(coupling([a, b], twice, responses=[(0, 4)], hz=np.array([5.0]), truncate=1e-9)).functions.H,
        once,
        rtol=1e-10,
    )


def test_variance_is_that_of_drawn_functions():
    """Measured functions with independent complex errors, a mass and a second measured part: first order against 4000 draws."""
    hz = np.array([4.0, 13.0, 31.0])
    a, b = (part.problem.structure for part in two_chains())
    HA = receptance(a.K, a.M, a.C, None, hz)[:, [4, 11]][:, :, [4, 11]]
    HB = receptance(b.K, b.M, b.C, None, hz)[:, [0, 8]][:, :, [0, 8]]
    VA, VB = (0.004 * np.abs(HA)) ** 2, (0.01 * np.abs(HB)) ** 2
    mass = Connection("m", Point(1, 1), mass=1.5)

    def answer(one, other, va=None, vb=None):
        parts = [measured("a", hz, one, va), measured("b", hz, other, vb)]
        return couple(coupling(parts, [((0, 1), (1, 0))], [mass], [(0, 0), (1, 1)])).functions

    stated = answer(HA, HB, VA, VB)
    rng = np.random.default_rng(5)

    def noise(V):
        return np.sqrt(V / 2) * (rng.standard_normal(V.shape) + 1j * rng.standard_normal(V.shape))

    drawn = np.array([answer(HA + noise(VA), HB + noise(VB)).H for _ in range(4000)])
    spread = (np.abs(drawn - stated.H) ** 2).mean(axis=0)
    np.testing.assert_allclose(stated.variance, spread, rtol=0.12)


def test_a_function_taken_by_reciprocity_errs_with_its_twin():
    """One column measured: H_12 = H_21 stands twice in the answer, and its error counts once, coherently."""
    hz = np.array([4.0, 13.0])
    a = two_chains()[0].problem.structure
    H = receptance(a.K, a.M, a.C, None, hz)[:, [11, 4]][:, :, [11]]
    V = (0.02 * np.abs(H)) ** 2
    mass = Connection("m", Point(0, 0), mass=2.0)

    def answer(values, variance=None):
        part = measured("a", hz, values, variance)
        return couple(coupling([part], [], [mass], [(0, 1), (0, 0)], [(0, 0)])).functions

    stated = answer(H, V)
    exact = receptance(a.K, a.M + np.diag([0] * 11 + [2.0]), a.C, None, hz)[:, [4, 11]][:, :, [11]]
    np.testing.assert_allclose(stated.H, exact, rtol=1e-10)
    rng = np.random.default_rng(6)
    drawn = []
    for _ in range(4000):
        error = np.sqrt(V / 2) * (rng.standard_normal(V.shape) + 1j * rng.standard_normal(V.shape))
        drawn.append(answer(H + error).H)
    np.testing.assert_allclose(stated.variance, (np.abs(np.array(drawn) - stated.H) ** 2).mean(axis=0), rtol=0.12)


def test_what_was_not_measured_is_said():
    hz = np.array([4.0])
    a = two_chains()[0].problem.structure
    H = receptance(a.K, a.M, a.C, None, hz)[:, [11, 4]][:, :, [11]]
    with pytest.raises(NumericalError, match="MD710"):
        couple(coupling([measured("a", hz, H)], responses=[(0, 1)]))
    mass = Connection("m", Point(0, 0), mass=2.0)
    found = couple(coupling([measured("a", hz, H)], [], [mass], [(0, 0)], [(0, 0)]))
    assert found.functions.H.shape == (1, 1, 1)


def test_modes_of_measured_parts_are_refused():
    hz = np.array([4.0])
    part = measured("a", hz, np.ones((1, 1, 1)))
    with pytest.raises(DeckError, match="MD715"):
        couple(coupling([part], responses=[(0, 0)], synthesis=((), (), 3)))


def test_with_all_modes_every_reduction_is_exact():
    """Free and held parts, joined rigidly and by a spring and a mass: nothing is truncated, and residuals vanish."""
    parts, mass = two_chains(), Connection("m", Point(0, 3), mass=2.0)
    spring = Connection("k", Point(0, 7), Point(1, 5), stiffness=2e4)
    asked = (("craig-bampton", "macneal", "modal", "rubin"), (12,), 15)
    found = couple(coupling(parts, [((0, 11), (1, 0))], [mass, spring], synthesis=asked)).modes
    for each in found.reduced:
        np.testing.assert_allclose(each.error, 0, atol=1e-8, err_msg=each.method)


def test_a_large_sparse_half_by_its_basis_is_the_whole_solved_directly(tmp_path):
    """Two halves of 1200 degrees of freedom each, their functions in a basis, against sparse LU of the textbook whole at
    single lines."""
    from scipy.sparse import csc_array
    from scipy.sparse.linalg import splu

    points = np.column_stack([np.linspace(0, 2, 801), np.zeros(801)])
    (tmp_path / "left.yaml").write_text(half("left", points[:401], 1))
    (tmp_path / "right.yaml").write_text(half("right", points[400:], 401))
    text = PORTAL.replace("10T", "401T").replace("10RZ", "401RZ")
    text = text[: text.index("  modes:")].replace("band: [2, 400], step: 2", "band: [0.5, 400], step: 0.5")
    text = text.replace("left: [5TX, 401RZ], right: [4TY, 6TX]", "left: [201TY], right: [101TY]").replace(
        "left: 5TX, right: 6TX", "left: 201TY"
    )
    found = couple(read(tmp_path, text))
    assert 0 < found.interface.error < 1e-6
    K, M = (csc_array(each[3:-3, 3:-3]) for each in frame(points, E, A, I, RHO))
    dofs = [3 * 200 + 1 - 3, 3 * 500 + 1 - 3]
    for line in (0, 63, 210, 477, 799):
        s2 = (2 * np.pi * found.functions.frequency_hz[line]) ** 2
        load = np.zeros(K.shape[0], complex)
        load[dofs[0]] = 1.0
        exact = splu(csc_array(K * (1 + 0.005j) - s2 * M)).solve(load)[dofs]
        np.testing.assert_allclose(found.functions.H[line, :, 0], exact, rtol=1e-5)


UNCERTAIN = """mouse: 1
title: Chain {name}
model:
  stiffness: {{dense: [[{k11}, -1000.0], [-1000.0, 1000.0]]}}
  mass: {{diagonal: [2.0, 1.0]}}
  damping: {{dense: [[3.0, 0.0], [0.0, 1.0]]}}
parameters:
  - {{name: k1, nominal: {k1}, sd: 4.0, stiffness: [[1, 1, 1]]}}
  - {{name: k2, nominal: 1000.0, sd: 3.0, stiffness: [[1, 1, 1], [1, 2, -1], [2, 2, 1]]}}
prior: {{correlations: [[k1, k2, 0.6]]}}
"""


def test_uncertain_properties_of_models_are_carried_to_the_whole(tmp_path):
    """Two chains with correlated springs joined, one taken through a spring to a third place: against 4000 drawn wholes, by
    numpy."""
    (tmp_path / "a.yaml").write_text(UNCERTAIN.format(name="a", k11=3000.0, k1=2000.0))
    (tmp_path / "b.yaml").write_text(UNCERTAIN.format(name="b", k11=1700.0, k1=700.0))
    text = """mouse: 1
couple:
  substructures: {a: {deck: a.yaml}, b: {deck: b.yaml}}
  interfaces: [{a: 2, b: 1}]
  connections: [{spring: 300.0, at: {a: 1}, to: {b: 2}}]
  responses: {a: [1], b: [2]}
  forces: {a: [2]}
  lines: {band: [1, 9], step: 1.6}
"""
    found = couple(read(tmp_path, text)).functions
    s = 2j * np.pi * found.frequency_hz[:, None, None]
    cov = np.array([[16.0, 7.2], [7.2, 9.0]])
    rng = np.random.default_rng(8)
    draws = [rng.multivariate_normal([k1, 1000.0], cov, 4000) for k1 in (2000.0, 700.0)]
    L = np.array([[1.0, 0, 0], [0, 1, 0], [0, 1, 0], [0, 0, 1]])
    drawn = []
    for (a1, a2), (b1, b2) in zip(*draws, strict=True):
        K = np.zeros((4, 4))
        K[:2, :2], K[2:, 2:] = [[a1 + a2, -a2], [-a2, a2]], [[b1 + b2, -b2], [-b2, b2]]
        K += 300.0 * np.outer([1, 0, 0, -1], [1, 0, 0, -1])
        Z = K + s * np.diag([3.0, 1, 3, 1]) + s**2 * np.diag([2.0, 1, 2, 1])
        drawn.append(np.linalg.inv(L.T @ Z @ L)[:, [0, 2]][:, :, [1]])
    np.testing.assert_allclose(found.variance, np.var(drawn, axis=0), rtol=0.1)

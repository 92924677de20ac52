"""Beams against closed forms: frequencies, buckling, foundations, orders of convergence, static patches."""

import mpmath
import numpy as np
import pytest
from element_meshes import BAR, STEEL, XY, beam_line, elements, hertz, matrices, mesh, pairs

from mouse_cli.dynamics.solver import eigensolution

EI, MU = STEEL["E"] * BAR["Iz"], STEEL["density"] * BAR["A"]
CLAMPED, PINNED = XY, (0, 1)

# Roots of the frequency equations (Blevins 1979, Table 8-1), to 20 digits by mpmath.
_EQUATIONS = {
    "clamped-free": (lambda x: mpmath.cos(x) * mpmath.cosh(x) + 1, (1.9, 4.7, 7.9)),
    "clamped-pinned": (lambda x: mpmath.tan(x) - mpmath.tanh(x), (3.93, 7.07, 10.2)),
    "clamped-clamped": (lambda x: mpmath.cos(x) * mpmath.cosh(x) - 1, (4.73, 7.85, 11.0)),
    "pinned-pinned": (mpmath.sin, (3.14, 6.28, 9.42)),
}
_SUPPORTS = {
    "clamped-free": lambda n: [(0, CLAMPED)],
    "clamped-pinned": lambda n: [(0, CLAMPED), (n, PINNED)],
    "clamped-clamped": lambda n: [(0, CLAMPED), (n, CLAMPED)],
    "pinned-pinned": lambda n: [(0, PINNED), (n, PINNED)],
}


def roots(ends: str) -> np.ndarray:
    """beta L of the first modes."""
    equation, starts = _EQUATIONS[ends]
    return np.array([float(mpmath.findroot(equation, x)) for x in starts])


def bending(beta_l: np.ndarray, length: float = 1.0) -> np.ndarray:
    """Frequencies in Hz after Euler and Bernoulli."""
    return beta_l**2 / length**2 * np.sqrt(EI / MU) / (2 * np.pi)


@pytest.mark.parametrize("ends", _EQUATIONS)
def test_euler_bernoulli_frequencies(ends):
    """Too high by the error of a mesh of cubic beams, (beta h)^4/1440 (Belytschko and Mindell 1980), and by nothing else."""
    exact = roots(ends)
    found = hertz(beam_line(24, supports=_SUPPORTS[ends](24)))[:3] / bending(exact)
    assert found - 1 == pytest.approx((exact / 24) ** 4 / 1440, rel=0.03, abs=1e-9)


def test_free_free_beam_has_three_rigid_modes_in_its_plane():
    K, M = matrices(beam_line(24))
    solution = eigensolution(K, M)
    assert np.abs(solution.eigenvalues[:3]).max() < 1e-7 * solution.eigenvalues[3]
    assert solution.frequencies_hz[3:6] == pytest.approx(bending(roots("clamped-clamped")), rel=4e-5)


@pytest.mark.parametrize(("options", "order"), [({}, 4.0), ({"mass": "lumped"}, 2.0)])
def test_order_of_convergence(options, order):
    """Consistent mass: error ~ h^4, from above; diagonal mass with turning half-bars: h^2, from below (Felippa 2013)."""
    exact = bending(roots("clamped-free"))[1]
    errors = [hertz(beam_line(n, supports=[(0, CLAMPED)], options=options))[1] / exact - 1 for n in (8, 16)]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.1)
    assert np.sign(errors).tolist() == [1.0, 1.0] if order == 4 else [-1.0, -1.0]


@pytest.mark.parametrize("mode", [1, 2, 3, 4])
def test_timoshenko_pinned_pinned_frequencies(mode):
    """Both roots of w^4 (rho^2 I/(k G)) - w^2 (rho A + rho I b^2 (1 + E/(k G))) + E I b^4 = 0, b = mode pi/L (Timoshenko 1921)."""
    length, kappa = 0.2, 5 / 6
    E, rho, A, I = STEEL["E"], STEEL["density"], BAR["A"], BAR["Iz"]
    G = E / 2.6
    b = mode * np.pi / length
    square = rho**2 * I / (kappa * G)
    linear = rho * A + rho * I * b**2 * (1 + E / (kappa * G))
    lowest = (linear - np.sqrt(linear**2 - 4 * square * E * I * b**4)) / (2 * square)
    coarse, fine = (_across(n, length)[mode - 1] for n in (40, 80))
    limit = fine + (fine - coarse) / 3  # Richardson, errors ~ h^2
    assert limit == pytest.approx(np.sqrt(lowest) / (2 * np.pi), rel=3e-6)
    assert limit < bending(np.array(mode * np.pi), length) * 0.999


@pytest.mark.parametrize("across", ["Y", "Z"])
def test_a_deep_cantilever_converges_as_a_slender_one(across):
    """Huang's frequency equation (J. Appl. Mech. 28, 1961), L/h = 10: by static shapes mode 5 is 3.7 % too high."""
    length, h = 0.2, 0.02
    A, I, E = 0.01 * h, 0.01 * h**3 / 12, STEEL["E"]
    r2, s2 = I / (A * length**2), E * I / (5 / 6 * E / 2.6 * A * length**2)

    def equation(b):
        root = mpmath.sqrt((r2 - s2) ** 2 + 4 / b**2)
        slow, fast = (mpmath.sqrt((root + sense * (r2 + s2)) / 2) for sense in (-1, 1))
        first = (b**2 * (r2 - s2) ** 2 + 2) * mpmath.cosh(b * slow) * mpmath.cos(b * fast)
        rest = b * (r2 + s2) / mpmath.sqrt(1 - b**2 * r2 * s2) * mpmath.sinh(b * slow) * mpmath.sin(b * fast)
        return float((2 + first - rest).real)

    grid = np.linspace(1.0, 140.0, 2000)
    values = np.array([equation(b) for b in grid])
    at = np.flatnonzero(values[:-1] * values[1:] < 0)[:5]
    exact = np.array([float(mpmath.findroot(equation, tuple(grid[i : i + 2]), solver="anderson")) for i in at])
    hz = exact * np.sqrt(E * I / (STEEL["density"] * A)) / length**2 / (2 * np.pi)
    free = XY if across == "Y" else (0, 2, 4)
    section = {"A": A, "Iy": I, "Iz": I, "J": I}
    points = np.zeros((9, 3))
    points[:, 0] = np.linspace(0, length, 9)
    line = mesh(
        points,
        [elements("beam", pairs(8), options={"theory": "timoshenko"}, **STEEL, **section)],
        [(0, free)],
        directions=free,
    )
    found = hertz(line)
    bending = found[np.abs(found[:, None] / hz - 1).argmin(axis=0)]
    assert np.abs(bending / hz - 1).max() < 5e-3


@pytest.mark.parametrize("rotary", ["included", "omitted"])
def test_the_mass_of_deep_elements_is_positive_and_moves_as_a_rigid_body(rotary):
    """Of elements from a hundredth of their height to a hundred times that."""
    for l in np.logspace(-4, 0, 13):
        line = beam_line(
            1, l, options={"theory": "timoshenko", "rotary_inertia": rotary}, **{"Iz": 0.01**4 / 12, "A": 1e-4}
        )
        _, M = matrices(line)
        scale = 1 / np.sqrt(np.diag(M))
        assert np.linalg.eigvalsh(M * scale[:, None] * scale)[0] > (1e-4 if rotary == "included" else 0)
        turning = np.zeros(len(M))
        turning[[1, 2, 4, 5]] = -l / 2, 1.0, l / 2, 1.0
        own = STEEL["density"] * (1e-4 * l**3 / 12 + (0.01**4 / 12 * l if rotary == "included" else 0.0))
        assert turning @ M @ turning == pytest.approx(own, rel=1e-9)


def _across(n: int, length: float) -> np.ndarray:
    """Bending frequencies of a pinned beam of n elements after Timoshenko."""
    held = [(i, (0,)) for i in range(n + 1)]
    return hertz(beam_line(n, length, [*held, (0, (1,)), (n, (1,))], {"theory": "timoshenko"}))


def test_rod_frequencies():
    """Fixed-free: (2 i - 1)/(4 L) sqrt(E/rho); a rod of n elements: Rayleigh's exact discrete value."""
    n, length = 40, 2.0
    points = np.zeros((n + 1, 3))
    points[:, 1] = np.linspace(0, length, n + 1)
    found = hertz(
        mesh(points, [elements("rod", pairs(n), E=STEEL["E"], density=STEEL["density"], A=1e-4)], [(0, range(6))])
    )
    speed = np.sqrt(STEEL["E"] / STEEL["density"])
    angle = (2 * np.arange(1, 4) - 1) * np.pi / (4 * n)  # of the wave across one element, halved
    discrete = np.sqrt(6 * (1 - np.cos(2 * angle)) / (2 + np.cos(2 * angle))) * speed * n / length / (2 * np.pi)
    assert found[:3] == pytest.approx(discrete, rel=1e-9)
    assert found[0] == pytest.approx(speed / (4 * length), rel=1e-4)


@pytest.mark.parametrize(("ends", "factor"), [("pinned-pinned", 1.0), ("clamped-free", 0.25), ("clamped-clamped", 4.0)])
@pytest.mark.parametrize("share", [0.5, 0.9])
def test_compression_lowers_frequencies_to_zero_at_the_buckling_load(ends, factor, share):
    """P_cr = factor pi^2 E I/L^2 (Euler); for pinned ends w^2 falls as 1 - P/P_cr exactly."""
    supports = {**_SUPPORTS, "clamped-clamped": lambda n: [(0, CLAMPED), (n, (1, 5))]}[ends](16)
    critical = factor * np.pi**2 * EI
    K, _ = matrices(beam_line(16, supports=supports, preload=-critical * share))
    assert np.linalg.eigvalsh(K).min() > 0
    K, _ = matrices(beam_line(16, supports=supports, preload=-critical * 1.0005))
    assert np.linalg.eigvalsh(K).min() < 0
    if ends == "pinned-pinned":
        loaded, free = (hertz(beam_line(16, supports=supports, preload=p))[0] for p in (-critical * share, 0.0))
        assert (loaded / free) ** 2 == pytest.approx(1 - share, rel=1e-3)


def test_string():
    """Rods under tension alone: i/(2 L) sqrt(T/mu) across, as n grows (Rayleigh)."""
    n, T, length = 60, 500.0, 1.5
    points = np.zeros((n + 1, 3))
    points[:, 0] = np.linspace(0, length, n + 1)
    string = elements("rod", pairs(n), E=1e11, density=7800.0, A=1e-6, preload=T)
    found = hertz(mesh(points, [string], [(0, range(6)), (n, range(6))]))
    assert found[:4:2] == pytest.approx(np.array([1, 2]) / (2 * length) * np.sqrt(T / 7.8e-3), rel=1e-3)


def test_elastic_foundation_raises_every_eigenvalue_alike():
    """w_i^2 = (E I beta_i^4 + k)/mu, for any ends (Winkler)."""
    n, k = 20, 3e5
    plain = beam_line(n, supports=[(0, CLAMPED)])
    bed = elements("foundation", pairs(n), 101, ky=k)
    K, M = matrices(mesh(plain.coordinates, [*plain.elements, bed], [(0, CLAMPED)], directions=XY))
    K0, M0 = matrices(plain)
    expected = np.sort((2 * np.pi * hertz(plain)[:3]) ** 2) + k / MU
    assert eigensolution(K, M).eigenvalues[:3] == pytest.approx(expected, rel=1e-7)
    assert np.array_equal(M, M0)
    assert not np.array_equal(K, K0)


def test_generic_element_has_euler_bernoulli_and_timoshenko_as_special_cases():
    """Lecture 21-1: k_ww = 12/(1 + g), k_thth = (4 + g)/(1 + g), in units of E I; that is s = 1, a = 1/(1 + g)."""
    g = 12 * EI / (5 / 6 * STEEL["E"] / 2.6 * BAR["A"] * 0.25**2)
    supports = [(0, CLAMPED)]
    euler, _ = matrices(beam_line(4, supports=supports))
    timoshenko, _ = matrices(beam_line(4, supports=supports, options={"theory": "timoshenko"}))
    generic, M = matrices(beam_line(4, supports=supports, options={"theory": "generic"}))
    assert np.allclose(generic, euler, rtol=1e-13, atol=1e-6)
    assert np.allclose(M, matrices(beam_line(4, supports=supports))[1], rtol=1e-12, atol=1e-15)
    generic, _ = matrices(beam_line(4, supports=supports, options={"theory": "generic"}, antisymmetric_z=1 / (1 + g)))
    assert np.allclose(generic, timoshenko, rtol=1e-13, atol=1e-6)


def test_generic_element_in_the_terms_of_the_lecture():
    """One element: K = E I/l^3 [k_ww, k_ww/2 l; k_thth l^2], with k_ww = 12 a and k_thth = s + 3 a; asymmetry adds c."""
    s, a, c = 0.7, 0.4, 0.1
    given = beam_line(1, options={"theory": "generic"}, symmetric_z=s, antisymmetric_z=a, coupling_z=c)
    K = matrices(given)[0] / EI
    w1, t1, w2, t2 = 1, 2, 4, 5
    assert K[w1, w1] == pytest.approx(12 * a)
    assert K[w1, t1] + K[w1, t2] == pytest.approx(12 * a)
    assert K[t1, t1] + K[t2, t2] == pytest.approx(2 * (s + 3 * a))
    assert K[t2, t2] - K[t1, t1] == pytest.approx(2 * np.sqrt(12) * c)
    assert np.linalg.eigvalsh(K[np.ix_([w1, t1, w2, t2], [w1, t1, w2, t2])])[:2] == pytest.approx([0, 0], abs=1e-12)


@pytest.mark.parametrize("theory", ["euler-bernoulli", "timoshenko"])
def test_tip_load_and_tip_moment_of_a_cantilever_are_exact(theory):
    """v = F L^3/(3 E I) + F L/(kappa G A), slope F L^2/(2 E I); M L^2/(2 E I) and M L/(E I) without shear."""
    L, F = 0.5, 10.0
    K, _ = matrices(beam_line(3, L, [(0, CLAMPED)], {"theory": theory}))
    shear = L / (5 / 6 * STEEL["E"] / 2.6 * BAR["A"]) if theory == "timoshenko" else 0.0
    load = np.zeros((len(K), 2))
    load[-2, 0], load[-1, 1] = F, F
    force, moment = np.linalg.solve(K, load).T
    assert force[-2:] == pytest.approx([F * (L**3 / (3 * EI) + shear), F * L**2 / (2 * EI)], rel=1e-9)
    assert moment[-2:] == pytest.approx([F * L**2 / (2 * EI), F * L / EI], rel=1e-9)


@pytest.mark.parametrize("ratio", [0.0001, 0.25, 1.0, 10.0])
def test_portal_frame(ratio):
    """Lateral stiffness 24 E Ic/h^3 (12 r + 1)/(12 r + 4), r = Ib/(4 Ic), span 2 h, no axial strain (Chopra, Eq. 1.3.5)."""
    h, Ic = 3.0, 1e-5
    points = np.array([[0, 0, 0], [0, h, 0], [2 * h, h, 0], [2 * h, 0, 0]])
    stiff = {"E": STEEL["E"], "A": 1e3}
    sets = [
        elements("beam", [[0, 1], [3, 2]], **stiff, Iz=Ic),
        elements("beam", [[1, 2]], 3, **stiff, Iz=4 * ratio * Ic),
    ]
    K, _ = matrices(mesh(points, sets, [(0, CLAMPED), (3, CLAMPED)], directions=XY))
    push = np.array([0.5, 0, 0, 0.5, 0, 0])
    exact = 24 * STEEL["E"] * Ic / h**3 * (12 * ratio + 1) / (12 * ratio + 4)
    assert 1 / (push @ np.linalg.solve(K, push)) == pytest.approx(exact, rel=1e-6)


def test_patch_of_unequal_skew_beams_carries_constant_axial_force_curvature_and_twist():
    """Displacements of constant strain, curvature in both planes and twist are in equilibrium at all inner nodes."""
    rng = np.random.default_rng(3)
    x = rng.normal(size=3)
    x = x / np.linalg.norm(x)
    y = np.cross([0, 0, 1], x)
    y /= np.linalg.norm(y)
    z = np.cross(x, y)
    s = np.array([0.0, 0.2, 0.55, 0.7, 1.2])
    given = mesh(s[:, None] * x, [elements("beam", pairs(4), options={"theory": "timoshenko"}, **STEEL, **BAR)])
    K, _ = matrices(given)
    fields = [
        (s[:, None] * x, 0 * s[:, None] * x),
        (s[:, None] ** 2 / 2 * y, s[:, None] * z),
        (s[:, None] ** 2 / 2 * z, -s[:, None] * y),
        (0 * s[:, None] * x, s[:, None] * x),
    ]
    for u, turn in fields:
        forces = K @ np.hstack([u, turn]).ravel()
        assert np.abs(forces[6:-6]).max() < 1e-9 * np.abs(forces).max()
        assert np.abs(forces).max() > 1.0


def test_release_is_a_hinge():
    """A beam clamped at both ends, hinged at one by a release: F L^3/(3 E I) at the hinged end carried by shear alone."""
    one = beam_line(1, 0.8, [(0, CLAMPED), (1, (0, 5))], {"releases": {2: ["RZ"]}})
    K, _ = matrices(one)
    assert K.shape == (1, 1)
    assert K[0, 0] == pytest.approx(3 * EI / 0.8**3, rel=1e-12)


def test_release_of_one_beam_is_the_pinned_end_of_the_other():
    """Clamped-pinned frequencies from clamped ends with a release."""
    n = 16
    plain = beam_line(n)
    properties = {**STEEL, **BAR}
    sets = [
        elements("beam", pairs(n - 1), **properties),
        elements("beam", pairs(1, n - 1), n, {"releases": {2: ["RZ"]}}, **properties),
    ]
    found = hertz(mesh(plain.coordinates, sets, [(0, CLAMPED), (n, CLAMPED)], directions=XY))
    assert found[:3] == pytest.approx(bending(roots("clamped-pinned")), rel=2e-4)


@pytest.mark.parametrize("share", [0.0, 0.31, 0.5, 1.0])
def test_inertia_of_a_bar_that_is_kinked_or_parted_by_quadrature(share):
    from mouse_cli.terms.elements import _beam

    l = mpmath.mpf("0.7")
    a = share * l
    N = [
        lambda x: 1 - 3 * (x / l) ** 2 + 2 * (x / l) ** 3,
        lambda x: x * (1 - x / l) ** 2,
        lambda x: 3 * (x / l) ** 2 - 2 * (x / l) ** 3,
        lambda x: x * (x / l) * (x / l - 1),
    ]
    psi = lambda x: max(x - a, 0) - (l - a) * N[2](x) - N[3](x)
    chi = lambda x: (x > a) - x / l
    integral = lambda f: float(mpmath.quad(f, [0, a]) + mpmath.quad(f, [a, l]))
    across, own = _beam.kinked(0.7, share)
    np.testing.assert_allclose(across, [integral(lambda x, n=n: n(x) * psi(x)) for n in N], atol=1e-15)
    np.testing.assert_allclose(own, integral(lambda x: psi(x) ** 2), atol=1e-15)
    along, parting = _beam.parted(0.7, share)
    linear = (lambda x: 1 - x / l, lambda x: x / l)
    np.testing.assert_allclose(along, [integral(lambda x, n=n: n(x) * chi(x)) for n in linear], atol=1e-15)
    np.testing.assert_allclose(parting, integral(lambda x: chi(x) ** 2), atol=1e-15)

"""The physics of the candidates, against closed forms: uniform bars cut into pieces, each with its exact solution."""

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.optimize import brentq

from mouse_cli.diagnosis.effects.fracture import factors
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble

ELEMENTS = 40
CLAMPED, PINNED = "{1: all}", "{1: [TX, TY], 41: [TY]}"
DECK = """\
mouse: 1
model:
  structure:
    nodes: {line: {from: 1, to: 41, start: [0, 0, 0], end: [1, 0, 0]}}
    elements:
      - {id: 1-40, type: beam, nodes: 1-41, E: 1, G: %(G)s, density: 1, A: 1, Iz: %(Iz)s, Iy: %(Iy)s, J: %(J)s}
    supports: %(supports)s
    %(plane)s
parameters:
  - {name: E, elements: 1-40, property: E, sd: 3 %%}
test:
  modes: {number: [1, 2, 3, 4], frequency: [1, 2, 3, 4], frequency_sd: 1 %%}
"""


def model(supports: str = CLAMPED, Iz: float = 1.0, plane: str = "plane: XY", first: int = 1, **more: float):
    """A bar of length 1 whose E A = mass per length = 1; first: number of the lowest mode that is measured."""
    values = {"G": 1.0, "Iy": 1.0, "J": 1.0} | more
    deck = DECK % {"supports": supports, "Iz": Iz, "plane": plane, **values}
    deck = deck.replace("number: [1, 2, 3, 4]", f"number: {[first + i for i in range(4)]}")
    problem = assemble(yaml_deck.read(deck, "bar.yaml"))
    return reduced(problem, problem.prior.mean)


def eigenvalues(found, key: str, values, says: str = "") -> np.ndarray | None:
    """All eigenvalues with candidate `key` at `values`, in the first of its recipes whose place `says` so; None: not physical."""
    recipes = registry()[key].recipes(found, registry()[key])
    fitting = (each for each in recipes if len(each.unknowns) == len(values))
    recipe = next(each for each in fitting if says in each.site(np.array(values, float)).text)
    point = Model(found, (recipe,)).point(np.append(found.z, recipe.coordinates(np.array(values, float))))
    return point and point.eigenvalues


def bending_of(found, key: str, values, says: str = "", count: int = 3) -> np.ndarray:
    """The lowest eigenvalues: bending, far below the axial motions of the same bar."""
    return eigenvalues(found, key, values, says)[:count]


class Bar:
    """Pieces (length, EI, mass per length) one after another; joints between them: (hinge flexibility, force per deflection).

    Determinant of the exact solutions w = a cos kx + b sin kx + c cosh kx + d sinh kx of the pieces, zero at the natural
    frequencies; a force may depend on the square of the frequency. root: (stiffness against motion, against turning), inf: held.
    """

    def __init__(self, pieces, joints=(), root=(np.inf, np.inf), tip=lambda lam: 0.0):
        self.pieces, self.joints, self.root, self.tip = pieces, list(joints), root, tip

    @staticmethod
    def _at(x: float, lam: float, EI: float, m: float) -> np.ndarray:
        """w, w', M, V (4, 4 coefficients) at x."""
        k = (lam * m / EI) ** 0.25
        c, s, C, S = np.cos(k * x), np.sin(k * x), np.cosh(k * x), np.sinh(k * x)
        return np.array(
            [
                [c, s, C, S],
                [-k * s, k * c, k * S, k * C],
                *(EI * k**2 * np.array([[-c, -s, C, S], [k * s, -k * c, k * S, k * C]])),
            ]
        )

    def determinant(self, lam: float) -> float:
        first = self._at(0.0, lam, *self.pieces[0][1:])
        rows = [
            first[0] if np.isinf(self.root[0]) else first[3] + self.root[0] * first[0],
            first[1] if np.isinf(self.root[1]) else first[2] - self.root[1] * first[1],
        ]
        total = 4 * len(self.pieces)
        matrix = [np.concatenate([row, np.zeros(total - 4)]) for row in rows]
        for i, (hinge, force) in enumerate(self.joints):
            left = self._at(self.pieces[i][0], lam, *self.pieces[i][1:])
            right = self._at(0.0, lam, *self.pieces[i + 1][1:])
            back = [left[0], left[1] + hinge * left[2], left[2], left[3] - force(lam) * left[0]]
            for one, other in zip(back, right, strict=True):
                row = np.zeros(total)
                row[4 * i : 4 * i + 4], row[4 * i + 4 : 4 * i + 8] = one, -other
                matrix.append(row)
        last = self._at(self.pieces[-1][0], lam, *self.pieces[-1][1:])
        for row in (last[2], last[3] - self.tip(lam) * last[0]):
            matrix.append(np.concatenate([np.zeros(total - 4), row]))
        matrix = np.array(matrix)
        return float(np.linalg.det(matrix / np.abs(matrix).max(axis=1, keepdims=True)))

    def eigenvalues(self, upto: float, count: int = 3) -> np.ndarray:
        roots = np.linspace(0.3, upto, 4000)
        values = [self.determinant(b**4 * self.pieces[0][1]) for b in roots]
        found = [
            brentq(lambda b: self.determinant(b**4 * self.pieces[0][1]), a, b, xtol=1e-13)
            for a, b, u, v in zip(roots, roots[1:], values, values[1:], strict=False)
            if u * v < 0
        ]
        return np.array(found[:count]) ** 4 * self.pieces[0][1]


EI = 1e-4  # bending far below the axial motions of the same bar
WHOLE = [(1.0, EI, 1.0)]


def free_joint(lam):
    return 0.0


def test_the_reference_itself_is_the_clamped_bar():
    roots = [1.875104068711961, 4.694091132974175, 7.854757438237613]  # Blevins 1979, table 8-1
    assert Bar(WHOLE).eigenvalues(9) == pytest.approx(EI * np.array(roots) ** 4, rel=1e-9)


@pytest.mark.parametrize("mass", [0.05, 0.5])
def test_mass_at_the_end_of_a_cantilever(mass):
    found = bending_of(model(Iz=EI), "mass", [mass, 1.0])
    assert found == pytest.approx(Bar(WHOLE, tip=lambda lam: -mass * lam).eigenvalues(9), rel=1e-4)


def test_spring_to_the_ground_within_an_element():
    k, at = 50 * EI, 0.6125
    expected = Bar([(at, EI, 1.0), (1 - at, EI, 1.0)], [(0.0, lambda lam: k)]).eigenvalues(9)
    assert bending_of(model(Iz=EI), "ground-spring", [k, at], "TY") == pytest.approx(expected, rel=1e-4)


def test_oscillator_at_the_end_of_a_cantilever():
    m, lam = 0.05, 30.0 * EI
    bar = Bar(WHOLE, tip=lambda w2: -m * lam * w2 / (lam - w2))
    found = bending_of(model(Iz=EI), "oscillator", [m, np.sqrt(lam) / (2 * np.pi), 1.0], "TY", count=4)
    exact = [root for root in bar.eigenvalues(9, 6) if abs(root / lam - 1) > 1e-6]  # a pole is no root
    assert found == pytest.approx(exact[:4], rel=1e-4)


def test_elastic_foundation_lifts_every_eigenvalue_alike():
    k = 300 * EI
    assert bending_of(model(Iz=EI), "foundation", [k]) == pytest.approx(Bar(WHOLE).eigenvalues(9) + k, rel=1e-4)


def on_a_bed(k: float, first: float, last: float) -> np.ndarray:
    """Ritz of a cantilever with x^2 ... x^14 on a bed of k between two places."""
    nodes, weights = np.polynomial.legendre.leggauss(30)
    square = np.polynomial.Polynomial([0, 0, 1]).convert(kind=np.polynomial.Legendre, domain=[0, 1])
    basis = [np.polynomial.Legendre.basis(i, domain=[0, 1]) * square for i in range(13)]

    def integral(a: float, b: float, order: int) -> np.ndarray:
        u = np.array([p.deriv(order)(a + (b - a) * (nodes + 1) / 2) for p in basis])
        return (u * weights * (b - a) / 2) @ u.T

    K = EI * integral(0, 1, 2) + k * integral(first, last, 0)
    return eigh(K, integral(0, 1, 0), eigvals_only=True)[:3]


@pytest.mark.parametrize(
    ("says", "ends"), [("element 1 towards", (0.0, 0.4625)), ("element 40 towards", (0.5375, 1.0))]
)
def test_a_bed_from_an_end_on_against_polynomials(says, ends):
    """Its edge within an element; the deck that is written has the same modes."""
    found, values = model(Iz=EI), np.array([0.02, 0.4625])
    expected = on_a_bed(values[0], *ends)
    assert bending_of(found, "foundation", values, says) == pytest.approx(expected, rel=1e-4)
    made = registry()["foundation"].recipes(found, registry()["foundation"])
    recipe = next(each for each in made if len(each.unknowns) == 2 and says in each.site(values).text)
    deck = recipe.extend(found.problem, values)
    assert reduced(deck, deck.prior.mean).eigenvalues[:3] == pytest.approx(expected, rel=1e-4)
    assert np.exp([each.log_prior for each in made]).sum() == pytest.approx(1)


@pytest.mark.parametrize(("key", "sign"), [("tension", 1), ("compression", -1)])
def test_axial_force_in_a_bar_on_two_bearings(key, sign):
    T, q = 5.0 * EI, np.pi * np.arange(1, 4)
    assert bending_of(model(PINNED, EI), key, [T]) == pytest.approx(EI * q**4 + sign * T * q**2, rel=1e-4)


@pytest.mark.parametrize(("supports", "first", "critical"), [(PINNED, 2, np.pi**2 * EI), ("{1-41: [TX]}", 3, 0.0)])
def test_a_push_that_buckles_is_no_model(supports, first, critical):
    """Though none of the measured modes buckles: on two bearings the first does so at pi^2 EI / L^2; a free bar turns at once."""
    found = model(supports, EI, first=first)
    assert eigenvalues(found, "compression", [critical + 0.1 * EI]) is None
    if critical:
        expected = EI * np.pi**4 - 0.99 * critical * np.pi**2
        assert bending_of(found, "compression", [0.99 * critical])[0] == pytest.approx(expected, rel=0.01)
    assert eigenvalues(found, "tension", [EI]) is not None


@pytest.mark.parametrize("k", [3.0, 100.0])
def test_clamp_that_turns_and_clamp_that_shifts(k):
    turning = bending_of(model(Iz=EI), "support-rotation", [k * EI])
    assert turning == pytest.approx(Bar(WHOLE, root=(np.inf, k * EI)).eigenvalues(9), rel=1e-4)
    shifting = bending_of(model(Iz=EI), "support-translation", [k * EI], "TY")
    assert shifting == pytest.approx(Bar(WHOLE, root=(k * EI, np.inf)).eigenvalues(9), rel=1e-4)


def test_hinge_of_a_crack_within_an_element():
    found = model(Iz=EI)
    height, nu, at, depth = np.sqrt(12 * EI), 0.3, 0.3125, 0.4
    c = 6 * (1 - nu**2) * height * factors(depth).turning / EI
    pieces = [(at, EI, 1.0), (1 - at, EI, 1.0)]
    expected = Bar(pieces, [(c, free_joint)]).eigenvalues(9)
    assert bending_of(found, "crack", [depth, at]) == pytest.approx(expected, rel=2e-3)  # which gives way in shear, too


@pytest.mark.parametrize("supports", ["{1: [TY, RZ]}", "{1: [TY], 41: [TY]}"])
def test_a_crack_opens_where_the_model_has_no_axial_motion(supports):
    """The same hinge, and the deck that is written has the same modes; short elements held it shut."""
    found = model(supports, Iz=EI, plane="directions: [TY, RZ]")
    height, nu, at, depth = np.sqrt(12 * EI), 0.3, 0.3125, 0.4
    c = 6 * (1 - nu**2) * height * factors(depth).turning / EI
    pinned = {} if "RZ" in supports else {"root": (np.inf, 0.0), "tip": lambda lam: 1e9}
    expected = Bar([(at, EI, 1.0), (1 - at, EI, 1.0)], [(c, free_joint)], **pinned).eigenvalues(10)
    cracked = eigenvalues(found, "crack", [depth, at])
    assert cracked[:3] == pytest.approx(expected, rel=2e-3)
    deck = registry()["crack"].recipes(found, registry()["crack"])[0].extend(found.problem, np.array([depth, at]))
    assert reduced(deck, deck.prior.mean).eigenvalues[:3] == pytest.approx(cracked[:3], rel=1e-3)


@pytest.mark.parametrize("depth", [0.1, 0.2, 0.3, 0.4, 0.5])
def test_compliance_of_a_crack_in_bending(depth):
    """Chondros, Dimarogonas and Yao, J. Sound Vib. 215 (1998), Eq. (25): 6 pi (1 - nu^2) h Phi / EI."""
    powers = [0.6272, -1.04533, 4.5948, -9.9736, 20.2948, -33.0351, 47.1063, -40.7556, 19.6]
    phi = sum(c * depth ** (i + 2) for i, c in enumerate(powers))
    assert factors(depth).turning == pytest.approx(np.pi * phi, rel=0.03)


def test_stretch_that_is_softer_with_ends_inside_elements():
    d, width, at = 0.8, 0.2, 0.4625
    a, b = at - width / 2, at + width / 2
    pieces = [(a, EI, 1.0), (width, EI / (1 + d), 1.0), (1 - b, EI, 1.0)]
    expected = Bar(pieces, [(0.0, free_joint)] * 2).eigenvalues(9)
    assert bending_of(model(Iz=EI), "stiffness-loss", [d, width, at]) == pytest.approx(expected, rel=2e-4)


def test_mass_along_a_part_of_the_bar():
    m, wet = 0.5, 0.6625
    expected = Bar([(wet, EI, 1.0 + m), (1 - wet, EI, 1.0)], [(0.0, free_joint)]).eigenvalues(9)
    assert bending_of(model(Iz=EI), "added-mass", [m, wet], "element 1 towards") == pytest.approx(expected, rel=1e-4)
    expected = Bar([(1 - wet, EI, 1.0), (wet, EI, 1.0 + m)], [(0.0, free_joint)]).eigenvalues(9)
    assert bending_of(model(Iz=EI), "added-mass", [m, wet], "element 40 towards") == pytest.approx(expected, rel=1e-4)
    assert bending_of(model(Iz=EI), "added-mass", [m]) == pytest.approx(Bar(WHOLE).eigenvalues(9) / (1 + m), rel=1e-4)


@pytest.mark.parametrize(("ratio", "rel"), [(3.0, 5e-4), (30.0, 4e-3)])  # linear shapes where shear rules: (q l)^2/12
def test_timoshenko_on_two_bearings(ratio, rel):
    """m rho I lam^2 - (m EI q^2 + rho I kGA q^2 + m kGA) lam + EI kGA q^4 = 0 (Timoshenko 1921), rho = m = A = E = 1."""
    bar, q, kGA = model(PINNED, EI), np.pi * np.arange(1, 5), 1 / ratio
    b = EI * q**2 + EI * kGA * q**2 + kGA
    both = (b - np.sqrt(b**2 - 4 * EI * EI * kGA * q**4)) / (2 * EI)
    assert bending_of(bar, "timoshenko", [ratio], count=4) == pytest.approx(both, rel=rel)
    shear = EI * kGA * q**4 / (EI * q**2 + kGA)
    assert bending_of(bar, "shear", [ratio], count=4) == pytest.approx(shear, rel=rel)
    rotary = EI * q**4 / (1 + ratio * EI * q**2)
    assert bending_of(bar, "rotary-inertia", [ratio], count=4) == pytest.approx(rotary, rel=2e-4)


def test_taper_against_polynomials():
    """Ritz with x^2 ... x^11, exact for practical purposes, of EI (1 + a (2x - 1)) and mass 1 + b (2x - 1)."""
    a, b = -0.5, -0.2
    x, w = np.polynomial.legendre.leggauss(30)
    x, w = (x + 1) / 2, w / 2
    basis = [np.polynomial.Legendre.basis(i, domain=[0, 1]) * np.polynomial.Polynomial([0, 0, 1]).convert(
        kind=np.polynomial.Legendre, domain=[0, 1]) for i in range(10)]  # fmt: skip
    u = np.array([p(x) for p in basis])
    curved = np.array([p.deriv(2)(x) for p in basis])
    K = (curved * (w * EI * (1 + a * (2 * x - 1)))) @ curved.T
    M = (u * (w * (1 + b * (2 * x - 1)))) @ u.T
    assert bending_of(model(Iz=EI), "taper", [a, b / a]) == pytest.approx(eigh(K, M, eigvals_only=True)[:3], rel=1e-3)


def test_a_column_falls_by_its_own_weight():
    """q L^3 / EI = 7.8373 (Greenhill 1881) takes the stiffness of a standing column away."""
    I = 9.80665 / 7.8373
    column = model(Iz=I)
    recipes = registry()["gravity"].recipes(column, registry()["gravity"])
    standing = next(each for each in recipes if "-X" in each.site(np.ones(1)).text)
    K = np.diag(column.eigenvalues) + standing.change(np.ones(1)).K
    assert abs(np.linalg.eigvalsh(K)[0]) < 2e-3 * column.eigenvalues[0]


def test_bending_and_twist_of_a_bar_with_its_mass_beside_the_shear_centre():
    """sin n pi x in deflection and twist: [[EI q^4, 0], [0, GJ q^2]] - lam [[m, m e], [m e, I_p + m e^2]]."""
    Iy, Iz, J, e = 1e-4, 3e-4, 2e-4, 0.02
    fork = "{1: [TX, TY, TZ, RX], 41: [TY, TZ, RX]}"
    bar = model(fork, Iz, "", Iy=Iy, J=J)
    found = eigenvalues(bar, "offset", [e], "local y")
    for n in (1, 2):
        q = n * np.pi
        K, M = np.diag([Iy * q**4, J * q**2]), np.array([[1.0, e], [e, Iy + Iz + e**2]])
        for expected in eigh(K, M, eigvals_only=True):
            assert np.abs(found / expected - 1).min() < 3e-3  # linear twist: (q l)^2/12


def test_gravity_of_a_chain_is_that_of_pendulums_upside_down():
    """Two masses on springs: K - a [[m1 + 2 m2, -m2], [-m2, m2]]; storey i carries the mass above it."""
    deck = """\
mouse: 1
model:
  stiffness: {order: 2, entries: [[1, 1, 300], [1, 2, -100], [2, 2, 100]]}
  mass: {diagonal: [2, 3]}
parameters:
  - {name: k, nominal: 1, sd: 0.1, stiffness: [[1, 1, 300], [1, 2, -100], [2, 2, 100]]}
test:
  modes: {frequency: [1], frequency_sd: 1 %}
"""
    problem = assemble(yaml_deck.read(deck, "chain.yaml"))
    found = eigenvalues(reduced(problem, problem.prior.mean), "gravity", [4.0])
    K = np.array([[300.0, -100.0], [-100.0, 100.0]]) - 4 * np.array([[2 + 2 * 3, -3], [-3, 3]])
    assert found == pytest.approx(eigh(K, np.diag([2.0, 3.0]), eigvals_only=True), rel=1e-9)


@pytest.mark.parametrize("side", [1, -1])
def test_slopes_at_a_node_are_those_within_the_bar(side):
    """A hinge at a node belongs to one of two bars: between them matrices jump, and the place has the slope of its own bar."""
    found = model(Iz=EI)
    recipe = registry()["crack"].recipes(found, registry()["crack"])[0]
    there = Model(found, (recipe,))
    at = lambda s: np.append(found.z, recipe.coordinates(np.array([0.4, s])))
    end = found.bars.lines[0].inner[9]
    node = end if side > 0 else np.nextafter(end, 0)
    slopes = [there.jacobian(there.point(at(s))) for s in (node, node + side * 2e-5)]
    np.testing.assert_allclose(slopes[0], slopes[1], rtol=0.01, atol=1e-3 * np.abs(slopes[1]).max())


@pytest.mark.parametrize("key", ["mass", "ground-spring", "oscillator"])
def test_slopes_of_what_sits_at_a_place_are_alike_on_both_sides_of_a_node(key):
    """What they act on, the deflection of a bar, has a continuous slope: central differences there straddle nothing."""
    found = model(Iz=EI)
    says = "TY" if key != "mass" else ""
    recipe = next(r for r in registry()[key].recipes(found, registry()[key]) if says in r.site(r.grid[0]).text)
    there = Model(found, (recipe,))
    assert recipe.unknowns[-1].name == "place" and not recipe.jumps
    sizes = [np.sqrt(each.lower * each.upper) for each in recipe.unknowns[:-1]]
    at = lambda s: there.point(np.append(found.z, recipe.coordinates(np.array([*sizes, s]))))
    slopes = [there.jacobian(at(0.25 + side * 1e-4))[:, -1] for side in (-1, 0, 1)]
    for slope in (slopes[0], slopes[2]):
        np.testing.assert_allclose(slopes[1], slope, rtol=0.01, atol=1e-3 * np.abs(slope).max())

"""Bearings that hold beside the axis, and joints that turn about both axes, named in tests of frames assembled here.

Elements of bars in space: axial and torsion linear, bending cubic, consistent masses (Przemieniecki 1968, ch. 5 and 11).
"""

import numpy as np
import pytest
from scipy.linalg import eigh

from mouse_cli.diagnosis import diagnose
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.arrays import dense
from mouse_cli.model.diagnosis import NAMED, Choices
from mouse_cli.terms.assembly import assembly

E, G, RHO = 7.1e10, 7.1e10 / 2.6, 2700.0


def element(l: float, A: float, I: float, J: float) -> tuple[np.ndarray, np.ndarray]:
    """K, M (12, 12) of a bar along x with one I in both planes: u, v, w, turns about x, y, z at either end."""
    K, M = np.zeros((2, 12, 12))
    rod, rod_mass = np.array([[1, -1], [-1, 1]]), np.array([[2, 1], [1, 2]]) / 6
    for own, k, m in (([0, 6], E * A / l, RHO * A * l), ([3, 9], G * J / l, RHO * 2 * I * l)):
        K[np.ix_(own, own)], M[np.ix_(own, own)] = k * rod, m * rod_mass
    for own, turn in (([1, 5, 7, 11], l), ([2, 4, 8, 10], -l)):
        unit = np.outer([1, turn, 1, turn], [1, turn, 1, turn])
        k = np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])
        m = np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]])
        K[np.ix_(own, own)] = E * I / l**3 * unit * k
        M[np.ix_(own, own)] = RHO * A * l / 420 * unit * m
    return K, M


def frame(
    points: np.ndarray, joins: list[tuple[int, int]], A: float, I: float, J: float
) -> tuple[np.ndarray, np.ndarray]:
    """K, M (6 n, 6 n) of bars that join points (n, 3)."""
    K, M = np.zeros((2, 6 * len(points), 6 * len(points)))
    for a, b in joins:
        along = points[b] - points[a]
        l = float(np.linalg.norm(along))
        x = along / l
        y = np.cross([0.0, 0.0, 1.0], x) if abs(x[2]) < 0.9 else np.array([0.0, 1.0, 0.0])
        y /= np.linalg.norm(y)
        T = np.kron(np.eye(4), np.stack([x, y, np.cross(x, y)]))
        own = np.concatenate([6 * a + np.arange(6), 6 * b + np.arange(6)])
        for into, part in zip((K, M), element(l, A, I, J), strict=True):
            into[np.ix_(own, own)] += T.T @ part @ T
    return K, M


def measured(K: np.ndarray, M: np.ndarray, free: np.ndarray, rows: np.ndarray, count: int, seed: int, read=np.copy) -> str:
    """The part of a deck that has frequencies to 0.1 % and shapes to 1 %, as sensors `read` those at `rows`."""
    lam, X = eigh(K[np.ix_(free, free)], M[np.ix_(free, free)], subset_by_index=[0, count - 1])
    rng, shapes = np.random.default_rng(seed), np.zeros((len(K), count))
    shapes[free] = X
    shapes = read(shapes[rows]) / np.abs(shapes[rows]).max(axis=0) + 0.01 * rng.standard_normal((len(rows), count))
    hz = np.sqrt(lam) / (2 * np.pi) * (1 + 1e-3 * rng.standard_normal(count))
    lines = "\n".join(f"      - [{', '.join(f'{value:.5f}' for value in row)}]" for row in shapes)
    labels = ", ".join(f"{row // 6 + 1}{('TX', 'TY', 'TZ')[row % 6]}" for row in rows)
    return f"""parameters:
  - {{name: E, material: aluminium, property: E, sd: 2 %}}
  - {{name: density, material: aluminium, property: density, sd: 1 %}}
test:
  modes:
    frequency: [{", ".join(f"{value:.8g}" for value in hz)}]
    frequency_sd: 0.1 %
    dofs: [{labels}]
    shapes:
{lines}
    shape_sd: 0.01
"""


def model(points: np.ndarray, joins: list[tuple[int, int]], A: float, I: float, J: float, more: str) -> str:
    """The part of a deck that has the structure."""
    nodes = "\n".join(f"      {i + 1}: {point.tolist()}" for i, point in enumerate(points))
    bars = "\n".join(f"      - {{id: {i + 1}, type: beam, nodes: [{a + 1}, {b + 1}], material: aluminium, section: bar}}"
                     for i, (a, b) in enumerate(joins))  # fmt: skip
    return f"""mouse: 1
model:
  structure:
    nodes:
{nodes}
    materials: {{aluminium: {{E: {E}, nu: 0.3, density: {RHO}}}}}
    sections: {{bar: {{A: {A}, Iy: {I}, Iz: {I}, J: {J}}}}}
    elements:
{bars}
{more}"""


def diagnosed(text: str, choices: Choices | None = None):
    return diagnose(assemble(yaml_deck.read(text, "deck.yaml")), choices=choices or Choices())


def test_a_seized_bearing_below_the_axis_holds_beside_it():
    """It resists sliding and turning at once: an inclined spring near the end does the same, and no other restraint does."""
    A, I, k, arm, n = 1.2e-3, 1.6e-6, 4e7, 0.08, 16
    points = np.column_stack([np.linspace(0, 4, n + 1), np.zeros((n + 1, 2))])
    joins = [(i, i + 1) for i in range(n)]
    K, M = frame(points, joins, A, I, 2 * I)
    b = np.zeros(len(K))
    b[6 * n], b[6 * n + 5] = 1.0, arm  # a point below the axis moves by u + arm times the turn
    K += k * np.outer(b, b)
    free = np.array([6 * i + d for i in range(n + 1) for d in (0, 1, 5) if (i, d) not in {(0, 0), (0, 1), (n, 1)}])
    supports = f"    supports: {{1: [TX, TY], {n + 1}: [TY]}}\n    plane: XY\n"
    test = measured(K, M, free, np.array([6 * i + 1 for i in range(2, n, 2)]), 6, seed=3)
    found = diagnosed(model(points, joins, A, I, 2 * I, supports) + test)
    assert (found.kind, found.best.physics) == (NAMED, "eccentric-bearing")
    for size, true in zip(found.best.causes[0].sizes, (k, arm), strict=True):
        assert abs(abs(size.value) - true) < 3 * size.sd  # motion across alone does not tell above from below


TURNS, BAR = E * 7.6e-7 / 0.76 * np.array([1.5, 2.0, 3.0]), (9.6e-4, 7.6e-7, 1.52e-6)  # N m/rad about x, y and z; A, I, J


def jointed(points: np.ndarray, joins: list[tuple[int, int]], at: int, turns: np.ndarray, bar: tuple = BAR):
    """K and M of bars of which the one from point `at` on has a joint there, N m/rad about its own x, y and z."""
    last = len(points)
    whole = np.vstack([points, points[at]])  # it begins at a node of its own
    K, M = frame(whole, [(a if (a, b) != (at, at + 1) else last, b) for a, b in joins], *bar)
    x = (points[at + 1] - points[at]) / np.linalg.norm(points[at + 1] - points[at])
    y = np.cross([0.0, 0.0, 1.0], x) / np.linalg.norm(np.cross([0.0, 0.0, 1.0], x))
    axes, spring = np.stack([x, y, np.cross(x, y)]), np.zeros((6, 6))
    spring[:3, :3], spring[3:, 3:] = 1e5 * E * bar[0] * np.eye(3), axes.T @ np.diag(turns) @ axes
    both, one = 6 * at + np.arange(6), 6 * last + np.arange(6)
    for p, q, sign in ((both, both, 1), (one, one, 1), (both, one, -1), (one, both, -1)):
        K[np.ix_(p, q)] += sign * spring
    return K, M


CRANK = [([0, 0, 0], [0, 0, 0.6]), ([0, 0, 0.6], [0.7, 0, 0.6]), ([0.7, 0, 0.6], [0.7, 0.5, 0.7])]


def crank(n: int) -> tuple[np.ndarray, list[tuple[int, int]], np.ndarray]:
    """Points and bars of an arm with a crank at its end, n to each of three lines, and what every second point reads."""
    points = np.concatenate([np.linspace(*line, n + 1)[i > 0 :] for i, line in enumerate(CRANK)])
    return points, [(i, i + 1) for i in range(3 * n)], np.array([6 * i + d for i in range(2, 3 * n + 1, 2) for d in range(3)])


@pytest.mark.proof
def test_a_joint_turns_about_both_axes():
    """A drive, a flange, a socket: one axis alone leaves the modes of the other plane wrong."""
    n = 6
    points = np.concatenate([
        np.linspace([0, 0, 0], [0, 0, 0.6], n + 1), np.linspace([0, 0, 0.6], [0.7, 0, 0.9], n + 1)[1:]
    ])  # fmt: skip
    joins = [(i, i + 1) for i in range(2 * n)]
    K, M = jointed(points, joins, n, np.array([1e5, 1.0, 1.0]) * TURNS)
    rows = np.array([6 * i + d for i in (2, 4, 6, 8, 10, 12) for d in range(3)])
    test = measured(K, M, np.arange(6, len(K)), rows, 7, seed=4)
    found = diagnosed(model(points, joins, *BAR, "    supports: {1: all}\n") + test)
    assert (found.kind, found.best.physics) == (NAMED, "joint")
    assert "about local z and local y" in found.best.causes[0].site.text


def test_a_joint_that_twists_as_well():
    """A pylon below a wing, a boom on a bolted bracket: an arm with a crank at its end, whose joint is flexible about all axes."""
    n = 4
    points, joins, rows = crank(n)
    K, M = jointed(points, joins, n, TURNS)
    test = measured(K, M, np.arange(6, len(K)), rows, 8, seed=4)
    choices = Choices(("joint", "support-rotation", "mass", "member"))
    found = diagnosed(model(points, joins, *BAR, "    supports: {1: all}\n") + test, choices)
    (cause,) = found.best.causes
    assert (found.kind, cause.physics) == (NAMED, "joint")
    assert cause.site.text == f"element {n + 1} at node {n + 1}, about local z, local y and local x"
    for size, true in zip(cause.sizes, TURNS[[2, 1, 0]], strict=True):
        assert abs(size.value - true) < 3 * size.sd + 0.01 * true


def on_crank(n: int, K: np.ndarray, M: np.ndarray, count: int, seed: int, *candidates: str, causes: int = 1):
    """The diagnosis of that arm, clamped at its foot, by `count` modes of K and M, with so many mechanisms at most."""
    points, joins, rows = crank(n)
    test = measured(K, M, np.arange(6, len(K)), rows, count, seed)
    return diagnosed(model(points, joins, *BAR, "    supports: {1: all}\n") + test, Choices(candidates, causes))


@pytest.mark.proof
def test_a_splice_along_a_line_that_twists_as_well():
    """Bolts of a flange within a straight arm are soft about all axes; about two alone the modes that twist it stay wrong."""
    n = 4
    points, joins, _ = crank(n)
    K, M = jointed(points, joins, n + 2, TURNS)
    found = on_crank(n, K, M, 8, 6, "joint", "support-rotation", "mass", "member")
    (cause,) = found.best.causes
    assert (found.kind, cause.physics) == (NAMED, "joint")
    assert cause.site.text.endswith(", about local z, local y and local x")
    np.testing.assert_allclose(cause.site.position, points[n + 2], atol=0.02)
    for size, true in zip(cause.sizes, TURNS[[2, 1, 0]], strict=False):
        assert abs(size.value - true) < 3 * size.sd + 0.01 * true


@pytest.mark.proof
def test_a_stretch_that_is_softer_in_both_planes_keeps_its_mass():
    """Laminate that has parted, concrete that has burnt: half of the stiffness in bending of two bars of the upright is lost."""
    n = 6
    points, joins, _ = crank(n)
    K, M = frame(points, joins, *BAR)
    K -= 0.5 * frame(points, joins[2:4], 0.0, BAR[1], 0.0)[0]
    found = on_crank(n, K, M, 8, 7, "stiffness-loss", "corrosion", "crack", "mass")
    (cause,) = found.best.causes
    assert (found.kind, cause.physics) == (NAMED, "stiffness-loss") and cause.site.text.endswith(", in both planes")
    added, width, place = cause.sizes
    assert abs(place.value - 0.3) < 3 * place.sd and place.sd < 0.05
    lost = added.value * width.value  # what a stretch bends more is its product alone, where it is short
    assert lost == pytest.approx(1 / 3, rel=0.2)
    extended = map(dense, assembly(found.extended).matrices(found.extended.prior.mean))
    rates = [eigh(*each, eigvals_only=True)[:8] for each in (extended, (K[6:, 6:], M[6:, 6:]))]
    np.testing.assert_allclose(*np.sqrt(rates), rtol=0.01)


@pytest.mark.proof
def test_mass_along_all_of_one_row_is_named_with_all_of_it():
    """A pipe that holds water between two corners: no part of the row from an end on, and no second mass at the other."""
    n = 4
    points, joins, _ = crank(n)
    K, M = frame(points, joins, *BAR)
    M += frame(points, joins[n : 2 * n], 0.6 * BAR[0], 0.0, 0.0)[1]
    found = on_crank(n, K, M, 7, 8, "added-mass", "mass", "lighter", causes=2)
    (cause,) = found.best.causes
    assert (found.kind, cause.physics, cause.site.text) == (NAMED, "added-mass", f"elements {n + 1} to {2 * n}")
    assert abs(cause.sizes[0].value - 0.6 * RHO * BAR[0]) < 3 * cause.sizes[0].sd


@pytest.mark.parametrize("mass", ["consistent", "lumped", "translational"])
def test_a_joint_takes_from_torsion_what_a_spring_in_series_does(mass):
    """omega^2 = k / (2 m a^2) of a column with a bar across: 1 / k = l / GJ + 1 / k_joint, and a / 6EI by which the bar yields."""
    A, I, m, a, l = 1e-2, 1e-5, 40.0, 1.5, 2.0
    light = model(
        np.array([[0, 0, 0], [0, 0, l], [-a, 0, l], [a, 0, l]]), [(0, 1), (1, 2), (1, 3)], A, I, 2 * I,
        f"      - {{id: 8-9, type: mass, nodes: [3, 4], mass: {m}}}\n    supports: {{1: all}}\n",
    ).replace(f"density: {RHO}", "density: 1.0e-3").replace("type: beam,", f"type: beam, mass: {mass},")  # fmt: skip
    test = "test:\n  modes: {frequency: [1.0], frequency_sd: 1 %}\n"
    problem = assemble(yaml_deck.read(light + test, "deck.yaml"))
    base = reduced(problem, problem.prior.mean)
    recipe = next(each for each in base.recipes(registry()["joint"]) if each.site(np.ones(3)).text.startswith(
        "element 1 at node 2, about local z, local y and local x"))  # fmt: skip
    k, rigid = G * 2 * I / l, [each.upper for each in recipe.unknowns[:2]]
    for share in (0.1, 1.0, 10.0):
        values = np.array([*rigid, share * k])
        rates = Model(base, (recipe,)).solved(np.concatenate([base.z, recipe.coordinates(values)]))[0]
        expected = 1 / (1 / k + 1 / (share * k) + a / (6 * E * I)) / (2 * m * a**2)
        assert np.abs(rates / expected - 1).min() < 1e-3
        made = recipe.extend(problem, values)
        K, M = map(dense, assembly(made).matrices(made.prior.mean))
        assert np.abs(expected * eigh(M, K, eigvals_only=True) - 1).min() < 1e-3


@pytest.mark.parametrize("mass", ["consistent", "translational"])
def test_a_joint_turns_where_masses_have_no_inertia_against_turns(mass):
    """omega^2 = 1 / (m (l^3 / 3EI + l^2 / k)) of a mast with a joint l below its top, which nothing in the modes of the deck is."""
    A, I, m, l = 1e-2, 1e-5, 40.0, 2.0
    deck = model(
        np.array([[0, 0, 0], [1.0, 0, 0], [1.0, 0, l]]), [(0, 1), (1, 2)], A, I, 2 * I,
        f"      - {{id: 9, type: mass, nodes: [3], mass: {m}}}\n    supports: {{1-2: all}}\n",
    ).replace(f"density: {RHO}", "density: 1.0e-3").replace("type: beam,", f"type: beam, mass: {mass},")  # fmt: skip
    problem = assemble(yaml_deck.read(deck + "test:\n  modes: {frequency: [1.0], frequency_sd: 1 %}\n", "deck.yaml"))
    base = reduced(problem, problem.prior.mean)
    recipe = next(each for each in base.recipes(registry()["joint"]) if len(each.unknowns) == 3)
    for k in np.array([0.1, 1.0, 10.0]) * E * I / l:
        values = np.array([k, k, 0.0])  # at the foot
        rates = Model(base, (recipe,)).solved(np.concatenate([base.z, recipe.coordinates(values)]))[0]
        assert np.abs(rates[:2] * m * (l**3 / (3 * E * I) + l**2 / k) - 1).max() < 1e-3


@pytest.mark.proof
def test_a_dish_beside_a_mast_is_a_mass_on_an_arm():
    """Between the ends of a member, where two modes of almost one frequency bend either way."""
    A, I, m, arm, n, at = 1.5e-3, 4e-6, 6.0, 0.7, 10, 6
    points = np.column_stack([np.zeros((n + 1, 2)), np.linspace(0, 6, n + 1)])
    joins = [(i, i + 1) for i in range(n)]
    K, M = frame(points, joins, A, I, 2 * I)
    for move, turn, sign in ((0, 0, 0.0), (1, 5, 1.0), (2, 4, -1.0)):  # u + theta x (arm, 0, 0)
        b = np.zeros(len(K))
        b[6 * at + move] = 1.0
        b[6 * at + turn] += sign * arm
        M += m * np.outer(b, b)
    rows = np.array([6 * i + d for i in (2, 4, 6, 8, 10) for d in (0, 1)])
    test = measured(K, M, np.arange(6, len(K)), rows, 6, seed=5)
    found = diagnosed(model(points, joins, A, I, 2 * I, "    supports: {1: all}\n") + test)
    assert (found.kind, found.best.physics) == (NAMED, "eccentric-mass")
    kg, x, *_ = found.best.causes[0].sizes
    assert abs(kg.value - m) < 3 * kg.sd and abs(abs(x.value) - arm) < 3 * x.sd


@pytest.mark.proof
@pytest.mark.parametrize("lines", [1, 3])
def test_a_tube_that_is_slotted_is_soft_in_torsion_alone(lines):
    """Of one member, or of all: it was a support that turns, or rotary inertia. A joint within it does almost the same."""
    n = 4
    points, joins, rows = crank(n)
    A, I, J = BAR
    slotted = joins[:n] if lines == 1 else joins
    parts = [frame(points, some, A, I, own) for some, own in ((slotted, 0.25 * J), (joins[len(slotted):], J)) if some]
    K, M = (sum(part) for part in zip(*parts, strict=True))
    test = measured(K, M, np.arange(6, len(K)), rows, 8, seed=4)
    choices = Choices(("torsion", "joint", "support-rotation", "rotary-inertia", "member", "stiffness-loss"), 1)
    found = diagnosed(model(points, joins, *BAR, "    supports: {1: all}\n") + test, choices)
    (cause,), p = found.explanations[0].causes, found.explanations[0].probability
    assert cause.physics == "torsion" and p > 0.9
    (size,) = cause.sizes
    assert abs(size.value - 0.25) < 3 * size.sd + 0.01


TURNED = {
    "90 degrees": [[0.0, 1.0], [-1.0, 0.0]],
    "270 degrees": [[0.0, -1.0], [1.0, 0.0]],
    "180 degrees": [[-1.0, 0.0], [0.0, -1.0]],
}


@pytest.mark.parametrize("turn", TURNED)
def test_a_sensor_of_three_axes_that_is_mounted_turned(turn):
    """About its third axis: two readings exchanged, one of them with another sign. Pairs of mechanisms were sought for 300 s."""
    n = 4
    points, joins, rows = crank(n)
    K, M = frame(points, joins, *BAR)
    at = np.flatnonzero(np.isin(rows, [6 * 6, 6 * 6 + 1]))

    def read(shapes):
        found = shapes.copy()
        found[at] = TURNED[turn] @ shapes[at]
        return found

    test = measured(K, M, np.arange(6, len(K)), rows, 6, seed=4, read=read)
    choices = Choices(("sensor-turned", "sensor-swap", "sensor-sign", "sensor-place"), 1)
    found = diagnosed(model(points, joins, *BAR, "    supports: {1: all}\n") + test, choices)
    assert (found.kind, found.best.physics) == (NAMED, "sensor-turned")
    assert found.best.causes[0].site.text == f"sensors 7TX and 7TY, turned by {turn}"


@pytest.mark.parametrize("alike", [True, False])
def test_a_member_that_is_gone_is_gone_at_any_modulus_and_density(alike):
    """It took a fixed part of K and M: where E or the density fell by what it has of them the model had buckled, or had no mass,
    and a brace that was missing from a tower had no answer in 570 s.
    """
    points = np.array([[0, 0, 0], [0, 0, 1.0], [0.8, 0, 1.0], [0.8, 0, 0], [0.8, 0.6, 1.0]])
    joins = [(0, 1), (1, 2), (2, 3), (2, 4), (0, 2)]
    K, M = frame(points, joins, *BAR)
    free = np.array([6 * i + d for i in (1, 2, 4) for d in range(6)])
    test = measured(K, M, free, np.array([6, 7, 12, 13, 25]), 5, seed=2)
    deck = assemble(yaml_deck.read(model(points, joins, *BAR, "    supports: {1: all, 4: all}\n") + test, "deck.yaml"))
    there = reduced(deck, deck.prior.mean)
    text = f"element 5, its {'mass alike' if alike else 'stiffness alone'}"
    recipe = next(one for one in there.recipes(registry()["member"]) if one.site(one.grid[0]).text == text)
    lost = Model(there, (recipe,))
    x = np.concatenate([np.array([-1.5, -2.0]), recipe.bounds[:, 1] if alike else [np.log(0.98)]])
    stiff, heavy = 1 - 1.5 * 0.02, 1 - 2.0 * 0.01
    without, bare = frame(points, joins[:-1], *BAR)
    K, M = (without, bare) if alike else (without + 0.02 * (K - without), M)
    lam = eigh(stiff * K[np.ix_(free, free)], heavy * M[np.ix_(free, free)], eigvals_only=True)
    at = lost.point(x)
    np.testing.assert_allclose(at.eigenvalues[:5], lam[:5], rtol=1e-5)
    step = 1e-4 * np.eye(2, len(x))
    slopes = [(lost.point(x + d).residual - lost.point(x - d).residual) / -2e-4 for d in step]
    np.testing.assert_allclose(lost.jacobian(at)[:, :2], np.transpose(slopes), rtol=1e-3, atol=1e-3 * np.abs(slopes).max())

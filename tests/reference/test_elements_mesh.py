"""A mesh made into a model: degrees of freedom, links, rigid motions, mechanisms, gravity, imported matrices."""

import numpy as np
import pytest
from element_meshes import BAR, STEEL, XY, beam_line, damping, elements, hertz, matrices, mesh, pairs, rigid

from mouse_cli.dynamics.solver import eigensolution
from mouse_cli.model.arrays import dense, is_sparse
from mouse_cli.model.mesh import Mesh, RigidLink
from mouse_cli.model.structure import Structure
from mouse_cli.terms import faults
from mouse_cli.terms.assembly import Assembly
from mouse_cli.terms.build import built

ALL = range(6)


def frame(**more) -> Mesh:
    """A small skew frame with an offset beam, releases, a lumped mass, a joint and a node on a rigid link."""
    points = [
        [0, 0, 0],
        [1.0, 0.2, 0.1],
        [1.3, 1.1, 0.4],
        [0.3, 1.2, 1.5],
        [1.0, 0.2, 0.1],
        [1.5, 1.5, 1.0],
        [0.1, 0.3, 0.2],
    ]
    sets = [
        elements("beam", [[0, 1], [1, 2]], 1, {"theory": "timoshenko"}, **STEEL, **BAR),
        elements("beam", [[2, 3]], 10, {"offsets": {1: [0.05, 0, 0.02], 2: [0, -0.03, 0]}}, **STEEL, **BAR),
        elements("beam", [[3, 0]], 20, {"releases": {1: ["RY"], 2: ["RY", "RZ"]}}, **STEEL, **BAR),
        elements("joint", [[1, 4]], 30, TX=1e7, TY=1e7, TZ=2e7, RX=1e4, RY=3e4, RZ=2e4),
        elements("beam", [[4, 3]], 40, {"theory": "generic"}, **STEEL, **BAR, antisymmetric_y=0.5),
        elements("mass", [[5]], 50, mass=2.0, Jx=0.01, Jy=0.02, Jz=0.03),
        elements("rod", [[6, 3]], 60, E=1e9, A=1e-4, density=1000.0),
    ]
    return mesh(points, sets, links=(RigidLink(2, 5), RigidLink(0, 6)), **more)


def test_rigid_motions_of_a_free_frame_cost_nothing_and_carry_its_mass():
    """K R = 0 with offsets, releases, joints and links; R'MR is the mass and its moments about the origin."""
    given = frame()
    model = built(given)
    K, M = (dense(matrix) for matrix in Assembly(model.structure, model.terms, 0).matrices(np.zeros(0)))
    R = rigid(model, given)
    assert np.abs(K @ R).max() < 1e-12 * (np.abs(K) @ np.abs(R)).max()
    assert np.linalg.matrix_rank(K / np.abs(K).max(), 1e-13) == len(K) - 6
    lengths = _lengths(given, (0, 1, 2, 4))
    steel = STEEL["density"] * BAR["A"] * sum(lengths)
    total = steel + 2.0 + 1000.0 * 1e-4 * np.linalg.norm(given.coordinates[6] - given.coordinates[3])
    body = R.T @ M @ R
    assert body[:3, :3] == pytest.approx(total * np.eye(3), rel=1e-10, abs=1e-10)
    assert [r.kind for r in model.remarks] == ["floating"]


def _lengths(given: Mesh, sets: tuple[int, ...]) -> list[float]:
    found = []
    for i in sets:
        offsets = given.elements[i].options.get("offsets", {})
        for first, last in given.elements[i].nodes:
            ends = given.coordinates[[first, last]] + [offsets.get(1, [0, 0, 0]), offsets.get(2, [0, 0, 0])]
            found.append(float(np.linalg.norm(ends[1] - ends[0])))
    return found


def test_moment_of_inertia_of_a_bar():
    """m L^2/3 about its end; with rotary inertia of sections rho I L more; polar rho (Iy + Iz) L about its own axis."""
    L = 1.4
    given = beam_line(3, L, options={"rotary_inertia": "included"}, directions=range(6))
    model = built(given)
    M = Assembly(model.structure, model.terms, 0).matrices(np.zeros(0))[1]
    R = rigid(model, given)
    inertia = (R.T @ M @ R)[3:, 3:]
    m, rho = STEEL["density"] * BAR["A"] * L, STEEL["density"]
    expected = [
        rho * (BAR["Iy"] + BAR["Iz"]) * L,
        m * L**2 / 3 + rho * BAR["Iy"] * L,
        m * L**2 / 3 + rho * BAR["Iz"] * L,
    ]
    assert inertia == pytest.approx(np.diag(expected), rel=1e-11, abs=1e-15)


def test_degrees_of_freedom_go_node_by_node_without_what_nothing_holds():
    points = [[0, 0, 0], [1, 0, 0], [1, 1, 0]]
    truss = elements("rod", [[0, 1], [1, 2], [2, 0]], E=1e9, A=1e-4, density=1e3)
    model = built(mesh(points, [truss], [(0, (0, 1)), (1, (1,))]))
    assert model.structure.labels == ("2TX", "3TX", "3TY")
    assert model.structure.geometry.labels() == model.structure.labels
    assert [(r.kind, r.places) for r in model.remarks] == [("unheld", ((1, 2), (2, 2), (3, 2)))]
    assert model.structure.geometry.lines.tolist() == [[0, 1], [1, 2], [2, 0]]


def test_dense_up_to_500_degrees_of_freedom():
    small, large = built(beam_line(166, supports=[(0, XY)])), built(beam_line(167, supports=[(0, XY)]))
    assert not is_sparse(small.structure.K)
    assert is_sparse(large.structure.K)
    assert (small.structure.n, large.structure.n) == (498, 501)


def test_a_rigid_link_is_a_long_offset():
    """A beam between the ends of rigid arms, made with links or with offsets, is the same beam."""
    points = [[0, 0, 0], [1, 0, 0], [0, 0.1, 0.2], [1, -0.1, 0.3]]
    supports = [(0, ALL)]
    linked = mesh(
        points, [elements("beam", [[2, 3]], **STEEL, **BAR)], supports, links=(RigidLink(0, 2), RigidLink(1, 3))
    )
    options = {"offsets": {1: [0, 0.1, 0.2], 2: [0, -0.1, 0.3]}}
    offset = mesh(points[:2], [elements("beam", [[0, 1]], 1, options, **STEEL, **BAR)], supports)
    for one, other in zip(matrices(linked), matrices(offset), strict=True):
        assert one == pytest.approx(other, rel=1e-12, abs=1e-9)


def test_links_in_a_chain_add_their_arms():
    points = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, 2]]
    beam = elements("beam", [[0, 1]], **STEEL, **BAR)
    tip = elements("mass", [[3]], 2, mass=3.0)
    chain = mesh(points, [beam, tip], [(0, ALL)], links=(RigidLink(1, 2), RigidLink(2, 3)))
    model = built(chain)
    assert model.motion.n == 6
    dofs, factors = model.motion.of(3, 0)
    moved = dict(zip([model.structure.labels[d] for d in dofs], factors, strict=True))
    assert moved == {"2TX": 1.0, "2RY": 2.0, "2RZ": -1.0}


def test_one_direction_of_a_link():
    """Two cantilevers that share TY at their tips only: their stiffnesses add."""
    points = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [1, 0, 0]]
    sets = [elements("beam", [[0, 1], [2, 3]], **STEEL, **BAR)]
    given = mesh(points, sets, [(0, XY), (2, XY)], links=(RigidLink(1, 3, (1,)),), directions=XY)
    K, _ = matrices(given)
    assert built(given).structure.labels == ("2TX", "2TY", "2RZ", "4TX", "4RZ")
    assert 1 / np.linalg.inv(K)[1, 1] == pytest.approx(2 * 3 * STEEL["E"] * BAR["Iz"], rel=1e-12)


@pytest.mark.parametrize("count", [3, 300])
def test_a_hinge_too_many_is_a_mechanism_that_is_named(count):
    """Simply supported with a hinge at midspan, in small and in large models."""
    n = 2 * count
    plain = beam_line(n)
    sets = [
        elements("beam", pairs(count), options={}, **STEEL, **BAR),
        elements("beam", pairs(1, count), 1001, {"releases": {1: ["RZ"]}}, **STEEL, **BAR),
        elements("beam", pairs(count - 1, count + 1), 2001, **STEEL, **BAR),
    ]
    given = mesh(plain.coordinates, sets, [(0, (0, 1)), (n, (1,))], directions=XY)
    with pytest.raises(faults.Mechanism) as found:
        built(given)
    assert all(d in (1, 5) for _, d in found.value.places)
    assert "nothing resists" in str(found.value)


@pytest.mark.parametrize("supports", [[], [(0, (0, 1))], [(0, XY)]])
def test_no_long_chain_is_taken_for_a_mechanism(supports):
    """20000 beams: the lowest eigenvalues of K are far below its rounding, but not the strains of its elements."""
    model = built(beam_line(20000, 1000.0, supports=supports))
    assert [r.kind for r in model.remarks] == (["floating"] if len(supports) == 0 or len(supports[0][1]) < 3 else [])


def test_a_square_truss_without_diagonal_is_a_mechanism():
    points = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    rods = elements("rod", [[0, 1], [1, 2], [2, 3], [3, 0]], E=1e9, A=1e-4, density=1e3)
    with pytest.raises(faults.Mechanism) as found:
        built(mesh(points, [rods], [(0, (0, 1)), (1, (0, 1))], directions=XY))
    assert found.value.nodes == (3, 4)
    assert set(found.value.places) == {(3, 0), (4, 0)}


def test_parts_that_float_are_remarked_one_by_one():
    points = [[0, 0, 0], [1, 0, 0], [5, 0, 0], [6, 0, 0]]
    model = built(mesh(points, [elements("beam", [[0, 1], [2, 3]], **STEEL, **BAR)], [(0, XY)], directions=XY))
    assert [(r.kind, r.nodes) for r in model.remarks] == [("floating", (3, 4))]
    assert "3 ways" in model.remarks[0].message


_BEAM = {**STEEL, **BAR}
_LINE = [[0, 0, 0], [1, 0, 0], [1, 0, 0]]
_FAULTS = {
    "node without element": (lambda: mesh(_LINE, [elements("beam", [[0, 1]], **_BEAM)]), faults.Disconnected, (3,), ()),
    "node with a mass only": (
        lambda: mesh(_LINE, [elements("beam", [[0, 1]], **_BEAM), elements("mass", [[2]], 2, mass=1.0)]),
        faults.Disconnected,
        (3,),
        (),
    ),
    "no length": (
        lambda: mesh(_LINE, [elements("beam", [[0, 1], [1, 2]], 7, **_BEAM)]),
        faults.ZeroLength,
        (2, 3),
        (8,),
    ),
    "orientation along the beam": (
        lambda: mesh(_LINE[:2], [elements("beam", [[0, 1]], 7, {"orientation": [2, 0, 0]}, **_BEAM)]),
        faults.Unoriented,
        (),
        (7,),
    ),
    "released at both ends": (
        lambda: mesh(_LINE[:2], [elements("beam", [[0, 1]], 7, {"releases": {1: ["RX"], 2: ["RX"]}}, **_BEAM)]),
        faults.Loose,
        (),
        (7,),
    ),
    "dependent and supported": (
        lambda: mesh(_LINE, [elements("beam", [[0, 1]], **_BEAM)], [(2, (1,))], links=(RigidLink(1, 2),)),
        faults.Overconstrained,
        (3,),
        (),
    ),
    "dependent twice": (
        lambda: mesh(_LINE, [elements("beam", [[0, 1]], **_BEAM)], links=(RigidLink(1, 2), RigidLink(0, 2))),
        faults.Overconstrained,
        (3,),
        (),
    ),
    "links in a circle": (
        lambda: mesh(_LINE, [elements("beam", [[0, 1]], **_BEAM)], links=(RigidLink(1, 2), RigidLink(2, 1))),
        faults.LinkLoop,
        (2, 3),
        (),
    ),
    "weight without support": (
        lambda: mesh(_LINE[:2], [elements("beam", [[0, 1]], **_BEAM)], gravity=[-9.81, 0, 0]),
        faults.NoLoadPath,
        (),
        (),
    ),
}


@pytest.mark.parametrize("case", _FAULTS)
def test_fault(case):
    make, kind, nodes, ids = _FAULTS[case]
    with pytest.raises(kind) as found:
        built(make())
    assert (found.value.nodes, found.value.elements) == (nodes, ids)
    assert found.value.help


def test_imported_matrices_come_first_and_share_labels():
    """A chain of two imported masses, held and extended by springs of a mesh."""
    base = Structure(np.array([[5.0, -5.0], [-5.0, 5.0]]), np.eye(2), ("7", "2TX"))
    springs = elements("spring", [[0, 1]], TX=3.0)
    tip = elements("mass", [[1]], 2, mass=2.0)
    given = mesh([[1, 0, 0], [2, 0, 0]], [springs, tip], directions=(0,))
    given = Mesh(np.array([2, 3]), given.coordinates, given.elements, given.supports, directions=(0,))
    model = built(given, base=base)
    assert model.structure.labels == ("7", "2TX", "3TX")
    K, M = Assembly(model.structure, model.terms, 0).matrices(np.zeros(0))
    assert K.tolist() == [[5, -5, 0], [-5, 8, -3], [0, -3, 3]]
    assert M.diagonal().tolist() == [1, 1, 2]


def test_supports_and_links_act_on_imported_matrices():
    """Node 2 supported, node 3 rigidly beside node 1: T'KT by hand."""
    base = Structure(np.array([[2.0, -1, 0], [-1, 2, -1], [0, -1, 2]]), np.diag([1.0, 2, 3]), ("1TX", "2TX", "3TX"))
    given = mesh(
        np.zeros((3, 3)),
        [elements("spring", [[0]], TX=10.0)],
        [(1, (0,))],
        directions=(0,),
        links=(RigidLink(0, 2, (0,)),),
    )
    model = built(given, base=base)
    K, M = Assembly(model.structure, model.terms, 0).matrices(np.zeros(0))
    assert model.structure.labels == ("1TX",)
    assert (K.tolist(), M.tolist()) == ([[14.0]], [[4.0]])


def test_springs_and_dashpots_act_direction_by_direction():
    """At some distance as at none: k (u2 - u1), no moments; in local axes R'kR."""
    points = [[0, 0, 0], [1, 2, 3]]
    axes = {"axes": [[1, 1, 0], [-1, 1, 0]]}
    sets = [elements("spring", [[0, 1]], 1, axes, TX=4.0, TY=1.0, RZ=7.0), elements("dashpot", [[0, 1]], 2, TX=0.5)]
    model = built(mesh(points, sets, [(0, ALL)]))
    assembly = Assembly(model.structure, model.terms, 0)
    K, C = assembly.matrices(np.zeros(0))[0], assembly.damping(np.zeros(0))[0]
    assert model.structure.labels == ("2TX", "2TY", "2RZ")
    assert pytest.approx(np.array([[2.5, 1.5, 0], [1.5, 2.5, 0], [0, 0, 7.0]])) == K
    assert C.tolist() == [[0.5, 0, 0], [0, 0, 0], [0, 0, 0]]


def test_joint_is_in_equilibrium_at_any_distance():
    """A moment on one side of a joint of RZ alone comes out whole; a force through it turns nothing."""
    given = mesh(
        [[0, 0, 0], [0, 2, 0]], [elements("joint", [[0, 1]], TX=1e3, TY=1e3, RZ=50.0)], [(0, XY)], directions=XY
    )
    K, _ = matrices(given)
    tx, _, rz = np.linalg.inv(K) @ [1.0, 0, 0]
    assert tx == pytest.approx(1 / 1e3 + 1.0**2 / 50.0)  # the arm from the joint, midway, to the node
    assert rz == pytest.approx(-1.0 / 50.0)


def test_damping_of_one_degree_of_freedom():
    """zeta = (beta w + alpha/w)/2 (Rayleigh), here on a rod fixed at one end; eta by the imaginary part of k."""
    k, m = 1e9 * 1e-4 / 2.0, 1e3 * 1e-4 * 2.0 / 3
    rod = elements(
        "rod", [[0, 1]], E=1e9, A=1e-4, density=1e3, loss_factor=0.02, stiffness_damping=3e-5, mass_damping=0.7
    )
    given = mesh([[0, 0, 0], [2, 0, 0]], [rod], [(0, (0,))], directions=(0,))
    C, D = damping(given)
    assert pytest.approx(np.array([[3e-5 * k + 0.7 * m]])) == C
    assert pytest.approx(np.array([[0.02 * k]])) == D
    assert damping(beam_line(2, supports=[(0, XY)])) == (None, None)


def test_tension_is_not_damped():
    """Material damping comes from K without the stiffness that axial force makes."""
    C, D = damping(beam_line(1, supports=[(0, XY)], preload=1e5, loss_factor=0.1, stiffness_damping=0.2))
    K, _ = matrices(beam_line(1, supports=[(0, XY)]))
    assert pytest.approx(0.1 * K) == D
    assert pytest.approx(0.2 * K) == C


def column(count: int, gravity: float, mass: float, L: float = 2.0) -> Mesh:
    """A massless column with a mass at its tip."""
    points = np.zeros((count + 1, 3))
    points[:, 2] = np.linspace(0, L, count + 1)
    shaft = elements("beam", pairs(count), **{**_BEAM, "density": 0.0}, preload=0.0)
    tip = elements("mass", [[count]], 1001, mass=mass)
    return mesh(points, [shaft, tip], [(0, ALL)], directions=(0, 2, 4), gravity=[0, 0, -gravity])


@pytest.mark.parametrize("sign", [1, -1])
def test_p_delta_of_a_column_with_a_tip_mass(sign):
    """Lateral stiffness under a dead load P = m g: P/(tan(a)/(a/L) - L), a = L sqrt(P/E I); hanging: with tanh (Timoshenko)."""
    L, EI, mass = 2.0, STEEL["E"] * BAR["Iy"], 30.0
    P = mass * 9.81
    a = L * np.sqrt(P / EI)
    exact = P / (np.tan(a) * L / a - L) if sign > 0 else P / (L - np.tanh(a) * L / a)
    K, _ = matrices(column(16, sign * 9.81, mass))
    tip = next(i for i, label in enumerate(built(column(16, 9.81, mass)).structure.labels) if label == "17TX")
    assert 1 / np.linalg.inv(K)[tip, tip] == pytest.approx(exact, rel=1e-5)


def test_p_delta_of_a_shear_building():
    """Each storey: k - W/h, W the weight of all floors above (hanging: k + W/h); two columns share it."""
    k, h, m, g = [9e5, 7e5, 5e5], [4.0, 3.0, 3.0], [3000.0, 2000.0, 1000.0], 9.81
    points = np.array([[0, 0, z] for z in np.concatenate([[0], np.cumsum(h)])])
    half = [elements("storey", [[i, i + 1]], 10 * i + j, TX=k[i] / 2) for i in range(3) for j in (1, 2)]
    floors = [elements("mass", [[i]], 100 + i, mass=m[i - 1]) for i in (1, 2, 3)]
    given = mesh(points, [*half, *floors], [(0, ALL)], gravity=[0, 0, -g])
    model = built(given)
    K, M = Assembly(model.structure, model.terms, 0).matrices(np.zeros(0))
    above = np.cumsum(m[::-1])[::-1] * g
    s = np.array(k) - above / h
    assert model.structure.labels == ("2TX", "3TX", "4TX")
    assert pytest.approx(np.array([[s[0] + s[1], -s[1], 0], [-s[1], s[1] + s[2], -s[2]], [0, -s[2], s[2]]])) == K
    assert M.diagonal().tolist() == m


def test_weight_on_a_storey_beside_another_way_down_is_refused():
    points = [[0, 0, 0], [0, 0, 3], [3, 0, 3], [3, 0, 0]]
    sets = [elements("storey", [[0, 1], [3, 2]], TX=1e5), elements("rod", [[1, 2]], 9, E=1e9, A=1e-3, density=1e3)]
    with pytest.raises(faults.NoLoadPath) as found:
        built(mesh(points, sets, [(0, ALL), (3, ALL)], gravity=[0, 0, -9.81]))
    assert found.value.nodes == (1, 2)


def test_weight_of_a_hanging_chain_of_rods():
    """Transverse frequencies of a hanging chain: w = j0_i/2 sqrt(g/L), j0 the zeros of J0 (Bernoulli 1733)."""
    import mpmath

    n, L = 150, 3.0
    points = np.zeros((n + 1, 3))
    points[:, 2] = -np.linspace(0, L, n + 1)
    chain = elements("rod", pairs(n), E=1e9, A=1e-4, density=8e3, preload=1e-6)
    given = mesh(points, [chain], [(0, ALL)], directions=(0, 2), gravity=[0, 0, -9.81])
    zeros = np.array([float(mpmath.besseljzero(0, i)) for i in (1, 2, 3)])
    assert hertz(given)[:3] == pytest.approx(zeros / 2 * np.sqrt(9.81 / L) / (2 * np.pi), rel=2e-3)


def test_diagonal_mass_is_positive_everywhere():
    """A diagonal mass is positive at every degree of freedom, so that no eigenvalue is lost."""
    K, M = matrices(beam_line(6, supports=[(0, XY)], options={"mass": "lumped"}))
    assert np.count_nonzero(M - np.diag(M.diagonal())) == 0
    assert M.diagonal().min() > 0
    assert eigensolution(K, M).eigenvalues.min() > 0


@pytest.mark.parametrize("sparse", [False, True])
def test_what_stands_on_something_soft_has_a_load_path(sparse):
    """1e9 N/m on 1 N/m: closed form 1 m and 1e-9 m more; without the soft one nothing holds it."""
    from scipy.sparse import csc_array

    from mouse_cli.terms.gravity import displacements

    of = csc_array if sparse else np.asarray
    link = 1e9 * np.array([[1.0, -1.0], [-1.0, 1.0]])
    held = link + np.diag([1.0, 0.0])
    assert displacements(of(held), np.array([0.0, 1.0])) == pytest.approx([1.0, 1.0 + 1e-9], rel=1e-6)
    with pytest.raises(faults.NoLoadPath):
        displacements(of(link), np.array([0.0, 1.0]))

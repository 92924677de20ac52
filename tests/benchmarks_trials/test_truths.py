"""The truths of the sealed trials beside closed forms, scikit-fem, CalculiX, and the decks that go with them."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))
from benchmarks.blind import verify
from benchmarks.trials import beam, case, chain, frame, plate
from benchmarks.trials.assembly import Assembly
from benchmarks.trials.bars import Bars
from benchmarks.trials.case import Blank
from benchmarks.trials.draw import Trial
from benchmarks.trials.kinds import Kind, kinds
from benchmarks.trials.outside import fields, links
from benchmarks.trials.seal import write
from benchmarks.trials.test_data import QUALITIES, measured, truth_of

ELEMENTS = 60


def bar(**fields: float) -> Bars:
    """A cantilever of length 1 with EI = m = 1, held against axial motion."""
    points = np.column_stack([np.linspace(0, 1, ELEMENTS + 1), np.zeros(ELEMENTS + 1)])
    index = np.arange(ELEMENTS + 1)
    made = Bars(points, np.column_stack([index[:-1], index[1:]]), points[:-1, 0])
    for name, value in ({"EI": 1.0, "m": 1.0, "EA": 1.0} | fields).items():
        getattr(made, name)[:] = value
    made.held = {*range(0, 3 * ELEMENTS + 3, 3), 1, 2}
    return made


def omegas(made: Assembly, count: int) -> np.ndarray:
    return 2 * np.pi * made.modes(count)[0]


def cantilever(z: float) -> float:
    return np.cos(z) + 1 / np.cosh(z)


def test_cantilever():
    assert omegas(bar(), 5) == pytest.approx(verify.roots(cantilever, 1, 20, 5, 0.1) ** 2, rel=1e-5)


def test_tip_mass():
    """1 + cos cosh = mu z (sin cosh - cos sinh), by cosh."""
    made = bar()
    made.weight({3 * ELEMENTS + 1: 1.0}, 0.2)
    exact = verify.roots(lambda z: cantilever(z) - 0.2 * z * (np.sin(z) - np.cos(z) * np.tanh(z)), 1, 20, 4, 0.1)
    assert omegas(made, 4) == pytest.approx(exact**2, rel=1e-5)


def test_bed():
    """omega^2 = z^4 + k on a bed of k EI/L^4."""
    assert omegas(bar(bed=50.0), 4) == pytest.approx(
        np.sqrt(verify.roots(cantilever, 1, 20, 4, 0.1) ** 4 + 50), rel=1e-5
    )


def test_turning_clamp():
    """A clamp that turns with k EI/L: k (1 + cos cosh) = z (sin cosh - cos sinh) (Blevins 1979, Table 8-1), by cosh."""
    made = bar()
    made.held.discard(2)
    made.spring({2: 1.0}, 4.0)
    f = lambda z: 4 * cantilever(z) - z * (np.sin(z) - np.cos(z) * np.tanh(z))
    assert omegas(made, 4) == pytest.approx(verify.roots(f, 0.5, 20, 4, 0.1) ** 2, rel=1e-5)


def test_hinge_at_the_root_is_a_turning_clamp():
    made, hinged = bar(), bar()
    made.held.discard(2)
    made.spring({2: 1.0}, 4.0)
    hinged.hinge(0, 0, 4.0)
    assert omegas(hinged, 4) == pytest.approx(omegas(made, 4), rel=1e-6)


def test_pull_on_a_pinned_bar():
    """omega^2 = (n pi)^4 + T (n pi)^2; at T = -pi^2 it buckles."""
    made = bar(axial=30.0)
    made.held = {*range(0, 3 * ELEMENTS + 3, 3), 1, 3 * ELEMENTS + 1}
    n = np.pi * np.arange(1, 5)
    assert omegas(made, 4) == pytest.approx(np.sqrt(n**4 + 30 * n**2), rel=1e-5)


def test_oscillator():
    """A tip oscillator acts as a mass m/(1 - omega^2 m/k) at the tip."""
    m, k = 0.1, 4.0
    made = bar()
    made.oscillator(3 * ELEMENTS + 1, m, k)
    mu = lambda z: m / (1 - z**4 * m / k)
    f = lambda z: (1 - z**4 * m / k) * (cantilever(z) - mu(z) * z * (np.sin(z) - np.cos(z) * np.tanh(z)))
    assert omegas(made, 4) == pytest.approx(verify.roots(f, 1, 20, 4, 0.05) ** 2, rel=1e-5)


def test_thick_pinned_bar():
    """Timoshenko, both ends pinned: r2 s w^4 - (1 + n2 (r2 + s)) w^2 + n4 = 0 for each n pi; s = EI/(kappa G A), EI = m = 1."""
    r2, s = 0.01 / 12, 0.003
    made = bar(rotary=r2, GA=1 / s)
    made.held = {*range(0, 3 * ELEMENTS + 3, 3), 1, 3 * ELEMENTS + 1}
    n2 = (np.pi * np.arange(1, 5)) ** 2
    b = 1 + n2 * (r2 + s)
    exact = np.sqrt((b - np.sqrt(b**2 - 4 * r2 * s * n2**2)) / (2 * r2 * s))
    assert omegas(made, 4) == pytest.approx(exact, rel=2e-3)


def test_portal_sways_as_its_exact_stiffness_says():
    """One bay, one storey: the corner turns, the beam rides along; half of the frame with antisymmetry."""
    H, W = 1.0, 1.4
    points, lines = frame._mesh([(0, 0, 0, H), (W, 0, W, H), (0, H, W, H)], 30)
    made = frame._bars(points, lines)
    made.EI[:], made.m[:], made.EA[:] = 1.0, 1.0, 1e7
    made.held = {3 * i + k for i, (_, y) in enumerate(points) if y < 1e-9 for k in range(3)}

    def sway(z: float) -> float:
        post, half = verify.dynamic(z, H), verify.dynamic(z, W / 2)
        K = np.array([[post[3, 3] + verify._pinned(half), post[3, 2]], [post[2, 3], post[2, 2] - z**4 * W / 2]])
        return float(np.linalg.det(K))

    assert np.sqrt(omegas(made, 1)[0]) == pytest.approx(verify.roots(sway, 0.5, 4, 1, 0.01)[0], rel=1e-4)


def test_plate_on_knife_edges():
    """Navier: omega = pi^2 (m^2/a^2 + n^2/b^2) sqrt(D/rho h)."""
    a, b, columns, rows = 1.0, 0.7, 10, 8
    made = Assembly(*plate.matrices(a, b, columns, rows))
    for i, j in np.ndindex(columns + 1, rows + 1):
        first = 4 * (i * (rows + 1) + j)
        made.held |= {first, first + 2} if i in (0, columns) else set()
        made.held |= {first, first + 1} if j in (0, rows) else set()
    exact = sorted(np.pi**2 * ((m / a) ** 2 + (n / b) ** 2) for m in range(1, 6) for n in range(1, 6))
    assert omegas(made, 5) == pytest.approx(exact[:5], rel=5e-4)


def test_plate_agrees_with_morley_elements():
    """A plate clamped along an edge, by another element of another library."""
    skfem = pytest.importorskip("skfem")
    from skfem.helpers import dd, ddot, eye, trace

    mesh = skfem.MeshTri.init_tensor(np.linspace(0, 1, 41), np.linspace(0, 0.7, 29))
    basis = skfem.Basis(mesh, skfem.ElementTriMorley())
    bend = skfem.BilinearForm(lambda u, v, _: ddot((1 - plate.NU) * dd(u) + plate.NU * eye(trace(dd(u)), 2), dd(v)))
    K, M = bend.assemble(basis), skfem.BilinearForm(lambda u, v, _: u * v).assemble(basis)
    free = basis.complement_dofs(basis.get_dofs(lambda x: x[0] < 1e-9))
    from scipy.sparse.linalg import eigsh

    found = np.sqrt(np.sort(eigsh(K[free][:, free], 4, M[free][:, free], sigma=0)[0]))
    made = Assembly(*plate.matrices(1.0, 0.7, plate.COLUMNS, plate.ROWS))
    made.held = set(plate.clamped_edge(plate.ROWS))
    assert omegas(made, 4) == pytest.approx(found, rel=5e-3)


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
def test_bar_agrees_with_calculix():
    """A slender solid with a soft stretch and a mass."""
    from benchmarks.blind.solids import Solid, modes

    solid = Solid(1.0, 1 / 150, 2.1e11, 7850.0, segment=(0.4, 0.6, 0.6), masses=[(1.0, 0.0)])
    solid = Solid(1.0, 1 / 150, 2.1e11, 7850.0, segment=(0.4, 0.6, 0.6), masses=[(0.8, 0.1 * solid.line)])
    made = bar()
    made.EI[(made.along > 0.4) & (made.along < 0.6)] *= 0.6
    made.weight({3 * round(0.8 * ELEMENTS) + 1: 1.0}, 0.1)
    assert made.modes(3)[0] * verify.unit(solid) * 2 * np.pi == pytest.approx(modes(solid)[0][:3], rel=2e-3)


def test_slipping_layers_lie_between_bonded_and_loose():
    first = []
    for size in (None, 1e-9, 1e9):
        blank = beam.beam(np.random.default_rng(3), "pinned", layer=fields.LAYER)
        if size is not None:
            log_uniform, fields.log_uniform = fields.log_uniform, lambda rng, low, high, size=size: size
            try:
                fields.slipping(blank, np.random.default_rng(1))
            finally:
                fields.log_uniform = log_uniform
        first.append(blank.truth.modes(1)[0][0])
    bonded, loose, stiff = first
    assert stiff == pytest.approx(bonded, rel=1e-3) and loose < 0.85 * bonded


def test_a_shallow_arch_gains_in_its_first_mode_alone():
    """Pinned, of rise a: omega_1^2 rises by EA a^2 pi^4 / (2 m L^4), as the thrust does no work in the other modes."""
    blank = beam.beam(np.random.default_rng(3), "pinned")
    truth, L, before = blank.truth, blank.span, omegas(blank.truth, 4)
    a = links.arch(blank, np.random.default_rng(1)).size
    gain = truth.EA.mean() * a**2 * np.pi**4 / (2 * truth.m.mean() * L**4)
    expected = np.sort(np.concatenate([[before[0] ** 2 + gain], before[1:] ** 2]))
    assert omegas(truth, 4) ** 2 == pytest.approx(expected, rel=1e-3) and gain > 0.1 * before[0] ** 2


def test_overall_bending_of_one_storey_under_a_static_force():
    """u = P / k + P / (4 k_turn): the floor turns by half the lever of the force."""
    blank = chain.chain(np.random.default_rng(3), storeys=True)
    blank.truth.springs, blank.places = blank.truth.springs[:1], {0: (0.0, 1.0)}
    truth, (_, k) = blank.truth, blank.truth.springs[0]
    truth.base = tuple(one[:1, :1] for one in truth.base)
    truth.n = 1
    turn = links.overall_bending(blank, np.random.default_rng(1)).size
    flexibility = np.linalg.inv(truth.matrices()[0])[0, 0]
    assert flexibility == pytest.approx(1 / k + 1 / (4 * turn), rel=1e-12)


def predicted(path: Path, blank: Blank) -> np.ndarray:
    """The lowest five frequencies of a deck as it stands, in Hz."""
    said = subprocess.run([sys.executable, "-m", "mouse_cli", "modes", "--json", path], capture_output=True, check=True)
    return np.array([one["hz"] for one in json.loads(said.stdout)["modes"]][blank.rigid :][:5])


def nominal(kind: Kind, folder: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[Path, Blank, np.ndarray]:
    """Deck, structure and frequencies of a kind whose parameters are as its deck has them."""
    monkeypatch.setattr(case, "spread", lambda rng, sd: 1.0)
    blank, mechanisms = kind.made(11)
    truth = truth_of(blank, 5)
    test = measured(np.random.default_rng(1), blank, truth, QUALITIES["A"], 0, "")
    return write(folder, "deck", Trial(kind.name, "A", blank, mechanisms, test, "", 0.0)), blank, truth.frequency


@pytest.mark.parametrize("kind", [k for k in kinds() if k.name.startswith("control/")], ids=lambda kind: kind.name)
def test_decks_of_controls_lack_nothing(kind, tmp_path, monkeypatch):
    path, blank, truth = nominal(kind, tmp_path, monkeypatch)
    assert predicted(path, blank) == pytest.approx(truth, rel=4e-4)


@pytest.mark.parametrize("kind", [k for k in kinds() if k.name.endswith("/shear")], ids=lambda kind: kind.name)
def test_decks_of_thick_structures_lack_shear(kind, tmp_path, monkeypatch):
    """Their own elements after Timoshenko have the frequencies of the truth; those of the deck are 3 % too high in one mode."""
    path, blank, truth = nominal(kind, tmp_path, monkeypatch)
    assert max(predicted(path, blank) / truth) > 1.03
    path.write_text(path.read_text().replace("type: beam,", "type: beam, theory: timoshenko,"))
    assert predicted(path, blank) == pytest.approx(truth, rel=2e-3)

"""The element library beside CalculiX (ccx): springs and masses, a truss, beams as solids, a frame in space."""

import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "reference"))
from element_meshes import STEEL, elements, hertz, matrices, mesh, pairs

from mouse_cli.terms.build import built

pytestmark = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
ALL = range(6)


def _ccx(folder: Path, deck: str) -> list[str]:
    """Lines of the results that ccx prints for a deck."""
    (folder / "job.inp").write_text(deck)
    subprocess.run(["ccx", "job"], cwd=folder, capture_output=True, timeout=60, check=True)
    return (folder / "job.dat").read_text().splitlines()


def frequencies(folder: Path, deck: str, count: int) -> np.ndarray:
    """The lowest frequencies in Hz: fourth number of the first table."""
    rows = [line.split() for line in _ccx(folder, f"{deck}*STEP\n*FREQUENCY\n{count}\n*END STEP\n")]
    return np.array([float(row[3]) for row in rows if len(row) == 5 and row[0].isdigit()][:count])


def displacements(folder: Path, deck: str, loads: dict[tuple[int, int], float]) -> np.ndarray:
    """Translations (k, 3) of all nodes under loads {(node, direction from 1): N}."""
    forces = "".join(f"{node},{d},{value}\n" for (node, d), value in loads.items())
    lines = _ccx(folder, f"{deck}*STEP\n*STATIC\n*CLOAD\n{forces}*NODE PRINT,NSET=NALL\nU\n*END STEP\n")
    rows = [line.split() for line in lines]
    return np.array([[float(x) for x in row[1:4]] for row in rows if len(row) in (4, 7) and row[0].isdigit()])


def nodes(points: np.ndarray) -> str:
    """The cards of the nodes."""
    return "*NODE,NSET=NALL\n" + "".join(f"{i},{x:.16g},{y:.16g},{z:.16g}\n" for i, (x, y, z) in enumerate(points, 1))


def material(nu: float) -> str:
    """Steel."""
    return f"*MATERIAL,NAME=M\n*ELASTIC\n{STEEL['E']},{nu}\n*DENSITY\n{STEEL['density']}\n"


def solved(given, loads: dict[tuple[int, int], float]) -> np.ndarray:
    """Translations (k, 3) of all nodes after mouse."""
    model = built(given)
    K, _ = matrices(given)
    f = np.zeros(6 * len(given.node_ids))
    for (node, d), value in loads.items():
        f[6 * (node - 1) + d - 1] = value
    return model.motion.apply(np.linalg.solve(K, model.motion.load(f))).reshape(-1, 6)[:, :3]


def test_chain_of_springs_and_masses(tmp_path):
    """SPRINGA and MASS: to the digits that ccx prints."""
    n = 20
    deck = nodes(np.arange(n + 1)[:, None] * [1.0, 0, 0])
    for i in range(1, n + 1):
        deck += f"*ELEMENT,TYPE=SPRINGA,ELSET=S{i}\n{i},{i},{i + 1}\n*SPRING,ELSET=S{i}\n1.\n{1000 * i}.\n"
        deck += f"*ELEMENT,TYPE=MASS,ELSET=M{i}\n{100 + i},{i + 1}\n*MASS,ELSET=M{i}\n{i + 1}.\n"
    deck += "*BOUNDARY\n1,1,3\n" + "".join(f"{i},2,3\n" for i in range(2, n + 2))
    springs = elements("spring", pairs(n), TX=1000.0 * np.arange(1, n + 1))
    masses = elements("mass", np.arange(1, n + 1)[:, None], 101, mass=np.arange(2.0, n + 2))
    points = np.arange(n + 1)[:, None] * [1.0, 0, 0]
    found = hertz(mesh(points, [springs, masses], [(0, ALL)], directions=(0,)))
    assert found[:4] == pytest.approx(frequencies(tmp_path, deck, 4), rel=1e-6)


def test_truss(tmp_path):
    """T3D2 under static loads, to the digits that ccx prints. (Its frequencies are not: ccx lets each bar turn about itself.)"""
    points = np.array([[0, 0, 0], [1, 0.3, 0], [2.2, 0, 0], [2.2, 1, 0.5], [1, 1, 1.2]])
    bars = np.array([(1, 2), (2, 3), (3, 4), (4, 5), (5, 1), (2, 5), (2, 4), (1, 4), (3, 5), (1, 3)])
    deck = nodes(points) + "*ELEMENT,TYPE=T3D2,ELSET=R\n"
    deck += "".join(f"{i},{a},{b}\n" for i, (a, b) in enumerate(bars, 1)) + material(0.0)
    deck += "*SOLID SECTION,ELSET=R,MATERIAL=M\n1.E-4\n*BOUNDARY\n1,1,3\n3,1,3\n2,3,3\n"
    loads = {(4, 1): 1000.0, (5, 3): -2000.0, (2, 2): 500.0}
    rods = elements("rod", bars - 1, E=STEEL["E"], A=1e-4, density=STEEL["density"])
    found = solved(mesh(points, [rods], [(0, range(3)), (2, range(3)), (1, (2,))]), loads)
    assert found == pytest.approx(displacements(tmp_path, deck, loads), rel=2e-6, abs=1e-15)


def test_cantilever_of_solid_elements(tmp_path):
    """B32R, which ccx makes into one quadratic solid across the section: Timoshenko's beam with shear that cannot warp.

    So the shear coefficient is 1, and without Poisson's ratio the clamp adds no stiffness; torsion, whose warping such a solid
    holds back, is left out. Euler-Bernoulli is off by 0.1 % in the first and 3 % in the seventh bending mode.
    """
    n, height, width = 60, 0.06, 0.04
    points = np.arange(2 * n + 1)[:, None] * [1 / (2 * n), 0, 0]
    deck = nodes(points) + "*ELEMENT,TYPE=B32R,ELSET=B\n"
    deck += "".join(f"{i + 1},{2 * i + 1},{2 * i + 2},{2 * i + 3}\n" for i in range(n)) + material(0.0)
    deck += f"*BEAM SECTION,ELSET=B,MATERIAL=M,SECTION=RECT\n{width},{height}\n0,1,0\n*BOUNDARY\n1,1,6\n"
    expected = np.delete(frequencies(tmp_path, deck, 8), 5)  # the sixth is torsion
    found = {}
    for theory in ("timoshenko", "euler-bernoulli"):
        beam = elements(
            "beam",
            pairs(n),
            options={"theory": theory},
            **{**STEEL, "nu": 0.0},
            A=height * width,
            Iy=width * height**3 / 12,
            Iz=height * width**3 / 12,
            kappa_y=1.0,
            kappa_z=1.0,
        )
        given = mesh(points[::2], [beam], [(0, ALL)], directions=(0, 1, 2, 4, 5))
        found[theory] = hertz(given)[:7]
    assert found["timoshenko"] == pytest.approx(expected, rel=5e-5)
    assert found["euler-bernoulli"][0] / expected[0] - 1 == pytest.approx(1e-3, rel=0.1)
    assert found["euler-bernoulli"][6] / expected[6] - 1 > 0.02


def test_skew_cantilever(tmp_path):
    """U1, the beam of ccx, along any direction in space, with unequal moments of inertia about its oriented axes.

    One element, since U1 does not pass its moments on to the next; and without shear, whose deflection it subtracts.
    """
    along, normal = np.array([2.0, 1, 0.5]) / np.sqrt(5.25), np.array([-0.5, 0, 2.0]) / np.sqrt(4.25)
    points = np.array([[0.0], [1.3]]) * along
    area, I1, I2 = 2.4e-3, 7.2e-7, 3.2e-7
    deck = nodes(points) + "*USER ELEMENT,TYPE=U1,NODES=2,INTEGRATION POINTS=2,MAXDOF=6\n*ELEMENT,TYPE=U1,ELSET=B\n"
    deck += "1,1,2\n" + material(0.3)
    deck += f"*BEAM SECTION,ELSET=B,MATERIAL=M,SECTION=GENERAL\n{area},{I1},0.,{I2},1.e12\n"
    deck += ",".join(f"{x:.16g}" for x in normal) + "\n*BOUNDARY\n1,1,6\n"
    loads = {(2, 1): 1000.0, (2, 2): -500.0, (2, 3): 700.0}
    beams = elements("beam", pairs(1), options={"orientation": normal}, **STEEL, A=area, Iy=I2, Iz=I1, J=I1 + I2)
    found, expected = solved(mesh(points, [beams], [(0, ALL)]), loads), displacements(tmp_path, deck, loads)
    assert found == pytest.approx(expected, rel=1e-6, abs=1e-6 * np.abs(expected).max())

"""Makes the files of this folder and ../plate_calculix.yaml with CalculiX (ccx): matrices, group matrices, simulated test.

    python make.py        writes everything anew; needs ccx 2.20 or later in the PATH, numpy and mouse

Stiffness is linear in Young's modulus, so that K with one modulus halved, subtracted from K, gives that group's share.
The test is CalculiX's own eigensolution of the same mesh with other moduli, and noise from a fixed seed.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from mouse_cli.formats.matrix_files import market, read_matrix

HERE = Path(__file__).parent
NOMINAL = {"ALU": 70e9, "CFRP": 48e9}  # Pa
TRUE = {"ALU": 66.5e9, "CFRP": 51.6e9}
MODES, SEED = 6, 1
DIRECTIONS = ("TX", "TY", "TZ")
FREQUENCY_SD, SHAPE_SD = 0.001, 0.02  # of each frequency; of the largest component of a mode
SENSORS = (("TZ", (36, 38, 40, 42, 44, 45, 46, 47, 50, 52, 54, 56)), ("TY", (45, 47)))  # on the upper face
FREQUENCIES = """\
*FREQUENCY
%d
*NODE PRINT, NSET=FREE
U
"""
MATRICES = "*FREQUENCY, SOLVER=MATRIXSTORAGE\n%d\n"


def mesh() -> str:
    """A strip 0.4 x 0.12 x 0.012 m of 4 x 1 x 1 solids (C3D20), clamped at x = 0; set ALU to x = 0.2 m, CFRP beyond."""
    lines = ["** Cantilever strip of two materials; unit system m, kg, s", "*NODE, NSET=ALL"]
    places = [(i, j, k) for k in range(3) for j in range(3) for i in range(9) if i % 2 + j % 2 + k % 2 < 2]
    number = {place: n for n, place in enumerate(places, 1)}
    lines += [f"{n}, {0.05 * i:.3f}, {0.06 * j:.3f}, {0.006 * k:.3f}" for (i, j, k), n in number.items()]
    square = [(0, 0), (2, 0), (2, 2), (0, 2)]
    middles = [(1, 0), (2, 1), (1, 2), (0, 1)]
    corners = [(*c, k) for k in (0, 2) for c in square]
    edges = [(*c, k) for k in (0, 2) for c in middles] + [(*c, 1) for c in square]
    for name, columns in (("ALU", (0, 2)), ("CFRP", (4, 6))):
        lines.append(f"*ELEMENT, TYPE=C3D20, ELSET={name}")
        for x in columns:
            nodes = [number[x + i, j, k] for i, j, k in corners + edges]
            words = [str(n) for n in (x // 2 + 1, *nodes)]
            lines += [", ".join(words[:15]) + ",", ", ".join(words[15:])]
    clamped = [n for (i, _, _), n in number.items() if i == 0]
    free = [n for n in number.values() if n not in clamped]
    lines += ["*NSET, NSET=ROOT", ", ".join(map(str, clamped)), "*NSET, NSET=FREE"]
    lines += [", ".join(map(str, free[i : i + 12])) + "," for i in range(0, len(free), 12)]
    return "\n".join([*lines, "*BOUNDARY", "ROOT, 1, 3"]) + "\n"


def deck(E: dict[str, float], step: str) -> str:
    """The input of CalculiX for Young's moduli `E`."""
    text = mesh()
    for name, (poisson, density) in {"ALU": (0.33, 2700.0), "CFRP": (0.30, 1550.0)}.items():
        text += f"*MATERIAL, NAME={name}\n*ELASTIC\n{E[name]:.6e}, {poisson}\n*DENSITY\n{density}\n"
        text += f"*SOLID SECTION, ELSET={name}, MATERIAL={name}\n"
    return text + "*STEP\n" + step % MODES + "*END STEP\n"


def ccx(folder: Path, name: str, text: str) -> Path:
    """Path, without suffix, of the files of a run."""
    (folder / f"{name}.inp").write_text(text)
    subprocess.run(["ccx", name], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    return folder / name


def solved(path: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Natural frequencies in Hz (m,), node numbers (k,) and displacements (m, k, 3) that a run printed."""
    text = path.with_suffix(".dat").read_text()
    table = text.split("P A R T I C I P A T I O N")[0]
    rows = re.findall(r"^ +(\d+) +(\S+E\S+) +(\S+E\S+) +(\S+E\S+) +(\S+E\S+) *$", table, re.M)
    blocks = re.findall(r"displacements \(vx,vy,vz\).*\n\n((?: +\d+ .*\n)+)", text)
    values = np.array([[line.split() for line in block.splitlines()] for block in blocks], dtype=float)
    return np.array([float(row[3]) for row in rows]), values[0, :, 0].astype(int), values[:, :, 1:]


def main() -> None:
    """Write all files."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        run = ccx(folder, "plate", deck(NOMINAL, MATRICES))
        for suffix in ("inp", "sti", "mas", "dof"):
            (HERE / f"plate.{suffix}").write_text(run.with_suffix(f".{suffix}").read_text())
        K = read_matrix(str(run.with_suffix(".sti")))
        for name, E in NOMINAL.items():
            other = ccx(folder, f"half_{name}", deck(NOMINAL | {name: E / 2}, MATRICES))
            slope = (K - read_matrix(str(other.with_suffix(".sti")))) / (E / 2 / 1e9)  # N/m for each GPa
            slope[abs(slope) < 1e-11 * abs(slope).max()] = 0  # digits that the file did not hold
            (HERE / f"{name.lower()}.mtx").write_text(market.text(slope, f"dK/dE of {name}, N/m for each GPa"))
        frequency, nodes, shapes = solved(ccx(folder, "true", deck(TRUE, FREQUENCIES)))
        before, _, _ = solved(ccx(folder, "before", deck(NOMINAL, FREQUENCIES)))
    write_deck(frequency[:MODES], before[:MODES], nodes, shapes[:MODES])


def write_deck(
    frequency: np.ndarray, before: np.ndarray, nodes: np.ndarray, shapes: np.ndarray, seed: int = SEED
) -> None:
    """The test, with noise, into the deck."""
    rng = np.random.default_rng(seed)
    place = {node: i for i, node in enumerate(nodes.tolist())}
    dofs = [(node, DIRECTIONS.index(d)) for d, listed in SENSORS for node in listed]
    phi = np.array([shapes[:, place[node], d] for node, d in dofs])
    phi /= abs(phi).max(axis=0)
    phi += SHAPE_SD * rng.standard_normal(phi.shape)
    measured = frequency * (1 + FREQUENCY_SD * rng.standard_normal(len(frequency)))
    labels = ", ".join(f"{node}{DIRECTIONS[d]}" for node, d in dofs)
    rows = "\n".join("      - [" + ", ".join(f"{x:.3f}" for x in row) + "]" for row in phi)
    shown = ", ".join(f"{f:.2f}" for f in before)
    text = (HERE / "deck.txt").read_text()
    text = text.replace("FREQUENCY", ", ".join(f"{f:.3f}" for f in measured)).replace("DOFS", labels)
    (HERE.parent / "plate_calculix.yaml").write_text(text.replace("SHAPES", rows).replace("BEFORE", shown))


if __name__ == "__main__":
    sys.exit(main())

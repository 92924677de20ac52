"""CalculiX (ccx) as the source of truth: runs, results, cache."""

import hashlib
import json
import os
import re
import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

EDITION = 3  # raised whenever truths are made otherwise than before: old ones in the cache are then made anew


@dataclass(frozen=True)
class Modes:
    """Natural frequencies (m,) in Hz, and displacements (m, k, 3) at the k nodes printed, in the order of `nodes`."""

    frequency: np.ndarray
    nodes: np.ndarray
    shapes: np.ndarray


def solve(text: str) -> Modes:
    """Modes of an input whose last step is *FREQUENCY with *NODE PRINT of U for one set of nodes.

    RuntimeError: ccx gave no modes.
    """
    with tempfile.TemporaryDirectory() as folder:
        data = run(Path(folder), text).with_suffix(".dat").read_text()
    return read(data)


def run(folder: Path, text: str) -> Path:
    """Path, without suffix, of the files of a run of ccx in `folder`, on one thread."""
    (folder / "job.inp").write_text(text)
    one = os.environ | {"OMP_NUM_THREADS": "1"}
    done = subprocess.run(["ccx", "job"], cwd=folder, capture_output=True, text=True, env=one, timeout=600)
    if done.returncode or "*ERROR" in done.stdout:
        raise RuntimeError(done.stdout[-2000:] + done.stderr[-500:])
    return folder / "job"


def read(data: str) -> Modes:
    """What a .dat file holds: the last table of eigenvalues and the displacements printed after it."""
    table = data.split("E I G E N V A L U E   O U T P U T")[-1]
    rows = re.findall(
        r"^ +(\d+) +(\S+E\S+) +(\S+E\S+) +(\S+E\S+) +(\S+E\S+) *$", table.split("P A R T I C I P")[0], re.M
    )
    blocks = re.findall(r"displacements \(vx,vy,vz\).*\n\n((?: +\d+ .*\n)+)", table)
    if not rows or not blocks:
        raise RuntimeError("ccx printed no modes")
    blocks = [re.sub(r"(\d)([+-]\d{3})\b", r"\1E\2", block) for block in blocks]  # Fortran drops the E before -112
    values = np.array([[line.split() for line in block.splitlines()] for block in blocks], dtype=float)
    return Modes(np.array([float(row[3]) for row in rows]), values[0, :, 0].astype(int), values[:, :, 1:])


def cached(folder: Path, inputs: dict, make: Callable[[dict], dict[str, np.ndarray]]) -> dict[str, np.ndarray]:
    """`make(inputs)`, from `folder` when it was made before; `inputs` is the key, with EDITION."""
    key = hashlib.sha256(json.dumps([EDITION, inputs], sort_keys=True).encode()).hexdigest()[:24]
    path = folder / f"{key}.npz"
    if not path.exists():
        folder.mkdir(parents=True, exist_ok=True)
        scratch = path.with_suffix(f".{os.getpid()}.npz")
        np.savez_compressed(scratch, **make(inputs))
        scratch.replace(path)
    with np.load(path) as held:
        return dict(held)


def material(name: str, E: float, density: float, nu: float = 0.3) -> list[str]:
    """Cards of an isotropic material."""
    return [f"*MATERIAL, NAME={name}", "*ELASTIC", f"{E:.12g}, {nu}", "*DENSITY", f"{density:.12g}"]


def spring(number: int, ends: tuple[int, ...], k: float, direction: int = 2) -> list[str]:
    """Cards of a spring in a direction between two nodes, or from one to ground; a k without a decimal point is misread."""
    name = f"S{number}"
    directions = ", ".join([str(direction)] * len(ends))
    head = [f"*ELEMENT, TYPE=SPRING{len(ends)}, ELSET={name}", ", ".join(map(str, (number, *ends)))]
    return [*head, f"*SPRING, ELSET={name}", directions, f"{k:.12e}"]


def mass(number: int, node: int, kg: float) -> list[str]:
    """Cards of a mass on a node, which must not be that of a plane element or beam."""
    name = f"M{number}"
    return [f"*ELEMENT, TYPE=MASS, ELSET={name}", f"{number}, {node}", f"*MASS, ELSET={name}", f"{kg:.12e}"]

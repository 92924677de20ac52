"""Back into the solver: the extended model fitted, exported as a complete job, run by ccx, compared in modes not fitted."""

import subprocess
import sys
from pathlib import Path

import numpy as np

from benchmarks.blind.calculix import Modes, solve
from benchmarks.blind.imported.parts import Concealed, Mesh, cards, step

HELD_OUT = 4  # modes of the structure above those of the test


def predicted(job: Path, extended: Path, mesh: Mesh, change: Concealed, fitted: int) -> tuple[float, float] | str:
    """Root mean square error of ln f of the held-out modes, by the job as it is drawn and by the revised one; or what failed."""
    result, revised = extended.with_name("result.json"), extended.with_name("revised.inp")
    words = [["run", extended, "--json", "-o", result],
             ["export", extended, "--for", "calculix", "--job", job, "--complete", "--result", result, "-o", revised]]  # fmt: skip
    for each in words:
        done = subprocess.run(
            [sys.executable, "-m", "mouse_cli", *map(str, each), "-q"], capture_output=True, text=True
        )
        if done.returncode > 1:
            return f"{each[0]}: {done.stderr.strip()[-200:]}"
    count = fitted + HELD_OUT + 2
    true = solve(cards(mesh, change, count))
    models = [solve(text + step(mesh, count)) for text in (cards(mesh, Concealed()), revised.read_text())]
    return tuple(_error(true, model, fitted) for model in models)


def _error(true: Modes, model: Modes, fitted: int) -> float:
    """Each held-out mode against the mode of the model whose shape is most alike."""
    elastic = np.flatnonzero(true.frequency > 1e-2 * true.frequency[-1])[fitted : fitted + HELD_OUT]
    nodes = np.intersect1d(true.nodes, model.nodes)
    x, y = (each.shapes[:, np.searchsorted(each.nodes, nodes)].reshape(len(each.shapes), -1) for each in (true, model))
    mac = (x @ y.T) ** 2 / np.outer((x**2).sum(axis=1), (y**2).sum(axis=1))
    like = mac[elastic].argmax(axis=1)
    return float(np.sqrt(np.mean(np.log(model.frequency[like] / true.frequency[elastic]) ** 2)))

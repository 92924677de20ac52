"""One cycle at 140 DOF - eigensolution, partials, estimate, tests - against its eigensolution alone, on one thread.

The cycle is taken from whole runs: the time of a long run less that of a short one, by the number of cycles between.
"""

import os

for name in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ[name] = "1"

import statistics
import time
from dataclasses import replace

import numpy as np

from mouse_cli.dynamics.eigen import eigensolution
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.parameter import Gaussian, Parameter
from mouse_cli.model.problem import Problem, RunOptions
from mouse_cli.model.structure import ListedElements, Structure
from mouse_cli.updating import run

N, FEW, MORE = 140, 2, 10


def timed(action) -> float:
    """Seconds of one call."""
    start = time.perf_counter()
    action()
    return time.perf_counter() - start


def chain(springs: int, modes: int, sensors: int) -> Problem:
    """A chain of 140 masses whose first `springs` springs are uncertain, tested in `modes` modes at `sensors` masses."""
    k = 1e5 * (1 + 0.3 * np.sin(np.arange(N)))
    K = np.diag(k + np.append(k[1:], 0.0)) - np.diag(k[1:], 1) - np.diag(k[1:], -1)
    rows = [(i, i) for i in range(springs)] + [(i, i + 1) for i in range(springs - 1)]
    A = np.zeros((len(rows), springs))
    A[np.arange(springs), np.arange(springs)] = 1.0
    A[np.arange(springs - 1), np.arange(1, springs)] = 1.0
    A[springs + np.arange(springs - 1), np.arange(1, springs)] = -1.0
    solution = eigensolution(K, np.eye(N))
    dofs = np.linspace(0, N - 1, sensors).astype(int)
    test = ModalTest(
        np.arange(1, modes + 1),
        solution.frequencies_hz[:modes] * 1.001,
        solution.frequencies_hz[:modes] * 0.001,
        dofs,
        solution.shapes[dofs, :modes],
        np.full((sensors, modes), 1e-3),
        "none",
    )
    return Problem(
        "chain of 140 masses",
        Structure(K, np.eye(N)),
        ListedElements([False] * len(rows), [r for r, _ in rows], [c for _, c in rows]),
        A,
        tuple(Parameter(f"k{i + 1}", 1e4, 1e5) for i in range(springs)),
        Gaussian(np.full(springs, 1e5), np.full(springs, 1e8)),
        test,
        RunOptions(pairing="number"),
    )


def cycles(problem: Problem, count: int) -> Problem:
    """The problem to be run for exactly `count` cycles of the loop of 1972."""
    return replace(problem, run=replace(problem.run, recursion="replaced", cycles=count))


for parameters, modes, sensors in ((60, 15, 30), (140, 20, 60)):
    problem = chain(parameters, modes, sensors)
    K, M = problem.structure.K, problem.structure.M
    seconds = []
    for _ in range(15):  # in turn: the difference of a long and a short run, and the eigensolutions of as many cycles
        short, long = (timed(lambda c=c: run(cycles(problem, c))) for c in (FEW, FEW + MORE))
        seconds.append(((long - short) / MORE, timed(lambda: [eigensolution(K, M) for _ in range(MORE)]) / MORE))
    cycle, alone = (1e3 * statistics.median(column) for column in zip(*seconds, strict=True))
    ratio = statistics.median(a / b for a, b in seconds)
    data = modes * (1 + sensors)
    print(
        f"{parameters} parameters, {data} data: cycle {cycle:.2f} ms, eigensolution {alone:.2f} ms, ratio {ratio:.2f}"
    )

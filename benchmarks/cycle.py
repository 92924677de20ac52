"""One cycle at 140 DOF - eigensolution, partials, estimate, tests - against its eigensolution alone, on one thread.

Taken in two ways. `in a run`: the time of a long run less that of a short one, by the number of cycles between. `once`: a
single cycle called between single eigensolutions before any run, when the allocator still gives its arrays back to the
system and fetches the pages anew (MALLOC_TRIM_THRESHOLD_ and MALLOC_MMAP_THRESHOLD_ set high make the difference go).
"""

import os

for name in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ[name] = "1"

import statistics
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from _paired import paired

from mouse_cli.dynamics.solver import eigensolution
from mouse_cli.estimators.bayes import solve
from mouse_cli.estimators.linear import LinearProblem
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.parameter import Gaussian, Parameter
from mouse_cli.model.problem import Problem, RunOptions
from mouse_cli.model.structure import ListedElements, Structure
from mouse_cli.updating import run
from mouse_cli.updating.prior_model import begin

N, FEW, MORE = 140, 2, 10


def timed(action) -> float:
    """Seconds of one call."""
    start = time.process_time()
    action()
    return time.process_time() - start


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


def by_itself(problem: Problem) -> Callable[[], None]:
    """One cycle from the prior: eigensolution, partials, estimate."""
    setting, start = begin(problem)

    def cycle() -> None:
        state = setting.state(start.u)
        solve(LinearProblem(state.T, state.residual, setting.sd, setting.coordinates.L))

    return cycle


for parameters, modes, sensors in ((60, 15, 30), (140, 20, 60)):
    problem = chain(parameters, modes, sensors)
    K, M = problem.structure.K, problem.structure.M
    once, alone, ratio_once = paired(
        by_itself(problem), lambda K=K, M=M: eigensolution(K, M), 41
    )  # first: later the allocator keeps pages
    seconds = []
    for _ in range(15):  # in turn: the difference of a long and a short run, and the eigensolutions of as many cycles
        short, long = (timed(lambda c=c: run(cycles(problem, c))) for c in (FEW, FEW + MORE))
        seconds.append(((long - short) / MORE, timed(lambda: [eigensolution(K, M) for _ in range(MORE)]) / MORE))
    in_run = 1e3 * statistics.median(cycle for cycle, _ in seconds)
    ratio_in_run = statistics.median(cycle / alone for cycle, alone in seconds)
    print(f"{parameters} parameters, {modes * (1 + sensors)} data: eigensolution {1e3 * alone:.2f} ms")
    print(
        f"  cycle in a run {in_run:.2f} ms, ratio {ratio_in_run:.2f}; once {1e3 * once:.2f} ms, ratio {ratio_once:.2f}"
    )

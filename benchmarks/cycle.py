"""One cycle at 140 DOF - eigensolution, partials, estimate - against its eigensolution alone, on one thread."""

import os

for name in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ[name] = "1"

import numpy as np
from _paired import paired

from mouse_cli.dynamics.eigen import eigensolution
from mouse_cli.estimators.bayes import solve
from mouse_cli.estimators._linear import LinearProblem
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.parameter import Gaussian, Parameter
from mouse_cli.model.problem import Problem, RunOptions
from mouse_cli.model.structure import ListedElements, Structure
from mouse_cli.updating.loop import _begin

N = 140


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


for parameters, modes, sensors in ((60, 15, 30), (140, 20, 60)):
    setting, start = _begin(chain(parameters, modes, sensors))

    def cycle(setting=setting, u=start.u) -> None:
        """Eigensolution, partials, estimate."""
        state = setting.state(u)
        solve(LinearProblem(state.T, state.residual, setting.sd, setting.coordinates.L))

    K, M = setting.problem.structure.K, setting.problem.structure.M
    a, b, ratio = paired(cycle, lambda K=K, M=M: eigensolution(K, M), 41)
    data = len(setting.y)
    print(f"{parameters} parameters, {data} data: cycle {a * 1e3:.2f} ms, eigensolution {b * 1e3:.2f} ms, ratio {ratio:.2f}")

"""Calibration of the chains that measure responses and forces: gains near 1 that are estimated beside the parameters.

A function is measured as g_o g_i H: one gain for each response by its name, the same in all measurements, and one for each force
of a measurement; each has the mean 1 and the standard deviation `gain_sd` that the deck gives. Gains are common to all lines.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.parameter import Parameter
from mouse_cli.model.problem import Problem
from mouse_cli.observables.frf import names
from mouse_cli.terms.further import with_parameters

Chains = dict[tuple[str, ...], tuple[str, float]]  # responses by their name, forces by that of their measurement too
_NONE = -1  # a chain whose gain is known


@dataclass(frozen=True)
class Gains:
    """outputs, inputs: for each measurement, which parameter is the gain of each response and of each force, from 0; _NONE."""

    outputs: tuple[np.ndarray, ...]
    inputs: tuple[np.ndarray, ...]

    def factor(self, k: int, theta: np.ndarray) -> np.ndarray:
        """What functions (o, i) of measurement k are multiplied by, at theta (p,)."""
        value = np.append(theta, 1.0)  # at _NONE
        return value[self.outputs[k]][:, None] * value[self.inputs[k]][None]

    def slopes(self, k: int, theta: np.ndarray, H: np.ndarray) -> Iterator[tuple[slice, np.ndarray]]:
        """dH/dtheta_j (f, o, i, 1) for each gain j of measurement k, of functions H (f, o, i) with their gains."""
        for j in sorted({*self.outputs[k].tolist(), *self.inputs[k].tolist()} - {_NONE}):
            power = (self.outputs[k] == j).astype(float)[:, None] + (self.inputs[k] == j).astype(float)
            yield slice(j, j + 1), (H * power / theta[j])[..., None]


def with_gains(problem: Problem) -> Problem:
    """The problem with a parameter for each gain that its measurements leave uncertain; itself where they leave none."""
    return with_parameters(
        problem, [Parameter(name, sd, 1.0, transform="log") for name, sd in chains(problem.frf).values()]
    )


def gains(problem: Problem, tests: tuple[FrfTest, ...]) -> Gains:
    """Which of the parameters of `problem`, as `with_gains` made it, are gains of `tests`."""
    known = chains(problem.frf)
    return numbered(tests, known, len(problem.parameters) - len(known))


def numbered(tests: tuple[FrfTest, ...], known: Chains, first: int = 0) -> Gains:
    """Gains of `tests`, those of `known` being parameters from number `first` on."""
    at = {key: first + i for i, key in enumerate(known)}
    outputs = (np.array([at.get(key, _NONE) for key in _responses(test)], int) for test in tests)
    inputs = (np.array([at.get(key, _NONE) for key in _forces(test)], int) for test in tests)
    return Gains(tuple(outputs), tuple(inputs))


def chains(tests: tuple[FrfTest, ...], unstated: float = 0.0) -> Chains:
    """Name and sd of the gain of each chain, as the first measurement says that has it; unstated: sd where one says none."""
    found: Chains = {}
    for test in tests:
        sd = test.gain_sd or unstated
        for keys, kind in ((_responses(test), "response"), (_forces(test), "force")) if sd else ():
            for name, key in zip(names(test)[kind == "force"], keys, strict=True):
                title = f" of {test.title}" if kind == "force" and len(tests) > 1 else ""
                found.setdefault(key, (f"gain of {kind} {name}{title}", sd))
    return found


def _responses(test: FrfTest) -> list[tuple[str, ...]]:
    return [(name,) for name in names(test)[0]]


def _forces(test: FrfTest) -> list[tuple[str, ...]]:
    return [(test.title, name) for name in names(test)[1]]

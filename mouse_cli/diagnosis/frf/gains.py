"""Gains of the chains that measure responses and forces: each function is a little too large or too small, for all lines alike."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.model.frf_test import FrfTest
from mouse_cli.observables.frf import names

SD = 0.02  # of the gain of an accelerometer or of a force transducer, as calibrated, where the deck states none


@dataclass(frozen=True)
class Gains:
    """ln of the gains of t chains, N(0, sd) each. outputs, inputs: for each test, the chain of each response and of each force."""

    sd: np.ndarray
    outputs: tuple[np.ndarray, ...]
    inputs: tuple[np.ndarray, ...]

    @property
    def count(self) -> int:
        """How many chains there are."""
        return len(self.sd)

    def factor(self, i: int, u: np.ndarray) -> np.ndarray:
        """What functions (o, i) of test i are multiplied by, at u (t,) standard deviations."""
        ln = self.sd * u
        return np.exp(ln[self.outputs[i]][:, None] + ln[self.inputs[i]][None])

    def slopes(self, i: int, H: np.ndarray) -> np.ndarray:
        """dH/du (f, o, i, t) of test i, for functions H (f, o, i) as measured."""
        found = np.zeros((*H.shape, self.count), complex)
        for o, chain in enumerate(self.outputs[i]):
            found[:, o, :, chain] += self.sd[chain] * H[:, o]
        for j, chain in enumerate(self.inputs[i]):
            found[:, :, j, chain] += self.sd[chain] * H[:, :, j]
        return found


def gains(tests: tuple[FrfTest, ...]) -> Gains:
    """One chain for each name of a response, the same in all tests, and one for each force of each test."""
    chains: dict[object, int] = {}
    sd: list[float] = []

    def number(key: object, test: FrfTest) -> int:
        if key not in chains:
            chains[key] = len(sd)
            sd.append(test.gain_sd or SD)
        return chains[key]

    outputs = tuple(np.array([number(name, test) for name in names(test)[0]], int) for test in tests)
    inputs = tuple(np.array([number((k, n), test) for n in names(test)[1]], int) for k, test in enumerate(tests))
    return Gains(np.array(sd), outputs, inputs)

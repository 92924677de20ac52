"""Gains of the chains that measure responses and forces, and delays of responses behind the forces, in standard deviations, as the
unknowns of a diagnosis are.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mouse_cli.model.frf_test import FrfTest
from mouse_cli.updating import frf_gains

SD = 0.02  # of the gain of an accelerometer or of a force transducer, as calibrated, where the deck states none


@dataclass(frozen=True)
class Gains:
    """ln of the gains of t chains, N(0, sd) each, then delays (s) of the r of them that are of responses, N(0, late) each; of none
    where late is 0.

    names (t + r,): what they are called; chains: which gain each test has.
    """

    names: tuple[str, ...]
    sd: np.ndarray
    late: float
    chains: frf_gains.Gains

    @property
    def count(self) -> int:
        """How many unknowns there are, t + r."""
        return len(self.names)

    @cached_property
    def delays(self) -> tuple[np.ndarray, ...]:
        """For each test, which unknown is the delay of each response (o,); none where there are no delays."""
        if not self.late:
            return tuple(own[:0] for own in self.chains.outputs)
        responses = np.unique(np.concatenate(self.chains.outputs))
        return tuple(len(self.sd) + np.searchsorted(responses, own) for own in self.chains.outputs)

    def of_force(self, j: int) -> bool:
        """Whether unknown j is of a force."""
        return any(j in own for own in self.chains.inputs)

    def factor(self, i: int, u: np.ndarray, s: np.ndarray) -> np.ndarray:
        """What functions (n, o, i) of test i at s (n,), rad/s, are multiplied by, at u (t + r,) standard deviations."""
        gain = self.chains.factor(i, np.exp(self.sd * u[: len(self.sd)]))
        if not self.late:
            return gain
        return gain * np.exp(-s[:, None] * (self.late * u[self.delays[i]]))[:, :, None]

    def by_gains(self, i: int, H: np.ndarray) -> np.ndarray:
        """dH/du (f, o, i, t) of test i by the gains, for functions H (f, o, i) as measured."""
        found = np.zeros((*H.shape, len(self.sd)), complex)
        for at, slope in self.chains.slopes(i, np.ones(len(self.sd)), H):
            found[..., at] = self.sd[at] * slope
        return found

    def by_delays(self, i: int, H: np.ndarray, s: np.ndarray) -> np.ndarray:
        """dH/du (r, n, o, i) of test i by the delays, for its functions H (n, o, i) at s (n,), rad/s."""
        found = np.zeros((self.count - len(self.sd), *H.shape), complex)
        for o, j in enumerate(self.delays[i] - len(self.sd)):
            found[j, :, o] -= self.late * s[:, None] * H[:, o]
        return found


def gains(tests: tuple[FrfTest, ...], late: float = 0.0) -> Gains:
    """One chain for each name of a response, the same in all tests, and one for each force of each measurement; late: sd (s) of
    the delays of responses, 0: they have none.
    """
    known = frf_gains.chains(tests, SD)
    names, sd = zip(*known.values(), strict=True)
    numbered = frf_gains.numbered(tests, known)
    responses = np.unique(np.concatenate(numbered.outputs))
    names += tuple(names[j].removeprefix("gain of ") for j in responses if late)
    return Gains(names, np.array(sd), late, numbered)

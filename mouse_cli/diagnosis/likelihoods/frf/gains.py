"""Gains of the chains that measure responses and forces, in standard deviations, as the unknowns of a diagnosis are."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.model.frf_test import FrfTest
from mouse_cli.updating import frf_gains

SD = 0.02  # of the gain of an accelerometer or of a force transducer, as calibrated, where the deck states none


@dataclass(frozen=True)
class Gains:
    """ln of the gains of t chains, N(0, sd) each, and what they are called; chains: which of them each test has."""

    names: tuple[str, ...]
    sd: np.ndarray
    chains: frf_gains.Gains

    @property
    def count(self) -> int:
        """How many chains there are."""
        return len(self.sd)

    def of_force(self, j: int) -> bool:
        """Whether gain j is that of a force."""
        return any(j in own for own in self.chains.inputs)

    def factor(self, i: int, u: np.ndarray) -> np.ndarray:
        """What functions (o, i) of test i are multiplied by, at u (t,) standard deviations."""
        return self.chains.factor(i, np.exp(self.sd * u))

    def slopes(self, i: int, H: np.ndarray) -> np.ndarray:
        """dH/du (f, o, i, t) of test i, for functions H (f, o, i) as measured."""
        found = np.zeros((*H.shape, self.count), complex)
        for at, slope in self.chains.slopes(i, np.ones(self.count), H):
            found[..., at] = self.sd[at] * slope
        return found


def gains(tests: tuple[FrfTest, ...]) -> Gains:
    """One chain for each name of a response, the same in all tests, and one for each force of each measurement."""
    known = frf_gains.chains(tests, SD)
    names, sd = zip(*known.values(), strict=True)
    return Gains(names, np.array(sd), frf_gains.numbered(tests, known))

"""Measurements that would separate explanations."""

from dataclasses import dataclass
from enum import IntEnum


class Effort(IntEnum):
    """What a measurement takes, the least first: the band of the test, a sensor, several, a mass, a hold on the structure."""

    MODES = 1
    SENSOR = 2
    SHAPES = 3
    MASS = 4
    SUPPORT = 5


SETTLES, HELPS = 4.0, 1.0  # nats from which on a measurement will separate two explanations, and may


@dataclass(frozen=True)
class Proposal:
    """A measurement that would separate two explanations: predicted separation in nats, and the effort."""

    text: str
    between: tuple[str, str]
    separation: float
    effort: Effort = Effort.MODES

    @property
    def promise(self) -> int:
        """2: it will settle it; 1: it may; 0: it will not."""
        return int(self.separation > SETTLES) + int(self.separation >= HELPS)

    @property
    def outlook(self) -> str:
        """The same in words."""
        return ("will not settle it", "may settle it", "will settle it")[self.promise]

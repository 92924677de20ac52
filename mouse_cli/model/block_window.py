"""The window by which measured blocks of force and response were multiplied before their spectra were taken."""

from dataclasses import dataclass

# Of one shape; an exponential one is a decay rate
WINDOWS = ("hann", "hamming", "blackmanharris", "flattop", "uniform")


@dataclass(frozen=True)
class BlockWindow:
    """name: one of WINDOWS; seconds: length T of a block. burst: share of it, from its beginning, in which the force acts: 1 for a
    stationary random force, less for burst random, 0 for a blow at the beginning of each block.
    """

    name: str
    seconds: float
    burst: float = 1.0

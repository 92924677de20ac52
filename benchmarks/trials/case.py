"""What a trial is: a structure that has a model, what the model lacks of it, and what was measured."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from benchmarks.trials.assembly import Assembly

NEAR = 0.05  # of the span: tolerance of a site
REGION = 0.15  # of the span: tolerance of a region of physics without a name


@dataclass(frozen=True)
class Mechanism:
    """One thing that the model lacks.

    kind: what it is in words; physics and group: what the library calls it, empty outside of the library; at: its centre, in
    coordinates of the deck, None where it acts everywhere; reach: largest distance from there of a right answer; size: in units
    of its own; also: (physics, group) of the library that are as true, declared beforehand; properties: of which nameless
    fields would describe it; regions: boxes (from, to) where it acts most.
    """

    kind: str
    physics: str = ""
    group: str = ""
    at: tuple[float, ...] | None = None
    reach: float = 0.0
    size: float = 0.0
    also: tuple[tuple[str, str], ...] = ()
    properties: tuple[str, ...] = ()
    regions: tuple[tuple[tuple[float, ...], tuple[float, ...]], ...] = ()


@dataclass(frozen=True)
class Prior:
    """Standard deviation of the logarithm of a parameter of the deck, and what multiplies it in the truth."""

    sd: float
    scale: Callable[[float], None]


@dataclass
class Line:
    """Elements of the truth from one end of a member to the other, and its points (k, 2)."""

    nodes: np.ndarray
    elements: np.ndarray
    points: np.ndarray

    @property
    def length(self) -> float:
        """In m."""
        return float(np.hypot(*(self.points[-1] - self.points[0])))

    @property
    def upright(self) -> bool:
        """Whether it stands."""
        step = abs(self.points[-1] - self.points[0])
        return bool(step[1] > step[0])

    def point(self, share: float) -> tuple[float, float]:
        """Coordinates at a share of the length."""
        x, y = self.points[0] + share * (self.points[-1] - self.points[0])
        return float(x), float(y)


@dataclass
class Blank:
    """A structure as it stands before anything is missing from its model, its parameters at their true values.

    truth: K and M; model: the deck up to its test; sensors: label and degree of freedom of all that may be measured; nodes and
    elements: coordinates by their numbers in the deck; stiffness (N/m), first (rad/s), weight (kg): scales; parameters: true values
    over those of the deck; priors: of the same.
    """

    family: str
    truth: Assembly
    model: str
    sensors: list[tuple[str, int]]
    nodes: dict[str, tuple[float, ...]]
    span: float
    weight: float
    first: float
    stiffness: float
    EI: float = 0.0
    line_mass: float = 0.0
    rigid: int = 0
    lines: list[Line] = field(default_factory=list)
    feet: list[int] = field(default_factory=list)  # nodes of the truth that are clamped or pinned
    corners: list[tuple[int, int]] = field(default_factory=list)  # (line, 0 or 1): ends that join others
    masses: list[tuple[int, float]] = field(default_factory=list)  # (index of node in the truth, kg) that the deck has
    places: dict[int, tuple[float, float]] = field(default_factory=dict)  # coordinates of the nodes of the truth
    elements: dict[str, tuple[float, ...]] = field(default_factory=dict)
    parameters: dict[str, float] = field(default_factory=dict)
    priors: dict[str, Prior] = field(default_factory=dict)
    files: dict[str, str] = field(default_factory=dict)
    tuned: list[tuple[dict[int, float], np.ndarray]] = field(default_factory=list)  # springs that differ mode by mode
    kind: str = ""

    def near(self) -> float:
        """Tolerance of a site."""
        return NEAR * self.span


def drawn(rng: np.random.Generator, priors: dict[str, Prior]) -> dict[str, float]:
    """The true parameters over those of the deck, drawn from their priors and put into the truth."""
    factors = {name: spread(rng, prior.sd) for name, prior in priors.items()}
    for name, factor in factors.items():
        priors[name].scale(factor)
    return factors


def spread(rng: np.random.Generator, sd: float) -> float:
    """A factor whose logarithm has the standard deviation `sd`: what a prior of that width says."""
    return float(np.exp(sd * rng.standard_normal()))

"""What is known of the vehicle: the report's two lists of frequencies, and the stack from the top down."""

from dataclasses import dataclass

import numpy as np

PREDICTED = (1.121, 1.840, 3.051, 4.747, 8.064)  # Hz, Table 5-4: original model
MEASURED = (1.106, 1.821, 2.547, 3.443, 5.167)  # Hz, Table 5-4: test
E, NU = 7.1e10, 0.33  # aluminium; only E I matters until shear is asked for
TOLERANCE = 0.01  # of each predicted frequency

HEIGHT, MASS = 110.64, 2.767e6  # m (363 ft), kg at lift-off: National Air and Space Museum, Apollo to the Moon
FOOT = 0.3048


@dataclass(frozen=True)
class Stage:
    """Of the stack, from the top: length and radius in m, elements, share of the mass, thickness in m of the tube that has its EI.

    Lengths and diameters of stages: U.S. Space and Rocket Center, Huntsville. Shares of mass and thicknesses
    are rough; the escape tower is stiff on purpose, so that none of the five modes is its own.
    """

    name: str
    length: float
    radius: float
    elements: int
    share: float
    thickness: float


STAGES = (
    Stage("escape tower", 33 * FOOT, 0.6, 3, 0.0014, 0.012),
    Stage("command and service module", 34 * FOOT, 1.95, 2, 0.0105, 0.0012),
    Stage("adapter and instrument unit", 31 * FOOT, 2.7, 2, 0.0070, 0.003),
    Stage("S-IVB", (58 + 8 / 12) * FOOT, 21.667 / 2 * FOOT, 5, 0.0415, 0.005),
    Stage("S-II", 81.5 * FOOT, 33 / 2 * FOOT, 6, 0.1650, 0.008),
    Stage("S-IC", 138 * FOOT, 33 / 2 * FOOT, 10, 0.7746, 0.010),
)
ELEMENTS = sum(stage.elements for stage in STAGES)
UPPER = ELEMENTS // 2  # elements of the upper half, which the report let fluctuate


@dataclass(frozen=True)
class Vehicle:
    """x (29,): nodes in m from the top. Of elements (28,): radius in m, mass per length in kg/m, EI in N m2, their stage."""

    x: np.ndarray
    radius: np.ndarray
    line_mass: np.ndarray
    EI: np.ndarray
    stage: np.ndarray

    @property
    def length(self) -> np.ndarray:
        """Of elements (28,)."""
        return np.diff(self.x)

    @property
    def mass(self) -> float:
        """Total in kg."""
        return float(self.line_mass @ self.length)

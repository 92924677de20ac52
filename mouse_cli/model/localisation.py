"""What measured shapes alone say of where physics is missing, whatever its law: sites, energies, implied force laws."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.model.site import Site


@dataclass(frozen=True)
class Place:
    """A place where one force that the model lacks could make all measured shapes: score in nats below the best."""

    site: Site
    channel: str
    probability: float
    deficit: float


@dataclass(frozen=True)
class Location:
    """Resolvent matching: places by probability, those of the 90 % region first; p: whether any single place can be it."""

    places: tuple[Place, ...]
    region: int
    p: float

    @property
    def single(self) -> bool:
        """Whether a force at one place may explain all shapes."""
        return self.p > 1e-3


@dataclass(frozen=True)
class EnergyMap:
    """Error in the constitutive relation: where the stiffness of the model and the measured shapes part.

    sites (j,) of elements, nodes or degrees of freedom; share (j,) of the whole that lies there, 1 in all; mode (m,): numbers of
    the measured modes, error (m,): of each, relative to the strain energy of its shape.
    """

    sites: tuple[Site, ...]
    share: np.ndarray
    mode: np.ndarray
    error: np.ndarray

    @property
    def order(self) -> np.ndarray:
        """Indices (j,) of the sites, the largest share first."""
        return np.argsort(-self.share, kind="stable")

    @property
    def half(self) -> int:
        """How few sites hold half of the whole."""
        return int(np.searchsorted(np.cumsum(self.share[self.order]), 0.5)) + 1


@dataclass(frozen=True)
class Law:
    """The force law that data imply at a place, whatever its form: d = -1/(B' R(lambda) B), R = (K - lambda M)^-1 of the model.

    frequency_hz (m,): measured; stiffness, sd (m,): d there and its standard deviation; fitted (m,): what the cause gives. A
    spring is constant and positive, a mass is -m lambda, an oscillator has a pole.
    """

    site: Site
    unit: str
    frequency_hz: np.ndarray
    stiffness: np.ndarray
    sd: np.ndarray
    fitted: np.ndarray

"""What sensors read where a support holds the model: 0, until the support is flexible."""

from dataclasses import dataclass


@dataclass(frozen=True)
class HeldReading:
    """weight: of the degree of freedom called `label`, which a support holds, in the reading of the sensor called `sensor`."""

    sensor: str
    label: str
    weight: float

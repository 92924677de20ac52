"""Data of a test that no fit uses: modes, sensors and configurations that a model must predict."""

from dataclasses import dataclass, field

import numpy as np

from mouse_cli.model.arrays import freeze
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.recording import Recording


@dataclass(frozen=True)
class Altered:
    """Another configuration of the same structure, k natural frequencies of which were measured.

    masses, springs: kg, and N/m to the ground, added at degrees of freedom from 0. number (k,): mode numbers from 1, rigid-body
    modes counted. frequency_hz, frequency_sd_hz (k,).
    """

    title: str
    masses: dict[int, float]
    springs: dict[int, float]
    number: np.ndarray
    frequency_hz: np.ndarray
    frequency_sd_hz: np.ndarray

    def __post_init__(self) -> None:
        k = len(self.number)
        freeze(self, int, number=(k,))
        freeze(self, frequency_hz=(k,), frequency_sd_hz=(k,))


@dataclass(frozen=True)
class HoldOut:
    """What of a test is kept from every fit.

    whole: the test as measured. modes (h,), sensors (t,): its columns and rows, from 0, that are held out; a datum is used in
    fits when neither its mode nor its sensor is held out.
    """

    whole: ModalTest
    modes: np.ndarray = field(default_factory=lambda: np.zeros(0, int))
    sensors: np.ndarray = field(default_factory=lambda: np.zeros(0, int))
    altered: tuple[Altered, ...] = ()

    def __post_init__(self) -> None:
        freeze(self, int, modes=(len(self.modes),), sensors=(len(self.sensors),))

    @property
    def fitted(self) -> ModalTest:
        """The part of the test that fits use: the modes and the sensors that stay."""
        return part(self.whole, self._kept_modes, self._kept_sensors)

    @property
    def test(self) -> ModalTest | None:
        """The modes that are held out, at the sensors that stay; None where none is."""
        return part(self.whole, self.modes, self._kept_sensors) if len(self.modes) else None

    @property
    def readings(self) -> ModalTest | None:
        """The modes that stay, at the sensors that are held out; None where none is."""
        return part(self.whole, self._kept_modes, self.sensors) if len(self.sensors) else None

    @property
    def _kept_modes(self) -> np.ndarray:
        return np.setdiff1d(np.arange(self.whole.m), self.modes)

    @property
    def _kept_sensors(self) -> np.ndarray:
        return np.setdiff1d(np.arange(self.whole.s), self.sensors)


@dataclass(frozen=True)
class HeldRecords:
    """Frequency response functions and recordings, or lines and stretches of them, that no fit uses."""

    frf: tuple[FrfTest, ...] = ()
    recordings: tuple[Recording, ...] = ()


def part(test: ModalTest, modes: np.ndarray, sensors: np.ndarray) -> ModalTest:
    """The columns `modes` and the rows `sensors`, both from 0, of a test."""
    return ModalTest(
        test.number[modes],
        test.frequency_hz[modes],
        test.frequency_sd_hz[modes],
        test.dofs[sensors],
        test.shapes[np.ix_(sensors, modes)],
        test.shape_sd[np.ix_(sensors, modes)],
        test.scale,
        None if test.sensing is None else test.sensing[sensors],
        tuple(test.sensors[i] for i in sensors) if test.sensors else (),
    )

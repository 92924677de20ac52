"""Errors of theory: by how much the best model of its kind is still wrong, which a diagnosis allows for and never names."""

from dataclasses import dataclass, field, fields, replace
from typing import Any

import numpy as np

from mouse_cli.model.modal_test import ModalTest


def _share(default: float, meaning: str, source: str) -> Any:
    """A field of Theory, with its default, what it is and where the default comes from."""
    return field(default=default, metadata={"meaning": meaning, "source": source})


@dataclass(frozen=True)
class Theory:
    """Standard deviations of errors of theory, each a share (1), above 0 and at most 1.

    The first four are of modes and frequency response functions, the last two of recordings. Errors of different modes are
    independent, and independent of those of the test: variances add.
    """

    frequency: float = _share(
        4e-4,
        "sd of ln f of each mode, by which theory errs",
        "judgement: what well meshed slender bars with ideal joints and supports leave",
    )
    shape: float = _share(
        2e-3,
        "sd of each component of a shape by which theory errs, over the largest component of the shape; of an FRF, over the "
        "largest response at each line",
        "judgement: what well meshed slender bars leave",
    )
    mechanism: float = _share(
        0.01,
        "share of what a mechanism does to frequencies and shapes by which its theory errs",
        "judgement: a hinge is not a crack, and Timoshenko's bar is no solid; without it very accurate data find a second one",
    )
    configurations: float = _share(
        0.01,
        "sd of ln f of each mode by which theory errs in all configurations of a structure alike; of a model before and after a "
        "change, by as much of its stiffness in shapes too",
        "a measured beam in twenty configurations: below 1.1 % in every mode",
    )
    link_stiffness: float = _share(
        0.05,
        "sd of the stiffness of each part that no parameter of the deck reaches, as a share of it, for recordings",
        "judgement: scatter of nominal stiffness; an error of the linear model that is left out is found again as a law",
    )
    link_damping: float = _share(
        0.5,
        "sd of the damping of each part and mode that no parameter reaches, as a share of it, for recordings; of a mode at least "
        "1 % of critical, and 2 % where the deck has no damping",
        "judgement: damping is seldom known better than to a factor of about 1.5",
    )

    def __post_init__(self) -> None:
        for each in fields(self):
            value = getattr(self, each.name)
            if not 0 < value <= 1:
                raise ValueError(f"theory.{each.name} is {value:g}; it must be above 0 and at most 1")

    def beyond_default(self, test: ModalTest) -> ModalTest:
        """`test` with the errors of theory in its standard deviations as far as they exceed the defaults.

        An update takes the stated standard deviations s as they are. Where more error of theory than usual is stated, its tests of
        the model form must allow for it: s^2 + tau^2 - tau_0^2, tau of this theory and tau_0 of the default.
        """
        off, moved = (_excess(getattr(self, name), getattr(_DEFAULT, name)) for name in ("frequency", "shape"))
        if not off and not moved:
            return test
        largest = np.abs(np.nan_to_num(test.shapes)).max(axis=0, initial=0.0)
        return replace(
            test,
            frequency_sd_hz=np.hypot(test.frequency_sd_hz, off * test.frequency_hz),
            shape_sd=np.hypot(test.shape_sd, moved * largest),
        )


def _excess(value: float, default: float) -> float:
    """sqrt(value^2 - default^2), 0 where `value` is the smaller."""
    return float(np.sqrt(max(value**2 - default**2, 0.0)))


_DEFAULT = Theory()

"""What `mouse modify` answers: modes and functions before and after, what a target asks for, and where a change does most."""

from dataclasses import dataclass

import numpy as np

from mouse_cli._errors import Diagnostic
from mouse_cli._notebook import Shown
from mouse_cli.model.coupled import Peak
from mouse_cli.model.coupling import Connection, Modification, Sweep, Target
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.result import Forecast


@dataclass(frozen=True)
class Shifts:
    """Modes after the changes beside those before. partner (k,): the mode (from 0) before that each is most like, -1 for none;
    mac (k,); shift_hz (k,) and its standard deviation sd_hz (k,), from what both have in common."""

    partner: np.ndarray
    mac: np.ndarray
    shift_hz: np.ndarray
    sd_hz: np.ndarray


@dataclass(frozen=True)
class Need:
    """What a target needs at one place: `value` (kg or N/m, negative: to be taken away) with its sd; nan where nothing does it.

    sure: with which the chance of success is that of the confidence level. reached_hz: the mode as the modified model has it.
    limit_hz: how far the mode can be moved at that place by adding what the target names; nan where that was not asked.
    likeness: of the mode there with the mode before (MAC weighted by mass); far from 1 where another mode has come down or up.
    """

    target: Target
    place: str
    value: float
    sd: float
    sure: float
    reached_hz: float
    limit_hz: float
    likeness: float
    reason: str = ""


@dataclass(frozen=True)
class Place:
    """One place of a sweep: frequency of the mode with the thing there; of an absorber its mass ratio, tuning and damping
    ratio, and the peak of the mode by its static response."""

    name: str
    hz: float
    mass_ratio: float = np.nan
    tuned_hz: float = np.nan
    damping_ratio: float = np.nan
    peak: float = np.nan


@dataclass(frozen=True)
class Swept:
    """Places in the order of their effect, best first. before_hz: the mode without."""

    sweep: Sweep
    before_hz: float
    places: tuple[Place, ...]


@dataclass(frozen=True)
class ModifiedFunctions:
    """Functions before and after, with the variance that the parameters give them; sd_log (f, o, i): of ln|H| after.
    peaks_before, peaks: of both."""

    before: FrfTest
    after: FrfTest
    sd_log: np.ndarray
    peaks_before: tuple[Peak, ...] = ()
    peaks: tuple[Peak, ...] = ()


@dataclass(frozen=True)
class Modified(Shown):
    """The answer. connections: the changes as they act, absorbers tuned; labels of the modified model are those of `after`."""

    modification: Modification
    connections: tuple[Connection, ...]
    before: Forecast
    after: Forecast
    shifts: Shifts
    needs: tuple[Need, ...] = ()
    swept: tuple[Swept, ...] = ()
    functions: ModifiedFunctions | None = None
    warnings: tuple[Diagnostic, ...] = ()

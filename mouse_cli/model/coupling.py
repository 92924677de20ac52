"""Substructures that are put together, taken apart or modified: what joins what, and what is asked of the whole."""

from dataclasses import dataclass

import numpy as np

from mouse_cli._errors import Diagnostic
from mouse_cli._span import Span
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.problem import Problem
from mouse_cli.model.units import UNDECLARED, Units

BELOW, ABOVE, EXACTLY = "below", "above", "at"
MASS, SPRING, ABSORBER = "mass", "spring", "absorber"


@dataclass(frozen=True)
class Substructure:
    """One part, by a model or by measured functions, and the r places of it that are named anywhere.

    problem: the deck, None for a file of functions. frf: measured functions that stand for the part, None where its model does.
    removed: it is taken away from the others (decoupling). reciprocal: a function that was not measured is taken from the one with
    response and force exchanged. places (r,): names; weights (r, n), sparse or dense: what each reads of a model. responses,
    forces (r,): number of each place in frf, -1 where it was not measured or driven; signs (r,): -1 for a place read backwards.
    """

    name: str
    problem: Problem | None
    frf: FrfTest | None = None
    removed: bool = False
    reciprocal: bool = True
    places: tuple[str, ...] = ()
    weights: Matrix | None = None
    responses: np.ndarray | None = None
    forces: np.ndarray | None = None
    signs: np.ndarray | None = None

    @property
    def measured(self) -> bool:
        """Whether functions stand for it."""
        return self.frf is not None


@dataclass(frozen=True)
class Point:
    """A place (from 0) of a substructure (from 0)."""

    substructure: int
    place: int


@dataclass(frozen=True)
class Connection:
    """Something with one degree of freedom at `at`, or between `at` and `to`.

    mass, kg; stiffness, N/m, with its loss_factor; damping, N s/m: those of spring and dashpot side by side, to the ground without
    `to`. hung: the mass hangs on spring and dashpot (an absorber); else it sits at the place itself. tuned_to: mode (from 1)
    by which spring and dashpot of an absorber are still to be found, the latter by its damping ratio where that is given.
    """

    name: str
    at: Point
    to: Point | None = None
    mass: float = 0.0
    stiffness: float = 0.0
    loss_factor: float = 0.0
    damping: float = 0.0
    hung: bool = False
    tuned_to: int | None = None
    ratio: float | None = None
    where: Span | None = None

    @property
    def kind(self) -> str:
        """One word for it."""
        if self.hung:
            return ABSORBER
        return MASS if self.mass else SPRING if self.stiffness else "dashpot"


@dataclass(frozen=True)
class Lines:
    """Frequencies at which functions are asked for, Hz; band: of those measured; both may be missing."""

    frequency_hz: np.ndarray | None = None
    band: tuple[float, float] | None = None


@dataclass(frozen=True)
class Synthesis:
    """Which reductions are compared (keys), with how many modes of each substructure, over how many modes of the whole."""

    methods: tuple[str, ...]
    keep: tuple[int, ...]
    count: int


@dataclass(frozen=True)
class Coupling:
    """A deck of coupled structures. interfaces: pairs of points that move together; truncate: relative size below which singular
    values of the interface flexibility are left out, 0 for none; kind: of the functions in the answer."""

    title: str
    path: str
    substructures: tuple[Substructure, ...]
    interfaces: tuple[tuple[Point, Point], ...]
    connections: tuple[Connection, ...]
    responses: tuple[Point, ...]
    forces: tuple[Point, ...]
    lines: Lines
    kind: str
    truncate: float
    synthesis: Synthesis | None
    units: Units = UNDECLARED
    warnings: tuple[Diagnostic, ...] = ()

    def name(self, point: Point) -> str:
        """`left 3TX`: substructure and place."""
        part = self.substructures[point.substructure]
        return f"{part.name} {part.places[point.place]}".strip()


@dataclass(frozen=True)
class Target:
    """Mode `mode` (from 1, rigid-body modes counted) is to lie below, above or at `hz`, by one `means` at a place.

    place: None, all of them are tried.
    """

    mode: int
    side: str
    hz: float
    means: str
    place: int | None = None
    where: Span | None = None


@dataclass(frozen=True)
class Sweep:
    """One thing tried at every place: a mass, a spring to the ground or an absorber of that size, for its effect on `mode`."""

    means: str
    size: float
    mode: int


@dataclass(frozen=True)
class Modification:
    """A deck of changes to one model. candidates: places (from 0) that targets and sweeps try; empty: all degrees of freedom."""

    part: Substructure
    path: str
    changes: tuple[Connection, ...]
    targets: tuple[Target, ...] = ()
    sweeps: tuple[Sweep, ...] = ()
    candidates: tuple[int, ...] = ()
    responses: tuple[int, ...] = ()
    forces: tuple[int, ...] = ()
    lines: Lines = Lines()
    kind: str = "receptance"
    count: int | None = None
    title: str = ""
    warnings: tuple[Diagnostic, ...] = ()

    @property
    def problem(self) -> Problem:
        """The model that is changed."""
        return self.part.problem

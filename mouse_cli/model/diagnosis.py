"""What a diagnosis found: where model and test part, what physics would explain it, how much of it, and whether that is true."""

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from mouse_cli.model.frf_fit import Damping, FrfFit
from mouse_cli.model.groups import joined, leading
from mouse_cli.model.problem import Problem
from mouse_cli.model.result import ChiSquareTest, Result

NOTHING, NAMED, ONE_OF, UNKNOWN = "nothing-missing", "named", "one-of", "unknown"
RIVAL = 0.05  # probability of a group, or share of a place, from which on it is listed beside the leading one


@dataclass(frozen=True)
class Site:
    """Where a cause acts. kind: `structure`, `node`, `element`, `dof` or `sensor`; ids as the deck names them.

    position (3,): coordinates in m where it is one point; text: in words, such as `element 12, 0.43 of its length`.
    """

    kind: str
    ids: tuple[int | str, ...] = ()
    position: tuple[float, float, float] | None = None
    text: str = ""


EVERYWHERE = Site("structure", text="the whole structure")


@dataclass(frozen=True)
class Size:
    """One parameter of a cause: value and sd in `unit`, and the range (lower, upper) that was held possible."""

    name: str
    unit: str
    value: float
    sd: float
    lower: float
    upper: float


@dataclass(frozen=True)
class Cause:
    """One piece of physics that the model does not have. physics: key of its candidate; group: of those hard to tell apart.

    law: `structural` or `viscous` where FRFs show how its spring loses energy; empty: as the rest of the structure, or unknown.
    """

    physics: str
    group: str
    title: str
    site: Site
    sizes: tuple[Size, ...]
    law: str = ""


@dataclass(frozen=True)
class Explanation:
    """No cause, one or two, fitted beside all parameters of the deck.

    chi2 on dof: what stays of the data's misfit; p of it; log_evidence: ln of the probability of the data; probability: of this
    explanation among all that were tried. theta (p,): values of the deck's own parameters. elsewhere: other places (sites of the
    causes), and the share of each in this probability.
    """

    causes: tuple[Cause, ...]
    chi2: float
    dof: int
    p: float
    log_evidence: float
    theta: np.ndarray
    probability: float = 0.0
    elsewhere: tuple[tuple[tuple[Site, ...], float], ...] = ()

    @property
    def group(self) -> str:
        """Groups of its causes, `none` without one; see `joined`."""
        return joined([cause.group for cause in self.causes])

    @property
    def physics(self) -> str:
        """Keys of its causes, `none` without one."""
        return " + ".join(cause.physics for cause in self.causes) or "none"

    @property
    def title(self) -> str:
        """Its causes in words."""
        return " and ".join(cause.title for cause in self.causes) or "nothing"


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


@dataclass(frozen=True)
class Score:
    """How well data that no fit has seen were predicted; rms_shape_error: at sensors held out, over the largest component."""

    rms_frequency_error: float
    log_predictive_density: float
    covered: float
    frequencies_hz: np.ndarray
    sd_hz: np.ndarray
    mac: np.ndarray
    rms_shape_error: float = float("nan")


BY_DECK, BY_MODE = "held out by the deck", "each mode from the others"


@dataclass(frozen=True)
class HeldOut:
    """Data kept from every fit, BY_DECK or BY_MODE. labels, measured_hz (h,); baseline, revised: how either model predicts them."""

    kind: str
    labels: tuple[str, ...]
    measured_hz: np.ndarray
    baseline: Score
    revised: Score | None


STIFFNESS, MASS, BED, FORCE = "stiffness", "mass", "bed", "force"  # of what kind physics without a name is


@dataclass(frozen=True)
class FieldValue:
    """A field at a site: value and sd, relative to what the model has there; of a bed in units of EI / L^4."""

    site: Site
    value: float
    sd: float


@dataclass(frozen=True)
class Field:
    """Physics that has no name: a smooth change of `property` (STIFFNESS, MASS, BED) along the structure, or a FORCE at one site.

    spread: sd of its values; length: over which they are correlated, in m or in steps from site to site (`unit`), 0 for a force.
    log_evidence_over_named: by which it leads everything that has a name; held_out: how the model with it predicts what no fit
    has seen.
    """

    property: str
    values: tuple[FieldValue, ...]
    spread: float
    length: float
    unit: str
    log_evidence_over_named: float
    held_out: HeldOut | None = None


@dataclass(frozen=True)
class Rest:
    """What remains unexplained with the mechanisms that are named: share of the misfit of the model as it is, p-value of it."""

    share: float
    p: float


@dataclass(frozen=True)
class Untried:
    """A candidate that could not be tried, and why: no site in this model, or nothing that the data respond to."""

    physics: str
    reason: str


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


@dataclass(frozen=True)
class Choices:
    """What a diagnosis was asked to consider. candidates: their keys, None for all; causes: most of them together."""

    candidates: tuple[str, ...] | None = None
    causes: int = 4


@dataclass(frozen=True)
class Diagnosis:
    """The answer of `diagnose`.

    kind: one of NOTHING, NAMED, ONE_OF, UNKNOWN. result: the update of the model as it is; best: the explanation named, or the
    first of the rivals; probability: of its group. explanations: all that were tried, most probable first. noise_scale: by what
    the stated variances were multiplied. refuted: groups that held-out data speak against; cautions: sentences on what the
    answer stands or falls with, the accuracy of the test above all; misstated: what of that the deck seems to have wrong,
    `gains`, `places` or `drift`. location, energy: what shapes alone say of the place.
    extended: the deck with the cause in it, and its update. frf, held_frf: functions of the model as it is, and with the cause
    where there is one, beside those fitted and those held out; damping: of the structure, as functions show it. field: physics
    without a name where the answer is UNKNOWN; rest: what a named mechanism leaves unexplained; untried: candidates left out.
    """

    problem: Problem
    kind: str
    result: Result
    innovation: ChiSquareTest
    explanations: tuple[Explanation, ...] = ()
    groups: tuple[tuple[str, float], ...] = ()
    noise_scale: float = 1.0
    location: Location | None = None
    energy: EnergyMap | None = None
    law: Law | None = None
    held_out: HeldOut | None = None
    proposals: tuple[Proposal, ...] = ()
    extended: Problem | None = None
    extended_result: Result | None = None
    remarks: tuple[str, ...] = ()
    refuted: tuple[str, ...] = ()
    cautions: tuple[str, ...] = ()
    misstated: str | None = None
    choices: Choices = Choices()
    frf: tuple[FrfFit, ...] = ()
    held_frf: tuple[FrfFit, ...] = ()
    damping: tuple[Damping, ...] = ()
    field: Field | None = None
    rest: Rest | None = None
    untried: tuple[Untried, ...] = ()

    @property
    def best(self) -> Explanation | None:
        """The leading explanation of the leading group, one with a cause where there is any."""
        standing = [pair for pair in self.groups if self.kind != ONE_OF or pair[0] not in self.refuted]
        at = leading(standing, [one.group for one in self.explanations])
        return next(iter(self.explanations), None) if at is None else self.explanations[at]

    @property
    def baseline(self) -> Explanation | None:
        """The explanation without any cause."""
        return next((one for one in self.explanations if not one.causes), None)

    @property
    def rivals(self) -> tuple[tuple[str, float], ...]:
        """Groups that hold more than 5 % of the probability, and it, the leading one first; never one alone of several."""
        least = 2 if self.kind == ONE_OF else 0
        standing = [pair for pair in self.groups if pair[0] not in self.refuted]
        return tuple((name, p) for i, (name, p) in enumerate(standing) if p > RIVAL or i < least)

    @property
    def probability(self) -> float:
        """Of the group of `best`, or of no cause where nothing is missing; NaN where nothing was compared."""
        best = self.best
        group = "none" if self.kind == NOTHING or best is None else best.group
        return dict(self.groups).get(group, float("nan"))

    @property
    def exit_code(self) -> int:
        """0: nothing is missing; 1: something is, or the update itself cannot be trusted."""
        return self.result.status.exit_code if self.kind == NOTHING else 1

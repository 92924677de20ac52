"""What a diagnosis found: where model and test part, what physics would explain it, how much of it, and whether that is true."""

from dataclasses import dataclass, field, replace

from mouse_cli._notebook import Shown
from mouse_cli.model.explanation import RIVAL as RIVAL
from mouse_cli.model.explanation import Cause as Cause
from mouse_cli.model.explanation import Explanation as Explanation
from mouse_cli.model.explanation import Size as Size
from mouse_cli.model.explanation import elsewhere as elsewhere
from mouse_cli.model.explanation import foremost as foremost
from mouse_cli.model.explanation import members as members
from mouse_cli.model.field import AXIAL as AXIAL
from mouse_cli.model.field import BED as BED
from mouse_cli.model.field import COMPLIANCE as COMPLIANCE
from mouse_cli.model.field import FORCE as FORCE
from mouse_cli.model.field import LAW as LAW
from mouse_cli.model.field import MASS as MASS
from mouse_cli.model.field import STIFFNESS as STIFFNESS
from mouse_cli.model.field import Field as Field
from mouse_cli.model.field import FieldValue as FieldValue
from mouse_cli.model.frf_fit import Damping, FrfFit
from mouse_cli.model.groups import leading
from mouse_cli.model.localisation import EnergyMap as EnergyMap
from mouse_cli.model.localisation import Law as Law
from mouse_cli.model.localisation import Location as Location
from mouse_cli.model.localisation import Place as Place
from mouse_cli.model.prediction import BY_DECK as BY_DECK
from mouse_cli.model.prediction import BY_MODE as BY_MODE
from mouse_cli.model.prediction import HeldOut as HeldOut
from mouse_cli.model.prediction import Score as Score
from mouse_cli.model.problem import Problem
from mouse_cli.model.proposal import HELPS as HELPS
from mouse_cli.model.proposal import SETTLES as SETTLES
from mouse_cli.model.proposal import Effort as Effort
from mouse_cli.model.proposal import Proposal as Proposal
from mouse_cli.model.result import ChiSquareTest, Result
from mouse_cli.model.shared_place import SharedPlace, shared_place
from mouse_cli.model.site import EVERYWHERE as EVERYWHERE
from mouse_cli.model.site import Site as Site

NOTHING, NAMED, ONE_OF, UNKNOWN = "nothing-missing", "named", "one-of", "unknown"
UNPROVED = 0.02  # probability that nothing is missing, from which on it is one of what may be


@dataclass(frozen=True)
class Rest:
    """What remains unexplained with the mechanisms that are named: share of the misfit of the model as it is, p-value of it.

    there: whether most of it follows from the motion at the place of the one that is named, whose law has another shape.
    """

    share: float
    p: float
    there: bool = False


@dataclass(frozen=True)
class Certain:
    """Mechanisms that most explanations share while what acts beside them is open.

    causes: as the leading of those has them; probability: of all that have them; members, companions: physics of theirs, and
    groups of what else acts (`none`: nothing), each with its probability given them.
    """

    causes: tuple[Cause, ...]
    probability: float
    members: tuple[tuple[str, float], ...]
    companions: tuple[tuple[str, float], ...]


@dataclass(frozen=True)
class Untried:
    """A candidate that could not be tried, and why: no site in this model, or nothing that the data respond to."""

    physics: str
    reason: str


@dataclass(frozen=True)
class Choices:
    """What a diagnosis was asked to consider. candidates: their keys, None for all; causes: most of them together.

    jobs: processes that share the search; the answer is the same whatever their number.
    """

    candidates: tuple[str, ...] | None = None
    causes: int = 4
    jobs: int = field(default=1, compare=False)


@dataclass(frozen=True)
class Diagnosis(Shown):
    """The answer of `diagnose`.

    kind: one of NOTHING, NAMED, ONE_OF, UNKNOWN. result: the update of the model as it is; best: the explanation named, or the
    first of the rivals; probability: of its group. explanations: all that were tried, most probable first. noise_scale: by what
    the stated variances were multiplied. refuted: groups that held-out data speak against; cautions: sentences on what the
    answer stands or falls with, the accuracy of the test above all; misstated: what of that the deck seems to have wrong,
    `gains`, `places`, `drift` or `scatter`, or of a mode. location, energy: what shapes alone say of the place.
    extended: the deck with the cause in it, and its update. frf, held_frf: functions of the model as it is, and with the cause
    where there is one, beside those fitted and those held out; damping: of the structure, as functions show it. field: physics
    without a name where the answer is UNKNOWN, or where it leads what has one; rest: what a named mechanism leaves unexplained;
    untried: candidates left out; certain: what is named where its companions are open; placed: False of ONE_OF whose rivals are
    sites of one mechanism, and of what is named somewhere in a line of panels. loose: titles of mechanisms that are named with
    more certainty than where they act, and the posterior sd (m) of that.
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
    certain: Certain | None = None
    placed: bool = True
    loose: tuple[tuple[str, float], ...] = ()

    @property
    def best(self) -> Explanation | None:
        """The explanation that stands for the leading group, one with a cause where there is any; of it, what is certain."""
        one = self._leading
        return one if one is None or self.certain is None else replace(one, causes=self.certain.causes, elsewhere=())

    @property
    def _leading(self) -> Explanation | None:
        standing = [pair for pair in self.groups if self.kind != ONE_OF or pair[0] not in self.refuted]
        at = leading(standing, [one.group for one in self.explanations])
        return next(iter(self.explanations), None) if at is None else foremost(self.explanations, self.explanations[at].group)

    @property
    def leader(self) -> Explanation | None:
        """The explanation that is named, or that leads its rivals; None where nothing is missing or no name is given."""
        best = self.best
        return best if best is not None and best.causes and self.kind in (NAMED, ONE_OF) else None

    @property
    def members(self) -> tuple[tuple[str, float], ...]:
        """Physics of the leading group and the probability of each within it, the largest first; empty without a leader."""
        if self.certain is not None:
            return self.certain.members
        return () if self.leader is None else members(self.explanations, self.leader.group)

    @property
    def elsewhere(self) -> tuple[tuple[tuple[Site, ...], float], ...]:
        """Rival sites of the leader, and the probability of each among its sites; see `elsewhere`."""
        named = self.leader if self.certain is None else None
        return () if named is None else elsewhere(self.explanations, named)

    @property
    def shared(self) -> SharedPlace | None:
        """What the rival sites of the leader have in common, where one mechanism moves from site to site; None: nothing."""
        sites = [self.leader.sites, *(sites for sites, _ in self.elsewhere)] if self.elsewhere else []
        moved = [one for one in zip(*sites, strict=True) if len(set(one)) > 1]
        return shared_place(self.problem.mesh, moved[0]) if len(moved) == 1 and self.problem is not None else None

    @property
    def baseline(self) -> Explanation | None:
        """The explanation without any cause."""
        return next((one for one in self.explanations if not one.causes), None)

    @property
    def listed(self) -> tuple[Explanation, ...]:
        """All that were tried, most probable first; where no probability is given, none first, then by their log evidence."""
        if self.kind != UNKNOWN:
            return self.explanations
        return tuple(sorted(self.explanations, key=lambda one: (bool(one.causes), -one.log_evidence)))

    @property
    def nearest(self) -> Explanation | None:
        """Of an answer without a name, the explanation with a cause that has most evidence; None: none has more than no cause."""
        none, first = self.baseline, next((one for one in self.listed if one.causes), None)
        gains = first is not None and (none is None or first.log_evidence > none.log_evidence)
        return first if gains else None

    @property
    def rivals(self) -> tuple[tuple[str, float], ...]:
        """Groups that hold more than RIVAL, `none` more than UNPROVED, the first first; never one alone of several groups."""
        least = (1 if self.nameless > RIVAL or not self.placed else 2) if self.kind == ONE_OF else 0
        named = {one.group for one in self.explanations}
        standing = [pair for pair in self.groups if pair[0] in named and pair[0] not in self.refuted]
        return tuple((name, p) for i, (name, p) in enumerate(standing) if p > (UNPROVED if name == "none" else RIVAL) or i < least)

    @property
    def nameless(self) -> float:
        """Probability of changes of the model that have no name."""
        named = {"none", *(one.group for one in self.explanations)}
        return float(sum(p for name, p in self.groups if name not in named))

    @property
    def probability(self) -> float:
        """Of the group of `best`, or of no cause where nothing is missing; NaN where nothing was compared."""
        if self.certain is not None:
            return self.certain.probability
        group = "none" if self.kind == NOTHING or self.best is None else self.best.group
        return dict(self.groups).get(group, float("nan"))

    @property
    def exit_code(self) -> int:
        """0: nothing is missing; 1: something is, or the update itself cannot be trusted."""
        return self.result.status.exit_code if self.kind == NOTHING else 1

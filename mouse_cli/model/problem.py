"""A deck, read and checked: everything a run needs, and nothing about where it was written but the spans."""

from dataclasses import dataclass, field

from mouse_cli._errors import Diagnostic
from mouse_cli._span import Span
from mouse_cli.model.arrays import Matrix, freeze
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.held import ElementGroup, Held
from mouse_cli.model.hold_out import HeldRecords, HoldOut
from mouse_cli.model.local_law import LocalLaw
from mouse_cli.model.mesh import Binding, Mesh
from mouse_cli.model.modal_damping import ModalDamping
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.parameter import Gaussian, Parameter
from mouse_cli.model.recording import Recording
from mouse_cli.model.structure import ListedElements, Structure
from mouse_cli.model.term import Term
from mouse_cli.model.theory import Theory
from mouse_cli.model.units import UNDECLARED, Units

RECURSIONS = ("replaced", "anchored")
PAIRINGS = ("number", "mac")
CONVERGENCE_RULES = ("ratio", "fraction")
STEPS = ("first-order", "second-order")
CONFIDENCES = (90, 95, 99)
MOST_COVARIANCE = 500  # parameters up to which their covariance (p, p) is formed without being asked for


@dataclass(frozen=True)
class RunOptions:
    """How to run; every field is a key of `run:` in a YAML deck and an option of `mouse run`.

    partials: most recomputations of the partial derivatives (NPARD). passes: passes of O-7/O-8 for each (ITERMX).
    cycles: exactly so many cycles, whatever the convergence test says. convergence: exceedances against
    non-exceedances (`ratio`) or against all data (`fraction`). extra_update: one more cycle after the test has passed.
    step: `second-order` adds the curvature of the data along the step. limit_sd: no correction beyond so many prior sd.
    print_covariance: the covariance of the revised parameters is formed however many they are; without it up to
    MOST_COVARIANCE. exact: partial derivatives of
    large models to rounding, in every cycle. legacy: the limits of 1972 are errors.
    fix_total_mass: total mass stays while component masses vary; total_mass_dofs (from 0) limits the sum to those
    degrees of freedom (empty: all).
    """

    estimator: str = "bayes"
    recursion: str = "anchored"
    confidence: int = 95
    partials: int = 30
    passes: int = 1
    cycles: int | None = None
    convergence: str = "ratio"
    extra_update: bool = False
    pairing: str = "mac"
    step: str = "first-order"
    limit_sd: float | None = None
    fix_total_mass: bool = False
    total_mass_dofs: tuple[int, ...] = ()
    print_partials: bool = False
    exact: bool = False
    print_covariance: bool = False
    legacy: bool = False


@dataclass(frozen=True)
class Source:
    """The file a problem was read from: `cards` or `yaml`, and its lines for the echo."""

    path: str = "<memory>"
    format: str = "yaml"
    lines: tuple[str, ...] = ()


@dataclass(frozen=True)
class Problem:
    """Structure, parameters with their prior, what ties parameters to the matrices, test and options.

    elements, A (e, p): d(element) = A d(parameter), Eq. (3-2) of the report; terms: further contributions, such as beams and
    springs; mesh, bindings: what they were made of, for models with geometry. test is None for a deck that only asks for modes; it
    holds what is fitted, and hold_out what is kept from every fit. frf, recordings: frequency response functions and time histories
    of the test. units: of all numbers that are not in s or Hz. laws: local forces that are not linear, which modes do not have.
    modal_damping: beside that of structure and terms. held: supports by name of imported matrices;
    groups: their element sets. theory: by how much the model may be wrong beside what is named.

    A problem is changed by `dataclasses.replace`, which makes another one.

    >>> from dataclasses import replace
    >>> import mouse_cli
    >>> problem = mouse_cli.read_deck("decks/table_5_3.yaml")
    >>> replace(problem, run=replace(problem.run, recursion="replaced")).run.recursion
    'replaced'
    """

    title: str
    structure: Structure
    elements: ListedElements
    A: Matrix
    parameters: tuple[Parameter, ...]
    prior: Gaussian
    test: ModalTest | None
    run: RunOptions = field(default_factory=RunOptions)
    source: Source = field(default_factory=Source)
    warnings: tuple[Diagnostic, ...] = ()
    places: dict[str, Span] = field(default_factory=dict)
    terms: tuple[Term, ...] = ()
    mesh: Mesh | None = None
    bindings: tuple[Binding, ...] = ()
    hold_out: HoldOut | None = None
    frf: tuple[FrfTest, ...] = ()
    recordings: tuple[Recording, ...] = ()
    units: Units = UNDECLARED
    held_records: HeldRecords | None = None
    laws: tuple[LocalLaw, ...] = ()
    modal_damping: ModalDamping | None = None
    theory: Theory = field(default_factory=Theory)
    held: Held | None = None
    groups: tuple[ElementGroup, ...] = ()

    def place(self, key: str) -> Span:
        """Where `key` (`order`, `estimator`, `mode 3`) stands in the deck; its first line when that is not known."""
        return self.places.get(key) or Span(self.source.path, 1)

    @property
    def by_recordings(self) -> bool:
        """Whether recordings are all that the model can be revised by."""
        return bool(self.recordings) and self.test is None and not self.frf

    def __post_init__(self) -> None:
        e, p = len(self.elements), len(self.parameters)
        freeze(self, A=(e, p))
        if len(self.prior.mean) != p:
            raise ValueError(f"prior has {len(self.prior.mean)} means for {p} parameters")

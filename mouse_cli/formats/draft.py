"""What a reader took from a file, before it is known to make sense; each value remembers where it was written.

A reader (cards, YAML) only reads. `assemble.assemble` applies the rules, once for all formats, and makes the Problem.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from mouse_cli._errors import ERROR, WARNING, Diagnostic
from mouse_cli._span import Span
from mouse_cli.formats.record_drafts import FrfDraft, RecordingDraft
from mouse_cli.formats.sensor import SensorDraft
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.geometry import Geometry
from mouse_cli.model.held import ElementGroup, Held
from mouse_cli.model.mesh import Binding, Mesh
from mouse_cli.model.modal_damping import ModalDamping
from mouse_cli.model.parameter import Parameter
from mouse_cli.model.problem import RunOptions, Source
from mouse_cli.model.theory import Theory
from mouse_cli.model.units import UNDECLARED, Units

Where = Callable[[int], Span | None]


def nowhere(_: int) -> None:
    """No place is known, e.g. for the elements of a matrix file."""


@dataclass
class Entries:
    """Matrix elements as listed: rows and columns from 1, values, and `where(i)`, the place of the i-th."""

    rows: np.ndarray
    cols: np.ndarray
    values: np.ndarray
    where: Where = nowhere

    def __len__(self) -> int:
        return len(self.rows)


@dataclass
class TestDraft:
    """The modal test as read. dofs count from 1; shapes and shape_sd are (s, m), NaN where missing.

    sensors (s,): what each row is measured by, in place of dofs, for readers of formats that describe sensors.
    """

    __test__ = False  # not a pytest class

    number: np.ndarray
    frequency_hz: np.ndarray
    frequency_sd_hz: np.ndarray
    dofs: np.ndarray
    shapes: np.ndarray
    shape_sd: np.ndarray
    scale: str = "least-squares"
    where_number: Where = nowhere
    where_frequency: Where = nowhere
    where_frequency_sd: Where = nowhere
    where_dof: Where = nowhere
    where_shape: Callable[[int, int], Span | None] = lambda s, m: None
    where_shape_sd: Callable[[int, int], Span | None] = lambda s, m: None
    sensors: tuple[SensorDraft, ...] = ()


@dataclass
class MeshDraft:
    """A structure, with the places of its parts.

    mesh, bindings: as read. node_place(i): place of node index i; element_place(s, i): of element i of set s; span: of all.
    labels: names of the degrees of freedom of a matrix model whose degrees of freedom are the nodes of the mesh, else empty.
    """

    mesh: Mesh
    span: Span
    node_place: Callable[[int], Span]
    element_place: Callable[[int, int], Span]
    bindings: list[Binding] = field(default_factory=list)
    labels: tuple[str, ...] = ()

    def of_element(self, number: int) -> Span:
        """Place of the element called `number`."""
        for s, members in enumerate(self.mesh.elements):
            found = np.flatnonzero(members.ids == number)
            if len(found):
                return self.element_place(s, int(found[0]))
        return self.span

    def of_node(self, number: int) -> Span:
        """Place of the node called `number`."""
        found = np.flatnonzero(self.mesh.node_ids == number)
        return self.node_place(int(found[0])) if len(found) else self.span


@dataclass
class LawDraft:
    """A law of a local force; dofs: numbers from 1, or labels, as written."""

    law: str
    variant: str
    dofs: list[str]
    values: dict[str, float]
    where: Span | None = None


Additions = dict[int | str, float]


@dataclass
class AlteredDraft:
    """Another configuration: what is added to degrees of freedom or, for masses, nodes, named by number or label."""

    title: str
    where: Span
    masses: Additions
    springs: Additions
    number: np.ndarray
    frequency_hz: np.ndarray
    frequency_sd_hz: np.ndarray


@dataclass
class HoldOutDraft:
    """What is kept from every fit. modes: numbers of modes of the test, sensors: as `dofs` names them; each with its place.

    recordings, frf: titles; segments: a title, and first sample and the one after the last; lines: lowest and highest Hz.
    """

    where: Span
    modes: list[tuple[int, Span]] = field(default_factory=list)
    sensors: list[tuple[str, Span]] = field(default_factory=list)
    altered: list[AlteredDraft] = field(default_factory=list)
    recordings: list[tuple[str, Span]] = field(default_factory=list)
    segments: list[tuple[str, tuple[int, int], Span]] = field(default_factory=list)
    frf: list[tuple[str, Span]] = field(default_factory=list)
    lines: list[tuple[tuple[float, float], Span]] = field(default_factory=list)


@dataclass
class SupportDraft:
    """A support of imported matrices as read: its name, degrees of freedom (from 1) and place."""

    name: str
    dofs: np.ndarray
    place: Span | None = None


@dataclass
class Draft:
    """A whole deck as read.

    K, M, C, D: Entries (diagonal and upper triangle) or a whole matrix from a file, None where there is none; mesh: a structure
    that makes them or is attached to them; geometry: where the rows of imported matrices are. order, labels: of
    the matrices; 0 while only the structure can tell. elements: Entries whose value is 0 for stiffness and 1 for mass, in the
    order of group RS, stiffness first. A: Entries (listed element, parameter, partial).
    covariance (p, p): the prior's, when it has off-diagonals; else the parameters' sd hold it. hold_out: what no fit uses of
    test, frf and recordings. supports: of the matrices, which the rules apply; held: what that left.
    """

    title: str
    order: int
    K: Entries | Matrix | None
    M: Entries | Matrix | None
    elements: Entries
    A: Entries
    parameters: list[Parameter]
    run: RunOptions
    source: Source
    covariance: np.ndarray | None = None
    test: TestDraft | None = None
    C: Entries | Matrix | None = None
    D: Entries | Matrix | None = None
    mesh: MeshDraft | None = None
    geometry: Geometry | None = None
    labels: tuple[str, ...] = ()
    supports: tuple[SupportDraft, ...] = ()
    groups: tuple[ElementGroup, ...] = ()
    held: Held | None = None
    units: Units = UNDECLARED
    frf: tuple[FrfDraft, ...] = ()
    recordings: tuple[RecordingDraft, ...] = ()
    hold_out: HoldOutDraft | None = None
    laws: tuple[LawDraft, ...] = ()
    modal_damping: ModalDamping | None = None
    theory: Theory = field(default_factory=Theory)
    where_order: Span | None = None
    where_covariance: Span | None = None
    where_total_mass: Span | None = None
    where_estimator: Span | None = None
    where_theory: Span | None = None
    diagnostics: list[Diagnostic] = field(default_factory=list)

    @property
    def has_errors(self) -> bool:
        """Whether anything found so far forbids a run."""
        return any(d.severity == ERROR for d in self.diagnostics)

    def error(self, code: str, message: str, span: Span | None = None, note: str = "", help: str = "") -> None:
        """Note an error and go on reading."""
        self.diagnostics.append(Diagnostic(code, ERROR, message, span, note, help))

    def warn(self, code: str, message: str, span: Span | None = None, note: str = "", help: str = "") -> None:
        """Note a warning."""
        self.diagnostics.append(Diagnostic(code, WARNING, message, span, note, help))

    def with_run(self, **changes: object) -> "Draft":
        """The same draft with some run options replaced, e.g. from the command line."""
        return replace(self, run=replace(self.run, **changes))

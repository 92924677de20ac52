"""Element library: one module = one type of element, found by `registry`; each is one function from properties to matrices."""

from collections.abc import Callable
from dataclasses import dataclass, field
from math import inf
from typing import Any

import numpy as np

from mouse_cli import _registry

# What the value of an option is: one of its words; [x, y, z]; two such vectors; {1: [x, y, z], 2: ...}; {1: [RZ], 2: [RY, RZ]}.
WORD, VECTOR, AXES, END_VECTORS, END_DIRECTIONS = "word", "vector", "axes", "end vectors", "end directions"


@dataclass(frozen=True)
class Layout:
    """Where e elements of k nodes each are: coordinates (e, k, 3) in m, and the options of their set.

    axial (e,): tension in N that gravity causes (see `Mesh.gravity`); it stiffens beside the property `preload`. stretches (e,):
    whether the ends of an element may move along it in the model, None: all may; for types that `opens` marks.
    """

    coordinates: np.ndarray
    options: dict[str, Any] = field(default_factory=dict)
    axial: np.ndarray | None = None
    stretches: np.ndarray | None = None
    _kept: dict[str, Any] = field(default_factory=dict, repr=False, compare=False)

    def __len__(self) -> int:
        return len(self.coordinates)

    def of(self, members: np.ndarray) -> "Layout":
        """The layout of some of the elements."""
        axial, stretches = (None if given is None else given[members] for given in (self.axial, self.stretches))
        return Layout(self.coordinates[members], self.options, axial, stretches)

    def once(self, key: str, make: Callable[["Layout"], Any]) -> Any:
        """make(layout), computed at the first call: what follows from geometry and options alone."""
        if key not in self._kept:
            self._kept[key] = make(self)
        return self._kept[key]


Properties = dict[str, np.ndarray]  # (e,) each; complex where a derivative is taken
Matrices = dict[str, np.ndarray]  # those of MATRICES that there are: (e, 6 k, 6 k), global axes, node by node, TX..RZ
GEOMETRIC = "Kg"  # a further key of Matrices: stiffness due to axial force, part of K that material damping leaves out


@dataclass(frozen=True)
class Property:
    """A number that elements of a type have: meaning, unit, default, and whether it must be positive, or may be zero besides.

    default None: it must be given; a function of (layout, properties): it follows from those that stand before it, as the
    meaning says. only: words of options with which it acts (none: always). below: what it must stay below.
    """

    meaning: str
    unit: str
    default: float | Callable[[Layout, Properties], np.ndarray] | None = None
    positive: bool = False
    or_zero: bool = False
    only: tuple[str, ...] = ()
    below: float = inf


@dataclass(frozen=True)
class Option:
    """What is no number to revise: meaning, default, the words it may be, and its form where it is no word."""

    meaning: str
    default: Any = None
    choices: tuple[str, ...] = ()
    form: str = WORD


DAMPING = {
    "loss_factor": Property("structural damping: D = loss_factor K", "1", 0.0),
    "stiffness_damping": Property("viscous damping in proportion to stiffness: C = stiffness_damping K", "s", 0.0),
    "mass_damping": Property("viscous damping in proportion to mass: C = mass_damping M", "1/s", 0.0),
}


@dataclass(frozen=True)
class ElementType:
    """A type of element. nodes: how many nodes it may have. damping: which of DAMPING it has as properties.

    `matrices(layout, properties)` must be made of operations that carry complex numbers through (no abs, max, comparisons of
    property values but with 0): derivatives by a property are taken by complex steps, exact to rounding (Squire and Trapp
    1998). `axial(layout, properties, displacements (e, 6 k))` is the tension (e,), for elements that carry load along their axis.
    reach: whether the element has a length, so that its nodes must not coincide. stacked: under gravity it carries the weight
    of everything beyond it, seen from the supports. opens: what it does in bending depends on whether it may stretch.
    """

    key: str
    meaning: str
    nodes: tuple[int, ...]
    properties: dict[str, Property]
    matrices: Callable[[Layout, Properties], Matrices]
    options: dict[str, Option] = field(default_factory=dict)
    damping: tuple[str, ...] = ("loss_factor", "stiffness_damping")
    axial: Callable[[Layout, Properties, np.ndarray], np.ndarray] | None = None
    reach: bool = False
    stacked: bool = False
    opens: bool = False

    def __post_init__(self) -> None:
        damping = {name: DAMPING[name] for name in self.damping}
        object.__setattr__(self, "properties", {**self.properties, **damping})

    def __reduce__(self):
        """By its key: another process has the same library."""
        return _of_key, (self.key,)

    def damped(self, layout: Layout, properties: Properties) -> Matrices:
        """`matrices` with the damping that follows from K and M: C += stiffness_damping K + mass_damping M, D = loss_factor K."""
        found = self.matrices(layout, properties)
        for name, source, target in (
            ("stiffness_damping", "K", "C"),
            ("mass_damping", "M", "C"),
            ("loss_factor", "K", "D"),
        ):
            factor = properties.get(name)
            if factor is not None and source in found and (factor != 0).any():
                found[target] = found.get(target, 0.0) + factor[:, None, None] * found[source]
        if GEOMETRIC in found:
            found["K"] = found["K"] + found.pop(GEOMETRIC)
        return found


def registry() -> dict[str, ElementType]:
    """All element types by key."""
    return _registry.discover(__name__, "ELEMENT")


def _of_key(key: str) -> ElementType:
    return registry()[key]

"""A structure as its engineer describes it: nodes, elements with their properties, supports and rigid links."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mouse_cli.model.arrays import frozen
from mouse_cli.model.geometry import DIRECTIONS


@dataclass(frozen=True)
class ElementSet:
    """e elements of one type with the same options.

    type: key of an element type (see `mouse list elements`). ids (e,), as the deck names them. nodes (e, k): indices of the
    nodes they join. properties: for each property of the type, nominal values (e,), whatever material or section they came from.
    options: what is no number to revise, such as theory, orientation, offsets, releases; the same for all e elements.
    origin: for each property taken from a material or section, its name, so that the deck can be written back.
    """

    type: str
    ids: np.ndarray
    nodes: np.ndarray
    properties: dict[str, np.ndarray]
    options: dict[str, Any] = field(default_factory=dict)
    origin: dict[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        e = len(self.ids)
        object.__setattr__(self, "ids", frozen(self.ids, (e,), "ids", int))
        object.__setattr__(self, "nodes", frozen(self.nodes, (e, np.shape(self.nodes)[1]), "nodes", int))
        values = {name: frozen(value, (e,), name) for name, value in self.properties.items()}
        object.__setattr__(self, "properties", values)

    def __len__(self) -> int:
        return len(self.ids)


@dataclass(frozen=True)
class RigidLink:
    """The `directions` of node `dependent` move with node `independent` as if a rigid bar joined them (node indices)."""

    independent: int
    dependent: int
    directions: tuple[int, ...] = tuple(range(6))


@dataclass(frozen=True)
class GenericGroup:
    """Like elements (numbers, as the deck names them) whose stiffness U0 k U0' a method may revise as one.

    couplings: which of k12, k13, k23 may differ from zero; a symmetric element has neither k12 nor k13.
    """

    name: str
    elements: np.ndarray
    couplings: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "elements", frozen(self.elements, (len(self.elements),), "elements", int))


@dataclass(frozen=True)
class Mesh:
    """k nodes and what is between them.

    node_ids (k,); coordinates (k, 3) in m. supports (c, 2): (node index, direction) that cannot move. directions: the ones kept
    at every node (all six, or those of a plane). gravity (3,): acceleration in m/s^2 whose axial forces stiffen or soften
    (P-delta); None: not considered. generic: groups of like elements for methods that revise their stiffness as a whole.
    """

    node_ids: np.ndarray
    coordinates: np.ndarray
    elements: tuple[ElementSet, ...]
    supports: np.ndarray
    links: tuple[RigidLink, ...] = ()
    directions: tuple[int, ...] = tuple(range(len(DIRECTIONS)))
    gravity: np.ndarray | None = None
    generic: tuple[GenericGroup, ...] = ()

    def __post_init__(self) -> None:
        k = len(self.node_ids)
        object.__setattr__(self, "node_ids", frozen(self.node_ids, (k,), "node_ids", int))
        object.__setattr__(self, "coordinates", frozen(self.coordinates, (k, 3), "coordinates"))
        object.__setattr__(self, "supports", frozen(self.supports, (len(self.supports), 2), "supports", int))


@dataclass(frozen=True)
class Binding:
    """Parameter number `parameter` is the `property` of `members` (indices within element set number `set`), all counted from 0.

    factor: it multiplies their nominal values; else it is their common value.
    """

    parameter: int
    set: int
    members: np.ndarray
    property: str
    factor: bool = False

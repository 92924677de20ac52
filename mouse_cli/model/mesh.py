"""A structure as its engineer describes it: nodes, elements with their properties, supports and rigid links."""

from collections.abc import Hashable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from mouse_cli.model.arrays import freeze, frozen
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
        freeze(self, int, ids=(e,), nodes=(e, np.shape(self.nodes)[1]))
        values = {name: frozen(value, (e,), name) for name, value in self.properties.items()}
        object.__setattr__(self, "properties", values)

    def __len__(self) -> int:
        return len(self.ids)

    @property
    def kind(self) -> Hashable:
        """Type, nodes of an element, options and given properties: sets alike in these can be worked on as one."""
        return self.type, self.nodes.shape[1], _hashable(self.options), tuple(sorted(self.properties))


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
        freeze(self, int, elements=(len(self.elements),))


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
        freeze(self, int, node_ids=(k,), supports=(len(self.supports), 2))
        freeze(self, coordinates=(k, 3))

    @cached_property
    def gathered(self) -> "Gathered":
        """Its elements in as few sets as can be, so that decks which list them one by one cost no more than others."""
        groups: dict[Hashable, list[int]] = {}
        for number, elements in enumerate(self.elements):
            groups.setdefault(elements.kind, []).append(number)
        return Gathered.of(self.elements, list(groups.values()))

    @cached_property
    def _still(self) -> np.ndarray:
        """Directions (6,) that all nodes are held in, as those of a frame in its plane, or of floors that only sway."""
        held = np.zeros((len(self.node_ids), 6), bool)
        held[tuple(self.supports.T)] = True
        joined = np.zeros(len(self.node_ids), bool)
        for each in self.elements:
            joined[each.nodes] = True
        return held[joined].all(axis=0)

    @property
    def moving(self) -> set[int]:
        """Those of `directions` in which some node can move."""
        return {d for d in self.directions if not self._still[d]}

    @cached_property
    def standing(self) -> np.ndarray:
        """Supports (c, 2) by which it stands somewhere: those in directions that all nodes are held in say as little of a place
        as `directions` that are not kept.
        """
        return self.supports[~self._still[self.supports[:, 1]]]


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


@dataclass(frozen=True)
class Gathered:
    """Element sets joined: elements (g,); group, first (sets,): which of them each set is in, and where its members begin there."""

    elements: tuple[ElementSet, ...]
    group: tuple[int, ...]
    first: tuple[int, ...]

    @classmethod
    def of(cls, sets: tuple[ElementSet, ...], groups: list[list[int]]) -> "Gathered":
        """`sets` joined by `groups` of their numbers."""
        group, first, joined = [0] * len(sets), [0] * len(sets), []
        for g, numbers in enumerate(groups):
            count = 0
            for number in numbers:
                group[number], first[number], count = g, count, count + len(sets[number])
            joined.append(_joined([sets[number] for number in numbers]))
        return cls(tuple(joined), tuple(group), tuple(first))

    def bindings(self, given: tuple[Binding, ...]) -> tuple[Binding, ...]:
        """The same parameters bound to members of the joined sets."""
        return tuple(
            replace(b, set=self.group[b.set], members=np.asarray(b.members) + self.first[b.set]) for b in given
        )

    def origin(self, g: int) -> tuple[np.ndarray, np.ndarray]:
        """Number of the set (e,), and of the member in it (e,), of each element of joined set g."""
        sets = np.array([i for i, each in enumerate(self.group) if each == g])
        first = np.array([self.first[i] for i in sets])
        at = np.arange(len(self.elements[g]))
        own = np.searchsorted(first, at, side="right") - 1
        return sets[own], at - first[own]


def _joined(sets: list[ElementSet]) -> ElementSet:
    """Sets of one kind as one."""
    if len(sets) == 1:
        return sets[0]
    ids, nodes = (np.concatenate([getattr(each, name) for each in sets]) for name in ("ids", "nodes"))
    properties = {name: np.concatenate([each.properties[name] for each in sets]) for name in sets[0].properties}
    return ElementSet(sets[0].type, ids, nodes, properties, sets[0].options)


def _hashable(value: Any) -> Hashable:
    if isinstance(value, dict):
        return tuple(sorted((str(key), _hashable(each)) for key, each in value.items()))
    if isinstance(value, np.ndarray):
        value = value.tolist()
    return tuple(map(_hashable, value)) if isinstance(value, list | tuple) else value

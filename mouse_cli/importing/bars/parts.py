"""A model of bars being made of bulk data: its nodes, what joins them, what holds them, and how its nodes move."""

from collections.abc import Hashable, Iterable
from dataclasses import dataclass, field

import numpy as np

from mouse_cli.formats import nastran_fields
from mouse_cli.importing.bulk_deck import BulkDeck
from mouse_cli.importing.bulk_systems import Systems
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.mesh import ElementSet, Mesh, RigidLink

_SMALL = 1e-9  # sines and cosines of directions that count as along an axis
_BASIC = "let the point move in the basic system, or act in all three directions"


@dataclass(frozen=True)
class Part:
    """An element of mouse's library: nodes, properties and options; origin: material and section that properties come from."""

    card: nastran_fields.Card
    type: str
    number: int
    nodes: tuple[int, ...]
    properties: dict[str, float]
    options: dict = field(default_factory=dict)
    origin: dict[str, str] = field(default_factory=dict)

    @property
    def kind(self) -> Hashable:
        """What elements of one set share."""
        return self.type, len(self.nodes), repr(self.options), tuple(self.properties), tuple(self.origin.items())


@dataclass(frozen=True)
class Spring:
    """A stiffness that is a parameter: its name, the number of its element, and the direction."""

    name: str
    number: int
    direction: str


@dataclass
class Bars:
    """What bulk data become. links: independent node, dependent nodes, directions; held: nodes and directions, from 0."""

    deck: BulkDeck
    systems: Systems
    parts: list[Part] = field(default_factory=list)
    springs: list[Spring] = field(default_factory=list)
    links: list[tuple[nastran_fields.Card, int, list[int], tuple[int, ...]]] = field(default_factory=list)
    held: dict[tuple[int, int], nastran_fields.Card] = field(default_factory=dict)
    materials: dict[str, dict[str, float]] = field(default_factory=dict)
    _numbers: set[int] = field(default_factory=set)
    _axes: dict[int, np.ndarray] = field(default_factory=dict)

    def add(
        self, card: nastran_fields.Card, type: str, nodes: Iterable[int], properties: dict[str, float], **more
    ) -> int:
        """Adds an element under its number in the job, or the next that is free; returns the number."""
        number = self.deck.whole(card, 0)
        if number in self._numbers:
            number = max(self._numbers | set(self.deck.numbers)) + 1
        self._numbers.add(number)
        self.parts.append(Part(card, type, number, tuple(nodes), properties, **more))
        return number

    def known(self, card: nastran_fields.Card, nodes: Iterable[int]) -> bool:
        """Whether all of these grid points are defined; notes the first that is not."""
        absent = [node for node in nodes if node not in self.deck.at]
        if absent:
            message = f"this {card.name} names grid point {absent[0]}, which is not defined"
            self.deck.refuse(card, message, "mend the number", "MD272")
        return not absent

    def axes(self, node: int) -> np.ndarray:
        """Directions (3, 3) that a grid point moves in, as columns, in the basic system."""
        if node not in self._axes:
            self._axes[node] = self.systems.directions(node)
        return self._axes[node]

    def directions(self, card: nastran_fields.Card, node: int, components: str) -> tuple[int, ...]:
        """Basic directions, from 0, of components of a grid point; notes those that are along no basic axis."""
        found, R = [], self.axes(node)
        for block in (0, 3):
            own = [d - 1 - block for d in map(int, components) if block < d <= block + 3]
            along = np.abs(R[:, own]) > _SMALL
            if len(own) < 3 and (along.sum(axis=0) != 1).any():
                message = f"this {card.name} acts at grid point {node} in directions of the point's own system"
                self.deck.refuse(card, message, _BASIC)
                return ()
            found += [block + d for d in np.flatnonzero(along.any(axis=1)).tolist()]
        return tuple(found)

    def mesh(self) -> Mesh:
        """Nodes that anything joins, and all of it in sets of elements that are alike."""
        joined = {node for part in self.parts for node in part.nodes}
        joined |= {node for _, first, others, _ in self.links for node in (first, *others)}
        ids = sorted(joined)
        index = {node: i for i, node in enumerate(ids)}
        kinds: dict[Hashable, list[Part]] = {}
        for part in self.parts:
            kinds.setdefault(part.kind, []).append(part)
        links = [RigidLink(index[a], index[b], along) for _, a, others, along in self.links for b in others]
        held = sorted((index[node], d) for node, d in self.held if node in index)
        sets = tuple(_set(parts, index) for parts in kinds.values())
        at = np.array([self.deck.at[node] for node in ids]).reshape(-1, 3)
        return Mesh(np.array(ids, int), at, sets, np.array(held, int).reshape(-1, 2), tuple(links))


def _set(parts: list[Part], index: dict[int, int]) -> ElementSet:
    first = parts[0]
    nodes = np.array([[index[node] for node in part.nodes] for part in parts])
    properties = {name: np.array([part.properties[name] for part in parts]) for name in first.properties}
    ids = np.array([part.number for part in parts])
    return ElementSet(first.type, ids, nodes, properties, first.options, first.origin)


def named(directions: Iterable[int]) -> list[str]:
    """TX, RZ, ... of directions from 0."""
    return [DIRECTIONS[d] for d in directions]

"""A structure with something added: elements split and joined, nodes, springs, masses and supports, as a deck that runs."""

from dataclasses import dataclass, field, replace

import numpy as np

from mouse_cli.diagnosis.extend.renumbered import moved, moved_channels, moved_functions
from mouse_cli.model.mesh import Binding, ElementSet, Mesh, RigidLink
from mouse_cli.model.parameter import Parameter
from mouse_cli.model.problem import Problem
from mouse_cli.model.structure import ListedElements, Structure
from mouse_cli.terms.further import with_parameters

_NEAR = 0.03  # share of an element from its end within which its node serves


@dataclass
class Edit:
    """The mesh of a deck while it is changed; `done` builds the deck. Elements are pairs (set, member), nodes indices."""

    problem: Problem
    node_ids: list[int] = field(init=False)
    coordinates: list[np.ndarray] = field(init=False)
    sets: list[ElementSet] = field(init=False)
    bindings: list[Binding] = field(init=False)
    links: list[RigidLink] = field(init=False)
    supports: list[tuple[int, int]] = field(init=False)
    parameters: list[Parameter] = field(init=False)
    gravity: np.ndarray | None = field(init=False)
    directions: tuple[int, ...] = field(init=False)

    def __post_init__(self) -> None:
        mesh = self.problem.mesh
        self.node_ids, self.coordinates = mesh.node_ids.tolist(), list(mesh.coordinates)
        self.sets, self.bindings, self.links = list(mesh.elements), list(self.problem.bindings), list(mesh.links)
        self.supports = [tuple(held) for held in mesh.supports.tolist()]
        self.parameters, self.gravity, self.directions = [], mesh.gravity, mesh.directions

    def index(self, node_id: int) -> int:
        """Index of the node called `node_id`."""
        return self.node_ids.index(node_id)

    def node(self, coordinates: np.ndarray) -> int:
        """A new node."""
        self.node_ids.append(max(self.node_ids) + 1)
        self.coordinates.append(np.asarray(coordinates, float))
        return len(self.node_ids) - 1

    def add(self, kind: str, nodes, properties: dict, options: dict | None = None) -> list[tuple[int, int]]:
        """New elements of one type at nodes (e, k), with values or (e,) of the properties."""
        first, e = max((int(s.ids.max()) for s in self.sets), default=0) + 1, len(nodes)
        values = {name: np.broadcast_to(np.asarray(value, float), e) for name, value in properties.items()}
        self.sets.append(ElementSet(kind, np.arange(first, first + e), np.asarray(nodes), values, dict(options or {})))
        return [(len(self.sets) - 1, i) for i in range(e)]

    def element(self, number: int) -> tuple[int, int]:
        """The element called `number`."""
        for s, members in enumerate(self.sets):
            for i in np.flatnonzero(members.ids == number):
                return s, int(i)
        raise KeyError(number)

    def values(self, element: tuple[int, int], name: str) -> float:
        """Nominal value of a property of an element."""
        return float(self._all(element[0], name)[element[1]])

    def _all(self, s: int, name: str) -> np.ndarray:
        """Nominal values (e,) of a property of a set, given or not."""
        from mouse_cli.terms.bound_properties import nominal_properties
        from mouse_cli.terms.elements import Layout, registry

        members = self.sets[s]
        if name in members.properties:
            return members.properties[name]
        kind = registry()[members.type]
        options = {key: option.default for key, option in kind.options.items()} | members.options
        return nominal_properties(kind, members, Layout(np.array(self.coordinates)[members.nodes], options))[name]

    def put(self, elements: list[tuple[int, int]], name: str, values: np.ndarray) -> None:
        """Gives `elements` their own values (e,) of a property, whatever material or section it came from."""
        for s in sorted({s for s, _ in elements}):
            own = np.array(self._all(s, name), float)
            for (t, i), value in zip(elements, np.broadcast_to(values, len(elements)), strict=True):
                if t == s:
                    own[i] = value
            members = self.sets[s]
            origin = {key: source for key, source in members.origin.items() if key != name}
            self.sets[s] = replace(members, properties=members.properties | {name: own}, origin=origin)

    def exchange(self, elements: list[tuple[int, int]], one: str, other: str) -> None:
        """Exchanges two properties of `elements`, their values and the parameters bound to them."""
        values = [np.array([self.values(each, name) for each in elements]) for name in (one, other)]
        self.put(elements, one, values[1]), self.put(elements, other, values[0])
        swap, bindings = {one: other, other: one}, []
        for b in self.bindings:
            own = np.array([(b.set, int(i)) in elements for i in b.members]) & (b.property in swap)
            kept = [(b.members[~own], b.property), (b.members[own], swap.get(b.property, b.property))]
            bindings += [replace(b, members=members, property=name) for members, name in kept if len(members)]
        self.bindings = bindings

    def option(self, s: int, **options: object) -> None:
        """Sets options of a whole set."""
        self.sets[s] = replace(self.sets[s], options=self.sets[s].options | options)

    def bind(self, name: str, elements: list[tuple[int, int]], properties: tuple[str, ...], **about) -> None:
        """A new parameter: the common value of `properties` of `elements`, or, where it differs or is bound, a factor of it.

        about: `unit`, and `factor`, the nominal value of a factor.
        """
        factor = "factor" in about
        values = np.concatenate([self._all(s, p)[[i]] for p in properties for s, i in elements])
        if not factor and not self._plain(values, elements, properties):
            about, factor = {"factor": 1.0}, True
        value, unit = float(about["factor"] if factor else values[0]), "" if factor else about.get("unit", "")
        transform = "log" if value > 0 else "identity"
        self.parameters.append(Parameter(name, abs(value), value, unit, transform=transform))
        self.follow(elements, properties, factor)

    def follow(self, elements: list[tuple[int, int]], properties: tuple[str, ...], factor: bool = False) -> None:
        """The newest parameter is the value of `properties` of `elements` too, or a factor of it."""
        number = len(self.problem.parameters) + len(self.parameters) - 1
        for s in sorted({s for s, _ in elements}):
            at = np.array(sorted(i for t, i in elements if t == s))
            self.bindings += [Binding(number, s, at, p, factor) for p in properties]

    def _plain(self, values: np.ndarray, elements: list[tuple[int, int]], properties: tuple[str, ...]) -> bool:
        taken = {(b.set, int(i)) for b in self.bindings if b.property in properties for i in b.members}
        return bool((values == values[0]).all()) and not taken & set(elements)

    def split(self, element: tuple[int, int], share: float) -> int:
        """The node at `share` of the length of a two-node element; a new one between two halves, unless an end is near."""
        s, i = element
        members = self.sets[s]
        offsets = list((members.options.get("offsets") or {}).values())
        apart = bool(offsets) and (len(offsets) < 2 or not np.array_equal(*offsets))
        if apart or share < _NEAR or share > 1 - _NEAR:
            return int(members.nodes[i, round(share)])
        if members.options.get("releases"):
            return self._apart(element, share)
        ends = [self.coordinates[n] for n in members.nodes[i]]
        middle = self.node((1 - share) * ends[0] + share * ends[1])
        nodes = np.insert(members.nodes, i + 1, [middle, members.nodes[i, 1]], axis=0)
        nodes[i, 1] = middle
        ids = np.insert(members.ids, i + 1, max(int(each.ids.max()) for each in self.sets) + 1)
        properties = {name: np.insert(value, i + 1, value[i]) for name, value in members.properties.items()}
        self.sets[s] = replace(members, ids=ids, nodes=nodes, properties=properties)
        self.bindings = [_shifted(b, i) if b.set == s else b for b in self.bindings]
        return middle

    def _apart(self, element: tuple[int, int], share: float) -> int:
        """The same of an element with releases: each half in a set of its own, with those of its end."""
        s, i = self.extract([element])[0]
        options = dict(self.sets[s].options)
        releases = options.pop("releases")
        self.sets[s] = replace(self.sets[s], options=options)
        node = self.split((s, i), share)
        for own, end in ((self.extract([(s, 1)])[0][0], 2), (s, 1)):
            if kept := {key: names for key, names in releases.items() if int(key) == end}:
                self.option(own, releases=kept)
        return node

    def meeting(self, element: tuple[int, int], node: int) -> tuple[int, int]:
        """The element, or, after it was split, the half in another set that begins or ends at `node`."""
        s, i = element
        if s < len(self.sets) and i < len(self.sets[s]) and node in self.sets[s].nodes[i]:
            return element
        return next(
            (t, int(np.flatnonzero((each.nodes == node).any(axis=1))[0]))
            for t, each in enumerate(self.sets)
            if each.type == "beam" and (each.nodes == node).any()
        )

    def detach(self, element: tuple[int, int], end: int) -> int:
        """A node of its own, at the same place, for one end (0, 1) of an element; it is not tied to the old one."""
        new = self.node(self.coordinates[self.sets[element[0]].nodes[element[1], end]])
        self.move_to(element, new, end)
        return new

    def move_to(self, element: tuple[int, int], node: int, end: int = 0) -> None:
        """Puts one end of an element to another node."""
        s, i = element
        nodes = self.sets[s].nodes.copy()
        nodes[i, end] = node
        self.sets[s] = replace(self.sets[s], nodes=nodes)

    def extract(self, elements: list[tuple[int, int]]) -> list[tuple[int, int]]:
        """The same elements, all of one set, in a set of their own."""
        s, own = elements[0][0], np.array(sorted(i for _, i in elements))
        left = np.setdiff1d(np.arange(len(self.sets[s])), own)
        if not len(left):
            return elements
        self.sets.append(_part(self.sets[s], own))
        self.sets[s] = _part(self.sets[s], left)
        new, bindings = len(self.sets) - 1, []
        for b in self.bindings:
            for t, kept in ((s, left), (new, own)) if b.set == s else ():
                members = np.searchsorted(kept, np.intersect1d(b.members, kept))
                bindings += [replace(b, set=t, members=members)] if len(members) else []
            bindings += [] if b.set == s else [b]
        self.bindings = bindings
        return [(new, i) for i in range(len(own))]

    def move(self, s: int, names: tuple[str, ...], to: int) -> None:
        """Bindings of properties of one set, to the same members of another."""
        self.bindings = [replace(b, set=to) if b.set == s and b.property in names else b for b in self.bindings]

    def done(self, searched: bool = True) -> Problem:
        """The deck: model, parameters and test brought to the new degrees of freedom; searched: see `built`. Raises a MeshFault."""
        from mouse_cli.terms.build import built

        mesh, old = self._mesh(), self.problem
        on_dofs = old.structure.geometry is None
        found = built(mesh, tuple(self.bindings), self._base(on_dofs), searched)
        structure = found.structure
        if on_dofs:
            own = len(old.structure.labels)
            labels = old.structure.labels + tuple(str(i + 1) for i in range(own, structure.n))
            structure = replace(structure, labels=labels, geometry=None)
        place = {label: i for i, label in enumerate(structure.labels)}
        to = np.array([place[label] for label in old.structure.labels], int)
        deck = with_parameters(old, self.parameters)
        return replace(
            deck,
            structure=structure,
            elements=_renumbered(old.elements, to),
            terms=found.terms,
            mesh=mesh,
            bindings=tuple(self.bindings),
            test=None if old.test is None else moved(old.test, to, structure.n, place),
            frf=tuple(moved_functions(each, to, structure.n, place) for each in old.frf),
            recordings=tuple(moved_channels(each, to, place) for each in old.recordings),
            run=replace(old.run, total_mass_dofs=tuple(int(to[i]) for i in old.run.total_mass_dofs)),
        )

    def _mesh(self) -> Mesh:
        supports = np.array(self.supports, int).reshape(-1, 2)
        return Mesh(
            np.array(self.node_ids),
            np.array(self.coordinates).reshape(-1, 3),
            tuple(self.sets),
            supports,
            tuple(self.links),
            self.directions,
            self.gravity,
        )

    def _base(self, on_dofs: bool) -> Structure | None:
        """The matrices that the mesh is attached to, if any."""
        found = self.problem.structure
        parts = [m for m in (found.K, found.M, found.C, found.D) if m is not None]
        if not on_dofs:
            return found if any((m.nnz if hasattr(m, "nnz") else m.any()) for m in parts) else None
        labels = tuple(f"{number}TX" for number in self.node_ids[: found.n])
        return replace(found, labels=labels, geometry=None)


def _part(members: ElementSet, own: np.ndarray) -> ElementSet:
    properties = {name: value[own] for name, value in members.properties.items()}
    return replace(members, ids=members.ids[own], nodes=members.nodes[own], properties=properties)


def _renumbered(listed: ListedElements, to: np.ndarray) -> ListedElements:
    row, col = to[listed.row], to[listed.col]
    return ListedElements(listed.is_mass, np.minimum(row, col), np.maximum(row, col))


def _shifted(binding: Binding, i: int) -> Binding:
    """A binding after member i of its set was split in two."""
    members = np.where(binding.members > i, binding.members + 1, binding.members)
    return replace(binding, members=np.append(members, i + 1) if i in binding.members else members)

"""Masses, springs, dashpots and oscillators as elements of the deck, at the places of `points` or of a law."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.matrices import Entries, of_matrices, plus, with_degree_of_freedom, with_entries
from mouse_cli.diagnosis.extend.places import node_at
from mouse_cli.diagnosis.sites.points import Points
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.parameter import Parameter
from mouse_cli.model.problem import Problem


@dataclass(frozen=True)
class Ends:
    """What an element acts on, one motion against the ground or two against each other: `dofs` of a model of matrices; of a mesh
    `nodes`, indices, along `direction`, TX to RZ.
    """

    dofs: tuple[int, ...]
    nodes: Callable[[Edit], list[int]]
    direction: str

    def unit(self, sign: float = 1.0) -> Entries:
        """A unit of what acts between them."""
        low, high = min(self.dofs), max(self.dofs)
        if low == high:
            return np.array([low]), np.array([low]), np.array([sign])
        return np.array([low, low, high]), np.array([low, high, high]), sign * np.array([1.0, -1.0, 1.0])


def found(name: str, value: float, unit: str) -> Parameter:
    """A new parameter at the value that was found: positive, its logarithm known to 1."""
    return Parameter(name, value, value, unit, transform="log")


def add_spring(problem: Problem, ends: Ends, name: str, k: float, sign: float = 1.0) -> Problem:
    """A spring k (N/m), or one that is lost."""
    if of_matrices(problem):
        return with_entries(problem, found(name, k, "N/m"), K=ends.unit(sign))
    return _element(problem, "spring", ends, name, sign * k, "N/m")


def add_dashpot(problem: Problem, ends: Ends, name: str, c: float) -> Problem:
    """A dashpot c (N s/m); in a model of matrices it is part of the damping matrix, and no parameter."""
    if of_matrices(problem):
        return _damped(problem, ends, c)
    return _element(problem, "dashpot", ends, name, c, "N s/m")


def add_mass(problem: Problem, dofs: tuple[int, ...], node: Callable[[Edit], int], name: str, m: float) -> Problem:
    """A mass m (kg) at degrees of freedom of a model of matrices, or at a node of a mesh."""
    if of_matrices(problem):
        return with_entries(problem, found(name, m, "kg"), M=_diagonal(dofs, 1.0))
    edit = Edit(problem)
    edit.bind(name, edit.add("mass", [[node(edit)]], {"mass": m}), ("mass",), unit="kg")
    return edit.done()


def remove_mass(
    problem: Problem, dofs: tuple[int, ...], node: Callable[[Edit], int], name: str, m: float
) -> Problem | None:
    """The same mass lost; of a mesh by the point masses of the node, None where they are not so heavy."""
    if of_matrices(problem):
        return with_entries(problem, found(name, m, "kg"), M=_diagonal(dofs, -1.0))
    edit = Edit(problem)
    at = node(edit)
    heavy = [(s, i) for s, each in enumerate(edit.sets) if each.type == "mass"
             for i in np.flatnonzero(each.nodes[:, 0] == at).tolist()]  # fmt: skip
    whole = sum(edit.values(one, "mass") for one in heavy)
    if whole <= m:
        return None
    edit.bind(name, heavy, ("mass",), factor=1 - m / whole)
    return edit.done()


def _diagonal(dofs: tuple[int, ...], value: float) -> Entries:
    at = np.array(dofs)
    return at, at, np.full(len(at), value)


def add_oscillator(problem: Problem, ends: Ends, names: tuple[str, str], m: float, k: float, c: float = 0.0) -> Problem:
    """A mass m (kg) on a spring k (N/m) and a dashpot c (N s/m); names: of mass and spring."""
    if of_matrices(problem):
        own = problem.structure.n
        deck = with_degree_of_freedom(problem, _free_label(problem))
        deck = add_mass(deck, (own,), lambda edit: own, names[0], m)
        pair = replace(ends, dofs=(ends.dofs[0], own))
        deck = add_spring(deck, pair, names[1], k)
        return _damped(deck, pair, c) if c else deck
    edit = Edit(problem)
    (node,) = ends.nodes(edit)
    free = edit.node(edit.coordinates[node])
    edit.bind(names[0], edit.add("mass", [[free]], {"mass": m}), ("mass",), unit="kg")
    edit.bind(names[1], edit.add("spring", [[node, free]], {ends.direction: k}), (ends.direction,), unit="N/m")
    if c:
        edit.add("dashpot", [[node, free]], {ends.direction: c})
    return edit.done()


def _element(problem: Problem, kind: str, ends: Ends, name: str, value: float, unit: str) -> Problem:
    edit = Edit(problem)
    edit.bind(name, edit.add(kind, [ends.nodes(edit)], {ends.direction: value}), (ends.direction,), unit=unit)
    return edit.done()


def _damped(problem: Problem, ends: Ends, c: float) -> Problem:
    structure = problem.structure
    C = 0 * structure.K if structure.C is None else structure.C
    return replace(problem, structure=replace(structure, C=plus(C, ends.unit(), c)))


def with_spring(problem: Problem, point: Points, at: np.ndarray, k: float) -> Problem:
    """A spring k (N/m) from the place to the ground."""
    return add_spring(problem, _ends(problem, point, at), f"ground spring at {point.site(at).text}", k)


def with_dashpot(problem: Problem, point: Points, at: np.ndarray, c: float) -> Problem:
    """A dashpot c (N s/m) from the place to the ground."""
    return add_dashpot(problem, _ends(problem, point, at), f"dashpot at {point.site(at).text}", c)


def with_mass(problem: Problem, point: Points, at: np.ndarray, m: float) -> Problem:
    """A mass m (kg) at the place."""
    site = point.site(at)
    return add_mass(problem, point.dofs, lambda edit: node_at(edit, site), f"mass at {site.text}", m)


def with_oscillator(problem: Problem, point: Points, at: np.ndarray, m: float, k: float) -> Problem:
    """A mass m (kg) on a spring k (N/m) that the place carries."""
    text = point.site(at).text
    names = f"hidden mass at {text}", f"spring of the mass at {text}"
    return add_oscillator(problem, _ends(problem, point, at), names, m, k)


def with_neighbour(problem: Problem, point: Points, at: np.ndarray, m: float, tie: float, own: float) -> Problem:
    """A mass m (kg) on a spring `own` (N/m) to the ground, which a spring `tie` joins to the place."""
    site = point.site(at)
    names = f"mass of what stands beside {site.text}", f"tie of what stands beside {site.text}"
    name, ends = f"its own spring of what stands beside {site.text}", _ends(problem, point, at)
    deck, last = add_oscillator(problem, ends, names, m, tie), problem.structure.n
    return add_spring(deck, Ends((last,), lambda edit: [len(edit.node_ids) - 1], ends.direction), name, own)


def _ends(problem: Problem, point: Points, at: np.ndarray) -> Ends:
    site = point.site(at)
    direction = "" if of_matrices(problem) else DIRECTIONS[point.dofs[0]]
    return Ends(point.dofs[:1], lambda edit: [node_at(edit, site)], direction)


def _free_label(problem: Problem) -> str:
    labels = problem.structure.labels
    number = len(labels) + 1
    while str(number) in labels:
        number += 1
    return str(number) if labels == tuple(str(i + 1) for i in range(len(labels))) else f"oscillator {number}"

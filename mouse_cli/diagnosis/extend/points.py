"""Masses, springs and oscillators at the places of `points`, as elements of the deck."""

import numpy as np

from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.matrices import of_matrices, with_degree_of_freedom, with_entries
from mouse_cli.diagnosis.extend.places import node_at
from mouse_cli.diagnosis.sites.points import Points
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.parameter import Parameter
from mouse_cli.model.problem import Problem


def found(name: str, value: float, unit: str) -> Parameter:
    """A new parameter at the value that was found: positive, its logarithm known to 1."""
    return Parameter(name, value, value, unit, transform="log")


def with_spring(problem: Problem, point: Points, at: np.ndarray, k: float) -> Problem:
    """A spring k (N/m) from the place to the ground."""
    site = point.site(at)
    name = f"ground spring at {site.text}"
    if of_matrices(problem):
        dof = np.array(point.dofs)
        return with_entries(problem, found(name, k, "N/m"), K=(dof, dof, np.ones(1)))
    edit = Edit(problem)
    spring = edit.add("spring", [[node_at(edit, site)]], {DIRECTIONS[point.dofs[0]]: k})
    edit.bind(name, spring, (DIRECTIONS[point.dofs[0]],), unit="N/m")
    return edit.done()


def with_mass(problem: Problem, point: Points, at: np.ndarray, m: float) -> Problem:
    """A mass m (kg) at the place."""
    site = point.site(at)
    name = f"mass at {site.text}"
    if of_matrices(problem):
        dofs = np.array(point.dofs)
        return with_entries(problem, found(name, m, "kg"), M=(dofs, dofs, np.ones(len(dofs))))
    edit = Edit(problem)
    edit.bind(name, edit.add("mass", [[node_at(edit, site)]], {"mass": m}), ("mass",), unit="kg")
    return edit.done()


def with_oscillator(problem: Problem, point: Points, at: np.ndarray, m: float, k: float) -> Problem:
    """A mass m (kg) on a spring k (N/m) that the place carries."""
    site = point.site(at)
    names = f"hidden mass at {site.text}", f"spring of the mass at {site.text}"
    if of_matrices(problem):
        n, dof = problem.structure.n, point.dofs[0]
        deck = with_degree_of_freedom(problem, _free_label(problem))
        own = np.array([n])
        deck = with_entries(deck, found(names[0], m, "kg"), M=(own, own, np.ones(1)))
        spring = np.array([dof, dof, n]), np.array([dof, n, n]), np.array([1.0, -1.0, 1.0])
        return with_entries(deck, found(names[1], k, "N/m"), K=spring)
    edit, direction = Edit(problem), DIRECTIONS[point.dofs[0]]
    node = node_at(edit, site)
    free = edit.node(edit.coordinates[node])
    edit.bind(names[0], edit.add("mass", [[free]], {"mass": m}), ("mass",), unit="kg")
    edit.bind(names[1], edit.add("spring", [[node, free]], {direction: k}), (direction,), unit="N/m")
    return edit.done()


def _free_label(problem: Problem) -> str:
    labels = problem.structure.labels
    number = len(labels) + 1
    while str(number) in labels:
        number += 1
    return str(number) if labels == tuple(str(i + 1) for i in range(len(labels))) else f"oscillator {number}"

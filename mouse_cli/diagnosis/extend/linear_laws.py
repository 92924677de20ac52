"""Linear causes that recordings show, as parts of the deck: springs, dashpots, masses and hidden oscillators."""

import re
from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.extend.edit import Edit, moved_channels
from mouse_cli.diagnosis.extend.matrices import Entries, of_matrices, with_degree_of_freedom, with_entries
from mouse_cli.model.arrays import dense
from mouse_cli.model.parameter import Parameter
from mouse_cli.model.problem import Problem
from mouse_cli.updating.recordings.hypothesis import Part


def with_linear(problem: Problem, part: Part, p: np.ndarray) -> Problem | None:
    """The deck with a linear law at its place, of parameters p (q,); None where the deck cannot hold it.

    What is lost is a negative spring. A dashpot in a model of matrices is part of its damping matrix, and no parameter.
    """
    add = _to_matrices if of_matrices(problem) else _to_mesh
    return add(problem, part, p)


def _to_matrices(problem: Problem, part: Part, p: np.ndarray) -> Problem | None:
    structure, labels = problem.structure, part.place.site.ids
    if structure.C is None and part.law.key in ("dashpot", "oscillator"):
        return None
    dofs = [structure.labels.index(label) for label in labels]
    parameter = lambda what, value, unit: Parameter(
        f"{what} at {' and '.join(labels)}", value, value, problem.units.of(unit), transform="log"
    )
    if part.law.key == "mass":
        return with_entries(problem, parameter("mass", p[0], "kg"), M=_pair(dofs))
    if part.law.key == "spring":
        return with_entries(
            problem, parameter(f"stiffness {_word(part)}", p[0], "N/m"), K=_pair(dofs, part.words["sign"])
        )
    if part.law.key == "dashpot":
        return _damped(problem, dofs, p[0])
    k, c = _spring_and_dashpot(p)
    deck = with_degree_of_freedom(problem, _free_label(structure.labels))
    both = [dofs[0], structure.n]
    deck = with_entries(deck, parameter("hidden mass", p[0], "kg"), M=_pair(both[1:]))
    deck = with_entries(deck, parameter("spring of the hidden mass", k, "N/m"), K=_pair(both))
    return _damped(deck, both, c)


def _word(part: Part) -> str:
    return part.law.words[part.variant]


def _spring_and_dashpot(p: np.ndarray) -> tuple[float, float]:
    """k = m w^2, c = 2 zeta m w of an oscillator of mass m, frequency in Hz and damping ratio zeta."""
    w = 2 * np.pi * p[1]
    return float(p[0] * w**2), float(2 * p[2] * p[0] * w)


def _pair(dofs: list[int], sign: float = 1.0) -> Entries:
    """A unit of what acts between two degrees of freedom, or between one and the ground."""
    low, high = min(dofs), max(dofs)
    if low == high:
        return np.array([low]), np.array([low]), np.array([sign])
    return np.array([low, low, high]), np.array([low, high, high]), sign * np.array([1.0, -1.0, 1.0])


def _damped(problem: Problem, dofs: list[int], c: float) -> Problem:
    """The deck with a dashpot in its damping matrix."""
    C = np.array(dense(problem.structure.C), float)
    b = np.zeros(len(C))
    b[dofs[-1]] = 1.0
    b[dofs[0]] -= float(len(dofs) > 1)
    return replace(problem, structure=replace(problem.structure, C=C + c * np.outer(b, b)))


def _free_label(labels: tuple[str, ...]) -> str:
    number = len(labels) + 1
    return str(number) if labels == tuple(str(i + 1) for i in range(len(labels))) else f"oscillator {number}"


def _to_mesh(problem: Problem, part: Part, p: np.ndarray) -> Problem | None:
    edit, ids = Edit(problem), part.place.site.ids
    nodes = [edit.index(int(re.match(r"\d+", label)[0])) for label in ids]
    direction, at = ids[0][-2:], " and ".join(ids)
    if part.law.key == "mass":
        edit.bind(f"mass at {at}", edit.add("mass", [nodes], {"mass": p[0]}), ("mass",), unit="kg")
    elif part.law.key == "spring":
        spring = edit.add("spring", [nodes], {direction: part.words["sign"] * p[0]})
        edit.bind(f"stiffness {_word(part)} at {at}", spring, (direction,), unit="N/m")
    elif part.law.key == "dashpot":
        edit.bind(f"dashpot at {at}", edit.add("dashpot", [nodes], {direction: p[0]}), (direction,), unit="N s/m")
    else:
        k, c = _spring_and_dashpot(p)
        free = edit.node(edit.coordinates[nodes[0]])
        edit.bind(f"hidden mass at {at}", edit.add("mass", [[free]], {"mass": p[0]}), ("mass",), unit="kg")
        spring = edit.add("spring", [[nodes[0], free]], {direction: k})
        edit.bind(f"spring of the hidden mass at {at}", spring, (direction,), unit="N/m")
        edit.add("dashpot", [[nodes[0], free]], {direction: c})
    deck, held = edit.done(), problem.held_records
    if held is None:
        return deck
    to = np.array([deck.structure.labels.index(label) for label in problem.structure.labels])
    return replace(
        deck, held_records=replace(held, recordings=tuple(moved_channels(one, to) for one in held.recordings))
    )

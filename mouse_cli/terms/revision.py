"""From a deck at the values of its prior to what other programs call them: materials, sections, springs, masses."""

import re
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.mesh import ElementSet
from mouse_cli.model.problem import Problem
from mouse_cli.model.revision import (
    ACROSS,
    ALONG,
    DENSITY_TIMES,
    E_TIMES,
    MASS_GAINED,
    MASS_LOST,
    OF_SPRING,
    ON_ALIKE,
    ON_SPRINGS,
    PART_LEFT,
    STIFFNESS_GAINED,
    STIFFNESS_LOST,
    THICKNESS,
    TO_THE_POWER,
    End,
    RevisedMass,
    RevisedMaterial,
    RevisedSection,
    RevisedSet,
    RevisedSpring,
    RevisedSupport,
    RevisedThickness,
    Revision,
)
from mouse_cli.model.units import UNDECLARED, system
from mouse_cli.terms.elements.mass import INERTIA, PRODUCTS

Constants = dict[str, tuple[float | None, float | None, float | None]]  # E, nu and density of materials by name

_LABEL = re.compile(r"(\d+)([TR][XYZ])")
_OF_MATERIAL = re.compile(r"(E|density) of (.+)")
_SUPPORTS = re.compile(f"(?:{ON_SPRINGS.format('')}|{ON_ALIKE.format('')})(.+?)(?:({ALONG}|{ACROSS})(T[XYZ]))?")
_OF_SHELLS = re.compile(THICKNESS.format("(.+?)") + f"({TO_THE_POWER.format('.+')})?")
_EQUAL = 1e-9
_OF_SETS: dict[str, Callable[[float], dict[str, float]]] = {
    PART_LEFT: lambda share: {"left": share},
    MASS_GAINED: lambda share: {"mass": share},
    MASS_LOST: lambda share: {"mass": -share},
    E_TIMES: lambda factor: {"stiffness": factor - 1.0},
    DENSITY_TIMES: lambda factor: {"mass": factor - 1.0},
    STIFFNESS_LOST: lambda share: {"stiffness": -share},
    STIFFNESS_GAINED: lambda share: {"stiffness": share},
    OF_SPRING: lambda constant: {"constant": constant},
}
_MOST_SPRINGS = 1000


def revision(
    problem: Problem, before: Problem | None = None, known: Constants | None = None, first: int = 900001
) -> Revision:
    """The revised values of `problem`: those of its prior, with their standard deviations.

    before: the deck before the test, for the notes; None: `problem` is no revised one. known: constants of materials that the
    input file of the solver states.
    """
    before = before or problem
    title, units = problem.title.strip(), "" if problem.units == UNDECLARED else system(problem.units)
    made = Revision(title, problem.source.path, units, first=first)
    for s in range(len(problem.mesh.elements) if problem.mesh is not None else 0):
        made = _of_set(made, problem, before, s)
    bound = {b.parameter for b in problem.bindings}
    for j in range(len(problem.parameters)):
        if j not in bound:
            made = _of_matrices(made, problem, before, j, known or {})
    return made


def _note(problem: Problem, before: Problem, j: int) -> str:
    """Posterior, sd, and the value before, of parameter j; its prior where the deck itself is written."""
    parameter, value, sd = problem.parameters[j], problem.prior.mean[j], problem.prior.sd[j]
    unit = f" {parameter.unit}" if parameter.unit else ""
    known = f"{value:.6g}{unit}, sd {sd:.3g}"
    if before is problem:
        return f"{parameter.name}: prior {known}"
    return f"{parameter.name}: posterior {known}; before the test {before.prior.mean[j]:.6g}"


def _values(problem: Problem, before: Problem, s: int) -> tuple[dict[str, np.ndarray], dict[str, list[str]]]:
    """Every property of set s (e,) at the revised values, and notes by property."""
    members = problem.mesh.elements[s]
    values = {name: np.array(value) for name, value in members.properties.items()}
    notes: dict[str, list[str]] = {}
    for b in (b for b in problem.bindings if b.set == s):
        theta = problem.prior.mean[b.parameter]
        held = values.setdefault(b.property, np.zeros(len(members)))
        held[b.members] = held[b.members] * theta if b.factor else theta
        notes.setdefault(b.property, []).append(_note(problem, before, b.parameter))
    return values, notes


def _of_set(made: Revision, problem: Problem, before: Problem, s: int) -> Revision:
    members = problem.mesh.elements[s]
    values, notes = _values(problem, before, s)
    if members.type == "mass":
        return replace(made, masses=made.masses + tuple(_masses(problem, members, values, notes)))
    if members.type == "spring" and not members.options.get("axes"):
        return replace(made, springs=made.springs + tuple(_springs(problem, members, values, notes)))
    if "E" in values and "A" in values:
        made = replace(made, materials=made.materials + tuple(_materials(made, members, values, notes)))
        if {"A", "Iy", "Iz", "J"} & set(notes):
            made = replace(made, sections=made.sections + tuple(_sections(members, values, notes)))
        return made
    remarks = tuple(f"{members.type} {members.ids[0]}: {note}" for each in notes.values() for note in each)
    return replace(made, unwritten=made.unwritten + remarks)


def _alike(values: dict[str, np.ndarray], names: tuple[str, ...], e: int) -> Iterator[tuple[np.ndarray, list[float]]]:
    """Elements (indices) that have the same values of `names`, and those values."""
    table = np.column_stack([values.get(name, np.zeros(e)) for name in names])
    rows, where = np.unique(table, axis=0, return_inverse=True)
    for k, row in enumerate(rows):
        yield np.flatnonzero(where.ravel() == k), row.tolist()


def _materials(made: Revision, members: ElementSet, values: dict, notes: dict) -> Iterator[RevisedMaterial]:
    """One for each pair of E and density in the set; names that stand for several are counted."""
    own = tuple(note for key in ("E", "G", "nu", "density") for note in notes.get(key, ()))
    if not own:
        return
    taken = {each.name for each in made.materials}
    nu = values.get("nu", np.full(len(members), 0.3))
    for at, (E, density) in _alike(values, ("E", "density"), len(members)):
        name = base = members.origin.get("E", f"M{members.ids[0]}")
        while name in taken:
            name = f"{base}_{1 + sum(each == base or each.startswith(base + '_') for each in taken)}"
        taken.add(name)
        yield RevisedMaterial(name, E, float(nu[at[0]]), density, own, tuple(members.ids[at].tolist()))


def _sections(members: ElementSet, values: dict, notes: dict) -> Iterator[RevisedSection]:
    own = tuple(note for key in ("A", "Iy", "Iz", "J") for note in notes.get(key, ()))
    for k, (at, constants) in enumerate(_alike(values, ("A", "Iy", "Iz", "J"), len(members))):
        name = members.origin.get("A", f"S{members.ids[0]}") + (f"_{k + 1}" if k else "")
        yield RevisedSection(name, *constants, own, tuple(members.ids[at].tolist()))


def _end(problem: Problem, node: int, direction: str) -> End | None:
    """Node and direction of an end; of a matrix model, whose nodes are its degrees of freedom, those of the label."""
    if problem.mesh.directions == (0,) and not problem.mesh.coordinates.any():
        return _labelled(problem, int(problem.mesh.node_ids[node]) - 1)
    return int(problem.mesh.node_ids[node]), DIRECTIONS.index(direction) + 1


def _labelled(problem: Problem, dof: int) -> End | None:
    found = _LABEL.fullmatch(problem.structure.labels[dof]) if problem.structure.labels else None
    return (int(found[1]), DIRECTIONS.index(found[2]) + 1) if found else None


def _springs(problem: Problem, members: ElementSet, values: dict, notes: dict) -> Iterator[RevisedSpring]:
    single = sum(bool(values[d].any()) for d in DIRECTIONS if d in values) == 1
    for direction in DIRECTIONS:
        for e, k in enumerate(values.get(direction, ())):
            ends = tuple(_end(problem, int(node), direction) for node in members.nodes[e])
            if k and None not in ends:
                note = "; ".join(notes.get(direction, ["as in the deck"]))
                note += _instead(ends, note)
                number = int(members.ids[e]) if single else None
                yield RevisedSpring(f"SPRING_{members.ids[e]}_{direction}", ends, float(k), note, number)


def _instead(ends: tuple[End, ...], note: str) -> str:
    """What to do about a support that a spring to the ground stands in place of, by the note on it; empty for other springs."""
    if len(ends) > 1 or not note.startswith(ON_SPRINGS.partition("{}")[0]):
        return ""
    ((node, direction),) = ends
    held = f"{node}{DIRECTIONS[direction - 1]}"
    return f"; where the model holds {held}, take that out of its supports, beside which a spring does nothing"


def _masses(problem: Problem, members: ElementSet, values: dict, notes: dict) -> Iterator[RevisedMass]:
    for e, mass in enumerate(values["mass"]):
        end = _end(problem, int(members.nodes[e, 0]), "TX")
        of = lambda names, e=e: tuple(float(values.get(key, np.zeros(len(members)))[e]) for key in names)
        offset = tuple(members.options.get("offset") or (0.0, 0.0, 0.0))
        note = "; ".join(note for each in notes.values() for note in each) or "as in the deck"
        if end is not None:
            own = f"MASS_{members.ids[e]}", end[0], float(mass), of(INERTIA), note, of(PRODUCTS)
            yield RevisedMass(*own, offset=offset, number=int(members.ids[e]))


def _of_matrices(made: Revision, problem: Problem, before: Problem, j: int, known: Constants) -> Revision:
    """A parameter of matrices: a material that it is called after, or a spring or a mass that its entries make."""
    name, note = problem.parameters[j].name, _note(problem, before, j)
    called = _OF_MATERIAL.fullmatch(name)
    if called and problem.parameters[j].unit != "1":
        return _of_material(made, called[1], called[2], problem.prior.mean[j], note, known)
    part = _of_part(problem, name, float(problem.prior.mean[j]), note)
    if part is not None:
        return replace(made, sets=(*made.sets, part))
    if feet := _of_supports(problem, name, float(problem.prior.mean[j]), note):
        return replace(made, supports=(*made.supports, *feet))
    shells = _OF_SHELLS.fullmatch(name)
    if shells and problem.groups:
        thickness = RevisedThickness(shells[1], float(problem.prior.mean[j]), note)
        return made if shells[2] else replace(made, thicknesses=(*made.thicknesses, thickness))
    column = np.asarray(problem.A[:, [j]].todense() if hasattr(problem.A, "todense") else problem.A[:, [j]]).ravel()
    rows = np.flatnonzero(column)
    listed, theta = problem.elements, float(problem.prior.mean[j])
    entries = [(int(listed.row[i]), int(listed.col[i]), float(column[i]) * theta) for i in rows[:_MOST_SPRINGS]]
    mass = bool(len(rows)) and bool(listed.is_mass[rows].all())
    spring = 0 < len(rows) <= _MOST_SPRINGS and not listed.is_mass[rows].any()
    every = _springs_of(problem, entries) if spring else []
    if every:
        names = [name] if len(every) == 1 else [f"{name} {i}" for i in range(1, len(every) + 1)]
        found = (RevisedSpring(own, ends, k, note) for own, (ends, k) in zip(names, every, strict=True))
        return replace(made, springs=(*made.springs, *found))
    at = _mass_at(problem, entries) if mass and len(rows) < 4 else None
    if at is not None:
        return replace(made, masses=(*made.masses, RevisedMass(name, at, entries[0][2], note=note)))
    return replace(made, unwritten=(*made.unwritten, note))


def _of_part(problem: Problem, name: str, value: float, note: str) -> RevisedSet | None:
    """What a parameter does to a named element set."""
    for group in problem.groups:
        for pattern, change in _OF_SETS.items():
            if name == pattern.format(group.name):
                return RevisedSet(group.name, **change(value), note=note)
    return None


def _of_supports(problem: Problem, name: str, value: float, note: str) -> tuple[RevisedSupport, ...]:
    """What a parameter does to supports that move as rigid bodies, one or several alike."""
    called = _SUPPORTS.fullmatch(name)
    if not called:
        return ()
    own = DIRECTIONS.index(called[3]) + 1 if called[2] else 0
    along = tuple(d for d in (1, 2, 3) if not own or (d == own) == (called[2] == ALONG))
    labels = set(problem.structure.labels)
    of = lambda support: tuple(i for i, d in enumerate(DIRECTIONS, 1) if f"{support} {d}" in labels)
    moved = {support: of(support) for support in (called[1], *re.split(", | and ", called[1]))}
    return tuple(RevisedSupport(support, own, value, note, along) for support, own in moved.items() if own)


def _of_material(made: Revision, what: str, name: str, value: float, note: str, known: Constants) -> Revision:
    own = next((each for each in made.materials if each.name == name), None)
    others = tuple(each for each in made.materials if each.name != name)
    if own is None:
        own = RevisedMaterial(name, *known.get(name, (None, None, None)))
    changed = {"E": value} if what == "E" else {"density": value}
    return replace(made, materials=(*others, replace(own, notes=(*own.notes, note), **changed)))


def _springs_of(problem: Problem, entries: list[tuple[int, int, float]]) -> list[tuple[tuple[End, ...], float]]:
    """The springs that entries make: k, k and -k between two ends, or each k on the diagonal to the ground; none for others."""
    diagonal = [(i, k) for i, j, k in entries if i == j]
    off = [k for i, j, k in entries if i != j]
    ends = [_labelled(problem, i) for i, _ in diagonal]
    if None in ends:
        return []
    if not off:
        return [((end,), k) for end, (_, k) in zip(ends, diagonal, strict=True)]
    pair = len(diagonal) == 2 and len(off) == 1 and abs(diagonal[0][1] - diagonal[1][1]) <= _EQUAL * abs(diagonal[0][1])
    pair = pair and abs(off[0] + diagonal[0][1]) <= _EQUAL * abs(off[0])
    return [(tuple(ends), diagonal[0][1])] if pair else []


def _mass_at(problem: Problem, entries: list[tuple[int, int, float]]) -> int | None:
    """The node of a mass that is alike in all the directions in which it may move there; None for others."""
    ends = [_labelled(problem, i) for i, j, _ in entries if i == j]
    if len(ends) != len(entries) or None in ends or np.ptp([m for *_, m in entries]) > _EQUAL * abs(entries[0][2]):
        return None
    node = ends[0][0]
    free = sum(1 for label in problem.structure.labels if re.fullmatch(rf"{node}T[XYZ]", label))
    return node if {each[0] for each in ends} == {node} and len(ends) == free else None

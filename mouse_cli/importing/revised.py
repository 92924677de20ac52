"""The whole job with what a test has revised and a diagnosis has added: materials, sets, supports, springs and masses as cards."""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli._errors import DeckError
from mouse_cli.formats.solver_cards import tag
from mouse_cli.formats.solver_cards.keywords import keyword_lines
from mouse_cli.importing.bricks import brick_lines
from mouse_cli.importing.cards import Card
from mouse_cli.importing.jobs import elastic, of_same_elements, real, section, times, without
from mouse_cli.importing.model import Group, InputModel
from mouse_cli.model.geometry import DIRECTIONS, rigid_motions
from mouse_cli.model.problem import Problem
from mouse_cli.model.revision import GONE, RevisedSpring, RevisedSupport, Revision

_POINT = 1e-9  # of the size of the structure: an arm that is none
_Factors = tuple[float, float]  # of the moduli and of the density, to those of the job


@dataclass(frozen=True)
class _Changes:
    """materials, groups (by id): factors; gone: elements that are taken out; released: nodes of supports that are
    other than before; notes: by the name of a material or a set; thickness: factors of groups (by id).
    """

    materials: dict[str, _Factors]
    groups: dict[int, _Factors]
    gone: set[int]
    released: set[int]
    notes: dict[str, list[str]]
    thickness: dict[int, float]


def revised_job(model: InputModel, problem: Problem, revision: Revision, inertia: bool) -> str:
    """The input file; inertia: the program has point inertias. Raises DeckError (MD483) where the deck is not of this job."""
    _of_this_job(model, problem)
    revision = replace(revision, first=max(revision.first, max(model.elements) + 1))
    added, released = _added(model, problem, revision, inertia)
    changes, used = _changes(model, revision, released), set(model.elsets) | set(model.materials)
    lines: list[str] = []
    material, stepped = "", False
    for card in model.every:
        if card.keyword == "MATERIAL":
            material = card.options.get("NAME", "")
            lines += [f"** {note}" for note in changes.notes.get(material, ())]
        if card.keyword == "STEP" and not stepped:
            stepped = True
            lines += added
        lines += _card(card, model, changes, material, used)
    return "\n".join(lines if stepped else lines + added) + "\n"


def _of_this_job(model: InputModel, problem: Problem) -> None:
    supports = {each.name for each in problem.held.supports} if problem.held is not None else set()
    known = {each.name for each in model.groups}, {each.name for each in model.supports}
    strange = sorted({each.name for each in problem.groups} - known[0]) + sorted(supports - known[1])
    if strange or not problem.groups:
        what = f"{strange[0]} is no set or support of {model.path}" if strange else "the deck has no element sets"
        help = "give the input file that `mouse import` made the deck of"
        raise DeckError.of("MD483", what, problem.place("order"), help=help)


def _changes(model: InputModel, revision: Revision, released: set[int]) -> _Changes:
    notes: dict[str, list[str]] = {}
    materials = {}
    for each in revision.materials:
        known = model.materials.get(each.name)
        if known is not None:
            ratio = each.E / known.E if each.E is not None else 1.0
            materials[each.name] = (ratio, each.density / known.rho if each.density and known.rho else 1.0)
            notes[each.name] = list(each.notes)
    groups, gone, kept = {}, set(), set()
    for group in model.groups:
        own = [part for part in revision.sets if part.name == group.name]
        left = float(np.prod([part.left for part in own]))
        e, r = materials.get(group.material.name, (1.0, 1.0)) if group.material is not None else (1.0, 1.0)
        if own:
            e *= float(np.prod([part.constant / group.constant for part in own if part.constant is not None]))
            groups[id(group)] = left * e + sum(p.stiffness for p in own), left * r + sum(p.mass for p in own)
            notes.setdefault(group.name, []).extend(part.note for part in own)
            gone |= set(group.elements) if left < GONE else set()
        kept |= set(group.elements) if not own or left >= GONE else set()  # other layers may be
    thickness = {}
    for one in revision.thicknesses:
        for group in model.groups:
            if group.shell and one.name in (group.name, group.owner.options.get("ELSET")):
                ratio = one.value / float(group.owner.lines[0].words[0])
                thickness[id(group)] = thickness.get(id(group), 1.0) * ratio
        notes.setdefault(one.name, []).append(one.note)
    return _Changes(materials, groups, gone - kept, released, notes, thickness)


def _card(card: Card, model: InputModel, changes: _Changes, material: str, used: set[str]) -> list[str]:
    """What a card of the job becomes; supports that are released, in part or as a whole, are written anew."""
    factors = changes.materials.get(material, (1.0, 1.0))
    own = [group for group in model.groups if group.owner is card]
    if card.keyword == "BOUNDARY":
        kept = [line.text for line in card.lines if not changes.released & set(_nodes(model, line.words[0]))]
        return [card.head.text, *kept] if kept else []
    thickness = {changes.thickness.get(id(group), 1.0) for group in own}
    if any(id(group) in changes.groups for group in own) or len(thickness) > 1:
        return _sections(own, changes, used)
    if card.keyword == "ELASTIC" and factors[0] != 1.0:
        return elastic(model.materials[material], factors[0])
    if card.keyword == "DENSITY" and factors[1] != 1.0:
        return [card.head.text, times(card, 0, factors[1], of=1)]
    if changes.gone and card.keyword in ("ELEMENT", "ELSET"):
        return without(card, model, changes.gone)
    named = card.options.get("ELSET")
    if thickness - {1.0}:
        noted, rest = (f"** {note}" for note in changes.notes.get(named, ())), (line.text for line in card.lines[1:])
        return [*noted, card.head.text, times(card, 0, thickness.pop(), of=1), *rest]
    if changes.gone and named in model.elsets and changes.gone.issuperset(model.elsets[named]):
        return []
    return card.text()


def _sections(own: list[Group], changes: _Changes, used: set[str]) -> list[str]:
    """A section for each group of one, with a material of its own; none for what is taken out."""
    lines = []
    for alike in of_same_elements(own):
        lines += [f"** {note}" for group in alike for note in changes.notes.get(group.name, ())]
        if changes.gone.issuperset(alike[0].elements):
            lines.append(f"** {alike[0].name} is taken out")
            continue
        of = {id(group): changes.materials[group.material.name] for group in alike
              if group.material is not None and group.material.name in changes.materials}  # fmt: skip
        thickness = changes.thickness.get(id(alike[0]), 1.0)
        lines += section(alike, tag(f"{alike[0].name}_REVISED", used), of | changes.groups, thickness)
    return lines


def _nodes(model: InputModel, word: str) -> list[int]:
    """Nodes of a set, or one by its number."""
    return [int(word)] if word.isdigit() else model.nsets.get(word.strip('"').upper(), [])


def _added(model: InputModel, problem: Problem, revision: Revision, inertia: bool) -> tuple[list[str], set[int]]:
    """Supports as they are now, where they are other than in the job, springs and masses that are new; nodes of these supports."""
    tied = {own.name: [part for part in revision.supports if part.name == own.name] for own in revision.supports}
    free, lines = set(problem.structure.labels), []
    first, springs, released = max(model.nodes) + 1, list(revision.springs), set()
    for support in model.supports:
        released |= {(n, d) for n, d in support.dofs if f"{n}{DIRECTIONS[d - 1]}" in free}
        if support.name in tied:
            moved, own, more = _rigid(model, support.dofs, tied[support.name], first)
            released |= moved
            springs += own
            lines += more
            first += len(tied[support.name][0].directions)
    nodes = {n for n, _ in released}
    if nodes & model.turned.keys():
        message = f"node {min(nodes & model.turned.keys())} has directions of *TRANSFORM, and its support is revised"
        raise DeckError.of("MD483", message, problem.place("order"), help="take *TRANSFORM out of the job")
    held = [dof for each in model.supports for dof in each.dofs if dof[0] in nodes and dof not in released]
    rest = replace(revision, materials=(), sections=(), sets=(), supports=(), springs=tuple(springs))
    boundary = ["*BOUNDARY", *(f"{n}, {d}, {d}" for n, d in held)] if held else []
    solids = not inertia and any(group.laminate for group in model.groups)
    points = brick_lines(model, rest, first) if solids else keyword_lines(rest, inertia)
    return [*lines, *points, *boundary], nodes


def _rigid(model: InputModel, dofs: list[tuple[int, int]], own: list[RevisedSupport], first: int):
    """A support as a rigid body: what of it is moved, its springs, and a node for each motion with equations that follow it.

    Springs of equal stiffness at every degree of freedom along some directions: together `stiffness` against the one motion, or in
    one translation; own: of each stiffness.
    """
    at, d = np.array([model.nodes[n] for n, _ in dofs]), np.array([d for _, d in dofs]) - 1
    centre = np.mean([model.nodes[n] for n in dict.fromkeys(n for n, _ in dofs)], axis=0)
    size = float(np.ptp(np.array(list(model.nodes.values())), axis=0).max())
    pattern = rigid_motions(at - centre, d, _POINT * size)[:, [k - 1 for k in own[0].directions]]
    place = ", ".join(map(real, centre.tolist()))
    lines = ["*NODE", *(f"{first + k}, {place}" for k in range(pattern.shape[1]))]
    moved = [i for i in range(len(dofs)) if pattern[i].any()]
    for i in moved:
        by = np.flatnonzero(pattern[i])
        terms = (f", {first + k}, 1, {real(-float(pattern[i, k]))}" for k in by.tolist())
        lines += ["*EQUATION", str(1 + len(by)), f"{dofs[i][0]}, {dofs[i][1]}, 1.0{''.join(terms)}"]
    one, springs = pattern.shape[1] == 1, []
    count = float(pattern[:, 0] @ pattern[:, 0] if one else np.count_nonzero(pattern[:, 0]))
    for part in own:
        sprung = [i for i in moved if one or d[i] + 1 in part.along]
        name = part.name + (f" {DIRECTIONS[part.along[0] - 1]}" if len(own) > 1 else "")
        springs += [RevisedSpring(f"{name} {i}", (dofs[k],), part.stiffness / count, part.note) for i, k in enumerate(sprung, 1)]
    return {dofs[i] for i in moved}, springs, lines

"""Bars without what they carry, or lighter themselves: an empty pipe or tank, a lining or cladding that is gone."""

from collections.abc import Callable

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe, proportional
from mouse_cli.diagnosis.effects.element_sets import LIGHTER, lighter
from mouse_cli.diagnosis.effects.losses import matrices_of
from mouse_cli.diagnosis.effects.members import Part, summed
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.bars import displacements
from mouse_cli.diagnosis.sites.members import ONE, SLENDER, Member, described, members
from mouse_cli.diagnosis.sites.reasons import members as why
from mouse_cli.model.mesh import Mesh
from mouse_cli.model.problem import Problem

_CARRIED, _OWN = "nonstructural_mass", "density"
_MOST = 240  # members that are looked at: the heaviest in a low mode
_FELT = 1e-6  # share of the mass of a mode below which a member has no part in it


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """M - d M_e of each member, row of members, storey and section: of what it carries, or of itself where it carries nothing."""
    if model.motion is None:
        return lighter(model, candidate)
    mesh, count = model.problem.mesh, model.low_modes()
    listed = members(mesh)
    listed += _laden(mesh, listed)
    parts = {s: _mass(model, s) for s in {s for member in listed for s, _ in member.elements}}
    found = [(member, summed(member, parts, 2)) for member in listed]
    felt = [float(M.diagonal()[:count].max()) for _, M in found]
    chosen = [found[i] for i in sorted(np.argsort(felt)[::-1][:_MOST].tolist()) if felt[i] > _FELT]
    kinds = [member.kind for member, _ in chosen]
    share = {kind: -float(np.log(len(set(kinds)) * kinds.count(kind))) for kind in kinds}
    return [_recipe(model, candidate, member, M, share[member.kind]) for member, M in chosen]


def _laden(mesh: Mesh, listed: list[Member]) -> list[Member]:
    """What each entry of the deck has of elements that carry mass, where that is none of the members `listed`."""
    known = {frozenset(member.elements) for member in listed}
    carrying = [
        tuple((s, int(i)) for i in np.flatnonzero(own.properties[_CARRIED]))
        for s, own in enumerate(mesh.elements)
        if _CARRIED in own.properties
    ]
    return [Member(ONE, part, described(mesh, part, ONE)) for part in carrying if part and frozenset(part) not in known]


def _lost(model: Reduced, s: int) -> str:
    """The property of the elements of a set that is less."""
    carried = model.problem.mesh.elements[s].properties.get(_CARRIED)
    return _CARRIED if carried is not None and np.any(carried) else _OWN


def _mass(model: Reduced, s: int) -> Part:
    """See `Part`; M (e, 12, 12) of what may be missing."""
    elements, found = model.problem.mesh.elements[s], matrices_of(model, s)
    less = matrices_of(model, s, **{_lost(model, s): 0.0}) if elements.type in SLENDER else found
    none = np.zeros_like(found["K"])  # of storeys, which only hold
    return displacements(model.motion, elements.nodes, model.V), found["K"], found.get("M", none) - less.get("M", none)


def _recipe(model: Reduced, candidate: Candidate, member: Member, M: np.ndarray, share: float) -> Recipe:
    site, groups = member.site, {}
    for s, i in member.elements:
        groups.setdefault(_lost(model, s), []).append(int(model.problem.mesh.elements[s].ids[i]))
    return proportional(candidate, LIGHTER, 4, site, share, _extension(groups, site.text), M=-M)


def _extension(groups: dict[str, list[int]], text: str) -> Callable[[Problem, np.ndarray], Problem]:
    """groups: numbers of the elements by the property that is less."""

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        (first, numbers), *others = groups.items()
        edit.bind(f"mass left of {text}", [edit.element(n) for n in numbers], (first,), factor=1 - values[0])
        for name, numbers in others:
            edit.follow([edit.element(n) for n in numbers], (name,), factor=True)
        return edit.done()

    return extend


CANDIDATE = Candidate(
    "lighter",
    "bars without what they carry",
    "mass-loss",
    "a beam, a straight row of beams or rods, the columns, braces or beams of one storey, all members of one section or a "
    "named element set that weigh less than modelled and are as stiff: a pipe or tank that is empty, a lining, cladding or "
    "ballast that is gone; of the nonstructural_mass, or of the density where there is none",
    recipes,
    why,
)

"""Members whose section is turned by a right angle: Iy and Iz exchanged, and what else belongs to an axis."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe
from mouse_cli.diagnosis.effects.losses import matrices_of
from mouse_cli.diagnosis.effects.members import Part, chosen, summed
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.bars import displacements
from mouse_cli.diagnosis.sites.left_out import left_out
from mouse_cli.diagnosis.sites.members import Element, Member, among
from mouse_cli.model.mesh import Mesh
from mouse_cli.model.problem import Problem

_MOST = 60  # members that are looked at: those whose turning changes most energy in the lowest modes
_FELT = 1e-6  # share of the energy of a mode below which turning a member changes nothing
_PAIRS = (("Iy", "Iz"), ("kappa_y", "kappa_z"))


def of_turned(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """K + K_e(Iz, Iy) - K_e(Iy, Iz), and M likewise, of each member, row and section, and of all beams: no unknown."""
    if model.motion is None:
        return []
    parts: dict[int, Part] = {}
    found = chosen(model, _oblong(model.problem.mesh), parts, _MOST, _FELT, _turned)
    return [_recipe(model, candidate, member, parts, share) for member, share in found]


def _oblong(mesh: Mesh) -> list[Member]:
    """Members of beams with two different second moments of area, and all of these."""
    own = lambda s, name: mesh.elements[s].properties.get(name)
    beams = [
        s for s, each in enumerate(mesh.elements) if each.type == "beam" and each.options.get("theory") != "generic"
    ]
    both = [s for s in beams if own(s, "Iy") is not None and own(s, "Iz") is not None]
    turns: set[Element] = set()
    for s in both:
        Iy, Iz = own(s, "Iy"), own(s, "Iz")
        turns |= {(s, int(i)) for i in np.flatnonzero((Iy > 0) & (Iz > 0) & (np.abs(Iy - Iz) > _FELT * (Iy + Iz)))}
    return among(mesh, turns, "all beams that are not as stiff about both axes")


def _turned(model: Reduced, s: int) -> Part:
    """Motion of the nodes of a set, and what K and M of its elements change by."""
    given, turned = matrices_of(model, s), matrices_of(model, s, _PAIRS)
    u = displacements(model.motion, model.problem.mesh.elements[s].nodes, model.V)
    return u, turned["K"] - given["K"], turned["M"] - given["M"]


def _recipe(model: Reduced, candidate: Candidate, member: Member, parts: dict[int, Part], log_prior: float) -> Recipe:
    mesh, site = model.problem.mesh, member.site
    numbers = [int(mesh.elements[s].ids[i]) for s, i in member.elements]
    nodes = np.array([mesh.elements[s].nodes[i] for s, i in member.elements])

    def turned(there: Reduced) -> np.ndarray:
        whole = {s: _turned(there, s)[1] for s in {s for s, _ in member.elements}}
        return np.array([whole[s][i] for s, i in member.elements])

    left, added = left_out(model, ("turned", member.elements), nodes, turned), summed(member, parts, 1)
    if left is not None:
        added = added + left.correction(1.0)
    change = Change(added, summed(member, parts, 2))

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        own = [edit.element(number) for number in numbers]
        kinds = {name for s, _ in own for name in edit.sets[s].properties}
        for pair in _PAIRS:
            if kinds.intersection(pair):
                edit.exchange(own, *pair)
        return edit.done()

    return Recipe(
        candidate, (), lambda values: change, np.zeros((1, 0)), lambda values: site, log_prior=log_prior, extend=extend
    )

"""Members whose torsional stiffness is another one: a tube that is slotted, a box that is open, warping that is held.

K + (r - 1) K_J, K_J of their torsion constants alone.
"""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.effects.members import Part, chosen, summed
from mouse_cli.diagnosis.effects.of_sets import Growth, matrices_of
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.bars import displacements
from mouse_cli.diagnosis.sites.left_out import left_out
from mouse_cli.diagnosis.sites.members import Member, among
from mouse_cli.diagnosis.sites.reasons import twisting
from mouse_cli.model.mesh import Mesh
from mouse_cli.model.problem import Problem

_MOST = 60  # members that are looked at: those that hold most energy of torsion in the lowest modes
_FELT = 1e-3  # share of the energy of a mode below which the torsion of a member has no part in it
_RATIO = Unknown("torsion constant over that of the model", "1", 0.01, 100.0)


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """K + (r - 1) K_J of each member, row and section, and of all beams."""
    if model.motion is None:
        return []
    parts: dict[int, Part] = {}
    found = chosen(model, _of_beams(model.problem.mesh), parts, _MOST, _FELT, _torsion)
    growth = Growth(model, lambda there, s: {"K": _stiffness(there, s)})
    made = ((member, _recipe(model, candidate, member, parts, share)) for member, share in found)
    return [replace(one, grows=growth.of(member.elements)) for member, one in made]


def _of_beams(mesh: Mesh) -> list[Member]:
    """Members of beams with a torsion constant, and all of these."""
    twist = {
        (s, int(i))
        for s, each in enumerate(mesh.elements)
        if each.type == "beam" and each.properties.get("J") is not None
        for i in np.flatnonzero(each.properties["J"] > 0)
    }
    return among(mesh, twist, "all beams")


def _torsion(model: Reduced, s: int) -> Part:
    """Motion of the nodes of a set, K of its torsion, and no M."""
    K = _stiffness(model, s)
    return displacements(model.motion, model.problem.mesh.elements[s].nodes, model.V), K, np.zeros_like(K)


def _stiffness(model: Reduced, s: int) -> np.ndarray:
    """K_J (e, 12, 12) of the elements of a set."""
    return matrices_of(model, s)["K"] - matrices_of(model, s, J=0.0)["K"]


def _recipe(model: Reduced, candidate: Candidate, member: Member, parts: dict[int, Part], log_prior: float) -> Recipe:
    mesh, site = model.problem.mesh, member.site
    numbers = [int(mesh.elements[s].ids[i]) for s, i in member.elements]
    nodes = np.array([mesh.elements[s].nodes[i] for s, i in member.elements])

    def stiffness(there: Reduced) -> np.ndarray:
        whole = {s: _stiffness(there, s) for s in {s for s, _ in member.elements}}
        return np.array([whole[s][i] for s, i in member.elements])

    left, K = left_out(model, ("torsion constant", member.elements), nodes, stiffness), summed(member, parts, 1)

    def change(values: np.ndarray) -> Change:
        more = float(values[0]) - 1
        return Change(more * K + (0.0 if left is None else left.correction(more)))

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        own = [edit.element(number) for number in numbers]
        edit.bind(f"torsion constant of {site.text}", own, ("J",), factor=float(values[0]))
        return edit.done()

    grid = steps(_RATIO, 4)[:, None]
    return Recipe(candidate, (_RATIO,), change, grid, lambda values: site, log_prior=log_prior, extend=extend)


CANDIDATE = Candidate(
    "torsion",
    "another torsional stiffness",
    "torsion",
    "a beam, a straight row of beams, those of one storey, all of one section or all beams whose torsion constant J alone is "
    "another one, smaller or larger: a tube that is slotted, a box or a cell that is open, an open section whose warping is held",
    recipes,
    twisting,
)

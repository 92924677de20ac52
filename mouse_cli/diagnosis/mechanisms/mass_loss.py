"""A point mass of the deck that has lost a part of itself, or is gone."""

import numpy as np

from mouse_cli.diagnosis.effects.change import LOST, Recipe, Unknown, proportional
from mouse_cli.diagnosis.effects.losses import matrices_of
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.gates import WHOLLY
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.problem import Problem
from mouse_cli.terms.elements.mass import INERTIA, PRODUCTS

_SHARE = Unknown(LOST, "1", 0.02, 0.99, at_end=WHOLLY)
_OWN = ("mass", *INERTIA, *PRODUCTS)


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """M - d M_e of each point mass."""
    mesh, found = model.problem.mesh, []
    for s, members in enumerate(() if mesh is None else mesh.elements):
        if members.type == "mass":
            heavy = matrices_of(model, s)["M"]
            found += [(s, i, M) for i, M in enumerate(heavy) if M.any()]
    return [_recipe(model, candidate, s, i, M, len(found)) for s, i, M in found]


def _recipe(model: Reduced, candidate: Candidate, s: int, i: int, M: np.ndarray, count: int) -> Recipe:
    members = model.problem.mesh.elements[s]
    number, node = int(members.ids[i]), int(members.nodes[i, 0])
    rows = model.node(node)
    lost = rows.T @ M @ rows
    site = Site("element", (number,), tuple(model.problem.mesh.coordinates[node].tolist()), f"mass {number}")

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        element = edit.element(number)
        own = tuple(name for name in _OWN if edit.values(element, name))
        edit.bind(f"mass left of {site.text}", [element], own, factor=1 - values[0])
        return edit.done()

    return proportional(candidate, _SHARE, 3, site, -float(np.log(count)), extend, M=-lost)


CANDIDATE = Candidate(
    "mass-loss",
    "a point mass that has lost a part of itself",
    "mass-loss",
    "an attached mass that is lighter than in the deck, or gone: M - d M_e of one point mass",
    recipes,
)

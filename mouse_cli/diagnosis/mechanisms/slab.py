"""A slab, a deck or sheeting that makes a floor stiff in its plane: what joins beams of a floor and the model does not have."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.extend.diagonals import with_diagonals
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest, total_mass
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.members import upward
from mouse_cli.diagnosis.sites.pairs import Pairs, pairs
from mouse_cli.diagnosis.sites.panels import level
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.problem import Problem

_SIZES = 8  # to begin from


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """K + G t times the integral of the squared shear of each panel of a floor, or of all floors: two diagonals stand for each.

    A panel of area A and shear stiffness G t per length is two springs k_i = G t d^2 / (2 A) along diagonals of length d.
    """
    every = pairs(model)
    floors = level(model, every)
    if not floors:
        return []
    axis = "XYZ"[upward(model.problem.mesh)]
    named = {f"the floor at {axis} = {height:g} m": two for height, two in floors.items()}
    if len(named) > 1:
        named["all floors"] = np.concatenate(list(floors.values()))
    return [_recipe(model, candidate, every, name, two, len(named)) for name, two in named.items()]


def _recipe(model: Reduced, candidate: Candidate, every: Pairs, name: str, two: np.ndarray, count: int) -> Recipe:
    """two (x, 2): numbers of the diagonals of x panels among `every`."""
    mesh, which = model.problem.mesh, two.ravel()
    nodes = every.keys[which, :2]
    along = np.diff(mesh.coordinates[nodes], axis=1)[:, 0]
    length = np.linalg.norm(along, axis=1)
    area = np.linalg.norm(np.cross(along[::2], along[1::2]), axis=1) / 2
    share = length**2 / (2 * np.repeat(area, 2))  # of G t that each diagonal is
    b, left = every.rows[which], every.left(model.eigenvalues)[which]
    scale = lowest(model) * total_mass(model)
    shear = Unknown("shear stiffness in its plane", "N/m", 1e-3 * scale, 1e5 * scale)
    ids = tuple(np.unique(mesh.node_ids[nodes]).tolist())
    site = Site("node", ids, tuple(mesh.coordinates[np.unique(nodes)].mean(axis=0).tolist()), name)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        return with_diagonals(problem, mesh.node_ids[nodes], f"shear stiffness of {name}", values[0] * share)

    return Recipe(
        candidate,
        (shear,),
        lambda values: Change(K=(b.T / (1 / (values[0] * share) + left)) @ b),
        steps(shear, _SIZES)[:, None],
        lambda values: site,
        log_prior=-float(np.log(count)),
        extend=extend,
    )


CANDIDATE = Candidate(
    "slab",
    "a floor that is stiff in its plane",
    "brace",
    "a slab, a deck, sheeting or bracing between the beams of one floor, or of all alike, that the model does not have, and that "
    "makes the floor a disc: G t times the squared shear of every panel of it, as two diagonals each",
    recipes,
)

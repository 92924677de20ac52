"""Items that the deck has as massless: each alone, or those of one entry alike."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, product, steps
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import BODY, span, total_mass
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.problem import Problem

_INERTIA = ("Jx", "Jy", "Jz")


def massless(problem: Problem) -> list[tuple[int, int, int]]:
    """Set, member and node (index) of every point mass of 0 kg."""
    if problem.mesh is None:
        return []
    return [
        (s, i, int(members.nodes[i, 0]))
        for s, members in enumerate(problem.mesh.elements)
        if members.type == "mass"
        for i in range(len(members))
        if members.properties["mass"][i] == 0
    ]


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """M + m (T'T + r^2 R'R) for the translations T and rotations R of each node: those of one entry alike, and each alone."""
    found = massless(model.problem)
    if not found:
        return []
    sets = [[one for one in found if one[0] == s] for s in sorted({s for s, _, _ in found})]
    choices = [alike for alike in sets if len(alike) > 1] + [[one] for one in found]
    return [_recipe(model, candidate, chosen, -float(np.log(len(choices)))) for chosen in choices]


def _recipe(model: Reduced, candidate: Candidate, chosen: list[tuple[int, int, int]], log_prior: float) -> Recipe:
    rows = [model.node(node) for _, _, node in chosen]
    straight, turning = (sum(u[own].T @ u[own] for u in rows) for own in (slice(0, 3), slice(3, 6)))
    total, length = total_mass(model), span(model)
    m = Unknown("mass of each", "kg", *(BODY * total))
    r = Unknown("radius of gyration", "m", 1e-3 * length, 0.1 * length)
    extended = bool(turning.any())  # else nothing in the model turns
    ids = tuple(int(model.problem.mesh.elements[s].ids[i]) for s, i, _ in chosen)
    named = f"item{'s' if len(ids) > 1 else ''} {', '.join(map(str, ids))}"
    change = lambda values: Change(M=values[0] * (straight + values[1] ** 2 * turning if extended else straight))

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        own = [edit.element(number) for number in ids]
        edit.put(own, "mass", np.full(len(own), values[0]))
        edit.bind(f"mass of {named}", own, ("mass",), unit="kg")
        if extended:
            for name in _INERTIA:
                edit.put(own, name, np.full(len(own), values[0] * values[1] ** 2))
            edit.bind(f"inertia of {named}", own, _INERTIA, unit="kg m2")
        return edit.done()

    site = Site("element", ids, None, named)
    unknowns, grid = ((m, r), product(steps(m, 5), steps(r, 2))) if extended else ((m,), steps(m, 5)[:, None])
    return Recipe(candidate, unknowns, change, grid, lambda values: site, log_prior=log_prior, extend=extend, linear=0)


CANDIDATE = Candidate(
    "items",
    "the mass of items that the deck has as massless",
    "items",
    "added masses at known positions (point masses of 0 kg in the deck), with an extent: one item, or all of "
    "one entry of the deck alike: M + m (T'T + r^2 R'R) for the translations T and rotations R of each node",
    recipes,
)

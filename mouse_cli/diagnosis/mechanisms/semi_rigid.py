"""Semi-rigid connections of one stiffness: all joints of beams and columns, or one kind of them; all corners of a run of pipes."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe, steps
from mouse_cli.diagnosis.effects.connections import turned, with_joints
from mouse_cli.diagnosis.effects.hinges import joint_stiffness
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites import reasons
from mouse_cli.diagnosis.sites.connections import Connections, connections
from mouse_cli.model.diagnosis import Site

_STARTS = 6  # stiffnesses to begin from
_ALL = 0.5  # prior probability that it is all joints, where there are kinds of them


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """F + sum over the joints of [1, eta]'[1, eta] / k, eta = +-1 at the ends of the bars, k (N m/rad) of all alike."""
    found = connections(model)
    share = [1.0] if len(found) == 1 else [_ALL] + [(1 - _ALL) / max(len(found) - 1, 1)] * (len(found) - 1)
    return [_recipe(model, candidate, one, float(np.log(own))) for one, own in zip(found, share, strict=False)]


def _recipe(model: Reduced, candidate: Candidate, found: Connections, log_prior: float) -> Recipe:
    every, own = model.bars, found.ends
    scale = np.array([every.EI[bar] / every.lines[every.line[bar]].length for bar in own[:, 0]])
    k = joint_stiffness(model, float(scale.min()), float(scale.max()), "stiffness of each joint")
    nodes = tuple(sorted({int(model.problem.mesh.node_ids[every.nodes[bar, end]]) for bar, end in own.tolist()}))
    site = Site(
        "node", nodes, None, f"{found.text}, {len(own)} ends of bars at nodes {', '.join(map(str, nodes))}, all alike"
    )
    change = lambda values: turned(every, own, values[0])
    extend = lambda problem, values: with_joints(problem, every, own, f"stiffness of {found.text}", values[0])
    grid = steps(k, _STARTS)[:, None]
    return Recipe(candidate, (k,), change, grid, lambda values: site, log_prior=log_prior, extend=extend)


CANDIDATE = Candidate(
    "semi-rigid",
    "semi-rigid joints",
    "semi-rigid",
    "connections between beams and columns (end plates, cleats, dowels) that the model takes as rigid, and that all turn in "
    "proportion to the moment with one stiffness: all of a frame, or those of one direction or section; or corners in space where "
    "two bars alone meet, such as elbows of a pipe that ovalise",
    recipes,
    reasons.connections,
    lasting=True,
)

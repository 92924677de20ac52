"""A spring from one place of the structure to the ground."""

import numpy as np

from mouse_cli.diagnosis.candidates import Candidate
from mouse_cli.diagnosis.change import Change, Recipe, Unknown, product, steps
from mouse_cli.diagnosis.extend_points import with_spring
from mouse_cli.diagnosis.points import Points, directions
from mouse_cli.diagnosis.reduced import Reduced
from mouse_cli.diagnosis.scales import lowest, total_mass

_ALONG, _AT = 6, 18  # stiffnesses to begin from: along a line each helps its neighbours, at one place nothing else does


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """K + k B'B, B the motion of a place in one direction."""
    scale = lowest(model) * total_mass(model)
    k = Unknown("stiffness", "N/m", 1e-3 * scale, 1e3 * scale)
    return [_at(point, k, candidate) for point in directions(model)]


def _at(point: Points, k: Unknown, candidate: Candidate) -> Recipe:
    def change(values: np.ndarray) -> Change:
        B = point.motion(values[1:])
        return Change(K=values[0] * B.T @ B)

    return Recipe(
        candidate,
        (k, *point.unknown),
        change,
        product(steps(k, _ALONG if point.unknown else _AT), *point.starts.T),
        lambda values: point.site(values[1:]),
        log_prior=float(np.log(point.share)),
        extend=lambda problem, values: with_spring(problem, point, values[1:], values[0]),
    )


CANDIDATE = Candidate(
    "ground-spring",
    "a spring to the ground",
    "ground-spring",
    "a support, cable or contact that ties one place to the surroundings: K + k B'B",
    recipes,
)

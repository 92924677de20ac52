"""A mass at one place of the structure."""

import numpy as np

from mouse_cli.diagnosis.candidates import Candidate
from mouse_cli.diagnosis.change import Change, Recipe, Unknown, product, steps
from mouse_cli.diagnosis.extend_points import with_mass
from mouse_cli.diagnosis.points import Points, all_motions
from mouse_cli.diagnosis.reduced import Reduced
from mouse_cli.diagnosis.scales import total_mass

_ALONG, _AT = 4, 8  # masses to begin from, along a line and at one place


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """M + m B'B, B the translations of a place."""
    total = total_mass(model)
    m = Unknown("mass", "kg", 1e-3 * total, 0.5 * total)
    return [_at(point, m, candidate) for point in all_motions(model)]


def _at(point: Points, m: Unknown, candidate: Candidate) -> Recipe:
    def change(values: np.ndarray) -> Change:
        B = point.motion(values[1:])
        return Change(M=values[0] * B.T @ B)

    return Recipe(
        candidate,
        (m, *point.unknown),
        change,
        product(steps(m, _ALONG if point.unknown else _AT), *point.starts.T),
        lambda values: point.site(values[1:]),
        log_prior=float(np.log(point.share)),
        extend=lambda problem, values: with_mass(problem, point, values[1:], values[0]),
    )


CANDIDATE = Candidate(
    "mass",
    "a lumped mass",
    "mass",
    "something heavy at one place that the model does not know: M + m B'B for the translations B of the place",
    recipes,
)

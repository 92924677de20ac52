"""A mass at one place of the structure."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown
from mouse_cli.diagnosis.effects.element_sets import point_masses
from mouse_cli.diagnosis.extend.points import with_mass
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import BODY, total_mass
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.points import all_motions, sized

_STARTS = 4, 8  # masses to begin from, along a line and at one place


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """M + m B'B, B the translations of a place; M + d M_s, where the model has a point mass of its own."""
    total = total_mass(model)
    m = Unknown("mass", "kg", *(BODY * total))
    change = lambda sizes, B: Change(M=sizes[0] * B.T @ B)
    points, known = all_motions(model), dict(point_masses(model))
    node = [None if point.unknown else point.site(np.zeros(0)).ids[0] for point in points]
    own = {n: point.share for n, point in zip(node, points, strict=True) if n in known}
    free = [point for n, point in zip(node, points, strict=True) if n not in known]
    share = 1 / max(len(points), 1)
    more = [recipe(candidate, own.get(n, share)) for n, recipe in known.items()]
    return sized(candidate, free, m, _STARTS, change, with_mass) + more


CANDIDATE = Candidate(
    "mass",
    "a lumped mass",
    "mass",
    "an added mass at one point that the model lacks: M + m B'B for the translations B of the point",
    recipes,
)

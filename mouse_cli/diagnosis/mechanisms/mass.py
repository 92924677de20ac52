"""A mass at one place of the structure."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown
from mouse_cli.diagnosis.effects.element_sets import heavier_points
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
    points, known = all_motions(model), heavier_points(model, candidate)
    node = [None if point.unknown else point.site(np.zeros(0)).ids[0] for point in points]
    share = dict.fromkeys(known, 1 / max(len(points), 1))
    share |= {n: point.share for n, point in zip(node, points, strict=True) if n in known}
    free = [point for n, point in zip(node, points, strict=True) if n not in known]
    more = [replace(recipe, log_prior=float(np.log(share[n]))) for n, recipe in known.items()]
    return sized(candidate, free, m, _STARTS, change, with_mass) + more


CANDIDATE = Candidate(
    "mass",
    "a lumped mass",
    "mass",
    "an added mass at one point that the model lacks: M + m B'B for the translations B of the point",
    recipes,
)

"""A mass at one place of the structure."""

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown
from mouse_cli.diagnosis.extend.points import with_mass
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import BODY, total_mass
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.points import all_motions, sized

_STARTS = 4, 8  # masses to begin from, along a line and at one place


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """M + m B'B, B the translations of a place."""
    total = total_mass(model)
    m = Unknown("mass", "kg", *(BODY * total))
    change = lambda sizes, B: Change(M=sizes[0] * B.T @ B)
    return sized(candidate, all_motions(model), m, _STARTS, change, with_mass)


CANDIDATE = Candidate(
    "mass",
    "a lumped mass",
    "mass",
    "an added mass at one point that the model lacks: M + m B'B for the translations B of the point",
    recipes,
)

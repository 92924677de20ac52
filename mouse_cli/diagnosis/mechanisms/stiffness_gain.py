"""A part that is stiffer than modelled: a stretch of a bar, another element, a spring of a model of matrices."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.effects.losses import of_elements, of_springs
from mouse_cli.diagnosis.effects.members import of_members
from mouse_cli.diagnosis.effects.thickness import of_shells
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.stretches import in_both_planes, of_lines

_SELDOM = 0.1  # how often a part is stiffer beside how often any other cause is there: nothing stiffens by wear or by accident
_KNOWN = 0.1  # the same of a part with a parameter of its own, of which the deck has said how far it may go
_SAME = 0.999  # cosine between the changes of stiffness by a part and by a parameter, from which on they are one


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """EI (1 + d) over a stretch of a line; K_e (1 + d) of an element or a member; K + d k b b' of a spring of matrices;
    K(t) and M(t) of a set of shells.
    """
    others = of_elements(model, candidate, 1, directed=True) + of_springs(model, candidate, 1)
    bars = [of_lines(model, candidate, True), in_both_planes(model, candidate, True)]
    kinds = [each for each in (*bars, others, of_members(model, candidate, 1), of_shells(model, candidate, 1)) if each]
    share = -float(np.log(max(len(kinds), 1)))
    found = [each for kind in kinds for each in kind]
    known = [_log_known(model, each) if len(each.unknowns) == 1 else 0.0 for each in found]
    seldom = [float(np.log(_SELDOM)) + log for log in known]
    return [replace(each, log_prior=each.log_prior + share + log, seldom=log) for each, log in zip(found, seldom, strict=True)]


def _log_known(model: Reduced, recipe: Recipe) -> float:
    """ln of how much less likely a part is to be stiffer when a parameter of the deck stands for that part alone."""
    K = recipe.change(np.ones(1)).K
    sizes = np.linalg.norm(model.dK, axis=(1, 2)) * np.linalg.norm(K)
    along = np.abs(np.tensordot(model.dK, K, 2))
    return float(np.log(_KNOWN)) if (along > _SAME * np.maximum(sizes, 1e-300)).any() else 0.0


CANDIDATE = Candidate(
    "stiffness-gain",
    "a local gain of stiffness",
    "added-stiffness",
    "a stretch of a bar, a member, a set of shells, or another element, that is stiffer than modelled: a doubler or a gusset, an "
    "infill, a repair, a thicker section; a priori ten times less probable than any other mechanism, a part with a parameter of "
    "its own a hundred times",
    recipes,
)

"""The laws of local forces that a deck has, as its fits take them."""

import numpy as np

from mouse_cli.model.local_law import LocalLaw
from mouse_cli.model.problem import Problem
from mouse_cli.terms.laws import registry
from mouse_cli.updating.recordings.hypothesis import Acting


def acting(problem: Problem, basis: np.ndarray) -> tuple[Acting, ...]:
    """The laws of a deck, in the coordinates of a basis (n, m)."""
    return tuple(_acting(one, basis) for one in problem.laws)


def _acting(one: LocalLaw, basis: np.ndarray) -> Acting:
    law = registry()[one.law]
    B = basis[one.dofs[-1]] - (basis[one.dofs[0]] if len(one.dofs) > 1 else 0.0)
    p = np.array([one.values[size.name] for size in law.parameters])
    return Acting(B, law, law.variants[law.words.index(one.variant)], p)

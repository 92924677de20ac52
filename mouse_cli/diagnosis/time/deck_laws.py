"""Laws of local forces between decks and hypotheses."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.time.hypothesis import Acting
from mouse_cli.diagnosis.time.polish import Fit
from mouse_cli.model.local_law import LocalLaw
from mouse_cli.model.problem import Problem
from mouse_cli.terms.laws import registry


def acting(problem: Problem, basis: np.ndarray) -> tuple[Acting, ...]:
    """The laws of a deck, in the coordinates of a basis (n, m)."""
    return tuple(_acting(one, basis) for one in problem.laws)


def _acting(one: LocalLaw, basis: np.ndarray) -> Acting:
    law = registry()[one.law]
    B = basis[one.dofs[-1]] - (basis[one.dofs[0]] if len(one.dofs) > 1 else 0.0)
    p = np.array([one.values[size.name] for size in law.parameters])
    return Acting(B, law, law.variants[law.words.index(one.variant)], p)


def extended(problem: Problem, best: Fit, motion: np.ndarray) -> Problem | None:
    """The deck with the law of a fit, along `motion` (n,), in it; None for linear laws."""
    law = best.hypothesis.law
    if law.linear:
        return None
    values = best.hypothesis.parameters(best.x[None])[:, 0]
    sizes = {size.name: float(value) for size, value in zip(best.hypothesis.unknowns, values, strict=True)}
    dofs = tuple(int(i) for i in np.argsort(motion) if motion[i])
    new = LocalLaw(law.key, law.words[best.hypothesis.variant], dofs, sizes)
    return replace(problem, laws=(*problem.laws, new))

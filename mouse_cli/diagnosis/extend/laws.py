"""Laws of local forces between decks and hypotheses."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.extend.linear_laws import with_linear
from mouse_cli.model.local_law import LocalLaw
from mouse_cli.model.problem import Problem
from mouse_cli.updating.recordings.hypothesis import Part
from mouse_cli.updating.recordings.polish import Fit


def extended(problem: Problem, best: Fit) -> Problem | None:
    """The deck with the causes of a fit in it: laws, and what is linear as parameters; None where one cannot be put into a deck."""
    deck, laws = problem, list(problem.laws)
    for part, values in best.hypothesis.sizes(best.x[None]):
        if not part.law.linear:
            laws.append(_law(part, values[:, 0]))
            continue
        deck = with_linear(deck, part, values[:, 0])
        if deck is None:
            return None
    return replace(deck, laws=tuple(_moved(one, problem, deck) for one in laws))


def _law(part: Part, p: np.ndarray) -> LocalLaw:
    sizes = {size.name: float(value) for size, value in zip(part.unknowns, p, strict=True)}
    motion = part.place.motion
    dofs = tuple(int(i) for i in np.argsort(motion) if motion[i])
    return LocalLaw(part.law.key, part.law.words[part.variant], dofs, sizes)


def _moved(one: LocalLaw, old: Problem, new: Problem) -> LocalLaw:
    """A law at the degrees of freedom of a deck that has changed."""
    place = {label: i for i, label in enumerate(new.structure.labels)}
    return replace(one, dofs=tuple(place[old.structure.labels[i]] for i in one.dofs))

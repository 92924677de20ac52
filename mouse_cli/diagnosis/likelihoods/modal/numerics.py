"""What of a misfit is numerics, which is never named as physics: the mesh of bars, and masses lumped at nodes.

Every bar halved, cables in quarters, and lumped masses spread along them: what that moves measured frequencies by is an error of
the model, which is corrected to first order where it matters. What that leaves, and what half as long elements leave, the data
must be allowed.
"""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.places import every_beam, every_cable
from mouse_cli.diagnosis.likelihoods.modal.finer import Finer, inertia
from mouse_cli.diagnosis.likelihoods.modal.point import Point
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.dynamics.solver import EigenSolver
from mouse_cli.model.problem import Problem
from mouse_cli.terms.assembly import assembly
from mouse_cli.terms.elements._beam import AT_ENDS

_SMALL, _LARGEST = 600, 20_000  # degrees of freedom of the finer model, about, up to which it is small; is solved
_TELLING = 0.3  # of a standard deviation
# Of what halving moves a frequency by, that half as long elements leave: the error of consistent ones goes with h^4;
# that of cables, whose shapes are linear, with h^2, so that quarters leave as much
_LEFT = 1 / 15


@dataclass(frozen=True)
class Numerics:
    """moved (m,): change of ln f of each measured mode on a finer mesh with masses spread; remarks where that is no trifle.

    finer: what corrects the model for it, where it is none; None: nothing does.
    """

    moved: np.ndarray
    remarks: tuple[str, ...] = ()
    finer: Finer | None = None

    def allowed(self, model: Reduced, at: Point) -> np.ndarray:
        """sd of ln f (m,) of the measured modes of a point of `model` as it is: of what the correction leaves."""
        if self.finer is None:
            return np.abs(self.moved)
        corrected, _ = replace(model, finer=self.finer).refined(at.eigenvalues, at.X)
        by = 0.5 * np.log(corrected[at.modes] / at.eigenvalues[at.modes])
        return np.abs(self.moved - by) + _LEFT * np.abs(self.moved)


def numerics(
    problem: Problem, theta: np.ndarray, numbers: np.ndarray, sd: np.ndarray, corrects: bool = False
) -> Numerics:
    """What mesh and lumping do to the modes `numbers` (m,), from 0, of `problem` at theta, beside the sd (m,) of ln f.

    corrects: whether a model is made that can be corrected for it.
    """
    still = Numerics(np.zeros(len(numbers)))
    if not len(numbers) or not refinable(problem, _LARGEST):
        return still
    finer = halved(problem)
    found = [_logarithms(each, theta, int(numbers.max()) + 1) for each in (problem, finer)]
    if any(len(each) <= numbers.max() for each in found):
        return still
    moved = found[1][numbers] - found[0][numbers]
    moved[~np.isfinite(moved)] = 0.0
    worst = int(np.argmax(np.abs(moved) / sd))
    if abs(moved[worst]) < _TELLING * sd[worst]:
        return Numerics(moved)
    by = inertia(problem, finer, theta) if corrects else None
    done = "that much is allowed for" if by is None else "predictions are corrected for it to first order"
    told = (
        f"numerics: half as long elements with masses spread along them move mode {numbers[worst] + 1} by "
        f"{100 * moved[worst]:.2g} %, {abs(moved[worst]) / sd[worst]:.1f} of its standard deviation; {done}, "
        "a finer mesh would be better"
    )
    return Numerics(moved, (told,), by)


def refinable(problem: Problem, most: int = _SMALL) -> bool:
    """Whether the deck has beams or cables, and at most so many degrees of freedom, to be looked at on shorter elements."""
    if problem.mesh is None or 2 * problem.structure.n > most:
        return False
    edit = Edit(problem)
    return bool(every_beam(edit) or every_cable(edit))


def halved(problem: Problem) -> Problem:
    """The deck with every beam in two halves, cables in four quarters, and their masses spread along them."""
    edit = Edit(problem)
    cables = set(every_cable(edit))
    for s, i in sorted({*every_beam(edit), *cables}, reverse=True):
        edit.split((s, i), 0.5)
        for half in (i + 1, i) if (s, i) in cables else ():
            edit.split((s, half), 0.5)
    for s in {s for s, _ in (*every_beam(edit), *cables)}:
        if edit.sets[s].options.get("mass") in AT_ENDS:
            edit.option(s, mass="consistent")
    return edit.done()


def _logarithms(problem: Problem, theta: np.ndarray, count: int) -> np.ndarray:
    """ln f of the lowest modes, -inf for rigid ones."""
    eigenvalues = EigenSolver().solve(*assembly(problem).matrices(theta), count).eigenvalues[:count]
    with np.errstate(divide="ignore", invalid="ignore"):
        return 0.5 * np.log(np.where(eigenvalues > 1e-9 * abs(eigenvalues[-1]), eigenvalues, 0.0))

"""What of a misfit is numerics, which is never named as physics: the mesh of bars, and masses lumped at nodes.

Every bar halved, cables in quarters, and lumped masses spread along them: what that moves measured frequencies by is an error of
the model, which is corrected to first order where it matters. What that leaves, and what half as long elements leave, the data
must be allowed.
"""

from collections.abc import Container
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.places import every_beam, every_cable
from mouse_cli.diagnosis.likelihoods.modal.finer import Finer, inertia
from mouse_cli.diagnosis.likelihoods.modal.point import Point
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.dynamics.solver import EigenSolver
from mouse_cli.model.arrays import dense
from mouse_cli.model.problem import Problem
from mouse_cli.terms.assembly import assembly
from mouse_cli.terms.elements._beam import AT_ENDS

_SMALL, _LARGEST = 600, 20_000  # degrees of freedom of the finer model, about, up to which it is small; is solved
_TELLING = 0.3  # of a standard deviation
# Of what halving moves a frequency by, that half as long elements leave: the error of consistent ones goes with h^4;
# that of cables, whose shapes are linear, with h^2, so that quarters leave as much
_LEFT = 1 / 15
_BESIDE = 12  # modes of the finer model beyond twice those that are looked at: bars of few elements have some of their own
_ALIKE, _MATCHED = 0.1, 0.5  # share of a mode that one of the finer model is of it at least; that all of these are


@dataclass(frozen=True)
class Numerics:
    """moved (m,): change of ln f of the modes `numbers` (m,), from 0, on a finer mesh with masses spread; remarks where that is no
    trifle.

    finer: what corrects the model for it, where it is none; None: nothing does.
    """

    numbers: np.ndarray
    moved: np.ndarray
    remarks: tuple[str, ...] = ()
    finer: Finer | None = None

    def allowed(self, model: Reduced, at: Point) -> np.ndarray:
        """sd of ln f (n,) by number of the mode, for a point of `model` as it is: of what the correction leaves."""
        found = np.zeros(int(self.numbers.max(initial=-1)) + 1)
        found[self.numbers] = np.abs(self.moved)
        if self.finer is not None:
            corrected, _ = replace(model, finer=self.finer).refined(at.eigenvalues, at.X)
            by = 0.5 * np.log(corrected[self.numbers] / at.eigenvalues[self.numbers])
            found[self.numbers] = np.abs(self.moved - by) + _LEFT * np.abs(self.moved)
        return found


def numerics(
    problem: Problem, theta: np.ndarray, numbers: np.ndarray, sd: np.ndarray, corrects: bool = False
) -> Numerics:
    """What mesh and lumping do to the modes `numbers` (m,), from 0, of `problem` at theta, beside the sd (m,) of ln f.

    corrects: whether a model is made that can be corrected for it.
    """
    still = Numerics(numbers, np.zeros(len(numbers)))
    if not len(numbers) or not refinable(problem, _LARGEST):
        return still
    coarse = _Solved(problem, theta, int(numbers.max()) + 1)
    if len(coarse.eigenvalues) <= numbers.max():
        return still
    finer = halved(problem)
    if loose := _loose(problem, finer, theta, float(coarse.eigenvalues[numbers].max())):
        finer = halved(problem, loose)
    moved = coarse.moved(_Solved(finer, theta, 2 * len(coarse.eigenvalues) + _BESIDE))[numbers]
    worst = int(np.argmax(np.abs(moved) / sd))
    if abs(moved[worst]) < _TELLING * sd[worst]:
        return Numerics(numbers, moved)
    by = inertia(problem, finer, theta) if corrects else None
    done = "that much is allowed for" if by is None else "predictions are corrected for it to first order"
    told = (
        f"numerics: half as long elements with masses spread along them move mode {numbers[worst] + 1} by "
        f"{100 * moved[worst]:.2g} %, {abs(moved[worst]) / sd[worst]:.1f} of its standard deviation; {done}, "
        "a finer mesh would be better"
    )
    return Numerics(numbers, moved, (told,), by)


def refinable(problem: Problem, most: int = _SMALL) -> bool:
    """Whether the deck has beams or cables, and at most so many degrees of freedom, to be looked at on shorter elements."""
    if problem.mesh is None or 2 * problem.structure.n > most:
        return False
    edit = Edit(problem)
    return bool(every_beam(edit) or every_cable(edit))


def halved(problem: Problem, but: Container[int] = ()) -> Problem:
    """The deck with every beam in two halves, cables in four quarters, and their masses spread along them; beams `but`, by their
    numbers, are left whole.
    """
    edit = Edit(problem)
    cables, whole = set(every_cable(edit)), set()
    for s, i in sorted({*every_beam(edit), *cables}, reverse=True):
        if int(edit.sets[s].ids[i]) in but:
            whole.add(s)
            continue
        edit.split((s, i), 0.5)
        for half in (i + 1, i) if (s, i) in cables else ():
            edit.split((s, half), 0.5)
    for s in {s for s, _ in (*every_beam(edit), *cables)} - whole:
        if edit.sets[s].options.get("mass") in AT_ENDS:
            edit.option(s, mass="consistent")
    return edit.done()


def _loose(problem: Problem, halves: Problem, theta: np.ndarray, highest: float) -> set[int]:
    """Numbers of beams that swing between their ends, held still, below the eigenvalue `highest`: they have modes of their own
    among those that are compared, and to first order no inertia is theirs.
    """
    from scipy.linalg import eigh

    K, M = assembly(halves).matrices(theta)
    mesh, dofs = halves.mesh, halves.structure.geometry.node
    first = len(problem.mesh.node_ids)
    own = {int(n) for each in problem.mesh.elements for n in each.ids}
    between = {
        int(node): int(number)
        for each in mesh.elements
        if each.type == "beam"
        for number, nodes in zip(each.ids, each.nodes, strict=True)
        for node in nodes
        if node >= first and int(number) in own
    }
    found = set()
    for node, number in between.items():
        at = np.flatnonzero(dofs == node)
        block = np.ix_(at, at)
        stiff, mass = (np.asarray(dense(each[block] if isinstance(each, np.ndarray) else each[at][:, at])) for each in (K, M))
        if not len(at):
            continue
        stiff[range(len(at)), range(len(at))] += np.finfo(float).eps * stiff.trace()  # no stiffness in torsion: loose
        if highest * eigh(mass, stiff, eigvals_only=True)[-1] > 1:
            found.add(number)
    return found


class _Solved:
    """The lowest modes of a deck at theta (p,), and its degrees of freedom."""

    def __init__(self, problem: Problem, theta: np.ndarray, count: int):
        self.K, self.M = assembly(problem).matrices(theta)
        found = EigenSolver().solve(self.K, self.M, min(count, problem.structure.n))
        self.labels = problem.structure.labels
        self.eigenvalues, self.shapes = found.eigenvalues[:count], found.shapes[:, :count]

    def moved(self, finer: "_Solved") -> np.ndarray:
        """Change (m,) of ln f of each mode in `finer`: of those that are like it there, in the mean; 0 where none is."""
        from scipy.sparse import csc_array
        from scipy.sparse.linalg import splu

        place = {label: i for i, label in enumerate(finer.labels)}
        old = np.array([place[label] for label in self.labels])
        shapes = np.zeros((len(finer.labels), len(self.eigenvalues)))
        shapes[old] = self.shapes
        if len(new := np.setdiff1d(np.arange(len(shapes)), old)):  # middles follow statically
            K = csc_array(finer.K)
            shapes[new] = -splu(K[new][:, new]).solve(K[new][:, old] @ self.shapes)
        alike = (shapes.T @ (finer.M @ finer.shapes)) ** 2 / np.einsum("nm,nm->m", shapes, finer.M @ shapes)[:, None]
        alike[alike < _ALIKE] = 0.0
        elastic = [each.eigenvalues > 1e-9 * abs(each.eigenvalues[-1]) for each in (self, finer)]
        own, other = (0.5 * np.log(np.where(is_, each.eigenvalues, 1.0)) for is_, each in zip(elastic, (self, finer), strict=True))
        alike[:, ~elastic[1]] = 0.0
        total = alike.sum(axis=1)
        known = elastic[0] & (total > _MATCHED)
        return np.where(known, (alike @ other) / np.where(known, total, 1.0) - own, 0.0)

"""What of a misfit is numerics, which is never named as physics: the mesh of bars, and masses lumped at nodes.

Every bar halved, cables in quarters, and lumped masses spread along them: what that moves measured frequencies by is an error of
the model, which is corrected to first order where it matters. What that leaves, and what half as long elements leave, the data
must be allowed.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.halves import halved
from mouse_cli.diagnosis.extend.places import every_beam, every_cable
from mouse_cli.diagnosis.likelihoods.modal.finer import Finer, inertia
from mouse_cli.diagnosis.likelihoods.modal.point import Point
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.dynamics.solver import EigenSolver
from mouse_cli.model.arrays import dense
from mouse_cli.model.problem import Problem
from mouse_cli.terms.assembly import assembly

_SMALL, _LARGEST = 600, 20_000  # degrees of freedom of the finer model, about, up to which it is small; is solved
_TELLING = 0.3  # of a standard deviation
# Of what halving moves a frequency by, that half as long elements leave: the error of consistent ones goes with h^4;
# that of cables, whose shapes are linear, with h^2, so that quarters leave as much
_LEFT = 1 / 15
_BESIDE = 12  # modes of the finer model beyond twice those that are looked at: bars of few elements have some of their own
_ALIKE, _MATCHED = 0.1, 0.5  # share of a mode that one of the finer model is of it at least; that all of these are


@dataclass(frozen=True)
class Numerics:
    """moved (m,): change of ln f of the modes `numbers` (m,), from 0, on a finer mesh with masses spread.

    sd (m,): of ln f, as measured. finer: what corrects the model for it; None: nothing does. above (m,): which it does not correct.
    loose: beams that swing by themselves below most of these modes, which are left whole.
    """

    numbers: np.ndarray
    moved: np.ndarray
    sd: np.ndarray
    finer: Finer | None = None
    above: np.ndarray | None = None
    loose: frozenset[int] = frozenset()

    @property
    def remarks(self) -> tuple[str, ...]:
        """What to say of it, where it is no trifle."""
        if not self.telling:
            return ()
        worst = self._worst
        corrected = self.finer is not None and not self.above[worst]
        done = "predictions are corrected for it to first order" if corrected else "that much is allowed for"
        return (
            f"numerics: half as long elements with masses spread along them move mode {self.numbers[worst] + 1} by "
            f"{100 * self.moved[worst]:.2g} %, {abs(self.moved[worst]) / self.sd[worst]:.1f} of its standard deviation; {done}, "
            "a finer mesh would be better",
        )

    @property
    def telling(self) -> bool:
        """Whether it is no trifle."""
        return len(self.moved) > 0 and abs(self.moved[self._worst]) >= _TELLING * self.sd[self._worst]

    @property
    def _worst(self) -> int:
        return int(np.argmax(np.abs(self.moved) / self.sd))

    def coarse(self, allowed: np.ndarray) -> str:
        """What a mesh too coarse for the test does: of a mode its correction leaves more, `allowed` (n,), than the sd of the test;
        nothing where it is not.
        """
        left = allowed[self.numbers] / self.sd
        worst = int(np.argmax(left)) if len(left) else 0
        if not len(left) or left[worst] <= 1:
            return ""
        number, by = self.numbers[worst] + 1, self.moved[worst]
        return f"half as long elements move mode {number} by {100 * by:.2g} %, {abs(by) / self.sd[worst]:.0f} standard deviations"

    def allowed(self, model: Reduced, at: Point) -> np.ndarray:
        """sd of ln f (n,) by number of the mode, for a point of `model` as it is: of what the correction leaves."""
        found = np.zeros(int(self.numbers.max(initial=-1)) + 1)
        found[self.numbers] = np.abs(self.moved)
        if self.finer is not None:
            corrected, _ = replace(model, finer=self.finer).refined(at.eigenvalues, at.X)
            by = 0.5 * np.log(corrected[self.numbers] / at.eigenvalues[self.numbers])
            found[self.numbers] = np.abs(self.moved - by) + _LEFT * np.abs(self.moved)
        return found


def numerics(problem: Problem, theta: np.ndarray, numbers: np.ndarray, sd: np.ndarray) -> Numerics:
    """What mesh and lumping do to the modes `numbers` (m,), from 0, of `problem` at theta, beside the sd (m,) of ln f."""
    still = Numerics(numbers, np.zeros(len(numbers)), sd)
    if not len(numbers) or not refinable(problem, _LARGEST):
        return still
    coarse = _Modes(_Mesh(problem, theta), int(numbers.max()) + 1)
    if len(coarse.eigenvalues) <= numbers.max():
        return still
    finer = _Mesh(halved(problem), theta)
    swings = finer.swings(problem)
    loose = frozenset(number for number, own in swings.items() if own < np.median(coarse.eigenvalues[numbers]))
    limit = min((own for number, own in swings.items() if number not in loose), default=np.inf)
    if loose:
        finer = _Mesh(halved(problem, loose), theta)
    moved = coarse.moved(_Modes(finer, 2 * len(coarse.eigenvalues) + _BESIDE))[numbers]
    found = Numerics(numbers, moved, sd, loose=loose)
    if not found.telling:
        return found
    by = inertia(problem, finer.problem, theta, limit)
    return replace(found, finer=by, above=coarse.eigenvalues[numbers] >= limit)


def refinable(problem: Problem, most: int = _SMALL) -> bool:
    """Whether the deck has beams or cables, and at most so many degrees of freedom, to be looked at on shorter elements."""
    if problem.mesh is None or 2 * problem.structure.n > most:
        return False
    edit = Edit(problem)
    return bool(every_beam(edit) or every_cable(edit))


class _Mesh:
    """A deck with K and M (n, n) at theta (p,)."""

    def __init__(self, problem: Problem, theta: np.ndarray):
        self.problem, (self.K, self.M) = problem, assembly(problem).matrices(theta)

    def swings(self, whole: Problem) -> dict[int, float]:
        """The lowest eigenvalue at which each beam of `whole`, halved here, swings between its ends, held still, by its number.

        Below, to first order, its inertia is its ends'; what swings among the modes that are compared has modes of its own there.
        """
        from scipy.linalg import eigh

        found, node_of = {}, self.problem.structure.geometry.node
        for node, number in self._middles(whole):
            at = np.flatnonzero(node_of == node)
            stiff, mass = (dense(each[at][:, at]) for each in (self.K, self.M))
            stiff = stiff + np.finfo(float).eps * stiff.trace() * np.eye(len(at))  # no stiffness in torsion: loose
            if len(at) and (rate := float(eigh(mass, stiff, eigvals_only=True)[-1])) > 0:
                found[number] = 1 / rate
        return found

    def _middles(self, whole: Problem) -> Iterator[tuple[int, int]]:
        """Nodes (indices) that `whole` does not have, and the number of the beam that each halves, which its first half keeps."""
        first, own = len(whole.mesh.node_ids), {n for each in whole.mesh.elements for n in each.ids.tolist()}
        for each in self.problem.mesh.elements:
            for number, nodes in zip(each.ids.tolist(), each.nodes, strict=True) if each.type == "beam" else ():
                if number in own:
                    yield from ((int(node), number) for node in nodes[nodes >= first])


class _Modes:
    """The lowest `count` modes of a mesh."""

    def __init__(self, mesh: _Mesh, count: int):
        found = EigenSolver().solve(mesh.K, mesh.M, min(count, mesh.problem.structure.n))
        self.mesh, self.labels = mesh, mesh.problem.structure.labels
        self.eigenvalues, self.shapes = found.eigenvalues[:count], found.shapes[:, :count]

    @property
    def elastic(self) -> np.ndarray:
        """Which are no motions of a rigid body."""
        return self.eigenvalues > 1e-9 * abs(self.eigenvalues[-1])

    @property
    def log(self) -> np.ndarray:
        """Half the logarithm of each eigenvalue, 0 of a rigid body."""
        return 0.5 * np.log(np.where(self.elastic, self.eigenvalues, 1.0))

    def moved(self, finer: "_Modes") -> np.ndarray:
        """Change (m,) of ln f of each mode in `finer`: of those that are like it there, in the mean; 0 where none is."""
        shapes = self._on(finer)
        inertia = finer.mesh.M @ shapes
        alike = (inertia.T @ finer.shapes) ** 2 / np.einsum("nm,nm->m", shapes, inertia)[:, None]
        alike[(alike < _ALIKE) | ~finer.elastic] = 0.0
        total = alike.sum(axis=1)
        known = self.elastic & (total > _MATCHED)
        return np.where(known, (alike @ finer.log) / np.where(known, total, 1.0) - self.log, 0.0)

    def _on(self, finer: "_Modes") -> np.ndarray:
        """Its shapes in all degrees of freedom of `finer`, whose further nodes follow statically."""
        from scipy.sparse import csc_array
        from scipy.sparse.linalg import splu

        place = {label: i for i, label in enumerate(finer.labels)}
        old = np.array([place[label] for label in self.labels])
        found = np.zeros((len(place), len(self.eigenvalues)))
        found[old] = self.shapes
        if len(new := np.setdiff1d(np.arange(len(place)), old)):
            K = csc_array(finer.mesh.K)
            found[new] = -splu(K[new][:, new]).solve(K[new][:, old] @ self.shapes)
        return found

"""A model without its supports, and what motions of them add to the reduced model."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Carried, Change
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.renumbered import moved, moved_channels, moved_functions
from mouse_cli.diagnosis.likelihoods.modal.directions import projected
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest
from mouse_cli.diagnosis.sites.bars import strained
from mouse_cli.dynamics.contraction import Stack
from mouse_cli.model.arrays import Matrix, is_sparse
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.held import freed, places
from mouse_cli.model.problem import Problem
from mouse_cli.terms.assembly import Assembly
from mouse_cli.terms.element_term import ElementTerm

SOFTEST, STIFFEST = 1e-3, 1e4  # stiffness of a support over `resistance`: from as good as free to as good as rigid
_IDLE = 1e-9  # share of the stiffness of a bed in combinations of motions that do not move it
_SHIFT = 1e-3  # of the lowest measured eigenvalue, so that motions that nothing resists need no support


@dataclass(frozen=True)
class Free:
    """The structure without its supports: `place` of degrees of freedom by label, deck: those of the deck; K, M at theta."""

    problem: Problem
    assembly: Assembly
    theta: np.ndarray
    place: dict[str, int]
    deck: np.ndarray
    K: Matrix
    M: Matrix

    @property
    def n(self) -> int:
        """Number of degrees of freedom."""
        return self.problem.structure.n

    def reactions(self, model: Reduced, s: np.ndarray, modes: slice) -> np.ndarray:
        """Loads (s, m) that modes put on the supports s."""
        V, f = model.V[:, modes], self.deck
        return self.K[s][:, f] @ V - (self.M[s][:, f] @ V) * model.eigenvalues[modes]


@dataclass(frozen=True)
class Followed:
    """What a degrees of freedom add to a model of r coordinates that follows them: K, M (r + a, r + a).

    sensing (s, r + a): what sensors read of them; carried: how they carry the model along.
    """

    K: np.ndarray
    M: np.ndarray
    sensing: np.ndarray
    carried: Carried

    def part(self, which: list[int], r: int) -> "Followed":
        """The same of a part of the degrees of freedom."""
        at = np.concatenate([np.arange(r), r + np.array(which)])
        own = np.ix_(at, at)
        return Followed(self.K[own], self.M[own], self.sensing[:, at], self.carried.part(which, r))

    def on_springs(self, stiffness: np.ndarray) -> Change:
        """Each degree of freedom on a spring to the ground, of `stiffness` (a,)."""
        K, own = self.K.copy(), np.arange(len(self.K) - len(stiffness), len(self.K))
        K[own, own] += stiffness
        return Change(K, self.M, self.sensing)


def label(problem: Problem, node: int, direction: int) -> str:
    """Label of the degree of freedom of a node (index), by which a model without supports knows it."""
    return f"{problem.mesh.node_ids[node]}{DIRECTIONS[direction]}"


def free_model(model: Reduced) -> Free:
    """The structure of a model without its supports, at the parameters where its own K and M are taken."""
    free, total = model.once("without supports", _without_supports)
    theta = model.theta if model.origin is None else model.origin
    place = {label: i for i, label in enumerate(free.structure.labels)}
    f = np.array([place[label] for label in model.problem.structure.labels], int)
    K, M = (m.tocsr() if is_sparse(m) else m for m in total.matrices(theta))
    return Free(free, total, theta, place, f, K, M)


def static(model: Reduced, free: Free, s: np.ndarray, pattern: np.ndarray) -> np.ndarray:
    """Motion (n, a) of the structure for motions `pattern` (s, a) of the supports s."""
    motion, f, (K, M) = np.zeros((free.n, pattern.shape[1])), free.deck, (free.K, free.M)
    motion[s] = pattern
    right = _dense(K[f][:, s]) @ pattern, _dense(M[f][:, s]) @ pattern
    motion[f] = -_solved(K[f][:, f], M[f][:, f], *right, _SHIFT * lowest(model))
    return motion


def followed(model: Reduced, free: Free, motion: np.ndarray) -> Followed:
    """What a motion (n, a) adds to the model."""
    f, (K, M) = free.deck, (free.K, free.M)
    whole = np.zeros((free.n, model.r + motion.shape[1]))
    whole[f, : model.r], whole[:, model.r :] = model.V, motion
    blocks = [whole.T @ (matrix @ whole) for matrix in (K, M)]
    for block in blocks:
        block[: model.r, : model.r] = 0.0
    slopes, stack = _slopes(model, free.assembly, free.theta, whole)
    within = model.V.T @ (M[f][:, f] @ motion[f])
    none = np.zeros((0, 3, motion.shape[1]))
    strain = none if model.bars is None else strained(free.problem, model.bars, motion)
    reading = free.problem.test.read(motion)
    sensing = np.hstack([np.zeros((len(reading), model.r)), reading])
    carried = Carried(
        within, motion, K @ motion, M @ motion, f, slopes, _across(model, stack, motion), strain, place=free.place
    )
    return Followed(*blocks, sensing, carried)


def resistance(model: Reduced, K: np.ndarray, M: np.ndarray, bed: np.ndarray | None = None) -> np.ndarray:
    """What the structure that follows motions of supports does against them (a,), K and M (r + a, r + a) as `followed` has them.

    psi'(K + lambda M) psi, by its stiffness and, at the lowest measured eigenvalue, by its inertia: a scale of the support and of
    what stands on it. One of the whole structure would exclude the true support where bars or spans differ. Of each motion alone;
    on a bed (a, a) of springs of all motions, of those combinations that it carries each by itself: a foot that is stiff in
    itself moves as a whole, which resists far less than one of its nodes does against the others.
    """
    opposing = (K + lowest(model) * M)[model.r :, model.r :]
    if bed is None:
        return opposing.diagonal()
    stiffness, W = np.linalg.eigh(bed)
    moved = stiffness > _IDLE * stiffness[-1]
    W = W[:, moved] / np.sqrt(stiffness[moved])
    return np.linalg.eigvalsh(W.T @ opposing @ W)


Slopes = tuple[np.ndarray, np.ndarray]


def _slopes(model: Reduced, free: Assembly, theta: np.ndarray, whole: np.ndarray) -> tuple[Slopes, Stack]:
    """See `Carried`. Its static motion is nearly in the space of the coordinates, and the mass that is left to a support beside
    theirs a small difference: M of the cause must follow the parameters as that of the model does, else M is indefinite.
    """
    stack = Stack(free.n, free.p, free.slopes(theta))
    found = projected(stack, model.directions, whole)
    for each in found:
        each[:, : model.r, : model.r] = 0.0
    return found, stack


def _across(model: Reduced, stack: Stack, motion: np.ndarray) -> Callable[[np.ndarray], Slopes]:
    """See `Carried`; what was asked for last is kept, as a pair of supports is looked at many times."""
    kept: list[tuple[np.ndarray, Slopes]] = []

    def across(other: np.ndarray) -> Slopes:
        if not kept or kept[0][0] is not other:
            b = other.shape[1]
            both = projected(stack, model.directions, np.hstack([other, motion]))
            kept[:] = [(other, tuple(each[:, :b, b:] for each in both))]
        return kept[0][1]

    return across


def _without_supports(problem: Problem) -> Problem:
    """The deck without supports; what bears weight keeps the axial force that it has on its supports."""
    if problem.held is not None:
        return _freed(problem)
    edit = Edit(problem)
    edit.supports, edit.gravity = [], None
    terms = [term for term in problem.terms if isinstance(term, ElementTerm)]
    for g, term in enumerate(terms):
        if term.axial is not None:
            own = list(zip(*(part.tolist() for part in problem.mesh.gathered.origin(g)), strict=True))
            edit.put(own, "preload", np.array([edit.values(element, "preload") for element in own]) + term.axial)
    return edit.done(
        searched=False
    )  # bodies on springs between nodes that are apart may move as supports did not let them


def _freed(problem: Problem) -> Problem:
    """Imported matrices without their named supports."""
    free, to = freed(problem), places(problem)
    n = free.structure.n
    return replace(
        free,
        test=None if problem.test is None else moved(problem.test, to, n),
        frf=tuple(moved_functions(each, to, n) for each in problem.frf),
        recordings=tuple(moved_channels(each, to) for each in problem.recordings),
    )


def _dense(matrix) -> np.ndarray:
    return matrix.toarray() if is_sparse(matrix) else matrix


def _solved(Kff, Mff, Kfs: np.ndarray, Mfs: np.ndarray, shift: float) -> np.ndarray:
    """(K + shift M)_ff^-1 (K + shift M)_fs."""
    right = Kfs + shift * Mfs
    if not is_sparse(Kff):
        return np.linalg.solve(Kff + shift * Mff, right)
    from mouse_cli.terms.mechanisms import definite_factor

    return definite_factor((Kff + shift * Mff).tocsc()).solve(right)

"""Supports that give way: the motion of each, as a degree of freedom of its own beside those of the reduced model."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.effects.change import Carried, Change, Recipe, Unknown, product, steps
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.directions import projected
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.bars import strained
from mouse_cli.dynamics.contraction import Stack
from mouse_cli.model.arrays import Matrix, is_sparse
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.problem import Problem
from mouse_cli.terms.assembly import Assembly
from mouse_cli.terms.element_term import ElementTerm

_LOADED = 0.02  # share of the largest reaction of its kind below which a support is not loaded
_SHIFT = 1e-3  # of the lowest measured eigenvalue, so that motions that nothing resists need no support
_TOGETHER = 16  # supports that may give way alike
_MOST = 48  # supports that are looked at: those that bear most


@dataclass(frozen=True)
class Released:
    """a supports, (node, direction) in `held`, and their motion: K (r + a, r + a) and M with the cause but without springs.

    Those of the model itself are taken out. reading (s, a): what sensors read of them; resistance (a,): stiffness of the
    structure against the motion of one support alone; load (a,): largest reactions in the lowest modes. carried: motion of the
    structure with them.
    """

    held: tuple[tuple[int, int], ...]
    K: np.ndarray
    M: np.ndarray
    reading: np.ndarray
    resistance: np.ndarray
    load: np.ndarray
    carried: Carried

    def some(self, which: list[int], r: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """K, M and reading for a part of the supports."""
        at = np.concatenate([np.arange(r), r + np.array(which)])
        return self.K[np.ix_(at, at)], self.M[np.ix_(at, at)], self.reading[:, which]


def yielding(model: Reduced, candidate: Candidate, turning: bool) -> list[Recipe]:
    """In translation or in rotation: a recipe for each support that the measured modes load, for all alike, and for those of one
    node, or of all alike, in both directions that bear most, each with a stiffness of its own.
    """
    found = released(model, range(3, 6) if turning else range(3))
    if found is None:
        return []
    single, alike = _sets(found)
    recipes = []
    for kind in (single, alike):
        share = -float(np.log(len(kind) * (1 + bool(alike)))) if kind else 0.0
        recipes += [_recipe(model, candidate, found, which, turning, share) for which in kind]
    return recipes


def _sets(found: Released) -> tuple[list[list[list[int]]], list[list[list[int]]]]:
    """Supports by number that give way together, in lists of one stiffness each: of single nodes, and of all."""
    by: dict[int, list[int]] = {}
    for i, (_, d) in enumerate(found.held):
        by.setdefault(d, []).append(i)
    strongest = sorted(by, key=lambda d: -sum(found.load[i] for i in by[d]))[:2]
    at = {held: i for i, held in enumerate(found.held)}
    both = [[[at[node, d]] for d in strongest] for node in dict.fromkeys(node for node, _ in found.held)
            if len(strongest) == 2 and all((node, d) in at for d in strongest)]  # fmt: skip
    many = {d: own for d, own in sorted(by.items()) if 1 < len(own) <= _TOGETHER}
    alike = [[own] for own in many.values()]
    if len(strongest) == 2 and all(d in many for d in strongest):
        alike.append([many[d] for d in strongest])
    return [[[i]] for i in range(len(found.held))] + both, alike


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

    def read(self, motion: np.ndarray) -> np.ndarray:
        """What sensors read of a motion (n, a)."""
        return self.problem.test.read(motion)

    def reactions(self, model: Reduced, s: np.ndarray, modes: slice) -> np.ndarray:
        """Loads (s, m) that modes put on the supports s."""
        V, f = model.V[:, modes], self.deck
        return self.K[s][:, f] @ V - (self.M[s][:, f] @ V) * model.eigenvalues[modes]


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


def followed(model: Reduced, free: Free, motion: np.ndarray) -> tuple[np.ndarray, np.ndarray, Carried]:
    """K and M (r + a, r + a) that a motion (n, a) adds to those of the model, and how it carries the model along."""
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
    return *blocks, Carried(within, motion, K @ motion, M @ motion, f, slopes, _across(model, stack, motion), strain)


def released(model: Reduced, kinds: range) -> Released | None:
    """The loaded supports in the directions `kinds`; None where there are none."""
    held = _candidates(model, kinds)
    if not held:
        return None
    free = free_model(model)
    held, s, load = _loaded(model, held, free)
    if not held:
        return None
    motion = static(model, free, s, np.eye(len(s)))
    K, M, carried = followed(model, free, motion)
    return Released(tuple(held), K, M, free.read(motion), np.asarray(free.K.diagonal())[s], load, carried)


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


def _candidates(model: Reduced, kinds: range) -> list[tuple[int, int]]:
    """Supports (node, direction) of `kinds`."""
    mesh = model.problem.mesh
    if model.motion is None:
        return []
    return [(node, d) for node, d in mesh.supports.tolist() if d in kinds and d in mesh.directions]


def _without_supports(problem: Problem) -> Problem:
    """The deck without supports; what bears weight keeps the axial force that it has on its supports."""
    edit = Edit(problem)
    edit.supports, edit.gravity = [], None
    terms = [term for term in problem.terms if isinstance(term, ElementTerm)]
    for s, term in enumerate(terms):
        if term.axial is not None:
            own = [(s, i) for i in range(len(edit.sets[s]))]
            edit.put(own, "preload", np.array([edit.values(element, "preload") for element in own]) + term.axial)
    return edit.done()


def _loaded(model: Reduced, held: list, free: Free) -> tuple[list, np.ndarray, np.ndarray]:
    """Those that bear a part of the largest reaction in the lowest modes, where they are in `free`, and their largest reactions.

    A support without mass would only be in series with what it holds, whose own stiffness says the same.
    """
    names = [f"{model.problem.mesh.node_ids[node]}{DIRECTIONS[d]}" for node, d in held]
    heavy = free.M.diagonal() > 0
    known = [i for i, name in enumerate(names) if name in free.place and heavy[free.place[name]]]
    if not known:
        return [], np.zeros(0, int), np.zeros(0)
    s = np.array([free.place[names[i]] for i in known])
    modes = slice(0, min(model.r, int(model.data.test.number.max()) + 1))
    size = np.abs(free.reactions(model, s, modes)).max(axis=1)
    order = np.sort(np.argsort(-size, kind="stable")[:_MOST])
    order = order[size[order] > _LOADED * size.max()]
    return [held[known[i]] for i in order], s[order], size[order]


def _dense(matrix) -> np.ndarray:
    return matrix.toarray() if is_sparse(matrix) else matrix


def _solved(Kff, Mff, Kfs: np.ndarray, Mfs: np.ndarray, shift: float) -> np.ndarray:
    """(K + shift M)_ff^-1 (K + shift M)_fs."""
    right = Kfs + shift * Mfs
    if not is_sparse(Kff):
        return np.linalg.solve(Kff + shift * Mff, right)
    from mouse_cli.terms.mechanisms import definite_factor

    return definite_factor((Kff + shift * Mff).tocsc()).solve(right)


def _recipe(
    model: Reduced, candidate: Candidate, found: Released, sets: list[list[int]], turning: bool, share: float
) -> Recipe:
    """sets: supports by number, those of each list with one stiffness."""
    unit, which = "N m/rad" if turning else "N/m", [i for own in sets for i in own]
    k = [Unknown(_called(found, own, sets), unit, *_range(model, found, own, turning)) for own in sets]
    K, M, reading = found.some(which, model.r)
    number = np.repeat(np.arange(len(sets)), [len(own) for own in sets])
    own_dofs = np.arange(model.r, len(K))
    sensing = np.hstack([np.zeros((len(reading), model.r)), reading])
    site = _site(model.problem, [found.held[i] for i in which])

    def change(values: np.ndarray) -> Change:
        with_springs = K.copy()
        with_springs[own_dofs, own_dofs] += values[number]
        return Change(with_springs, M, sensing)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        for own, value in zip(sets, values, strict=True):
            held = [found.held[i] for i in own]
            nodes = [edit.index(int(model.problem.mesh.node_ids[node])) for node, _ in held]
            direction = held[0][1]
            edit.supports = [each for each in edit.supports if each not in {(node, direction) for node in nodes}]
            springs = edit.add("spring", [[node] for node in nodes], {DIRECTIONS[direction]: value})
            name = f"stiffness of {_site(model.problem, held).text}"
            edit.bind(name, springs, (DIRECTIONS[direction],), unit=unit)
        return edit.done()

    return Recipe(
        candidate,
        tuple(k),
        change,
        product(*(steps(each, 6 if len(sets) == 1 else 4) for each in k)),
        lambda values: site,
        own=len(which),
        log_prior=share,
        extend=extend,
        carried=found.carried.part(which, model.r),
    )


def _called(found: Released, own: list[int], sets: list[list[int]]) -> str:
    """What a stiffness is called."""
    return "stiffness of the support" + (f", {DIRECTIONS[found.held[own[0]][1]]}" if len(sets) > 1 else "")


def _range(model: Reduced, found: Released, own: list[int], turning: bool) -> tuple[float, float]:
    """Flexibility between 1e-6 and 0.1 L^3/EI in translation, 1e-4 and 1 L/EI in rotation; without bars by what they hold."""
    if model.bars is None:
        resistance = float(found.resistance[own].mean())
        return 0.3 * resistance, 1e3 * resistance
    EI, L = model.bars.stiffness, model.bars.span
    return (EI / L, 1e4 * EI / L) if turning else (10 * EI / L**3, 1e6 * EI / L**3)


def _site(problem: Problem, held: list[tuple[int, int]]) -> Site:
    ids = tuple(dict.fromkeys(int(problem.mesh.node_ids[node]) for node, _ in held))
    direction = " and ".join(dict.fromkeys(DIRECTIONS[d] for _, d in held))
    if len(ids) > 1:
        return Site("node", ids, None, f"the supports of nodes {', '.join(map(str, ids))}, {direction}, all alike")
    position = tuple(problem.mesh.coordinates[held[0][0]].tolist())
    return Site("node", ids, position, f"the support of node {ids[0]}, {direction}")

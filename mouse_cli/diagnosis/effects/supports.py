"""Supports that give way: the motion of each, as a degree of freedom of its own beside those of the reduced model."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.effects.change import Carried, Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.directions import projected
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.dynamics.contraction import Stack
from mouse_cli.model.arrays import is_sparse
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.problem import Problem
from mouse_cli.terms.assembly import Assembly, assembly

_LOADED = 0.02  # share of the largest reaction of its kind below which a support is not loaded
_SHIFT = 1e-3  # of the lowest measured eigenvalue, so that motions that nothing resists need no support
_TOGETHER = 12  # supports that may give way alike
_MOST = 24  # supports that are looked at: those that bear most


@dataclass(frozen=True)
class Released:
    """a supports, (node, direction) in `held`, and their motion: K (r + a, r + a) and M with the cause but without springs.

    Those of the model itself are taken out. reading (s, a): what sensors read of them; resistance (a,): stiffness of the
    structure against the motion of one support alone. carried: motion of the structure with them.
    """

    held: tuple[tuple[int, int], ...]
    K: np.ndarray
    M: np.ndarray
    reading: np.ndarray
    resistance: np.ndarray
    carried: Carried

    def some(self, which: list[int], r: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """K, M and reading for a part of the supports."""
        at = np.concatenate([np.arange(r), r + np.array(which)])
        return self.K[np.ix_(at, at)], self.M[np.ix_(at, at)], self.reading[:, which]


def yielding(model: Reduced, candidate: Candidate, turning: bool) -> list[Recipe]:
    """A recipe for each support that the measured modes load, and one for all alike, in translation or in rotation."""
    found = released(model, range(3, 6) if turning else range(3))
    if found is None:
        return []
    groups = [[i] for i in range(len(found.held))]
    for d in sorted({d for _, d in found.held}):
        alike = [i for i, (_, direction) in enumerate(found.held) if direction == d]
        if 1 < len(alike) <= _TOGETHER:
            groups.append(alike)
    return [_recipe(model, candidate, found, group, turning, len(groups)) for group in groups]


def released(model: Reduced, kinds: range) -> Released | None:
    """The loaded supports in the directions `kinds`; None where there are none."""
    held = _candidates(model, kinds)
    if not held:
        return None
    free = _without_supports(model.problem)
    theta = model.theta if model.origin is None else model.origin  # where its own K and M are taken
    place = {label: i for i, label in enumerate(free.structure.labels)}
    f = np.array([place[label] for label in model.problem.structure.labels], int)
    names = [f"{model.problem.mesh.node_ids[node]}{DIRECTIONS[d]}" for node, d in held]
    K, M = (m.tocsr() if is_sparse(m) else m for m in assembly(free).matrices(theta))
    held, names = _loaded(model, held, names, place, f, K, M)
    if not held:
        return None
    s = np.array([place[name] for name in names])
    motion = np.zeros((free.structure.n, len(s)))
    motion[s, range(len(s))] = 1.0
    motion[f] = -_solved(K[f][:, f], M[f][:, f], _dense(K[f][:, s]), _dense(M[f][:, s]), _SHIFT * lowest(model))
    whole = np.zeros((free.structure.n, model.r + len(s)))
    whole[f, : model.r], whole[:, model.r :] = model.V, motion
    blocks = [whole.T @ (matrix @ whole) for matrix in (K, M)]
    for block in blocks:
        block[: model.r, : model.r] = 0.0
    slopes, stack = _slopes(model, assembly(free), theta, whole)
    within = model.V.T @ (M[f][:, f] @ motion[f])
    carried = Carried(within, motion, K @ motion, M @ motion, f, slopes, _across(model, stack, motion))
    return Released(tuple(held), *blocks, free.test.read(motion), np.asarray(K.diagonal())[s], carried)


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
    """Supports (node, direction) of `kinds`; none under gravity, whose weight needs them."""
    mesh = model.problem.mesh
    if model.motion is None or mesh.gravity is not None:
        return []
    return [(node, d) for node, d in mesh.supports.tolist() if d in kinds and d in mesh.directions]


def _without_supports(problem: Problem) -> Problem:
    edit = Edit(problem)
    edit.supports = []
    return edit.done()


def _loaded(
    model: Reduced, held: list, names: list[str], place: dict[str, int], f: np.ndarray, K, M
) -> tuple[list, list]:
    """Those that bear a part of the largest reaction in the lowest modes.

    A support without mass would only be in series with what it holds, whose own stiffness says the same.
    """
    heavy = M.diagonal() > 0
    known = [i for i, name in enumerate(names) if name in place and heavy[place[name]]]
    if not known:
        return [], []
    s = np.array([place[names[i]] for i in known])
    modes = slice(0, min(model.r, int(model.data.test.number.max()) + 1))
    reaction = K[s][:, f] @ model.V[:, modes] - (M[s][:, f] @ model.V[:, modes]) * model.eigenvalues[modes]
    size = np.abs(reaction).max(axis=1)
    order = np.sort(np.argsort(-size, kind="stable")[:_MOST])
    chosen = [known[i] for i in order if size[i] > _LOADED * size.max()]
    return [held[i] for i in chosen], [names[i] for i in chosen]


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
    model: Reduced, candidate: Candidate, found: Released, which: list[int], turning: bool, count: int
) -> Recipe:
    unit = "N m/rad" if turning else "N/m"
    k = Unknown("stiffness of the support", unit, *_range(model, float(found.resistance[which].mean()), turning))
    K, M, reading = found.some(which, model.r)
    springs = np.zeros(K.shape)
    springs[range(model.r, len(K)), range(model.r, len(K))] = 1.0
    sensing = np.hstack([np.zeros((len(reading), model.r)), reading])
    held = [found.held[i] for i in which]
    site = _site(model.problem, held)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        nodes = [edit.index(int(model.problem.mesh.node_ids[node])) for node, _ in held]
        direction = held[0][1]
        edit.supports = [each for each in edit.supports if each not in {(node, direction) for node in nodes}]
        springs = edit.add("spring", [[node] for node in nodes], {DIRECTIONS[direction]: values[0]})
        edit.bind(f"stiffness of {site.text}", springs, (DIRECTIONS[direction],), unit=unit)
        return edit.done()

    return Recipe(
        candidate,
        (k,),
        lambda values: Change(K + values[0] * springs, M, sensing),
        steps(k, 6)[:, None],
        lambda values: site,
        own=len(which),
        log_prior=-float(np.log(count)),
        extend=extend,
        carried=_part(found.carried, which, model.r),
    )


def _part(carried: Carried, which: list[int], r: int) -> Carried:
    """What a part of the supports carries along."""
    own = [getattr(carried, name)[:, which] for name in ("model", "whole", "K", "M")]
    at = np.concatenate([np.arange(r), r + np.array(which)])
    slopes = tuple(each[:, at[:, None], at] for each in carried.slopes)

    def across(other: np.ndarray) -> Slopes:
        return tuple(each[..., which] for each in carried.across(other))

    return Carried(*own, carried.deck, slopes, across)


def _range(model: Reduced, resistance: float, turning: bool) -> tuple[float, float]:
    """Flexibility between 1e-6 and 0.1 L^3/EI in translation, 1e-4 and 1 L/EI in rotation; without bars by what they hold."""
    if model.bars is None:
        return 0.3 * resistance, 1e3 * resistance
    EI, L = model.bars.stiffness, model.bars.span
    return (EI / L, 1e4 * EI / L) if turning else (10 * EI / L**3, 1e6 * EI / L**3)


def _site(problem: Problem, held: list[tuple[int, int]]) -> Site:
    ids = tuple(int(problem.mesh.node_ids[node]) for node, _ in held)
    direction = DIRECTIONS[held[0][1]]
    if len(ids) > 1:
        return Site("node", ids, None, f"the supports of nodes {', '.join(map(str, ids))}, {direction}, all alike")
    position = tuple(problem.mesh.coordinates[held[0][0]].tolist())
    return Site("node", ids, position, f"the support of node {ids[0]}, {direction}")

"""Flexible supports: the motion of each, as a degree of freedom of its own beside those of the reduced model."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe, Unknown, product, steps
from mouse_cli.diagnosis.effects.named_supports import named
from mouse_cli.diagnosis.effects.released import (
    SOFTEST,
    STIFFEST,
    Followed,
    Free,
    followed,
    free_model,
    label,
    resistance,
    static,
)
from mouse_cli.diagnosis.effects.support_sets import (
    TOGETHER,
    by_direction,
    dofs,
    sprung,
    stiffness_name,
    support_sets,
    support_site,
    unit_of,
)
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.model.geometry import DIRECTIONS

_LOADED = 0.02  # share of the largest reaction of its kind below which a support is not loaded
_MOST = 48  # supports that are looked at: those that bear most
_STARTS = {1: 7, 2: 4}  # stiffnesses to begin from, of one, and of each of two
# Supports of one direction up to which any of them may be flexible together, each with a stiffness of its own
_APART = 4


@dataclass(frozen=True)
class Released:
    """a supports, (node, direction) in `held`, and their motion `moved`.

    resistance (a,): of the structure against the motion of one support alone; load (a,): largest reactions in the lowest modes.
    """

    held: tuple[tuple[int, int], ...]
    moved: Followed
    resistance: np.ndarray
    load: np.ndarray


def yielding(model: Reduced, candidate: Candidate, turning: bool) -> list[Recipe]:
    """In translation or in rotation: a recipe for each support that the measured modes load, for all alike, and for those of one
    node, or of all alike, in several directions, each with a stiffness of its own; and for any of few in one direction, or in
    two, each with a stiffness of its own: what was built alike, or stands on one ground, gives together though not alike.

    Half of the prior is that of one support, half that of several.
    """
    if model.problem.held is not None:
        return named(model, candidate, turning)
    found = released(model, range(3, 6) if turning else range(3))
    if found is None:
        return []
    return _recipes(model, candidate, found, _sets(model, found))


def _recipes(model: Reduced, candidate: Candidate, found: Released, kinds: Sequence[list[list[list[int]]]]) -> list[Recipe]:
    """Of the sets of each kind, single supports first, which share half of the prior."""
    single, *together = [kind for kind in kinds if kind]
    return [
        _recipe(model, candidate, found, which, -float(np.log(len(kind) * some * (1 + bool(together)))))
        for kind, some in [(single, 1), *((kind, len(together)) for kind in together)]
        for which in kind
    ]


def loose(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """A recipe for the support of each node that is held along an axis and against turning, and for all of them alike: it gives
    along one, or along all that bear, and turns, each with a stiffness of its own.
    """
    found = None if model.problem.held is not None else released(model, range(3), range(3, 6))
    sets = [] if found is None else _lifted(found)
    return _recipes(model, candidate, found, sets) if any(sets) else []


def _lifted(found: Released) -> tuple[list[list[list[int]]], list[list[list[int]]]]:
    """Supports by number that are loose together: of each node those against turning, with one along an axis or all of these; and
    the same of all nodes, in the directions that are common to them, alike in each.
    """
    of: dict[int, dict[int, int]] = {}
    for i, (node, d) in enumerate(found.held):
        of.setdefault(node, {})[d] = i
    single = [[[own[d]] for d in some] for own in of.values() for some in _loosened(own)]
    common = [d for d in range(6) if all(d in own for own in of.values())] if 1 < len(of) <= TOGETHER else []
    return single, [[[own[d] for own in of.values()] for d in some] for some in _loosened(common)]


def _loosened(directions: Iterable[int]) -> list[list[int]]:
    """Of the directions in which a node is held those in which it may be loose together; none where it is not held both ways."""
    along, turns = ([d for d in directions if (d < 3) is straight] for straight in (True, False))
    some = [[d] for d in along] + ([along] if len(along) > 1 else []) if turns else []
    return [own + turns for own in some]


def _sets(model: Reduced, found: Released) -> tuple[list[list[list[int]]], ...]:
    """Supports by number that are flexible together, in lists of one stiffness: single nodes, all or a row alike, several apart."""
    single, alike = support_sets(model.problem.mesh, found.held, found.load)
    few = [own for own in by_direction(found.held).values() if len(own) <= _APART]
    apart = [[[i] for i in some] for own in few for n in range(2, len(own) + 1) for some in combinations(own, n)]
    return single, alike, apart + _in_two(found)


def _in_two(found: Released) -> list[list[list[int]]]:
    """Two nodes or more, of few, each in the same two directions: how feet are nearly pinned."""
    at, nodes = {each: i for i, each in enumerate(found.held)}, list(dict.fromkeys(node for node, _ in found.held))
    sets = []
    for two in combinations(sorted(by_direction(found.held)), 2):
        own = [node for node in nodes if all((node, d) in at for d in two)]
        few = range(2, len(own) + 1) if len(own) <= _APART else ()
        sets += [[[at[node, d]] for node in some for d in two] for n in few for some in combinations(own, n)]
    return sets


def _grid(found: Released, sets: list[list[int]], k: list[Unknown]) -> np.ndarray:
    """Stiffnesses to begin from: all combinations of few; of several nodes in two directions those that are alike in each."""
    directions = [found.held[own[0]][1] for own in sets]
    loosened = len({d < 3 for d in directions}) > 1  # along axes and in turning, each as one
    directions = [d < 3 for d in directions] if loosened else directions
    kinds = list(dict.fromkeys(directions))
    if not loosened and (len(kinds) == 1 or len(kinds) == len(sets)):
        return product(*(steps(each, _STARTS.get(len(sets), 3)) for each in k))
    count = _STARTS[1]
    levels, own = np.array([steps(each, count) for each in k]), [kinds.index(d) for d in directions]
    return np.array([levels[np.arange(len(k)), at[own]] for at in product(*[np.arange(count)] * len(kinds))])


def released(model: Reduced, *kinds: range, most: int = _MOST, light: bool = False) -> Released | None:
    """The loaded supports in the directions of each of `kinds`, `most` at most of each; None where one has none. light: those
    without mass too.
    """
    each = [_candidates(model, own) for own in kinds]
    if not all(each):
        return None
    free = free_model(model)
    known = [_loaded(model, own, free, most, light) for own in each]
    if not all(own for own, *_ in known):
        return None
    held = [one for own, *_ in known for one in own]
    s, load = (np.concatenate([own[i] for own in known]) for i in (1, 2))
    moved = followed(model, free, static(model, free, s, np.eye(len(s))))
    return Released(tuple(held), moved, resistance(model, moved.K, moved.M), load)


def _candidates(model: Reduced, kinds: range) -> list[tuple[int, int]]:
    """Supports (node, direction) of `kinds`."""
    mesh = model.problem.mesh
    if model.motion is None:
        return []
    return [(node, d) for node, d in mesh.supports.tolist() if d in kinds and d in mesh.directions]


def _loaded(
    model: Reduced, held: list, free: Free, most: int, light: bool
) -> tuple[list, np.ndarray, np.ndarray]:
    """Those that bear a part of the largest reaction of their direction in the lowest modes, and a direction one of the largest of
    all, where they are in `free`; and their largest reactions.

    A support without mass would only be in series with what it holds, whose own stiffness says the same.
    """
    names, heavy = [label(model.problem, *each) for each in held], free.M.diagonal() > 0
    known = [i for i, name in enumerate(names) if name in free.place and (light or heavy[free.place[name]])]
    if not known:
        return [], np.zeros(0, int), np.zeros(0)
    s = np.array([free.place[names[i]] for i in known])
    modes = slice(0, model.low_modes())
    size = np.abs(free.reactions(model, s, modes)).max(axis=1)
    order = np.sort(np.argsort(-size, kind="stable")[:most])
    along = np.array([held[i][1] for i in known])
    largest = np.array([size[along == d].max() for d in along])  # those of a direction that bears are alike, if they are
    largest[largest <= _LOADED * size.max()] = size.max()
    order = order[size[order] > _LOADED * largest[order]]
    return [held[known[i]] for i in order], s[order], size[order]


def _recipe(
    model: Reduced, candidate: Candidate, found: Released, sets: list[list[int]], share: float
) -> Recipe:
    """sets: supports by number, those of each list with one stiffness."""
    which = [i for own in sets for i in own]
    held = [[found.held[i] for i in own] for own in sets]
    unit = [unit_of(own[0][1]) for own in held]
    k = [Unknown(stiffness_name(model.problem, held, i), unit[i], *_range(found, own)) for i, own in enumerate(sets)]
    moved = found.moved.part(which, model.r)
    number = np.repeat(np.arange(len(sets)), [len(own) for own in sets])
    site = support_site(model.problem, [found.held[i] for i in which], len(which) > len(sets))
    change = lambda values: moved.on_springs(values[number])
    extend = lambda problem, values: sprung(problem, model.problem, held, values, released=True)
    return Recipe(
        candidate,
        tuple(k),
        change,
        _grid(found, sets, k),
        lambda values: site,
        own=len(which),
        log_prior=share,
        extend=extend,
        carried=moved.carried,
        parts=_parts(model, found, which) if len(which) == len(sets) else (),
        dofs=dofs(model.problem, held),
    )


def _parts(model: Reduced, found: Released, which: list[int]) -> tuple[str, ...]:
    """Names of the nodes and of what moves there, all of them in the same directions."""
    by: dict[int, str] = {}
    for node, d in (found.held[i] for i in which):
        by[node] = by.get(node, str(model.problem.mesh.node_ids[node])) + DIRECTIONS[d]
    return tuple(by.values())


def _range(found: Released, own: list[int]) -> tuple[float, float]:
    """From as good as free to as good as rigid, of supports with one stiffness."""
    against = found.resistance[own]
    return SOFTEST * float(against.min()), STIFFEST * float(against.max())

"""Flexible supports of imported matrices, by name, on springs of their own: see `support_motions`."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.effects.released import (
    SOFTEST,
    STIFFEST,
    Followed,
    followed,
    free_model,
    resistance,
    static,
)
from mouse_cli.diagnosis.effects.support_motions import Motions, kinds, parts
from mouse_cli.diagnosis.extend.supports import with_motions
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.groups import enumerated
from mouse_cli.model.revision import ACROSS, ALONG, ON_ALIKE, ON_SPRINGS

_MOST = 24  # supports
_STARTS, _APART = 8, 1.6  # stiffnesses to begin from, at least, and how far apart they are, of the logarithm, at most
_IN_PLANE = (0.03, 0.2, 1.0, 5.0)  # stiffnesses in the plane to begin from, over that across it


def named(model: Reduced, candidate, turning: bool) -> list[Recipe]:
    """A recipe for each support and direction, for each in all directions on a bed of springs, for nodes of it side by side, and
    for supports that are alike.
    """
    free = free_model(model)
    sets = kinds(free, model.problem.held.supports[:_MOST], turning)
    if not sets:
        return []
    s, pattern, columns = _together([each for kind in sets for each in kind])
    moved = followed(model, free, static(model, free, s, pattern))
    at = iter(columns)
    placed = [[(each, next(at)) for each in kind] for kind in sets]
    whole = [each for kind in placed[1:2] * (not turning) for each in kind]
    loose = [(part, [at[i] for i in own]) for each, at in whole for part, own in parts(free, each)]
    placed += [loose] if loose else []
    return [
        _recipe(model, candidate, each, which, moved, len(kind) * len(placed), turning)
        for kind in placed
        for each, which in kind
    ]


def _together(motions: list[Motions]) -> tuple[np.ndarray, np.ndarray, list[list[int]]]:
    """Degrees of freedom of all supports, patterns (s, a) of all motions, none twice, and which of these each has."""
    s = np.unique(np.concatenate([each.dofs for each in motions]))
    found, which = np.zeros((len(s), 0)), []
    known: dict[bytes, int] = {}
    for each in motions:
        block = np.zeros((len(s), each.pattern.shape[1]))
        block[np.searchsorted(s, each.dofs)] = each.pattern
        keys = [column.tobytes() for column in block.T]
        found = np.hstack([found, block[:, [key not in known for key in keys]]])
        which.append([known.setdefault(key, len(known)) for key in keys])
    return s, found, which


def _recipe(
    model: Reduced, candidate, own: Motions, which: list[int], moved: Followed, count: int, turning: bool
) -> Recipe:
    K, M, beds = moved.K, moved.M, own.beds
    r, one = model.r, len(own.labels) == 1
    at = np.concatenate([np.arange(r), r + np.array(which)])
    own_rows, sensing = np.ix_(at, at), moved.sensing[:, at]
    unit = "N m/rad" if turning else "N/m"
    against = [resistance(model, K[own_rows], M[own_rows], bed) for bed in beds]
    sizes = [(SOFTEST * float(each.min()), STIFFEST * float(each.max())) for each in against]
    unknowns = tuple(Unknown(name, unit, *size) for name, size in zip(_stiffnesses(own), sizes, strict=True))
    site = Site("node", (), None, f"{own.called}, {own.labels[0] if one else own.words}")

    def change(values: np.ndarray) -> Change:
        with_springs = K[own_rows]  # of all supports: many recipes share it
        with_springs[r:, r:] += sum(value * bed for value, bed in zip(values, beds, strict=True))
        return Change(with_springs, M[own_rows], sensing)

    names = tuple(each.name for each in own.supports)
    labels = own.labels if len(names) > 1 else tuple(f"{names[0]} {label}" for label in own.labels)
    called = [_parameter(own, name) for name in _stiffnesses(own)]
    by = lambda values: dict(zip(called, zip(beds, values.tolist(), strict=True), strict=True))
    extend = lambda problem, values: with_motions(problem, names, own.pattern, labels, by(values), unit)
    return Recipe(
        candidate,
        unknowns,
        change,
        _begun(unknowns),
        lambda values: site,
        own=len(which),
        log_prior=-float(np.log(count)),
        extend=extend,
        carried=moved.carried.part(which, r),
    )


def _begun(unknowns: tuple[Unknown, ...]) -> np.ndarray:
    """Stiffnesses (g, t) to begin from."""
    low, high = unknowns[0].bounds
    first = steps(unknowns[0], max(_STARTS, int((high - low) / _APART)))
    if len(unknowns) == 1:
        return first[:, None]
    both = [(k, np.clip(k * ratio, *np.exp(unknowns[1].bounds))) for k in first for ratio in _IN_PLANE]
    return np.unique(both, axis=0)


def _parameter(own: Motions, stiffness: str) -> str:
    """What a stiffness is called in a deck."""
    names = [each.name for each in own.supports]
    of = (ON_SPRINGS if len(names) == 1 else ON_ALIKE).format(enumerated(names))
    return of + stiffness.partition("support")[2]


def _stiffnesses(own: Motions) -> list[str]:
    """What the stiffnesses are called."""
    name = "stiffness of the support" if len(own.supports) == 1 else "stiffness of each support"
    return [f"{name}{which}{own.across}" for which in (ALONG, ACROSS)] if own.across else [name]

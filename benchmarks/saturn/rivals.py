"""Candidates of `mouse diagnose` for five frequencies: evidence beside none, and what modes 1 to 3 foretell of the others."""

from dataclasses import dataclass

import numpy as np

from benchmarks.saturn.decks import segments
from benchmarks.saturn.stack import MEASURED, Vehicle
from benchmarks.saturn.vehicle import problem
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate, registry
from mouse_cli.diagnosis.search.fit import Fit, fit

_STARTS, _FEWER = 8, 4  # fits of candidates with one unknown, and with more
SENSORS = np.array([1, 3, 5, 7, 9, 11, 13, 14, 15, 17, 19, 20, 21, 22, 23, 25, 26, 27, 28]) - 1  # nodes of Table 5-5


@dataclass(frozen=True)
class Rival:
    """One candidate fitted to some modes. gain: ln of its evidence over none's; rms: of ln f, fitted; values: of its unknowns.

    hz (modes,): frequencies of all measured modes, and of one more, of the fitted model; shapes (19, modes):
    their deflections at the stations of Table 5-5.
    """

    key: str
    fit: Fit
    gain: float
    rms: float
    hz: np.ndarray
    values: dict[str, float]
    shapes: np.ndarray


def rivals(vehicle: Vehicle, fitted: int, keys: tuple[str, ...]) -> dict[str, Rival]:
    """Candidates `keys`, and none, for the first `fitted` measured frequencies; the deck's segments are refitted beside each."""
    deck = problem(segments(vehicle, MEASURED[:fitted]))
    base = reduced(deck, deck.prior.mean)
    none = fit(Model(base), np.zeros(0))
    found = {"none": _rival("none", none, none)}
    for key in keys:
        one = _best(base, registry()[key])
        if one is not None:
            found[key] = _rival(key, one, none)
    return found


def _best(base: Reduced, candidate: Candidate) -> Fit | None:
    """The most probable of several fits, from the places and sizes that lower the misfit most."""
    starts = []
    for recipe in candidate.recipes(base, candidate):
        model = Model(base, (recipe,))
        for values in recipe.grid:
            at = model.point(np.concatenate([base.z, recipe.coordinates(values)]))
            if at is not None:
                starts.append((at.chi2, model, at.x))
    if not starts:
        return None
    starts.sort(key=lambda item: item[0])
    fits = [
        fit(model, x[model.k :], x[: model.k])
        for _, model, x in starts[: _STARTS if len(starts[0][1].bounds) == 1 else _FEWER]
    ]
    return max((one for one in fits if one is not None), key=lambda one: one.log_evidence, default=None)


def _rival(key: str, one: Fit, none: Fit) -> Rival:
    at = one.point
    modes = np.arange(2, 2 + len(MEASURED) + 1)
    hz = np.sqrt(np.maximum(at.eigenvalues[modes], 0.0)) / (2 * np.pi)
    fitted = one.model.base.data.m
    error = np.log(hz[:fitted] / MEASURED[:fitted])
    base = one.model.base
    shapes = (base.V @ at.X[: base.r])[2 * SENSORS][:, modes]
    values = {}
    for recipe, own in zip(one.recipes, one.model.own, strict=True):
        values |= dict(zip((u.name for u in recipe.unknowns), recipe.values(one.c[own]).tolist(), strict=True))
    gain = one.log_evidence - none.log_evidence
    return Rival(key, one, gain, float(np.sqrt(np.mean(error**2))), hz, values, shapes)

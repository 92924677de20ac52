"""Element sets that the test makes likely to be missing together: few coordinates of the whole hold no mode without both."""

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.model import Model, modes_of
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.sets import MISSING, sets_in

_TOGETHER = 3  # sets at most
_BEAM = 4  # of each number of them from which more are tried
_LIKELY = 3  # of each number of them


def absent_together(model: Reduced) -> list[tuple[int, ...]]:
    """Numbers of sets, two or more each, without which the model is nearer to the test than without any part of them.

    Judged in the coordinates of `model`, at its parameters: what these miss makes modes too high, by much for those that matter,
    yet hardly changes which sets they are.
    """
    lost = _lost(model)
    if len(lost) < 2:
        return []
    misfit: dict[tuple[int, ...], float] = {(): _misfit(model, [])}
    beam: list[tuple[int, ...]] = [()]
    found: list[tuple[int, ...]] = []
    for count in range(1, min(_TOGETHER, len(lost)) + 1):
        tried = {tuple(sorted({*each, i})) for each in beam for i in lost if i not in each}
        for each in tried:
            misfit[each] = _misfit(model, [lost[i] for i in each])
        better = [each for each in tried if misfit[each] < min(misfit[part] for part in _parts(each, misfit))]
        beam = sorted(better if count > 1 else tried, key=misfit.__getitem__)[:_BEAM]
        found += beam[:_LIKELY] if count > 1 else []
    return found


def _parts(sets: tuple[int, ...], known: dict) -> list[tuple[int, ...]]:
    """Those without one of them, as far as they were tried."""
    return [part for i in sets if (part := tuple(each for each in sets if each != i)) in known]


def _lost(model: Reduced) -> dict[int, tuple[np.ndarray, np.ndarray]]:
    """K and M (r, r) that go with each set that has both, by its number."""
    of = [sets_in(model, name) for name in "KM"]
    factors, found = [each.factors(model) for each in of], {}
    for i in range(len(model.problem.groups)):
        own = [each.projected[i] if of[0].less[i] is None else each.less[i] for each in of]
        if all(x is not None for x in own):
            found[i] = tuple(by[i] * x for by, x in zip(factors, own, strict=True))
    return found


def _misfit(model: Reduced, lost: list[tuple[np.ndarray, np.ndarray]]) -> float:
    """Of the model without what is lost, at its parameters; infinite where that is no structure."""
    K, M = (each.copy() for each in model.matrices(model.z))
    for stiff, heavy in lost:
        K -= MISSING[0] * stiff
        M -= MISSING[1] * heavy
    eigenvalues, X = modes_of(K, M)
    if not np.isfinite(eigenvalues).all():
        return np.inf
    at = Model(model).paired(model.z, eigenvalues, X, np.zeros_like(model.sensing))
    return np.inf if at is None else float(at.residual @ at.residual)

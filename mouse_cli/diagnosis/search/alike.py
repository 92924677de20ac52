"""Several mechanisms of one kind at different sites, as many as may rival what else explains the data."""

from collections.abc import Iterable

import numpy as np

from mouse_cli.diagnosis.gates import GATE, MATERIAL
from mouse_cli.diagnosis.search.fit import Fit, fit
from mouse_cli.diagnosis.search.found import Found, keep
from mouse_cli.diagnosis.search.moves import QUICK, REACH, SECOND, adequate, beside, exchanged, finished, promised
from mouse_cli.diagnosis.search.optima import within
from mouse_cli.diagnosis.search.study import Study

_LEADING, _PROMISING = 2, 3  # kinds of which several are tried: those that lead alone, and of the others those that promise most


def same_kind(
    study: Study, singles: list[Fit], most: int, known: Iterable[Fit] = (), begun: Found | None = None
) -> list[Fit]:
    """Two and more of one kind at different sites, each moved in turn to where it fits best, as far as they may rival `known`.

    begun: sets of one kind, among others, from which they may go on.
    """
    found, begun = Found(), Found(begun)
    known = [*known, *begun.values()]
    for one in _kinds(study, singles, begun):
        best = max([*known, *found.values()], key=lambda one: one.log_evidence, default=None)
        if not _grown(study, one, most, found, best, begun) and not adequate(one):
            for other in _elsewhere(study, one):  # beside all feet of a frame no foot of it can be flexible once more
                _grown(study, other, most, found, best, begun)
    return finished(study, found)


def _kinds(study: Study, singles: list[Fit], begun: Found) -> list[Fit]:
    """Kinds of which several may be: those of which `begun` has the best sets, and those that lead alone."""
    name = lambda one: one.recipes[0].candidate.key
    order = sorted(singles, key=lambda one: -one.log_evidence)
    able = [one for one in order if len(study.recipes(name(one))) > 1 and one.c.size]
    best = sorted(begun.items(), key=lambda item: item[1].log_evidence)
    reach = {names[0]: one.log_evidence for names, one in best if len(set(names)) == 1}
    first = sorted((one for one in able if name(one) in reach), key=lambda one: -reach[name(one)])[:_PROMISING]
    leading = able[: _LEADING if first else _LEADING + _PROMISING]
    return first + [one for one in leading if not any(one is each for each in first)]


def _grown(study: Study, one: Fit, most: int, found: Found, best: Fit | None, begun: Found) -> bool:
    """Into `found` sets of the kind of `one` that grow from it while they, or larger ones that were `begun`, may rival `best`.

    Whether a second can be beside it.
    """
    name, possible = one.recipes[0].candidate.key, False
    while len(one.recipes) < most and not adequate(one):
        larger = Found()
        beside(study, one, [name], larger)
        keep(larger, begun.get((name,) * (len(one.recipes) + 1)))
        possible = possible or bool(larger)
        ahead = [each for n in range(len(one.recipes) + 2, most + 1) if (each := begun.get((name,) * n))]
        if best and not any(_may_rival(one, each, most, best) for each in [*larger.values(), *ahead]):
            break
        more = [exchanged(study, each, (name,)) for each in larger.values()]
        if not more or more[0].log_evidence < one.log_evidence + MATERIAL:
            break
        one = more[0]
        keep(found, one)
    return possible


def _may_rival(one: Fit, larger: Fit, most: int, best: Fit) -> bool:
    """Whether a set may rival `best` if every further one up to `most`, and every exchange, gained as the last one did.

    That is by its evidence where the best explains the data, else by its misfit: the second of several often gains least.
    """
    least = promised(one, larger, most - len(larger.recipes) + 1)
    if not adequate(best, GATE):
        return least < within([best])
    size = lambda fit: fit.log_evidence + 0.5 * fit.misfit  # what its unknowns cost
    return size(larger) - size(best) - 0.5 * (least - best.misfit) > -REACH


def _elsewhere(study: Study, one: Fit) -> list[Fit]:
    """The same kind in the recipes that are next best by themselves, in few steps."""
    (recipe,) = one.recipes
    name, fits = recipe.candidate.key, {}
    for _, number, x in study.looks(name, np.zeros(study.k), ()):
        if number != recipe.number and number not in fits and len(fits) < SECOND:
            fits[number] = fit(study.with_cause((), name, number), x[study.k :], x[: study.k], QUICK)
    return [each for each in fits.values() if each is not None]

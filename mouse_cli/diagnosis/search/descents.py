"""The most probable fit of a mechanism: descents from the best first looks, weighed in all coordinates, and settled."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.likelihoods.modal.unseen import unseen
from mouse_cli.diagnosis.search.escape import shifted, uncrossed
from mouse_cli.diagnosis.search.fit import MOST, Fit, cost_at, descended, fit
from mouse_cli.diagnosis.search.optima import BEYOND, NEAR, TIED, distinct, within
from mouse_cli.diagnosis.search.pared import pared
from mouse_cli.diagnosis.search.starts import cost
from mouse_cli.diagnosis.search.study import BRIEF, MOVED, Study, weighed_beside

_STARTS = 3  # fits of a candidate to the end, from different optima
_SLACK = 1.5  # times the misfit that matters in all coordinates: what matters in few
_TIES = 12  # places as good as the best that are fitted
_SETTLE = 3  # times that causes are weighed anew
# Share of parameters within which what element sets give is alike: of a missing one nothing must be left
_OF_SETS = 1e-5
_FEW = 16  # places and sizes that are looked at in all coordinates


def idealised(one: Fit) -> Fit:
    """The fit when the theory of its causes is right to some share of what they do."""
    loose = one.model.loosened(one.point, one.model.base.problem.theory.mechanism)
    return one if loose is None else fit(loose, one.c, one.point.x[: one.model.k]) or one


def plainer(one: Fit, study: Study) -> Fit:
    """A fit by theory that errs, see `idealised`, without parts that only made up for what it errs."""
    if one.data is study.model.data:
        return one
    found = pared(one, study)
    return found if len(found.c) < len(one.c) else one


def settled(one: Fit, study: Study) -> Fit:
    """The fit with no modes crosswise, and its causes weighed at the parameters that it found, not where the search began."""
    one = uncrossed(one)
    trifle = _OF_SETS if study.model.first.problem.groups else MOVED
    for _ in range(_SETTLE):
        theta = one.model.base.parameters(one.point.x[: one.model.k])
        before = one.model.base.theta
        if not one.recipes or np.all(np.abs(theta - before) <= trifle * np.abs(before)):
            break
        there = study.about(one) if trifle == MOVED else study.at(one)
        base = there.model.judged_by(one.model.base.data)
        again = fit(study.kind(base, there.own(one.recipes)), one.c, one.point.x[: one.model.k])
        if again is None:
            break
        one = again
    return one


def best(study: Study, name: str, reach: float = np.inf) -> Fit | None:
    """The most probable fit of candidate `name` over all of its places, its evidence summed over distinct optima.

    reach: misfit above which no fit matters, and is left as it was found.
    """
    found, others = tried(study, name, (), np.zeros(study.k), _STARTS, reach=reach)
    apart = distinct([pared(one, study) for one in found])
    whole = summed([settled(shifted(one), study) if one.misfit < reach else one for one in apart], reach, others)
    return whole and plainer(whole, study)


def tried(
    study: Study,
    name: str,
    others: tuple[Recipe, ...],
    before: np.ndarray,
    count: int,
    most: int = MOST,
    reach: float = np.inf,
) -> tuple[list[Fit], float]:
    """Fits of candidate `name` from its `count` most promising places, in at most so many steps, beside `others` there `before`;
    and the evidence of places that need no fit, over that of the first.

    Each first in the lowest coordinates, then in all; in all at once where there is little to look at, for what is spread over
    the structure, such as shear, is not to be had in few. reach: misfit above which none matters.
    """
    first = study if sum(len(recipe.grid) for recipe in study.recipes(name)) <= _FEW else study.coarse
    near_by = first.approached(name, before, others, _SLACK * reach)
    if not others and near_by and first.idle(near_by[0][0], before):
        chosen, further, alike = near_by[:count], [], near_by[count:]
    else:
        tied = 0 if others or not near_by else sum(left < near_by[0][0] + TIED for left, _, _ in near_by)
        count = max(count, min(tied, _TIES)) if near_by and near_by[0][0] < BEYOND * reach else 1
        chosen = near_by[:count] if first is study else _weighed(study, before, others, name, near_by, count)
        further, alike = [] if others else _screened(study, name, reach), []
    found: list[Fit] = []
    for way, _, i, x in [*((first, *each) for each in chosen), *((study, *each) for each in further)]:
        least = min(reach, within(found, NEAR)) if found and others else reach  # beside others the best alone is kept
        one = _ended(study, way, others, name, i, x, most, least)
        found += [] if one is None else [one]
    return found, sum(float(np.exp((near_by[0][0] - left) / 2)) for left, _, _ in alike)


def _screened(study: Study, name: str, reach: float) -> list[tuple[float, int, list[np.ndarray]]]:
    """Likewise from where a screening of the candidate's own puts its recipes, in all coordinates: the best, and those as good.

    A screening pairs modes by their shapes, where those of a wrong size misfit more than those of a wrong place.
    """
    none, ends = np.zeros(study.k), []
    for recipe in study.recipes(name):
        trial = study.with_cause((), name, recipe.number)
        each = (descended(trial, recipe.coordinates(values), none, BRIEF, _SLACK * reach) for values in recipe.starts)
        ends += [(cost(end), recipe.number, [end.point.x]) for end in each if end is not None]
    ends.sort(key=lambda item: item[0])
    return [each for n, each in enumerate(ends[:_TIES]) if n < _STARTS or each[0] < ends[0][0] + TIED]


def _weighed(study: Study, before: np.ndarray, others: tuple, name: str, near_by: list, count: int) -> list:
    """The `count` of `near_by` that misfit least in all coordinates, from where they ended or the prior mean; and the first of all.

    In few coordinates the true place may be behind several others. Parameters, and
    what is there `before`, adapt to first order.
    """
    if len(near_by) <= count:
        return near_by
    k, left = study.k, []
    for _, i, (end, *_) in near_by[: weighed_beside(others)]:
        whole = study.with_cause(others, name, i)
        points = [whole.point(x) for x in (end, np.concatenate([np.zeros(k), end[k:]]))]
        cost = min((study.predicted(at, before, whole.recipes[:-1]) for at in points if at is not None), default=np.inf)
        left.append(cost - 2 * whole.recipes[-1].log_prior)
    best = np.argsort(left, kind="stable")[:count].tolist()
    return [near_by[j] for j in (best if 0 in best else [*best, 0])]


def _ended(
    study: Study, first: Study, others: tuple, name: str, i: int, starts: list, most: int, reach: float
) -> Fit | None:
    """The fit of recipe i, in the coordinates of `first`, then in all from where the whole misfits least.

    That may be there, a start, or the same causes at the prior mean.
    """
    k, whole = study.k, study.with_cause(others, name, i)
    if first is not study:
        near = descended(first.with_cause(others, name, i), starts[0][k:], starts[0][:k], most, _SLACK * reach)
        starts = starts if near is None else [near.point.x, *starts]
        reach = reach if near is None or near.misfit > reach else np.inf
    plain = [np.concatenate([np.zeros(k), x[k:]]) for x in starts[:1]]
    points = [at for at in map(whole.point, [*starts, *plain]) if at is not None]
    if not points:
        return None
    x = min(points, key=lambda at: cost_at(at, k)).x
    one = fit(whole, x[k:], x[:k], most, reach)
    lost = one is None or one.misfit > (reach if others else BEYOND * reach)
    return one if lost else uncrossed(one, most, reach)


def summed(found: list[Fit], reach: float = np.inf, more: float = 0.0) -> Fit | None:
    """The best of several optima, its theory taken for as good as it is; those at other places add to its evidence.

    Each is weighed by what it says of modes that the test does not have. more: evidence of further places over that of the best.
    """
    if not found:
        return None
    weighed = [(one.log_evidence - unseen(one), one) for one in distinct(found)]
    weighed.sort(key=lambda item: -item[0])
    (first, leading), *rest = weighed
    total = float(np.logaddexp.reduce([weight for weight, _ in weighed] + [first + np.log(max(more, 1e-300))]))
    others = tuple((one, float(np.exp(weight - total))) for weight, one in rest)
    best = idealised(leading) if leading.misfit < reach else leading
    return replace(best, log_evidence=best.log_evidence - unseen(best) + total - first, elsewhere=others)

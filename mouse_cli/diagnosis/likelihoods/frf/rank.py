"""Explanations of modes, judged anew by the frequency response functions: with laws of damping, and causes that only damp.

All are fitted to few lines and in few steps first; those that lead are fitted to all lines and to the end.
"""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from mouse_cli.diagnosis.gates import GATE
from mouse_cli.diagnosis.likelihoods.frf.correlated import correlated, scatter
from mouse_cli.diagnosis.likelihoods.frf.damping import damping
from mouse_cli.diagnosis.likelihoods.frf.data import FrfData, lines
from mouse_cli.diagnosis.likelihoods.frf.judge import BRIEF, DAMPERS, THIN, Judge
from mouse_cli.diagnosis.likelihoods.frf.lossy import GROUPS, LAWS
from mouse_cli.diagnosis.likelihoods.frf.mesh import of_mesh
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.noise import log_density
from mouse_cli.diagnosis.search.fit import End, Fit, descended
from mouse_cli.diagnosis.search.moves import adequate
from mouse_cli.diagnosis.search.optima import distinct, within
from mouse_cli.diagnosis.search.rank import Ranking, ranking
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.updating.chi_square import upper_tail

_REACH = 60.0  # nats by which modes may speak against an explanation that is judged by FRFs still
_SINGLES = 3  # single causes that are judged in any case
# Other places at which modes leave a cause possible: so many whatever they say, and so many of at least this share
_ELSEWHERE, _PLACES, _SHARE = 2, 6, 1e-3
_UNSTATED = ("hann", "uniform")  # windows that are tried where a deck states none
_PLAIN = 10.0  # nats that one must gain
_WEIGHED = 3  # times that accuracies nobody stated are taken from what is left
# Nats below the leading one up to which an explanation is fitted to the end, and how many are at least
_FAR, _LEAST = 200.0, 4


@dataclass(frozen=True)
class FitWithModes(Fit):
    """A fit of FRFs, with the model of modes at the same parameters beside it, which all that follows a ranking needs."""

    frf: Fit | None = None
    bearable: ClassVar[float] = 1.2  # scatter of functions is measured better than that of modes
    telling: ClassVar[bool] = True

    @property
    def dof(self) -> int:
        """Degrees of freedom of the FRFs."""
        return self.frf.dof

    @property
    def strained(self) -> bool:
        """The same of functions of no stated accuracy, which any explanation leaves as much as it does."""
        z = self.frf.point.x[: self.frf.model.of_deck]
        return self.frf.model.base.data.assumed and upper_tail(float(z @ z), max(len(z), 1)) < GATE


class ByFunctions:
    """What FRFs make of rankings of one deck; a fit that was judged once is not fitted again.

    candidates: keys of what is considered; None: all.
    """

    def __init__(self, candidates: tuple[str, ...] | None = None) -> None:
        self._sought = tuple(key for key in DAMPERS if candidates is None or key in candidates)
        self._own: tuple[Fit, Judge] | None = None
        self._meshes: dict[tuple[bytes, float], float] = {}

    def __call__(self, modal: Ranking, measured: bool) -> Ranking:
        """The ranking `modal` by modes, ranked again by the FRFs of the test; `modal` itself where there are none.

        measured: the modes were measured beside the FRFs, and both judge; else the FRFs showed them, and judge alone.
        """
        base = modal.baseline.model.base
        if not base.problem.frf:
            return modal
        judge = self._judge(modal.baseline, measured)
        fits = _searched(judge, modal)
        if not fits:
            return modal
        if not any(map(adequate, fits)) and (erring := _erring(judge, fits, modal)):
            judge, fits = erring, _searched(erring, modal) or fits
        fits = _shared(_together(_weighed(judge, fits)))
        fits[0] = self._without_mesh(fits[0], base)
        found = ranking(fits[0], fits)
        views = {id(one): _beside_modes(one, base.data) for one in fits}
        return replace(found, baseline=views[id(fits[0])], fits=tuple(views[id(one)] for one in found.fits))

    def _judge(self, baseline: Fit, measured: bool) -> Judge:
        """The FRFs beside `baseline`, the fit without a cause of the modes; with what they judged of it before."""
        if self._own is None or self._own[0] is not baseline:
            base, theory = baseline.model.base, _theory(baseline)
            data = FrfData(tuple(lines(test, base.problem.theory) for test in base.problem.frf), theory)
            self._own = baseline, Judge(data, damping(base, len(theory)), base.data.theory if measured else None, self._sought)
        return self._own[1]

    def _without_mesh(self, none: Fit, base: Reduced) -> Fit:
        """The fit without a cause, as probable as if its mesh had left nothing: no cause gains more by imitating the mesh.

        Where the functions are far off for other reasons that is little of what the noise would have to be.
        """
        key = none.point.x.tobytes(), none.misfit
        if key not in self._meshes:
            self._meshes[key] = of_mesh(none, base)
        left = max(none.misfit - self._meshes[key], 0.0)
        gained = float(log_density(left, none.dof) - log_density(none.misfit, none.dof))
        return replace(none, log_evidence=none.log_evidence + gained)


def _weighed(judge: Judge, fits: list[Fit]) -> list[Fit]:
    """`fits` where lines that say the same count once, and the residual gives the accuracies that nobody stated."""
    alike = None
    for _ in range(_WEIGHED):
        nearest = min(fits, key=lambda one: one.misfit)
        if adequate(nearest) or not (alike is None or judge.data.assumed):
            break
        alike = correlated(nearest) if alike is None else 1.0
        judge = replace(judge, data=judge.data.reweighted(alike, _scatter(nearest)))
        fits = judge.all_of(fits)
    return fits


def _searched(judge: Judge, modal: Ranking) -> list[Fit]:
    """The explanations `modal` of modes and what only damps, fitted to the functions to the end, that without a cause first.

    None where the model without a cause is not physical.
    """
    quick, stages = judge.thinned, judge.broadened
    begun = quick.near(modal.baseline, stages)
    none = None if begun is None else quick.fitted(begun)
    if none is None:
        return []
    starts, looked = _promising(modal), []
    if adequate(none):
        once = _once(quick, none, modal, starts)
        gained = {_causes(one) for one in once if one.log_evidence > none.log_evidence + _PLAIN / THIN}
        starts = [one for one in starts if _causes(one) in gained]
        again = {_causes(one) for one in starts}
        looked = [one for one in once if _causes(one) not in again]
    if starts or not looked:
        looked = _looked(quick, none, modal, starts, stages, looked)
    return judge.uneven(judge.all_of([none, *_leading(looked)]))


def _once(quick: Judge, none: Fit, modal: Ranking, starts: list[Fit]) -> list[Fit]:
    """A first look beside a model that explains the functions by itself: each hypothesis once, its resonances where they are."""
    looked = [one for start in starts if (one := quick.fitted(start, most=BRIEF, reach=within([none])))]
    looked += quick.damped(none, modal.baseline.model.base, within([none]))
    best: dict[tuple, Fit] = {}
    for one in sorted(looked, key=lambda each: -each.log_evidence):
        best.setdefault(_hypothesis(one), one)
    return list(best.values())


def _looked(
    quick: Judge, none: Fit, modal: Ranking, starts: list[Fit], stages: tuple[Judge, ...], once: list[Fit]
) -> list[Fit]:
    """A first look at `starts`, under every law of damping, and where modes did not show anything; with what was looked at `once`,
    where there is such, and else with what only damps.
    """
    looked = list(once)

    def look(starts: list[End], stages: tuple[Judge, ...]) -> None:
        for start in starts:
            one = quick.near(start, stages)
            looked.extend([] if one is None else quick.laws(one, within([none, *looked])))

    look(starts, stages)
    looked += [] if once else quick.damped(none, modal.baseline.model.base, within([none, *looked]))
    if quick.known is not None or not any(map(adequate, looked)):
        look(stages[0].once(("anew", *_known(modal)), modal.baseline, np.inf, lambda: anew(stages[0], modal)), stages[1:])
    return looked


def _erring(judge: Judge, fits: list[Fit], modal: Ranking) -> Judge | None:
    """By an error that functions may have, if they are explained with it: by what is nearest in `fits` with a window that the deck
    does not state, or with late responses by what explains the modes, for delays bend a fit that has none; None: by none.
    """
    nearest, late = min(fits, key=lambda one: one.misfit), judge.delayed
    begun = [(there, nearest) for there in map(judge.windowed, _UNSTATED) if there]
    begun += [(late, at) for one in (modal.baseline, modal.fits[0]) if (at := late.near(one, late.broadened))]
    trials = [(one, there) for there, start in begun if (one := there.fitted(start))]
    if not trials:
        return None
    one, there = min(trials, key=lambda trial: trial[0].misfit)
    return there if adequate(one) and nearest.misfit - one.misfit > 2 * _PLAIN else None


def anew(judge: Judge, modal: Ranking) -> list[End]:
    """Single mechanisms at places that modes did not show: where a first look by functions that are broadened finds most.

    judge: by these.
    """
    base, found = modal.baseline.model.base, []
    known = _known(modal)
    study, k = Study(Study(base).coarse.model, known, judge.model), judge.model(base).k
    study.k = k
    for name in known:
        recipes, first = Study(base, known).recipes(name), {}
        for _, number, x in study.looks(name, np.zeros(k), ()):
            first.setdefault(number, x)
        for number, x in list(first.items())[:_ELSEWHERE]:
            found.append(descended(judge.model(base, (recipes[number],)), x[k:], x[:k], BRIEF))
    return [one for one in found if one is not None]


def _known(modal: Ranking) -> dict[str, Candidate]:
    """Candidates that explain the modes as single mechanisms, by key."""
    return {one.recipes[0].candidate.key: one.recipes[0].candidate for one in modal.fits if len(one.recipes) == 1}


def _theory(one: Fit) -> np.ndarray:
    """sd of ln f (c,) of the lowest modes, by what theory and numerics leave, of the fit `one` of modes."""
    data, modes = one.model.base.data, one.point.modes
    found = np.full(min(one.model.base.r, int(modes.max()) + 2), data.allowed.frequency)
    found[modes] = data.theory
    return found


def _scatter(nearest: Fit) -> float:
    """Variance of the data over what it was held to be: what the nearest fit leaves, of what a deck states if that is scatter."""
    return nearest.misfit / nearest.dof if nearest.model.base.data.assumed else scatter(nearest)


def _promising(modal: Ranking) -> list[Fit]:
    """Explanations that modes leave possible, at all places that do; the best of single causes whatever modes say of them."""
    best = modal.fits[0].log_evidence / modal.noise_scale
    near = [
        one
        for one in modal.fits
        if (one.recipes or one.nameless) and one.log_evidence / modal.noise_scale > best - _REACH
    ]
    singles = [one for one in modal.fits if len(one.recipes) == 1 and not any(one is other for other in near)]
    return [place for one in near + singles[:_SINGLES] for place in _places(one)]


def _places(one: Fit) -> list[Fit]:
    """A fit, and the same at other places that modes leave possible."""
    others = enumerate(one.elsewhere[:_PLACES])
    return [one, *(other for i, (other, share) in others if i < _ELSEWHERE or share > _SHARE)]


def _leading(looked: list[Fit]) -> list[Fit]:
    """Those of a first look that may lead when all lines are used: while even the best leaves more than noise, none is at its end,
    and nats count by what it leaves.
    """
    order = sorted(looked, key=lambda one: -one.log_evidence)
    if not order:
        return []
    best, reach = order[0].log_evidence, _FAR / THIN * max(1.0, order[0].misfit / max(order[0].dof, 1))
    return [one for i, one in enumerate(order) if i < _LEAST or best - one.log_evidence < reach]


def _together(fits: list[Fit]) -> list[Fit]:
    """One of each hypothesis: the best, its evidence summed over distinct optima; those are where else it may act."""
    names: dict[tuple, list[Fit]] = {}
    for one in fits:
        names.setdefault(_hypothesis(one), []).append(one)
    found = []
    for alike in names.values():
        best, *others = distinct(alike)
        total = np.logaddexp.reduce([one.log_evidence for one in (best, *others)])
        elsewhere = tuple((one, float(np.exp(one.log_evidence - total))) for one in others)
        found.append(replace(best, log_evidence=float(total), elsewhere=elsewhere))
    return found


def _hypothesis(one: Fit) -> tuple:
    """What a fit says acts, by which law, wherever it does."""
    return *_causes(one), *(recipe.law for recipe in one.recipes)


def _causes(one: Fit) -> tuple[str, ...]:
    """What a fit says acts, wherever it does and by whatever law."""
    return one.nameless.rival.key if one.nameless else "", *(recipe.candidate.key for recipe in one.recipes)


def _shared(fits: list[Fit]) -> list[Fit]:
    """Fits whose springs follow one law of several: each law has its share of the prior of the cause."""
    return [replace(one, log_evidence=one.log_evidence - np.log(_laws(one))) for one in fits]


def _laws(one: Fit) -> int:
    return len(LAWS) if any(recipe.candidate.group in GROUPS for recipe in one.recipes) else 1


def _beside_modes(one: Fit, data) -> Fit:
    """The fit `one` of FRFs with the model of modes at its parameters; one itself where modes have none there."""
    own, k = one.model.of_deck, one.model.k
    model = Model(one.model.base.judged_by(data), one.recipes)
    elastic = np.r_[0:own, k : k + one.model.t]
    at = model.point(one.point.x[elastic])
    if at is None:
        return one
    known = np.linalg.inv(one.covariance[np.ix_(elastic, elastic)])  # the damping of the structure integrated out
    elsewhere = tuple((_beside_modes(other, data), share) for other, share in one.elsewhere)
    return FitWithModes(model, at, one.misfit, known, one.log_evidence, elsewhere, frf=one)

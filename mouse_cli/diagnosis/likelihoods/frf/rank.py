"""Explanations of modes, judged anew by the frequency response functions: with laws of damping, and causes that only damp.

All are fitted to few lines and in few steps first; those that lead are fitted to all lines and to the end.
"""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.gates import GATE
from mouse_cli.diagnosis.likelihoods.frf.correlated import correlated
from mouse_cli.diagnosis.likelihoods.frf.damping import Damping, damping
from mouse_cli.diagnosis.likelihoods.frf.dashpots import dashpots
from mouse_cli.diagnosis.likelihoods.frf.data import FrfData, lines
from mouse_cli.diagnosis.likelihoods.frf.lossy import GROUPS, LAWS, LOSS, SAME, lossy
from mouse_cli.diagnosis.likelihoods.frf.lossy_parts import lossy_parts
from mouse_cli.diagnosis.likelihoods.frf.mesh import of_mesh
from mouse_cli.diagnosis.likelihoods.frf.model import FrfModel
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.search.fit import MOST, Fit, fit
from mouse_cli.diagnosis.search.optima import distinct
from mouse_cli.diagnosis.search.rank import Ranking, ranking
from mouse_cli.diagnosis.search.several import adequate
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.updating.chi_square import upper_tail
from mouse_cli.updating.frf_start import WIDTHS

_REACH = 60.0  # nats by which modes may speak against an explanation that is judged by FRFs still
_SINGLES, _ELSEWHERE = (
    3,
    2,
)  # single causes that are judged in any case; other places at which modes leave a cause possible
_PLACES, _KEPT = 5, 2  # places from which what only damps begins, and how many of its kind go on
_THIN, _BRIEF = 4, 12  # in a first look: every so manieth line, and steps
_WIDTHS = WIDTHS[1:]  # damping ratios by which resonances are broadened
_WEIGHED = 3  # times that accuracies nobody stated are taken from what is left
_FAR, _LEAST = (
    200.0,
    4,
)  # nats below the leading one up to which an explanation is fitted to the end, and how many are at least


@dataclass(frozen=True)
class Heard(Fit):
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


@dataclass(frozen=True)
class Judge:
    """FRFs of a test and the damping of the structure as it is held likely.

    known (m,): sd of ln f of modes measured beside them by what theory leaves of both; None: the modes are those of the functions.
    """

    data: FrfData
    damping: Damping
    known: np.ndarray | None = None

    def thinned(self) -> "Judge":
        """By few lines."""
        return replace(self, data=replace(self.data, blocks=tuple(block.every(_THIN) for block in self.data.blocks)))

    def broadened(self, width: float) -> "Judge":
        """By functions with broader resonances."""
        return replace(
            self, data=replace(self.data, blocks=tuple(block.broadened(width) for block in self.data.blocks))
        )

    def model(self, base: Reduced, recipes: tuple = ()) -> FrfModel:
        """The reduced model `base` with causes, as the FRFs see it, and the modes that were measured beside them."""
        modes = base.data
        if isinstance(modes, FrfData):
            modes = modes.modes
        elif self.known is None:
            modes = None
        else:
            modes = modes.sharpened(self.known)
        return FrfModel(replace(base, data=replace(self.data, modes=modes)), self.damping, recipes)

    def fitted(self, one: Fit, law: str = SAME, most: int = MOST) -> Fit | None:
        """The explanation `one` of modes, or of FRFs, fitted from where it is; law: of its springs, where they have none yet."""
        recipes = tuple(lossy(recipe, law, self.data.middle) for recipe in one.recipes)
        model = self.model(one.model.base, recipes)
        parts = zip(one.recipes, recipes, one.model.own, strict=True)
        c = [np.append(one.c[own], [np.log(LOSS)] * (len(r.unknowns) - len(was.unknowns))) for was, r, own in parts]
        start = np.concatenate([one.point.x[: one.model.k], model.start[one.model.k :]])
        return fit(model, np.concatenate([np.zeros(0), *c]), start, most)

    def all_of(self, fits: list[Fit]) -> list[Fit]:
        """Each fitted to the end, from where it is."""
        found = [self.fitted(one) for one in fits]
        return [one for one in found if one is not None]

    def near(self, one: Fit, stages: "tuple[Judge, ...]") -> Fit | None:
        """`one` where its resonances are near the measured ones: as it is, or fitted with ever narrower resonances, `stages`."""
        end = one
        for stage in stages:
            end = stage.fitted(end, most=_BRIEF // 2) or end
        starts = [at for at in (self.fitted(one, most=0), self.fitted(end, most=0)) if at is not None]
        return min(starts, key=lambda at: at.misfit, default=None)

    def laws(self, one: Fit) -> list[Fit]:
        """A first look at the explanation `one` under each law of damping that its springs may follow."""
        may = any(recipe.candidate.group in GROUPS for recipe in one.recipes)
        found = [self.fitted(one, law, _BRIEF) for law in (LAWS if may else (SAME,))]
        return [each for each in found if each is not None]

    def damped(self, one: Fit, base: Reduced) -> list[Fit]:
        """A first look at what only damps, beside the causes of `one`, a fit of FRFs; base: its model with its modes."""
        found = []
        for recipes in (dashpots(base), lossy_parts(base, self.data.middle)):
            recipes = [replace(recipe, number=i) for i, recipe in enumerate(recipes)]
            fits = [fit(trial, x[trial.k :], x[: trial.k], _BRIEF) for trial, x in self._starts(one, recipes)]
            found += sorted((each for each in fits if each is not None), key=lambda each: -each.log_evidence)[:_KEPT]
        return found

    def _starts(self, one: Fit, recipes: list[Recipe]) -> list[tuple[FrfModel, np.ndarray]]:
        """Where what only damps does most: models and x, at most one for each place of a recipe.

        The damping of the structure is as it is held likely: `one` has made that of the cause.
        """
        x, tried = one.point.x.copy(), []
        x[one.model.of_deck : one.model.lossy] = 0.0
        for recipe in recipes:
            trial = self.model(one.model.base, (*one.recipes, recipe))
            places: dict[bytes, tuple] = {}
            for values in recipe.grid:
                at = trial.point(np.concatenate([x, recipe.coordinates(values)]))
                place = values[1:].tobytes()
                if at is not None and (place not in places or at.chi2 < places[place][0]):
                    places[place] = at.chi2, trial, at.x
            tried += places.values()
        return [(trial, x) for _, trial, x in sorted(tried, key=lambda item: item[0])[:_PLACES]]


def ranked_by_frf(modal: Ranking, measured: bool) -> Ranking:
    """The ranking `modal` by modes, ranked again by the FRFs of the test; `modal` itself where there are none.

    measured: the modes were measured beside the FRFs, and both judge; else the FRFs showed them, and judge alone.
    """
    base = modal.baseline.model.base
    if not base.problem.frf:
        return modal
    blocks = tuple(lines(test, base.problem.theory) for test in base.problem.frf)
    judge = Judge(FrfData(blocks, _theory(modal.baseline)), damping(base), base.data.theory if measured else None)
    quick, stages = judge.thinned(), tuple(judge.broadened(width) for width in _WIDTHS)
    begun = quick.near(modal.baseline, stages)
    none = None if begun is None else quick.fitted(begun)
    if none is None:
        return modal
    starts = [quick.near(one, stages) for one in _promising(modal)]
    looked = [law for one in starts if one for law in quick.laws(one)] + quick.damped(none, base)
    if measured or not any(map(adequate, looked)):
        starts = [quick.near(one, stages[1:]) for one in anew(stages[0], modal)]
        looked += [law for one in starts if one for law in quick.laws(one)]
    fits = judge.all_of([none, *_leading(looked)])
    alike = None
    for _ in range(_WEIGHED):
        nearest = min(fits, key=lambda one: one.misfit)
        if adequate(nearest) or not (alike is None or judge.data.assumed):
            break
        alike = correlated(nearest) if alike is None else 1.0
        judge = replace(judge, data=judge.data.weighed(alike, _scatter(nearest)))
        fits = judge.all_of(fits)
    fits = _shared(_together(fits))
    fits[0] = replace(fits[0], log_evidence=fits[0].log_evidence + of_mesh(fits[0], base) / 2)
    found = ranking(fits[0], fits)
    views = {id(one): _beside_modes(one, base.data) for one in fits}
    return replace(found, baseline=views[id(fits[0])], fits=tuple(views[id(one)] for one in found.fits))


def anew(judge: Judge, modal: Ranking) -> list[Fit]:
    """Single mechanisms at places that modes did not show: where a first look by functions that are broadened finds most.

    judge: by these.
    """
    base, found = modal.baseline.model.base, []
    known = {one.recipes[0].candidate.key: one.recipes[0].candidate for one in modal.fits if len(one.recipes) == 1}
    study, k = Study(Study(base).coarse.model, known, judge.model), judge.model(base).k
    study.k = k
    for name in known:
        recipes, first = Study(base, known).recipes(name), {}
        for _, number, x in study.looks(name, np.zeros(k), ()):
            first.setdefault(number, x)
        for number, x in list(first.items())[:_ELSEWHERE]:
            found.append(fit(judge.model(base, (recipes[number],)), x[k:], x[:k], _BRIEF))
    return [one for one in found if one is not None]


def _theory(one: Fit) -> np.ndarray:
    """sd of ln f (c,) of the lowest modes, by what theory and numerics leave, of the fit `one` of modes."""
    data, modes = one.model.base.data, one.point.modes
    found = np.full(min(one.model.base.r, int(modes.max()) + 2), data.allowed.frequency)
    found[modes] = data.theory
    return found


def _scatter(nearest: Fit) -> float:
    """Variance of the data over what it was held to be: 1 where a deck states it, else what the nearest fit leaves."""
    return nearest.misfit / nearest.dof if nearest.model.base.data.assumed else 1.0


def _promising(modal: Ranking) -> list[Fit]:
    """Explanations that modes leave possible, at all places that do; the best of single causes whatever modes say of them."""
    best = modal.fits[0].log_evidence / modal.noise_scale
    near = [
        one
        for one in modal.fits
        if (one.recipes or one.nameless) and one.log_evidence / modal.noise_scale > best - _REACH
    ]
    singles = [one for one in modal.fits if len(one.recipes) == 1 and not any(one is other for other in near)]
    return [
        place
        for one in near + singles[:_SINGLES]
        for place in (one, *(other for other, _ in one.elsewhere[:_ELSEWHERE]))
    ]


def _leading(looked: list[Fit]) -> list[Fit]:
    """Those of a first look that may lead when all lines are used."""
    order = sorted(looked, key=lambda one: -one.log_evidence)
    best = order[0].log_evidence if order else 0.0
    return [one for i, one in enumerate(order) if i < _LEAST or best - one.log_evidence < _FAR / _THIN]


def _together(fits: list[Fit]) -> list[Fit]:
    """One of each hypothesis: the best, its evidence summed over distinct optima; those are where else it may act."""
    names: dict[tuple, list[Fit]] = {}
    for one in fits:
        field = one.nameless.rival.key if one.nameless else ""
        names.setdefault((field, *((r.candidate.key, r.law) for r in one.recipes)), []).append(one)
    found = []
    for alike in names.values():
        best, *others = distinct(alike)
        total = np.logaddexp.reduce([one.log_evidence for one in (best, *others)])
        elsewhere = tuple((one, float(np.exp(one.log_evidence - total))) for one in others)
        found.append(replace(best, log_evidence=float(total), elsewhere=elsewhere))
    return found


def _shared(fits: list[Fit]) -> list[Fit]:
    """Fits whose springs follow one law of several: each law has its share of the prior of the cause."""
    return [replace(one, log_evidence=one.log_evidence - np.log(_laws(one))) for one in fits]


def _laws(one: Fit) -> int:
    return len(LAWS) if any(recipe.candidate.group in GROUPS for recipe in one.recipes) else 1


def _beside_modes(one: Fit, data) -> Fit:
    """The fit `one` of FRFs with the model of modes at its parameters; one itself where modes have none there."""
    own, k = one.model.of_deck, one.model.k
    model = Model(replace(one.model.base, data=data), one.recipes)
    elastic = np.r_[0:own, k : k + one.model.t]
    at = model.point(one.point.x[elastic])
    if at is None:
        return one
    known = np.linalg.inv(one.covariance[np.ix_(elastic, elastic)])  # the damping of the structure integrated out
    elsewhere = tuple((_beside_modes(other, data), share) for other, share in one.elsewhere)
    return Heard(model, at, one.misfit, known, one.log_evidence, elsewhere, frf=one)

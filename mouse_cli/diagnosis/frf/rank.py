"""Explanations of modes, judged anew by the frequency response functions: with laws of damping, and causes that only damp."""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.baseline.altered import Model
from mouse_cli.diagnosis.baseline.reduced import Reduced
from mouse_cli.diagnosis.data import THEORY_LOG, THEORY_SHAPE
from mouse_cli.diagnosis.frf.damping import Damping, damping
from mouse_cli.diagnosis.frf.dashpots import dashpots
from mouse_cli.diagnosis.frf.data import FrfData, Lines, lines
from mouse_cli.diagnosis.frf.lossy import GROUPS, LAWS, SAME, STRUCTURAL, lossy
from mouse_cli.diagnosis.frf.model import FrfModel
from mouse_cli.diagnosis.name.fit import Fit, fit
from mouse_cli.diagnosis.name.rank import Ranking, ranking

_REACH = 60.0  # nats by which modes may speak against an explanation that is judged by FRFs still
_SINGLES = 3  # single causes that are judged in any case
_LOSS = np.log(0.1)  # where loss factors of causes begin
_PLACES = 3  # places from which a dashpot begins
_STEP = 1e-4  # of frequency, for derivatives of FRFs


@dataclass(frozen=True)
class Heard(Fit):
    """A fit of FRFs, with the model of modes at the same parameters beside it, which all that follows a ranking needs."""

    frf: Fit | None = None

    @property
    def dof(self) -> int:
        """Degrees of freedom of the FRFs."""
        return self.frf.dof


@dataclass(frozen=True)
class Judge:
    """FRFs of a test and the damping of the structure as it is held likely."""

    data: FrfData
    damping: Damping

    def fitted(self, one: Fit, law: str = SAME) -> Fit | None:
        """The explanation `one` of modes as FRFs see it, its springs by `law`."""
        recipes = tuple(lossy(recipe, law, self.data.middle) for recipe in one.recipes)
        model = FrfModel(replace(one.model.base, data=self.data), self.damping, recipes)
        parts = zip(recipes, one.model.own, strict=True)
        c = [np.append(one.c[part], _LOSS if recipe.law != SAME else []) for recipe, part in parts]
        start = np.concatenate([one.point.x[: one.model.k], model.start[model.own :]])
        return fit(model, np.concatenate([np.zeros(0), *c]), start)

    def laws(self, one: Fit) -> list[Fit]:
        """The same under each law of damping that its springs may follow, which share its prior."""
        may = any(recipe.candidate.group in GROUPS for recipe in one.recipes)
        found = [self.fitted(one, law) for law in (LAWS if may else (SAME,))]
        share = np.log(len(found))
        return [replace(each, log_evidence=each.log_evidence - share) for each in found if each is not None]

    def damped(self, one: Fit, base: Reduced) -> list[Fit]:
        """A dashpot beside the causes of `one`, a fit of FRFs, from its most promising places; base: its model with its modes."""
        model, tried = one.model, []
        for recipe in dashpots(base):
            trial = FrfModel(model.base, self.damping, (*model.recipes, recipe))
            for values in recipe.grid:
                at = trial.point(np.concatenate([one.point.x, recipe.coordinates(values)]))
                if at is not None:
                    tried.append((at.chi2, trial, at.x))
        tried.sort(key=lambda item: item[0])
        found = [fit(trial, x[trial.k :], x[: trial.k]) for _, trial, x in tried[:_PLACES]]
        return sorted((each for each in found if each is not None), key=lambda each: -each.log_evidence)[:1]


def heard(modal: Ranking) -> Ranking:
    """The ranking `modal` of what modes say, judged anew by the FRFs of the test; `modal` itself where there are none."""
    tests = modal.baseline.model.base.problem.frf
    if not tests:
        return modal
    judge = Judge(FrfData(tuple(lines(test) for test in tests)), damping(modal.baseline.model.base))
    first = judge.fitted(modal.fits[0], STRUCTURAL)
    if first is not None:
        judge = replace(judge, data=FrfData(tuple(_loosened(first, i) for i in range(len(tests)))))
    baseline = judge.fitted(modal.baseline)
    if baseline is None:
        return modal
    fits = [baseline, *(each for one in _promising(modal) for each in judge.laws(one))]
    found = ranking(baseline, fits + judge.damped(baseline, modal.baseline.model.base))
    data = modal.baseline.model.base.data
    views = {id(one): _beside_modes(one, data) for one in (baseline, *found.fits)}
    return replace(found, baseline=views[id(baseline)], fits=tuple(views[id(one)] for one in found.fits))


def _promising(modal: Ranking) -> list[Fit]:
    """Explanations that modes leave possible, the best of single causes whatever modes say of them."""
    best = modal.fits[0].log_evidence / modal.noise_scale
    near = [one for one in modal.fits if one.recipes and one.log_evidence / modal.noise_scale > best - _REACH]
    singles = [one for one in modal.fits if len(one.recipes) == 1 and not any(one is other for other in near)]
    return near + singles[:_SINGLES]


def _beside_modes(one: Fit, data) -> Fit:
    """The fit `one` of FRFs with the model of modes at its parameters; one itself where modes have none there."""
    own, k = one.model.own, one.model.k
    model = Model(replace(one.model.base, data=data), one.recipes)
    elastic = np.r_[0:own, k : k + one.model.t]
    at = model.point(one.point.x[elastic])
    if at is None:
        return one
    known = np.linalg.inv(one.covariance[np.ix_(elastic, elastic)])  # the damping of the structure integrated out
    return Heard(model, at, one.misfit, known, one.log_evidence, frf=one)


def _loosened(one: Fit, i: int) -> Lines:
    """Lines of test i with what theory leaves: an error of every natural frequency, and of shapes, as for modes."""
    up, down = (_at(one, i, 1 + sign * _STEP) for sign in (1, -1))
    moved, H = np.abs(up - down) / (2 * _STEP), np.abs(one.point.parts[i].H)
    return one.model.base.data.blocks[i].loosened(np.hypot(THEORY_LOG * moved, THEORY_SHAPE * H))


def _at(one: Fit, i: int, factor: float) -> np.ndarray:
    """H of test i at its frequencies times `factor`."""
    blocks = tuple(each.at(factor) if j == i else each for j, each in enumerate(one.model.base.data.blocks))
    model = FrfModel(replace(one.model.base, data=FrfData(blocks)), one.model.damping, one.model.recipes)
    return model.point(one.point.x).parts[i].H

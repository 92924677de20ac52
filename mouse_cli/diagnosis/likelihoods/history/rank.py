"""Explanations of modes and functions, judged anew by recordings: each at its sites, its linear model simulated."""

from dataclasses import dataclass, replace
from functools import partial
from itertools import product

import numpy as np

from mouse_cli.diagnosis.likelihoods.history.posterior import Posterior, expanded, modelled, posterior
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.search.fit import Fit, fit
from mouse_cli.diagnosis.search.rank import Ranking, ranking
from mouse_cli.model.groups import enumerated
from mouse_cli.updating.recordings.adequacy import close, unlikely, with_noise
from mouse_cli.updating.recordings.fit import Fit as Simulated
from mouse_cli.updating.recordings.noise import noise
from mouse_cli.updating.recordings.records import cannot_judge, records
from mouse_cli.updating.recordings.study import Study, alike, fitted, study

_REACH = 60.0  # nats by which all else may speak against an explanation that recordings judge still
_SINGLES = 3  # single mechanisms that are judged in any case
# Other sites of an explanation that are judged, and the share of it that they hold at least
_ELSEWHERE, _SHARE = 6, 0.01
_CLIMBED, _LEAST = 2, -300.0  # explanations that are moved to sites nearby; ln of the share that such a site may hold
_BEHIND = 2.0  # times the cost of a better one, from which on what modes say is not expanded anew
_AWAY = 1.0  # nats by which the expansion of what modes say may be wrong where recordings lead


@dataclass(frozen=True)
class Judged(Ranking):
    """A ranking by recordings too, or one that they could not judge; remarks: which of both, in sentences."""

    remarks: tuple[str, ...] = ()


@dataclass(frozen=True)
class Seen:
    """An explanation at one site, `one`, as recordings see it in a study of its own model; whole: at all sites; share: of its
    evidence that this one holds.
    """

    whole: Fit
    one: Fit
    share: float
    known: Posterior
    record: Simulated
    study: Study

    @property
    def log_evidence(self) -> float:
        """ln Z(records | all else)."""
        return self.record.log_evidence + self.known.gained

    @property
    def x(self) -> np.ndarray:
        """Where recordings leave x (k + t,)."""
        return self.known.x(self.record.x[: len(self.known.mean)])

    @property
    def view(self) -> Fit:
        """`one` with its parameters and sizes where recordings leave them, and as sure; itself where modes have no model there."""
        root, d = self.known.root, len(self.known.mean)
        at = self.one.model.point(self.x)
        hessian = np.linalg.inv(root @ self.record.covariance[:d, :d] @ root.T)
        return self.one if at is None else replace(self.one, point=at, hessian=hessian)


class ByRecordings:
    """What recordings make of rankings of one deck; a fit that was judged once is not simulated again.

    unexplained: what fits of the recordings share where these ask for more than any linear mechanism, what modes know their prior.
    """

    unexplained: Study | None = None

    def __init__(self) -> None:
        self._own: tuple[Fit, Study] | None = None
        self._seen: dict[
            tuple[int, int], tuple[Fit, Fit, Seen | None]
        ] = {}  # with the fits, so that no id is used again
        self._near: dict[int, tuple[Seen, list[Seen]]] = {}
        self._best = np.inf

    def __call__(self, found: Ranking) -> Ranking:
        """The ranking `found` judged anew by the recordings of the deck; `found` itself where there are none."""
        problem, none = found.baseline.model.base.problem, found.baseline
        self.unexplained = None
        if not problem.recordings:
            return found
        if refused := cannot_judge(problem):
            return _with(found, f"recordings did not judge: {refused[0].message}")
        own = self._study(none)
        others = [each for trial in _trials(found) if (each := self._at(own, *trial)) is not None]
        first = self._at(own, none, none, 1.0)
        if first is None:
            return _with(found, "recordings did not judge: the model as it is cannot be simulated under their forces")
        leading = sorted((each for each in others if not each.one.nameless), key=lambda each: -each.log_evidence)
        seen = [first, *others, *(more for each in leading[:_CLIMBED] for more in self._climbed(own, each, others))]
        ahead = max(seen, key=lambda each: each.log_evidence)
        best, there = ahead.record, ahead.study
        left = noise(there.spectrum, best.hypothesis, there.places, best.x) if unlikely(best) else None
        if left is None and not close(best):
            self.unexplained = own
            return _with(found, _MORE.format(best.misfit / best.dof))
        said = _JUDGED.format(len(own.records.fitted), enumerated([f"'{one.title}'" for one in own.records.fitted]))
        return _with(_anew(found, seen, with_noise(best, left)), said, *own.records.remarks, *own.model.remarks)

    def _study(self, none: Fit) -> Study:
        """That of the model as it is."""
        if self._own is None or self._own[0] is not none:
            problem = none.model.base.problem
            self._own = none, study(problem, records(problem), partial(modelled, posterior(none)))
            self._seen, self._near, self._best = {}, {}, np.inf
        return self._own[1]

    def _at(self, own: Study, whole: Fit, one: Fit, share: float) -> Seen | None:
        """What recordings make of a fit at one site; no fit far behind another is followed to its end."""
        key = id(whole), id(one)
        if key not in self._seen:
            found = seen(own, whole, one, share, self._best)
            self._seen[key] = whole, one, found
            self._best = min(self._best, np.inf if found is None else found.record.cost)
        return self._seen[key][2]

    def _climbed(self, own: Study, at: Seen, judged: list[Seen]) -> list[Seen]:
        """Sites from that of `at` on, each mechanism moved to the next one as long as recordings gain by it."""
        if id(at) in self._near:
            return self._near[id(at)][1]
        found, known = [], {_place(each.one): each for each in judged}
        for i, step in product(range(len(at.one.recipes)), (1, -1)):
            best = max([at, *found], key=lambda each: each.log_evidence)
            while (one := _moved(best.one, i, step)) is not None:
                there = known.get(_place(one))
                if there is None:
                    share = float(np.exp(max(one.log_evidence - at.whole.log_evidence, _LEAST)))
                    there = seen(own, at.whole, one, share, self._best)
                    found += [] if there is None else [there]
                if there is None or there.log_evidence <= best.log_evidence:
                    break
                known[_place(one)] = best = there
        self._near[id(at)] = at, found
        return found


def _place(one: Fit) -> tuple[tuple[str, int], ...]:
    """Keys of mechanisms, and numbers of their sites."""
    return tuple((recipe.candidate.key, recipe.number) for recipe in one.recipes)


def _moved(one: Fit, i: int, step: int) -> Fit | None:
    """The explanation of modes with mechanism i at the next of its sites in their order; None at their end."""
    recipe = one.recipes[i]
    sites, at = one.model.base.recipes(recipe.candidate), recipe.number + step
    if not 0 <= at < len(sites) or len(sites[at].unknowns) != len(recipe.unknowns) or not isinstance(one.model, Model):
        return None
    there = (*one.recipes[:i], replace(sites[at], number=at), *one.recipes[i + 1 :])
    return fit(Model(one.model.base, there), one.c, one.point.x[: one.model.k])


def _anew(found: Ranking, seen: list[Seen], scale: float) -> Ranking:
    """The ranking by the evidence of recordings too, each explanation where they leave it."""
    fits, views = _weighed(seen, scale)
    again = ranking(found.baseline, [found.baseline, *fits])
    shown = tuple(
        one
        if one is found.baseline
        else replace(views[id(one)], log_evidence=one.log_evidence, elsewhere=one.elsewhere)
        for one in again.fits
    )
    return replace(again, fits=shown)


_MORE = (
    "the recordings demand more than a linear mechanism: the best leaves {:.3g} times the variance of their noise, and they did "
    "not judge between linear mechanisms"
)
_JUDGED = "recordings judged too, beside all else that was measured, {} in all: {}"


def _with(found: Ranking, *said: str) -> Judged:
    return Judged(**{name: getattr(found, name) for name in Ranking.__dataclass_fields__}, remarks=said)


def _trials(found: Ranking) -> list[tuple[Fit, Fit, float]]:
    """Each promising explanation, at each of its sites, and the share of its evidence that the site holds."""
    return [(whole, *site) for whole in _promising(found) for site in _sites(whole)]


def _promising(found: Ranking) -> list[Fit]:
    """Explanations that all else leaves possible; the best of single mechanisms whatever it says of them."""
    best = found.fits[0].log_evidence / found.noise_scale
    others = [one for one in found.fits if one is not found.baseline and isinstance(one.model, Model)]
    near = [one for one in others if one.log_evidence / found.noise_scale > best - _REACH]
    singles = [one for one in others if len(one.recipes) == 1 and not any(one is other for other in near)]
    return near + singles[:_SINGLES]


def _sites(one: Fit) -> list[tuple[Fit, float]]:
    """An explanation at its leading sites, and the share of its evidence that each holds."""
    others = [(other, share) for other, share in one.elsewhere[:_ELSEWHERE] if share > _SHARE]
    return [(one, max(1 - sum(share for _, share in one.elsewhere), _SHARE)), *others]


def seen(own: Study, whole: Fit, one: Fit, share: float, beat: float = np.inf) -> Seen | None:
    """What recordings make of a fit `one` of modes; beat: the cost of a better one. None where no simulation stays finite."""
    known = posterior(one)
    its = alike(own, partial(modelled, known))
    record = fitted(its, None, beat)
    if record is None:
        return None
    found = Seen(whole, one, share, known, record, its)
    if getattr(one, "frf", None) is not None or record.cost > _BEHIND * beat:
        return found
    there = expanded(known, found.x)
    if there is None or abs(_cost(there, found.x) - _cost(known, found.x)) < 2 * _AWAY:
        return found
    its = alike(own, partial(modelled, there))
    record = fitted(its, None, beat)
    return found if record is None else Seen(whole, one, share, there, record, its)


def _cost(known: Posterior, x: np.ndarray) -> float:
    """-2 ln of what modes say of x, but for a constant of the fit."""
    return float((x - known.mean) @ known.H @ (x - known.mean)) - 2 * known.gained - np.linalg.slogdet(known.H)[1]


def _weighed(seen: list[Seen], scale: float) -> tuple[list[Fit], dict[int, Fit]]:
    """The explanations with the evidence of recordings, each led by its best site, and by id what recordings make of it.

    scale: times the stated variance that recordings are worth.
    """
    first, wholes = seen[0], {id(each.whole): each.whole for each in seen[1:]}
    fits, views = [], {}
    for key, whole in wholes.items():
        sites = [each for each in seen[1:] if id(each.whole) == key]
        shares = [np.log(each.share) + (each.log_evidence - first.log_evidence) / scale for each in sites]
        total, order = np.logaddexp.reduce(shares), np.argsort(shares)[::-1]
        elsewhere = tuple((sites[i].one, float(np.exp(shares[i] - total))) for i in order[1:])
        best = sites[order[0]]
        fits.append(replace(best.one, log_evidence=float(whole.log_evidence + total), elsewhere=elsewhere))
        views[id(fits[-1])] = best.view
    return fits, views

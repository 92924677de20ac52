"""Every law at every place, weighed: the model as it is, first looks in closed form, fits by simulation, and their evidence."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.time.deck_laws import acting
from mouse_cli.diagnosis.time.free_force import Spectrum
from mouse_cli.diagnosis.time.hypothesis import Hypothesis, Place
from mouse_cli.diagnosis.time.places import places
from mouse_cli.diagnosis.time.polish import Fit, Segments, followed, segments
from mouse_cli.diagnosis.time.records import Records, reduced, steps
from mouse_cli.diagnosis.time.regression import Regression, Start, starts
from mouse_cli.diagnosis.time.series import REACH, Series
from mouse_cli.diagnosis.time.uncertain import Uncertain, uncertain
from mouse_cli.model.problem import Problem
from mouse_cli.terms.laws import Law
from mouse_cli.terms.laws import registry as laws
from mouse_cli.updating.chi_square import upper_tail

GATE, MATERIAL, INADEQUATE = 1e-3, 1.1, 1.5  # probability of a misfit by chance; ratios to the variance expected
OFFSET = 0.3  # sd of the offset of a force channel, by its rms
_SAMPLES = 8192  # of a record that the closed form looks at
_PERIODS, _SHORTEST, _LONGEST = 10, 256, 1024  # of the first mode in a horizon; its samples
_SEGMENTS = 10
_POLISHED, _MORE, _AGAIN = 4, 12, 8  # starts that are fitted; where none of them is adequate; of the nearest law again

Notice = Callable[[str], None]


@dataclass
class Study:
    """Everything that fits of one deck share."""

    problem: Problem
    records: Records
    model: Uncertain
    base: Hypothesis
    look: Series
    data: list[Segments]
    band: tuple[float, float]
    length: int

    def __post_init__(self) -> None:
        self.spectrum = Spectrum(self.look, self.model.linear)
        self.places = places(self.problem, self.spectrum, self.model.basis, self.band)
        self._at: dict[int, Regression] = {}

    def at(self, place: Place, series: Series | None = None) -> Regression:
        """The regression at a place of the record that is looked at, or of another."""
        if series is not None:
            return Regression(Spectrum(series, self.model.linear), self.base.placed(place))
        if id(place) not in self._at:
            self._at[id(place)] = Regression(self.spectrum, self.base.placed(place))
        return self._at[id(place)]


def study(problem: Problem, found: Records) -> Study:
    """What the fits of a deck begin from."""
    half = 0.5 / found.fitted[0].dt
    model = uncertain(problem, half)
    hz = _resonances(model)
    low, high = _band(found.fitted[0], hz)
    make = lambda one: steps(reduced(one, model.basis), min(hz.max(), high))
    fitted = [make(one) for one in found.fitted]
    first = hz[hz > 1e-3 * hz.max()].min()
    length = int(np.clip(_PERIODS / first / fitted[0].dt, _SHORTEST, _LONGEST))
    length = max(64, min(length, min(len(one) for one in fitted) // 3))
    share = max(2, _SEGMENTS // len(fitted))
    data = [segments(one, length, share) for one in fitted]
    rms = np.sqrt(np.mean([(one.force**2).mean(axis=0) for one in fitted], axis=0))
    base = Hypothesis(model.linear, OFFSET * rms, acting(problem, model.basis))
    loudest = max(fitted, key=lambda one: float((one.measured / one.sd).std()))
    look = loudest.part(0, min(len(loudest), _SAMPLES))
    return Study(problem, found, model, base, look, data, (low, high), length)


def _resonances(model: Uncertain) -> np.ndarray:
    from scipy.linalg import eigh

    values = eigh(model.linear.K, model.linear.M, eigvals_only=True)
    return np.sqrt(np.maximum(values, 0.0)) / (2 * np.pi)


def _band(series: Series, hz: np.ndarray) -> tuple[float, float]:
    """Where the response is, in Hz: all but a thousandth of its power, and the first mode."""
    power = (np.abs(np.fft.rfft((series.measured - series.measured.mean(axis=0)) / series.sd, axis=0)) ** 2).sum(axis=1)
    share = np.cumsum(power) / power.sum()
    lines = np.fft.rfftfreq(len(series), series.dt)
    low, high = lines[np.searchsorted(share, 0.001)], lines[np.searchsorted(share, 0.999)]
    return min(float(low), 0.5 * float(hz[hz > 1e-3 * hz.max()].min())), float(high)


def fitted(study: Study, start: Start | None, beat: float = np.inf) -> Fit | None:
    """A start followed to its optimum, or until it stays far behind `beat`; the model as it is without one."""
    hypothesis = study.base if start is None else start.hypothesis
    place = hypothesis.place or study.places[0]
    x = np.zeros(len(study.base.mean)) if start is None else start.x
    look = {id(data): study.at(place, _own(study, data)) for data in study.data}
    spread = look[id(study.data[0])].spread
    states, internal = begin(hypothesis, x, study.data, [look[id(data)] for data in study.data])
    return followed(hypothesis, study.data, spread, x, states, internal, beat)


def begin(hypothesis: Hypothesis, x: np.ndarray, data: list[Segments], looks: list[Regression]):
    """States (2n, G), and internal states of each law, in which the segments begin, by the motion that records show."""
    at = [part.starts - REACH for part in data]
    pairs = list(zip(looks, at, strict=True))
    states = np.concatenate([look.states(own) for look, own in pairs], axis=1)
    internal = []
    for one in hypothesis.acting(x):
        parts = [look.internal(one, own) for look, own in pairs]
        internal.append(None if parts[0] is None else np.concatenate(parts, axis=2))
    return states, internal or None


def _own(study: Study, data: Segments) -> Series | None:
    """The series of `data` where it is not the one that is looked at from its beginning."""
    last = int(data.starts.max()) + data.length
    same = (
        data.series.title == study.look.title
        and data.series.first == study.look.first
        and last <= len(study.look) - REACH
    )
    return None if same else data.series


def weighed(study: Study, notice: Notice, known: list[Law] | None = None) -> tuple[Fit, list[Fit]]:
    """The model as it is, and every explanation that was followed to its optimum."""
    notice("the linear model as it is")
    baseline = fitted(study, None)
    if baseline is None or not missing(baseline):
        return baseline, []
    notice(f"{len(study.places)} places, first look")
    order = starts(study.spectrum, study.base, study.places, known)
    found, best = [], baseline
    for count, start in enumerate(_varied(order), 1):
        if count > _POLISHED and (adequate(best) or count > _MORE):
            break
        law = start.hypothesis.law
        notice(f"{law.title}, {start.hypothesis.place.site.text}")
        one = fitted(study, start, best.cost if found else np.inf)
        if one is not None:
            found.append(one)
            best = min(best, one, key=lambda each: each.misfit)
    if not adequate(best):
        found += _again(study, best)
    return baseline, found + _relatives(study, best, known)


def _again(study: Study, best: Fit) -> list[Fit]:
    """The law that comes nearest, begun from other sizes until one is adequate."""
    if best.hypothesis.law is None:
        return []
    found = []
    for start in study.at(best.hypothesis.place).apart(best.hypothesis.law, best.hypothesis.variant, _AGAIN)[1:]:
        one = fitted(study, start)
        found += [] if one is None else [one]
        if one is not None and adequate(one):
            break
    return found


def _varied(order: list[Start]) -> list[Start]:
    """The first of each law at each place; after the leaders the first of each group that is not among them."""
    seen, found = set(), []
    for one in order:
        key = one.hypothesis.law.key, id(one.hypothesis.place)
        if key not in seen:
            seen.add(key)
            found.append(one)
    known = {one.hypothesis.law.group for one in found[:_POLISHED]}
    groups, others = [], []
    for one in found[_POLISHED:]:
        (others if one.hypothesis.law.group in known else groups).append(one)
        known.add(one.hypothesis.law.group)
    return found[:_POLISHED] + groups + others


def _relatives(study: Study, best: Fit, known: list[Law] | None) -> list[Fit]:
    """Laws that have no first look of their own, begun from the one they generalise: Iwan's from friction."""
    law = best.hypothesis.law
    relative = laws()["iwan"]
    if law is None or law.key != "friction" or adequate(best) or (known is not None and relative not in known):
        return []
    kt, slip = best.hypothesis.parameters(best.x[None])[:, 0]
    hypothesis = best.hypothesis.at(relative, 0)
    x = np.concatenate([best.x[: -len(best.hypothesis.unknowns)], np.log([1.3 * slip, 1.3 * kt, 0.6, 1.0])])
    one = fitted(study, Start(hypothesis, x, 0.0))
    return [] if one is None else [one]


def missing(baseline: Fit) -> bool:
    """Whether what the model leaves is neither chance nor a trifle."""
    return upper_tail(baseline.misfit, max(int(baseline.dof), 1)) < GATE and baseline.misfit > MATERIAL * baseline.dof


def adequate(one: Fit) -> bool:
    """Whether what a fit leaves may be noise."""
    return one.misfit <= INADEQUATE * one.dof or upper_tail(one.misfit, max(int(one.dof), 1)) >= GATE

"""What all fits of a deck by its recordings share, and one fit."""

from collections.abc import Callable
from copy import copy
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.model.local_law import LocalLaw
from mouse_cli.model.problem import Problem
from mouse_cli.terms.assembly import assembly
from mouse_cli.terms.laws import registry
from mouse_cli.updating.recordings.accuracy import accurate
from mouse_cli.updating.recordings.acting import Acting, Place
from mouse_cli.updating.recordings.calibration import calibration
from mouse_cli.updating.recordings.channels import SCALE, channel_sites
from mouse_cli.updating.recordings.disturbance import BLOCK
from mouse_cli.updating.recordings.excited import repeated
from mouse_cli.updating.recordings.fit import Fit
from mouse_cli.updating.recordings.free_force import Spectrum
from mouse_cli.updating.recordings.hypothesis import Hypothesis
from mouse_cli.updating.recordings.linear import Linear, rigid
from mouse_cli.updating.recordings.places import places
from mouse_cli.updating.recordings.polish import followed
from mouse_cli.updating.recordings.records import Records, reduced, steps
from mouse_cli.updating.recordings.regression import Regression, Start
from mouse_cli.updating.recordings.roving import with_all_forces
from mouse_cli.updating.recordings.segments import Segments, segments
from mouse_cli.updating.recordings.series import REACH, Series
from mouse_cli.updating.recordings.uncertain import Uncertain, uncertain


def acting(problem: Problem, basis: np.ndarray) -> tuple[Acting, ...]:
    """The laws of a deck, in the coordinates of a basis (n, m)."""
    return tuple(_acting(one, basis) for one in problem.laws)


def _acting(one: LocalLaw, basis: np.ndarray) -> Acting:
    law = registry()[one.law]
    p = np.array([one.values[size.name] for size in law.parameters])
    words = law.variants[law.words.index(one.variant)]
    if law.motions > 1:
        return Acting(basis[one.dofs[0]], law, words, p, basis[one.dofs[1]])
    B = basis[one.dofs[-1]] - (basis[one.dofs[0]] if len(one.dofs) > 1 else 0.0)
    return Acting(B, law, words, p)


Modelled = Callable[[Problem, float, np.ndarray], Uncertain]

OFFSET = 0.3  # sd of the offset of a force channel, by its rms
_SAMPLES = 8192  # of a record that the closed form looks at
_PERIODS, _SHORTEST, _LONGEST = 10, 256, 1024  # of the first mode in a horizon; its samples
_SEGMENTS = 10
_ABOVE = 5.0  # highest mode of a large model, by the highest frequency of the response: what acts between sensors bends it too
_SAME = 1.1  # times its cost, up to which a fit in shorter steps is the same optimum
_BEYOND = 0.75  # the same, by the sample rate at most


@dataclass
class Study:
    """Everything that fits of one deck share. spread (2m,): sd of initial states before the test; None: what the record shows."""

    problem: Problem
    records: Records
    model: Uncertain
    base: Hypothesis
    look: Series
    data: list[Segments]
    band: tuple[float, float]
    length: int
    spread: np.ndarray | None = None

    def __post_init__(self) -> None:
        self.spectrum = Spectrum(self.look, self.model.linear)
        first = self.records.fitted[0]
        sensed = np.hstack([first.inputs, first.sensing.T]).any(axis=1)
        self.places = places(self.problem, self.spectrum, self.model.basis, self.band, sensed)
        still = np.zeros(self.model.basis.shape[1]), False, SCALE, np.zeros(len(self.model.basis))
        sites = channel_sites(self.records.outputs, self.records.inputs)
        self.channels = [Place(site, *still, channel=i) for i, site in sites]
        self._at: dict[tuple, tuple[Fit | None, Regression]] = {}

    def tune(self, one: Fit) -> bool:
        """Lets the noise of the excitation be amplified as the structure of a fit amplifies it: a resonance that is off by its own
        width at the mean of the parameters would take it for something else. Whether there is such noise.
        """
        if not self.look.repeated.given.size:
            return False
        matrices = (each[0] for each in one.hypothesis.linear.matrices(one.x[None, : self.model.linear.k]))
        sd = self.look.sd
        noisy = repeated(self.look, *matrices).by(sd * np.sqrt(self.look.repeated.own), sd)
        heard = lambda series: replace(series, repeated=noisy)
        self.data = [replace(part, series=heard(part.series)) for part in self.data]
        self.look = heard(self.look)
        return True

    def at(self, place: Place, series: Series | None = None, first: Fit | None = None) -> Regression:
        """The regression at a place of the record that is looked at, or of another; beside the laws of `first`."""
        if series is not None:
            return self.looked(place, Spectrum(series, self.model.linear), first)
        key = id(place), id(first)
        if key not in self._at:
            self._at[key] = first, self.looked(place, self.spectrum, first)
        return self._at[key][1]

    def looks(self, place: Place, first: Fit | None = None) -> list[Regression]:
        """The same of the records of all stretches."""
        return [self.at(place, _own(self, part), first) for part in self.data]

    def looked(self, place: Place, spectrum: Spectrum, first: Fit | None = None, error: float = 0.0) -> Regression:
        """The same of a spectrum, not kept; error: of the closed form."""
        base, x = (self.base, None) if first is None else (first.hypothesis, first.x)
        return Regression(spectrum, base.placed(place), x, error)


def study(problem: Problem, found: Records, of: Modelled = uncertain) -> Study:
    """What the fits of a deck begin from; of: its model, see `uncertain`."""
    first = found.fitted[0]
    lowest, high = _occupied(first)
    model = of(problem, *_needed(problem, first, high))
    hz = resonances(model)
    flexible = hz[hz > 1e-3 * max(hz.max(), lowest)]
    slowest, highest = (flexible.min(), flexible.max()) if len(flexible) else (2 * lowest, high)
    low = min(lowest, 0.5 * float(slowest))
    length = int(np.clip(_PERIODS / slowest / first.dt, _SHORTEST, _LONGEST))
    length = max(64, min(length, min(len(one) for one in found.fitted) // 3))
    slow = length if float(hz.min()) * length * first.dt < 1 else 0
    found = _excited(accurate(found, length, slow), model)
    # what stops and starts, as nothing holds it, shakes modes far above the band of the force
    top = highest if slow else min(highest, high)
    fitted = [steps(reduced(one, model), top, float(hz.max())) for one in found.fitted]
    share = max(2, _SEGMENTS // len(fitted))
    data = [segments(one, length, share) for one in fitted]
    rms = np.sqrt(np.mean([(one.force**2).mean(axis=0) for one in fitted], axis=0))
    ground = bool(first.base.any()) and not first.inputs.any()
    known = calibration(found.outputs, found.inputs)
    base = Hypothesis(model.linear, OFFSET * rms, acting(problem, model.basis), ground=ground, channels=known)
    base = replace(base, inputs=tuple(one.name for one in found.inputs))
    loudest = max(fitted, key=lambda one: float((one.measured / one.sd).std()))
    look = loudest.part(0, min(len(loudest), _SAMPLES))
    return Study(with_all_forces(problem), found, model, base, look, data, (low, high), length)


def _excited(found: Records, model: Uncertain) -> Records:
    """The records with what simulations make of the noise of their excitation, at the mean of the parameters.

    What it adds to an acceleration at its own sample is in the sd of that channel too, by which first looks weigh it.
    """
    first, linear = reduced(found.fitted[0], model), model.linear
    if not first.force_noise.any():
        return found
    noisy = repeated(first, linear.M, linear.C, linear.K)
    ever = np.ones(len(first.force_noise), dtype=bool) if first.acts is None else first.acts.all(axis=0)
    sd = np.sqrt(first.sd**2 + ((first.order == 2)[:, None] * noisy.direct[:, ever] ** 2).sum(axis=1))
    noisy = noisy.by(first.sd, sd)
    own = lambda series: tuple(replace(one, sd=sd, repeated=noisy) for one in series)
    return replace(found, fitted=own(found.fitted), held=own(found.held))


def alike(own: Study, of: Modelled) -> Study:
    """The same stretches of the same records, judged by another model: as accurate, and begun within the same spread."""
    first = own.records.fitted[0]
    model = of(own.problem, *_needed(own.problem, first, _occupied(first)[1]))
    there = reduced(first, model)
    seen = lambda one: replace(one, inputs=there.inputs, sensing=there.sensing, base=there.base)
    data = [replace(part, series=seen(part.series)) for part in own.data]
    base = replace(own.base, linear=model.linear, known=acting(own.problem, model.basis))
    found = Study(own.problem, own.records, model, base, seen(own.look), data, own.band, own.length)
    begun, found.spread = (spread_over(one.looks(one.places[0])) for one in (own, found))
    if own.model.basis.shape[0] == own.model.basis.shape[1]:
        # further degrees of freedom are those of a mechanism, behind those of the deck
        for into, known in zip(np.split(found.spread, 2), np.split(begun, 2), strict=True):
            into[: len(known)] = known
    return found


def _needed(problem: Problem, first: Series, high: float) -> tuple[float, np.ndarray]:
    """Frequency (Hz) up to which a model is to be true for a record, and motions (n, q) of its sensors and forces."""
    loads = first.inputs
    if first.base.any():
        loads = first.loads(assembly(problem).matrices(problem.prior.mean)[1])
    return min(_ABOVE * high, _BEYOND / first.dt), np.unique(np.hstack([loads, first.sensing.T]), axis=1)


def resonances(model: Uncertain) -> np.ndarray:
    """Natural frequencies (n,) of the model as it is, in Hz, ascending."""
    from scipy.linalg import eigh

    values = eigh(model.linear.K, model.linear.M, eigvals_only=True)
    return np.sqrt(np.maximum(values, 0.0)) / (2 * np.pi)


def _occupied(series: Series) -> tuple[float, float]:
    """Where the response is, in Hz: all but a thousandth of its power."""
    own = series.disturbance.cleared_by(series.measured, series.dt, BLOCK)
    power = (np.abs(np.fft.rfft((own - own.mean(axis=0)) / series.sd, axis=0)) ** 2).sum(axis=1)
    share = np.cumsum(power) / power.sum()
    lines = np.fft.rfftfreq(len(series), series.dt)
    return float(lines[np.searchsorted(share, 0.001)]), float(lines[np.searchsorted(share, 0.999)])


def fitted(study: Study, start: Start | None, beat: float = np.inf, first: Fit | None = None) -> Fit | None:
    """A start followed to its optimum, or until it stays far behind `beat`; the model as it is without one.

    first: the fit of the laws that the start has beside its last one.
    """
    hypothesis = study.base if start is None else start.hypothesis
    place = hypothesis.place or study.places[0]
    x = np.zeros(len(study.base.mean)) if start is None else start.x
    looks = study.looks(place, first)
    spread = spread_over(looks) if study.spread is None else study.spread
    states, internal = begin(hypothesis, x, study.data, looks)
    return followed(hypothesis, study.data, spread, x, states, internal, beat)


def finer(study: Study, one: Fit) -> Fit:
    """The fit with its sizes as steps of half the length leave them, whose error is a quarter; all else is as it was compared."""
    halved = copy(study)
    halved.data = [part.halved for part in study.data]
    found = fitted(halved, Start(one.hypothesis, one.x, 0.0), one.cost)
    if found is None or found.cost > _SAME * one.cost:
        return one
    return replace(one, x=found.x, states=found.states, covariance=found.covariance)


def spread_over(looks: list[Regression]) -> np.ndarray:
    """sd (2m,) of initial states in stretches of all records: the rms of what each shows, as some are louder than others."""
    return np.sqrt(np.mean([look.spread**2 for look in looks], axis=0))


def begin(hypothesis: Hypothesis, x: np.ndarray, data: list[Segments], looks: list[Regression]):
    """States (2n, G), and internal states of each law, in which the segments begin, by the motion that records show."""
    at = [part.starts - REACH for part in data]
    pairs = list(zip(looks, at, strict=True))
    states = np.concatenate([look.states(own) for look, own in pairs], axis=1)
    place = _misplaced(hypothesis.linear, data, states)
    states[: len(place)] -= place
    internal = []
    for one in hypothesis.acting(x):
        parts = [look.internal(one, own) for look, own in pairs]
        internal.append(None if parts[0] is None else np.concatenate(parts, axis=2) - one.B @ place)
    return states, internal or None


def _misplaced(linear: Linear, data: list[Segments], states: np.ndarray) -> np.ndarray:
    """Displacements (n, G) in states (2n, G) along what nothing holds, by which they are not where channels of place show it.

    Spectra are about the mean of a record. Where no such channel is, all of it: twice summed noise, that no fit has a reason to
    keep and its prior would count. Sliders of laws move along.
    """
    x, series = states[: len(linear.M)], data[0].series
    if not series.slow:
        return np.zeros_like(x)
    R, placed = rigid(linear.K, linear.M, series.slow * series.dt), series.order == 0
    if not placed.any():
        return R @ (R.T @ linear.M @ x)
    sensing = series.sensing[placed]
    shown = np.hstack([part.series.measured[part.starts - REACH].T for part in data])[placed]
    return R @ np.linalg.lstsq(sensing @ R, sensing @ x - shown, rcond=None)[0]


def _own(study: Study, data: Segments) -> Series | None:
    """The series of `data` where it is not the one that is looked at from its beginning."""
    last = int(data.starts.max()) + data.length
    same = (
        data.series.title == study.look.title
        and data.series.first == study.look.first
        and last <= len(study.look) - REACH
    )
    return None if same else data.series

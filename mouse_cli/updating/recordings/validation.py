"""Is it true? Simulations of records that no fit has seen, with and without the cause.

Where trajectories diverge (impacts) a long simulation judges nothing: over short horizons only the initial states are fitted,
for both models alike. The long one is told beside it.
"""

from dataclasses import replace

import numpy as np

from mouse_cli.dynamics.response import simulate
from mouse_cli.model.record_diagnosis import (
    AS_IT_IS,
    WITH_CAUSE,
    RecordScore,
    Surface,
    Trace,
)
from mouse_cli.updating.recordings.channels import earlier
from mouse_cli.updating.recordings.fit import Fit
from mouse_cli.updating.recordings.free_force import Spectrum
from mouse_cli.updating.recordings.law_forces import stepped
from mouse_cli.updating.recordings.polish import followed
from mouse_cli.updating.recordings.records import reduced
from mouse_cli.updating.recordings.regression import Regression
from mouse_cli.updating.recordings.segments import segments
from mouse_cli.updating.recordings.series import REACH, Series, passed
from mouse_cli.updating.recordings.study import Study, begin

_SEGMENTS = 12
_JUDGES = 0.1  # share of the squared error above the noise of the channels, from which on a held-out record judges
_LONG = 45_000  # samples of a record that is simulated as a whole, at most


def scores(study: Study, baseline: Fit, best: Fit | None) -> tuple[RecordScore, ...]:
    """Each held-out record under both models."""
    models = {AS_IT_IS: baseline} | ({WITH_CAUSE: best} if best else {})
    return tuple(_score(study, held, models) for held in _held(study) if len(held) >= study.length + 4 * REACH)


def _held(study: Study) -> list[Series]:
    seen = study.data[0].series
    found = [reduced(one, study.model) for one in study.records.held]
    return [replace(one, factor=seen.factor, coarsest=seen.coarsest) for one in found]


def _score(study: Study, held: Series, models: dict[str, Fit]) -> RecordScore:
    short, free = {}, {}
    for name, one in models.items():
        found = _short(study, held, one)
        short[name] = np.full(len(held.sd), np.inf)
        if found is not None:
            short[name] = held.sd * np.sqrt((found.residual**2).mean(axis=(1, 2)))
        error = held.measured - free_run(study, held, one, found)
        free[name] = _rms(held.disturbance.cleared_by(error[: min(len(held), _LONG)], held.dt, study.length))
    noise = None if held.floor is None else held.floor * np.sqrt(passed())
    return RecordScore(held.title, study.length * held.dt, _rms(held.measured), short, free, noise)


def _rms(x: np.ndarray) -> np.ndarray:
    with np.errstate(over="ignore", invalid="ignore"):
        found = np.sqrt((x**2).mean(axis=0))
    return np.where(np.isfinite(found), found, np.inf)


def _look(study: Study, spectrum: Spectrum, one: Fit) -> Regression:
    """The regression at the place of the last law, beside the others."""
    hypothesis, x = one.hypothesis, one.x
    if not hypothesis.parts:
        return study.looked(study.places[0], spectrum)
    return Regression(spectrum, hypothesis.without_last, x[: len(x) - len(hypothesis.parts[-1].unknowns)])


def _short(study: Study, held: Series, one: Fit) -> Fit | None:
    """Short horizons of a record, in which only the initial states are fitted."""
    data = segments(held, study.length, _SEGMENTS)
    fixed, look = one.hypothesis.held(one.x), _look(study, Spectrum(held, study.model.linear), one)
    return followed(fixed, [data], look.spread, np.zeros(0), *begin(fixed, one.x, [data], [look]))


def free_run(study: Study, held: Series, one: Fit, found: Fit | None) -> np.ndarray:
    """Outputs (t, s) simulated over a whole record, from the initial state of its first horizon; nan beyond what is simulated."""
    part = held.part(0, min(len(held), _LONG))
    h, x = one.hypothesis, one.x[None]
    n2 = 2 * (len(one.hypothesis.linear.M) + h.extra)
    start = np.zeros((n2, 1)) if found is None or held.at_rest else found.states[:, :1]
    force = np.concatenate([part.fine[:, :, None], np.ones((len(part.fine), 1, 1))], axis=1)
    z = [np.zeros((one.law.states, 1, 1, 1)) for one in h.acting(one.x)]
    with np.errstate(all="ignore"):
        out = simulate(h.plant(x, held), held.dt / held.factor, force, start[None], h.local(x), z)
    answer, read = np.full(held.measured.shape, np.nan), h.read(x, held)
    answer[: len(part)] = earlier(read.gain[0] * out[0, :, :: held.factor, 0].T, held.dt, -read.delay[0])
    return answer


def ratio(found: tuple[RecordScore, ...]) -> float:
    """Error over short horizons with the cause over that without, all held-out records together, the noise of the channels taken
    out of both; nan without any, or where the model as it is leaves nothing but that noise and the cause no more.
    """
    if not found or WITH_CAUSE not in found[0].short:
        return float("nan")
    noise = [0.0 if one.noise is None else one.noise**2 for one in found]
    mean = lambda values: float(np.mean([(v / one.signal**2).mean() for v, one in zip(values, found, strict=True)]))
    whole = [mean([one.short[name] ** 2 for one in found]) for name in (WITH_CAUSE, AS_IT_IS)]
    excess = [
        mean([np.maximum(one.short[name] ** 2 - n, 0.0) for one, n in zip(found, noise, strict=True)])
        for name in (WITH_CAUSE, AS_IT_IS)
    ]
    if excess[1] > _JUDGES * whole[1]:
        return float(np.sqrt(excess[0] / excess[1]))
    return float(np.sqrt(whole[0] / whole[1])) if whole[0] > (1 + _JUDGES) * whole[1] else float("nan")


def trace(study: Study, baseline: Fit, best: Fit | None) -> Trace | None:
    """The loudest stretch of a held-out record, measured and simulated over one horizon."""
    held = [one for one in _held(study) if len(one) >= study.length + 4 * REACH]
    if not held:
        return None
    one = max(held, key=lambda each: float((each.measured / each.sd).std()))
    models = {AS_IT_IS: baseline} | ({WITH_CAUSE: best} if best else {})
    middle = int(np.argmax(np.abs(one.measured[:, 0])))
    first = int(np.clip(middle - study.length // 2 - REACH, 0, len(one) - study.length - 2 * REACH))
    part, simulated = one.part(first, first + study.length + 2 * REACH), {}
    for name, each in models.items():
        found = _short(study, part, each)
        if found is not None:
            simulated[name] = part.filtered[REACH:-REACH, 0] - part.sd[0] * found.residual[0, :, 0]
    channel = study.records.outputs[0]
    time = (first + REACH + np.arange(study.length)) * one.dt
    title, measured = f"{one.title}, {channel.sensor or channel.name}", part.filtered[REACH:-REACH, 0]
    return Trace(title, channel.unit, float(part.sd[0]), time, measured, simulated)


def surface(study: Study, best: Fit) -> Surface | None:
    """The force that the record asks for where the last law acts, line by line, and the law at the same motion; None for a linear
    law, or without any.
    """
    if not best.hypothesis.parts:
        return None
    part, p = best.hypothesis.sizes(best.x[None])[-1]
    law, words, p = part.law, part.words, p[:, 0]
    if law.linear:
        return None
    look = _look(study, study.spectrum, best)
    force = look.free(best.x)
    x, v, own = look.local.x, look.local.v, look.kept
    given = stepped(law, x, v, p[:, None], words)[:, 0] if law.states else law.force(x, v, None, p, **words)[0]
    return Surface(part.title, part.place.site.text, x[own], v[own], force[own], given[own])

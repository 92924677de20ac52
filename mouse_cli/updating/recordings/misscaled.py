"""Channels at another scale, late, or without what is slow: a factor, delay or corner with which the model explains it."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from mouse_cli._errors import DeckError
from mouse_cli.model.recording import Recording
from mouse_cli.updating.recordings.adequacy import INADEQUATE
from mouse_cli.updating.recordings.channels import earlier
from mouse_cli.updating.recordings.coupled import coupled
from mouse_cli.updating.recordings.noise import predicted
from mouse_cli.updating.recordings.readings import (
    Reading,
    changed,
    columns_of,
    diagnostic,
    named,
    record_of,
    reread,
    shares_left,
    strained,
)
from mouse_cli.updating.recordings.regression import Regression
from mouse_cli.updating.recordings.series import Series
from mouse_cli.updating.recordings.study import Study

_TURNS, _SLIGHT = 4, 0.02  # of a scale that is sought; a channel that is off by less is none that is wrong
_WIDE = 0.7  # of the logarithm of the scale of a table, or of a corner, either way
_LATE = 0.5, 16.0, 6  # samples, the least and the most, that a delay is first sought at, either way, and how many
_THOUGHT = 0.5  # of what is left, that a corner leaves in closed form to be thought of


def check_coupling(own: Study, look: Series, at: Regression, before: float) -> None:
    """Raise DeckError (MD457) where outputs that lose what is slow explain a record, and as they are read they do not.

    Of masses that nothing holds a dashpot to the ground does the same; free decays have no force that is not filtered.
    """
    forced = not (look.slow or look.free)
    slow = coupled(at) if forced and at.nothing > INADEQUATE * at.y.size else None
    if slow is None or slow.left > _THOUGHT * at.nothing:
        return
    record, _ = record_of(own, look)
    outputs = columns_of(own.problem, own.records.outputs)
    wrong = [outputs[j] for j in slow.outputs]
    others = [j for j in range(len(record.channels)) if j not in wrong]
    corner = slow.corner_hz * _least(own, look, record, lambda factor: _filtered(others, slow.corner_hz * factor))
    there = reread(own, _filtered(others, corner)(record), look)
    if not _explains(there):
        return
    names = named(record, wrong)
    said = f"if {names} lose{'s' * (len(wrong) == 1)} what is slower than {corner:.3g} Hz (AC coupling, a high-pass of first order)"
    remedy = f"pass the other channels through the same filter, or {names} through its inverse; or record with DC coupling"
    raise _error(own, record, before, there, Reading(said, remedy, _filtered(others, corner)))


def _filtered(columns: Sequence[int], corner_hz: float) -> Callable[[Recording], Recording]:
    """Channels through a high-pass of first order."""
    from scipy.signal import butter, lfilter

    def of(one: Recording) -> Recording:
        samples = one.samples.copy()
        samples[:, columns] = lfilter(*butter(1, corner_hz, "high", fs=1 / one.time_step_s), samples[:, columns], axis=0)
        return replace(one, samples=samples)

    return of


def check_grounded(own: Study, look: Series, at: Regression, before: float) -> None:
    """Raise DeckError (MD457) where one output, or else the motion of the ground, at another scale or late leaves no more than
    noise of a record, and as it is more.
    """
    if at.nothing <= INADEQUATE * at.y.size:
        return
    record, _ = record_of(own, look)
    for reading in _misread(own, look, record, at):
        there = reread(own, reading.of(record), look)
        if _explains(there):
            raise _error(own, record, before, there, reading)


def _misread(own: Study, look: Series, record: Recording, at: Regression) -> Iterator[Reading]:
    """The loudest output, and the motion of the ground, at the scale and with the delay that leave least."""
    outputs = columns_of(own.problem, own.records.outputs)
    loudest = int(np.argmax((at.left[at.kept] ** 2).sum(axis=0)))
    grounds = [j for j in columns_of(own.problem, own.records.inputs) if record.channels[j].ground]
    grounds = grounds if len(grounds) == 1 else []
    factors = [(outputs[loudest], by_model(own, look, loudest, record, at))]
    factors += [(j, _least(own, look, record, partial(changed, [j]))) for j in grounds]
    for j, factor in factors:
        if factor is not None and abs(factor - 1) >= _SLIGHT:
            name, reads = named(record, [j]), f"{1 / factor:.4g} times what it measures"
            remedy = f"check the calibration of {name}, which reads {reads}"
            yield Reading(f"if {name} reads {reads}", remedy, changed([j], factor))
    for j in (outputs[loudest], *grounds):
        seconds = _delay(own, look, record, j)
        if seconds:
            name, is_ = named(record, [j]), f"{1e3 * abs(seconds):.3g} ms {'late' if seconds > 0 else 'early'}"
            yield Reading(f"if {name} is {is_}", f"shift {name} by so much in its file: it is {is_}", _prompt(j, seconds))


def _prompt(column: int, seconds: float) -> Callable[[Recording], Recording]:
    """A channel without its delay."""

    def of(one: Recording) -> Recording:
        delay = np.zeros(len(one.channels))
        delay[column] = seconds
        mean = one.samples.mean(axis=0)
        return replace(one, samples=mean + earlier(one.samples - mean, one.time_step_s, delay))

    return of


def _delay(own: Study, look: Series, record: Recording, column: int) -> float:
    """That of a channel, s, without which the model leaves least; 0 where it is none that is tried."""
    from scipy.optimize import minimize_scalar

    def left(seconds: float) -> float:
        at = reread(own, _prompt(column, seconds)(record), look)
        return np.inf if at is None else at.nothing

    once = np.geomspace(*_LATE) * record.time_step_s
    tried = np.concatenate([-once[::-1], [0.0], once])
    best = int(np.argmin([left(seconds) for seconds in tried]))
    if tried[best] == 0:
        return 0.0
    bounds = tried[max(best - 1, 0)], tried[min(best + 1, len(tried) - 1)]
    return float(minimize_scalar(left, bounds=bounds, method="bounded", options={"xatol": 1e-3 * record.time_step_s}).x)


def _explains(at: Regression | None) -> bool:
    """Whether the model leaves no more than noise of a record in some reading, with nuisances within their prior."""
    return at is not None and at.nothing <= INADEQUATE * at.y.size and not strained(at)


def _error(own: Study, record: Recording, before: float, there: Regression, reading: Reading) -> DeckError:
    """MD457 of a record of which the model leaves `before`, and in one reading what it leaves `there`."""
    outputs = columns_of(own.problem, own.records.outputs)
    left, _ = shares_left(there, record.samples[:, outputs])
    return DeckError(diagnostic(own.problem, record, before, [(left, reading)]))


def by_model(own: Study, look: Series, j: int, record: Recording, at: Regression) -> float | None:
    """The factor of output j with which the model, its nuisances free, says what it reads; None where it cannot judge."""
    column, factor = columns_of(own.problem, own.records.outputs)[j], 1.0
    for _ in range(_TURNS):
        factor /= 1 + _share(at, j)
        at = reread(own, changed([column], factor)(record), look)
        if at is None:
            return None
    return factor


def _least(own: Study, look: Series, record: Recording, reading: Callable[[float], Callable[[Recording], Recording]]) -> float:
    """The factor whose reading the model leaves least of."""
    from scipy.optimize import minimize_scalar

    def left(log: float) -> float:
        at = reread(own, reading(float(np.exp(log)))(record), look)
        return np.inf if at is None else float(np.log(at.nothing))

    return float(np.exp(minimize_scalar(left, bounds=(-_WIDE, _WIDE), method="bounded", options={"xatol": 1e-4}).x))


def _share(at: Regression, j: int) -> float:
    """By how much output j is larger than the model says, its nuisances free."""
    left, model = at.left[at.kept, j], predicted(at)[:, j]
    return float(model @ left) / max(float(model @ model), 1e-300)

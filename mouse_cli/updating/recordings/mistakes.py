"""Records that the model explains in another reading: other units, another kind of motion, exchanged channels, another time step.

What the linear model leaves of a record in closed form, its parameters and nuisances free within their prior, tells readings from
one another: no lack in a model is the same factor, or power of the frequency, in all modes alike.
"""

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations

import numpy as np

from mouse_cli._errors import DeckError
from mouse_cli.model.channel_units import COMMON, target, unit
from mouse_cli.model.problem import Problem
from mouse_cli.model.recording import MOTIONS, Recording
from mouse_cli.updating.recordings.misscaled import by_model, check_coupling, check_grounded
from mouse_cli.updating.recordings.readings import (
    Reading,
    changed,
    columns_of,
    diagnostic,
    looked,
    named,
    record_of,
    reread,
    share_left,
    shares_left,
    strained,
)
from mouse_cli.updating.recordings.series import Series
from mouse_cli.updating.recordings.study import Study

_ASTRAY = 0.2  # share of a channel that the model leaves, from which on another reading is thought of
_GAINED = 0.1  # of what is left of the record, or of the record, that a reading leaves at most
_WORST = 3  # channels, by what is left of them, that may be wrong by themselves
_RATES = (2.0, 10.0, 1e3, 2 * np.pi)  # that a sample rate may be wrong by
_PAIRED = 8  # channels that may be exchanged where the model leaves little
_LIKELY = 2  # units of a kind that one channel alone is taken to be in


def check(own: Study) -> None:
    """Raise DeckError (MD457) where the model leaves most of a record as it is read, and little of it in another reading.

    Of channels that are exchanged also where it leaves little with parameters far from their prior, which make up for them; of one
    that is scaled or late where the ground moves the model and the others are explained with it read otherwise: no law of a channel
    is sought there.

    Read otherwise are the loudest record, and that of which the model leaves most: it may be one of many that is wrong.
    """
    looks = [
        own.look,
        *(each.series.part(0, len(own.look)) for each in own.data if each.series.title != own.look.title),
    ]
    read = [looked(own, each) for each in looks]
    left = [shares_left(at, record_of(own, each)[1]) for at, each in zip(read, looks, strict=True)]
    worst = max(range(len(looks)), key=lambda i: left[i][1].max())
    for i in dict.fromkeys((0, worst)):
        if left[i][1].max() >= _ASTRAY or strained(read[i]):
            _check(own, looks[i], *left[i])
    check_coupling(own, looks[0], read[0], left[0][0])
    if own.base.ground:
        check_grounded(own, looks[0], read[0], left[0][0])


def _check(own: Study, look: Series, before: float, by_channel: np.ndarray) -> None:
    """Raise DeckError (MD457) where a record, of which the model leaves so much, is explained in another reading."""
    problem, (record, _) = own.problem, record_of(own, look)
    outputs = columns_of(problem, own.records.outputs)
    if by_channel.max() < _ASTRAY:
        readings = (_exchanged(record, i, j) for i, j in combinations(sorted(outputs)[:_PAIRED], 2))
    else:
        worst = [outputs[i] for i in np.argsort(-by_channel)[:_WORST]]
        readings = _readings(problem, record, outputs, columns_of(problem, own.records.inputs), worst)
    found = []
    for each in readings:
        after = share_left(own, each.of(record), outputs, look)
        if after < _GAINED * min(before, 1.0):
            found.append((after, each))
    if not found and by_channel.max() >= _ASTRAY:
        found = list(_of_kind_and_scale(own, look, record, int(np.argmax(by_channel)), before))
    if found:
        raise DeckError(diagnostic(problem, record, before, found))


def _of_kind_and_scale(own: Study, look: Series, record: Recording, j: int, before: float) -> Iterator[tuple[float, Reading]]:
    """Readings of output j as another kind of motion, at whatever scale, that leave little."""
    outputs = columns_of(own.problem, own.records.outputs)
    for each in _of_kind(own.problem, record, [outputs[j]], 1):
        other = each.of(record)
        at = reread(own, other, look)
        factor = None if at is None else by_model(own, look, j, other, at)
        if factor is None:
            continue
        scaled = changed([outputs[j]], factor)
        after = share_left(own, scaled(other), outputs, look)
        if after < _GAINED * min(before, 1.0):
            times = f"{1 / factor:.4g} times it"
            yield after, Reading(f"{each.said}, {times}", f"{each.remedy}, and scale it: it reads {times}", scaled)


def _readings(
    problem: Problem, record: Recording, outputs: list[int], inputs: list[int], worst: list[int]
) -> Iterator[Reading]:
    every, channels = (*outputs, *inputs), record.channels
    for quantity in dict.fromkeys(channels[j].quantity for j in every):
        same = [j for j in every if channels[j].quantity == quantity and not channels[j].ground]
        usual, factor = target(quantity, problem.units)
        for each in (one for one in COMMON.get(quantity, ()) if unit(one).factor != factor):
            yield _scaled(record, same, usual, each)
            yield _scaled(record, same, each, usual)
        yield from _of_kind(problem, record, same)
    for j in worst:
        yield from _of_kind(problem, record, [j], _LIKELY)
    for i, j in combinations(sorted(worst), 2):
        yield _exchanged(record, i, j)
    for force in (j for j in inputs if not channels[j].ground):
        yield from (_moved(record, force, j) for j in outputs if channels[j].weights != channels[force].weights)
    for factor in (*_RATES, *(1 / each for each in _RATES)):
        rate = record.sample_rate_hz * factor
        said, remedy = f"sampled at {rate:.6g} Hz", f"write sample_rate: {rate:.6g}, or mend the time column"
        yield Reading(said, remedy, lambda one, by=factor: replace(one, time_step_s=one.time_step_s / by))


def _scaled(record: Recording, columns: list[int], stated: str, true: str) -> Reading:
    names = named(record, columns)
    factor = unit(true).factor / unit(stated).factor
    return Reading(
        f"with {names} in {true}, not in {stated}", f"write unit: {true} for {names}", changed(columns, factor)
    )


def _of_kind(problem: Problem, record: Recording, columns: list[int], most: int | None = None) -> Iterator[Reading]:
    """Motions that are of another kind, their numbers in one of its units, the first `most`."""
    if not columns or (stated := record.channels[columns[0]].quantity) not in MOTIONS:
        return
    names = named(record, columns)
    for quantity in (one for one in MOTIONS if one != stated):
        for each in COMMON[quantity][:most]:
            factor = unit(each).factor / target(quantity, problem.units)[1]
            said = f"with {names} as {quantity} in {each}"
            yield Reading(
                said,
                f"write quantity: {quantity}, unit: {each} for {names}",
                changed(columns, factor, quantity=quantity),
            )


def _exchanged(record: Recording, i: int, j: int) -> Reading:
    order = np.arange(len(record.channels))
    order[[i, j]] = j, i
    names = f"{record.channels[i].name} and {record.channels[j].name}"
    of = lambda one: replace(one, samples=one.samples[:, order])
    return Reading(f"with channels {names} exchanged", f"exchange {names} in outputs, or on the structure", of)


def _moved(record: Recording, force: int, output: int) -> Reading:
    there, name = record.channels[output], record.channels[force].name
    remedy = f"write inputs: {{{there.sensor}: {name}}}, if the force acted there"
    return Reading(f"with force {name} at {there.sensor}", remedy, changed([force], 1.0, weights=there.weights))

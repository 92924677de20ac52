"""Records that the model explains in another reading: other units, another kind of motion, exchanged channels, another time step.

What the linear model leaves of a record in closed form, its parameters and nuisances free within their prior, tells readings from
one another: no lack in a model is the same factor, or power of the frequency, in all modes alike.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from mouse_cli._errors import ERROR, DeckError, Diagnostic
from mouse_cli.model.channel_units import COMMON, target, unit
from mouse_cli.model.problem import Problem
from mouse_cli.model.recording import MOTIONS, Channel, Recording
from mouse_cli.updating.recordings.adequacy import INADEQUATE
from mouse_cli.updating.recordings.free_force import Spectrum
from mouse_cli.updating.recordings.noise import predicted
from mouse_cli.updating.recordings.records import in_order, records, reduced
from mouse_cli.updating.recordings.regression import Regression
from mouse_cli.updating.recordings.series import Series
from mouse_cli.updating.recordings.study import Study

_ASTRAY = 0.2  # share of a channel that the model leaves, from which on another reading is thought of
_GAINED = 0.1  # of what is left of the record, or of the record, that a reading leaves at most
_EQUAL = 1.5  # times what the best reading leaves, up to which another one fits as well
_FAR = 5.0  # prior standard deviations that nuisances may move in the right reading
_WORST = 3  # channels, by what is left of them, that may be wrong by themselves
_RATES = (2.0, 10.0, 1e3, 2 * np.pi)  # that a sample rate may be wrong by
_PAIRED = 8  # channels that may be exchanged where the model leaves little
_TURNS, _SLIGHT = 4, 0.02  # of a scale that is sought; a channel that is off by less is none that is wrong
_LIKELY = 2  # units of a kind that one channel alone is taken to be in
_WIDE = 0.7  # of the logarithm of the scale of a table, either way


@dataclass(frozen=True)
class _Reading:
    """What is taken to be so, what to do, and the record in that reading."""

    said: str
    remedy: str
    of: Callable[[Recording], Recording]


def check(own: Study) -> None:
    """Raise DeckError (MD457) where the model leaves most of a record as it is read, and little of it in another reading.

    Of channels that are exchanged also where it leaves little with parameters far from their prior, which make up for them; of one
    that is scaled where the ground moves the model and the others are explained with it at another scale: no law of a channel is
    sought there.

    Read otherwise are the loudest record, and that of which the model leaves most: it may be one of many that is wrong.
    """
    looks = [
        own.look,
        *(each.series.part(0, len(own.look)) for each in own.data if each.series.title != own.look.title),
    ]
    read = [_looked(own, each) for each in looks]
    left = [_left(at, _record(own, each)[1]) for at, each in zip(read, looks, strict=True)]
    worst = max(range(len(looks)), key=lambda i: left[i][1].max())
    for i in dict.fromkeys((0, worst)):
        if left[i][1].max() >= _ASTRAY or _strained(read[i]):
            _check(own, looks[i], *left[i])
    if own.base.ground:
        _check_scales(own, looks[0], read[0], left[0][0])


def _check_scales(own: Study, look: Series, at: Regression, before: float) -> None:
    """Raise DeckError (MD457) where one output at another scale, or else the motion of the ground, leaves no more than noise of a
    record, and as it is more.
    """
    if at.nothing <= INADEQUATE * at.y.size:
        return
    record, _ = _record(own, look)
    outputs = _columns(own.problem, own.records.outputs)
    loudest = int(np.argmax((at.left[at.kept] ** 2).sum(axis=0)))
    scaled = [(outputs[loudest], _by_model(own, look, loudest, record, at))]
    grounds = [j for j in _columns(own.problem, own.records.inputs) if record.channels[j].ground]
    scaled += [(j, _by_search(own, look, j, record)) for j in grounds if len(grounds) == 1]
    for column, factor in scaled:
        there = None if factor is None else _reread(own, _changed([column], factor)(record), look)
        if there is None or there.nothing > INADEQUATE * there.y.size or _strained(there) or abs(factor - 1) < _SLIGHT:
            continue
        name, reads = _named(record, [column]), f"{1 / factor:.4g} times what it measures"
        remedy = f"check the calibration of {name}, which reads {reads}"
        found = _Reading(f"if {name} reads {reads}", remedy, _changed([column], factor))
        raise DeckError(_told(own.problem, record, before, [(_left(there, record.samples[:, outputs])[0], found)]))


def _by_model(own: Study, look: Series, j: int, record: Recording, at: Regression) -> float | None:
    """The factor of output j with which the model, its nuisances free, says what it reads; None where it cannot judge."""
    column, factor = _columns(own.problem, own.records.outputs)[j], 1.0
    for _ in range(_TURNS):
        factor /= 1 + _share(at, j)
        at = _reread(own, _changed([column], factor)(record), look)
        if at is None:
            return None
    return factor


def _by_search(own: Study, look: Series, column: int, record: Recording) -> float | None:
    """The factor of the motion of the ground that leaves least of a record."""
    from scipy.optimize import minimize_scalar

    def left(log: float) -> float:
        at = _reread(own, _changed([column], float(np.exp(log)))(record), look)
        return np.inf if at is None else float(np.log(at.nothing))

    return float(np.exp(minimize_scalar(left, bounds=(-_WIDE, _WIDE), method="bounded", options={"xatol": 1e-4}).x))


def _share(at: Regression, j: int) -> float:
    """By how much output j is larger than the model says, its nuisances free."""
    left, model = at.left[at.kept, j], predicted(at)[:, j]
    return float(model @ left) / max(float(model @ model), 1e-300)


def _record(own: Study, look: Series) -> tuple[Recording, np.ndarray]:
    """The recording that a series is of, its channels in the order of the first, and its outputs (t, s) as they were read."""
    title, first = look.title.removesuffix(", its end"), own.problem.recordings[0]
    record = in_order(next(one for one in own.problem.recordings if one.title == title), first)
    return record, record.samples[:, _columns(own.problem, own.records.outputs)]


def _check(own: Study, look: Series, before: float, by_channel: np.ndarray) -> None:
    """Raise DeckError (MD457) where a record, of which the model leaves so much, is explained in another reading."""
    problem, (record, _) = own.problem, _record(own, look)
    outputs = _columns(problem, own.records.outputs)
    if by_channel.max() < _ASTRAY:
        readings = (_exchanged(record, i, j) for i, j in combinations(sorted(outputs)[:_PAIRED], 2))
    else:
        worst = [outputs[i] for i in np.argsort(-by_channel)[:_WORST]]
        readings = _readings(problem, record, outputs, _columns(problem, own.records.inputs), worst)
    found = []
    for each in readings:
        after = _read(own, each.of(record), outputs, look)
        if after < _GAINED * min(before, 1.0):
            found.append((after, each))
    if not found and by_channel.max() >= _ASTRAY:
        found = list(_of_kind_and_scale(own, look, record, int(np.argmax(by_channel)), before))
    if found:
        raise DeckError(_told(problem, record, before, found))


def _of_kind_and_scale(own: Study, look: Series, record: Recording, j: int, before: float) -> Iterator[tuple[float, _Reading]]:
    """Readings of output j as another kind of motion, at whatever scale, that leave little."""
    outputs = _columns(own.problem, own.records.outputs)
    for each in _of_kind(own.problem, record, [outputs[j]], 1):
        other = each.of(record)
        at = _reread(own, other, look)
        factor = None if at is None else _by_model(own, look, j, other, at)
        if factor is None:
            continue
        scaled = _changed([outputs[j]], factor)
        after = _read(own, scaled(other), outputs, look)
        if after < _GAINED * min(before, 1.0):
            times = f"{1 / factor:.4g} times it"
            yield after, _Reading(f"{each.said}, {times}", f"{each.remedy}, and scale it: it reads {times}", scaled)


def _told(problem: Problem, record: Recording, before: float, found: list[tuple[float, _Reading]]) -> Diagnostic:
    """The first of the readings that fit alike, and the others beside it."""
    least = min(left for left, _ in found)
    alike = {each.said: each.remedy for left, each in found if left < _EQUAL * least}
    (said, remedy), *rest = alike.items()
    name = f"recording '{record.title}'"
    message = (
        f"the model leaves {100 * min(before, 1.0):.3g} % of {name}{f' ({record.path})' if record.path else ''} unexplained; "
        f"{said}, it would leave {100 * least:.2g} %"
    )
    note = "; ".join(f"{other}: {mend}" for other, mend in rest[:3])
    return Diagnostic("MD457", ERROR, message, problem.place(name), f"as well fits: {note}" if note else "", remedy)


def _columns(problem: Problem, channels: tuple[Channel, ...]) -> list[int]:
    """Of channels of the first recording: files of other runs may call theirs otherwise."""
    return [problem.recordings[0].channels.index(one) for one in channels]


def _read(own: Study, record: Recording, outputs: list[int], seen: Series) -> float:
    """Share of a record that is left; infinite where it cannot judge in that reading, or moves nuisances out of their prior."""
    at = _reread(own, record, seen)
    return np.inf if at is None or _strained(at) else _left(at, record.samples[:, outputs])[0]


def _reread(own: Study, record: Recording, seen: Series) -> Regression | None:
    """What the model makes of a record in that reading; None where it cannot judge."""
    try:
        (series,) = records(replace(own.problem, recordings=(record,), held_records=None)).fitted
    except DeckError:
        return None
    look = reduced(series, own.model).part(0, len(seen))
    return _looked(own, replace(look, slow=seen.slow, disturbance=seen.disturbance))


def _strained(at: Regression) -> bool:
    """Whether nuisances of the model leave their prior."""
    z = at.begin(np.zeros_like(at.y), np.zeros(0))[0][: at.base.linear.k]
    return bool(np.abs(z).max(initial=0.0) > _FAR)


def _looked(own: Study, look: Series) -> Regression:
    return Regression(Spectrum(look, own.model.linear), own.base.placed(own.places[0]))


def _left(at: Regression, samples: np.ndarray) -> tuple[float, np.ndarray]:
    """Share of outputs as they were read, samples (t, s), that the linear model leaves, and that of each (s,).

    Of motions relative to the ground a share would be small where outputs are read as nothing.
    """
    spectrum, own = at.spectrum, samples[: len(at.spectrum.series)]
    size = (spectrum.whitened((own - own.mean(axis=0)) * spectrum.window[:, None])[at.kept] ** 2).sum(axis=0)
    if not size.all():  # no line is left of the band, such as beside the mains at another sample rate
        return np.inf, np.full(len(size), np.inf)
    return at.nothing / float(size.sum()), (at.left[at.kept] ** 2).sum(axis=0) / size


def _readings(
    problem: Problem, record: Recording, outputs: list[int], inputs: list[int], worst: list[int]
) -> Iterator[_Reading]:
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
        yield _Reading(said, remedy, lambda one, by=factor: replace(one, time_step_s=one.time_step_s / by))


def _named(record: Recording, columns: Sequence[int]) -> str:
    return f"channel{'s' * (len(columns) > 1)} {', '.join(record.channels[j].name for j in columns)}"


def _changed(columns: Sequence[int], factor: float, **stated) -> Callable[[Recording], Recording]:
    """Channels times a factor, and whatever else is stated of them."""

    def of(one: Recording) -> Recording:
        size = np.ones(len(one.channels))
        size[list(columns)] = factor
        channels = tuple(replace(c, **stated) if j in columns else c for j, c in enumerate(one.channels))
        return replace(one, channels=channels, samples=one.samples * size)

    return of


def _scaled(record: Recording, columns: list[int], stated: str, true: str) -> _Reading:
    names = _named(record, columns)
    factor = unit(true).factor / unit(stated).factor
    return _Reading(
        f"with {names} in {true}, not in {stated}", f"write unit: {true} for {names}", _changed(columns, factor)
    )


def _of_kind(problem: Problem, record: Recording, columns: list[int], most: int | None = None) -> Iterator[_Reading]:
    """Motions that are of another kind, their numbers in one of its units, the first `most`."""
    if not columns or (stated := record.channels[columns[0]].quantity) not in MOTIONS:
        return
    names = _named(record, columns)
    for quantity in (one for one in MOTIONS if one != stated):
        for each in COMMON[quantity][:most]:
            factor = unit(each).factor / target(quantity, problem.units)[1]
            said = f"with {names} as {quantity} in {each}"
            yield _Reading(
                said,
                f"write quantity: {quantity}, unit: {each} for {names}",
                _changed(columns, factor, quantity=quantity),
            )


def _exchanged(record: Recording, i: int, j: int) -> _Reading:
    order = np.arange(len(record.channels))
    order[[i, j]] = j, i
    names = f"{record.channels[i].name} and {record.channels[j].name}"
    of = lambda one: replace(one, samples=one.samples[:, order])
    return _Reading(f"with channels {names} exchanged", f"exchange {names} in outputs, or on the structure", of)


def _moved(record: Recording, force: int, output: int) -> _Reading:
    there, name = record.channels[output], record.channels[force].name
    remedy = f"write inputs: {{{there.sensor}: {name}}}, if the force acted there"
    return _Reading(f"with force {name} at {there.sensor}", remedy, _changed([force], 1.0, weights=there.weights))

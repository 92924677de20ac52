"""The recordings of a deck as series: channels of the model, accuracies from the records, what is fitted and what held out."""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli._errors import ERROR, WARNING, DeckError, Diagnostic
from mouse_cli.model.problem import Problem
from mouse_cli.model.recording import FORCES, MOTIONS, ROTATIONS, Channel, Recording
from mouse_cli.updating.recordings import ground
from mouse_cli.updating.recordings.clipped import unclipped
from mouse_cli.updating.recordings.disturbance import BLOCK, Disturbance
from mouse_cli.updating.recordings.floors import floor
from mouse_cli.updating.recordings.quietened import acting, excitation_noise, quietened
from mouse_cli.updating.recordings.roving import measures, with_all_forces
from mouse_cli.updating.recordings.series import Series
from mouse_cli.updating.recordings.uncertain import Uncertain

FLOOR = 0.01  # of the rms of a channel: no transducer and no theory is more accurate
HELD = 0.3  # share at the end of each record that is held out where the deck holds nothing out
_RUNG, _SHORTEST = 0.999, 256  # share of the energy of a free decay that is used; its samples, at least
_ORDERS = MOTIONS | ROTATIONS  # how many times differentiated
_MOVING = (
    "the ground moves: motions are simulated relative to it, and absolute channels compared less its measured motion"
)
_RATE = 30.0  # steps in a period of the highest mode of interest, at least


@dataclass(frozen=True)
class Records:
    """Series that are fitted and series that are held out, of the same channels; basis (n, m) of the model; remarks."""

    fitted: tuple[Series, ...]
    held: tuple[Series, ...]
    outputs: tuple[Channel, ...]
    inputs: tuple[Channel, ...]
    remarks: tuple[str, ...]


def records(problem: Problem) -> Records:
    """All of a deck. Raises DeckError (MD640) where a record has no force or no motion that the model has."""
    problem = with_all_forces(problem)
    fitted = list(problem.recordings)
    held = list(problem.held_records.recordings) if problem.held_records else []
    said: list[str] = []
    first = fitted[0] if fitted else held[0]
    inputs, outputs = _channels(problem, first)
    ordered = lambda every: [own for one in every if (own := in_order(one, first)) is not None]
    alike = ordered(fitted)
    if lost := len(fitted) - len(alike):
        said.append(f"{lost} recordings have other channels or another rate than the first and were left out")
    alike, held, outputs, clipped = unclipped(alike, ordered(held), outputs)
    said += clipped
    alike, held = ([_rung(one, outputs) for one in every] for every in (alike, held))
    floors = {id(one): floor(one.samples[:, outputs]) for one in [*alike, *held]}
    sd = np.max([floors[id(one)] for one in alike], axis=0)
    clear = lambda one: _disturbance(one).cleared_by(one.samples[:, outputs], one.time_step_s, BLOCK)
    sd = np.max([sd, *(FLOOR * clear(one).std(axis=0) for one in alike)], axis=0)
    stated = lambda columns: np.array([first.channels[j].noise_sd for j in columns])
    sd = np.max([sd, *(stated(outputs) * clear(one).std(axis=0) for one in alike)], axis=0)
    quiet = np.max([excitation_noise(ground.accelerations(one, inputs), stated(inputs)) for one in alike], axis=0)
    make = lambda one: replace(
        _series(problem, quietened(one, inputs, quiet), inputs, outputs, sd),
        floor=floors[id(one)],
        force_noise=quiet,
        acts=acting(ground.accelerations(one, inputs)),
    )
    said += [_left_out(one, outputs) for one in alike[:1] if _disturbance(one)]
    if any(first.channels[j].ground for j in inputs):
        said.append(_MOVING)
    alike, held = _apart(alike, held, said)
    series, kept = [make(one) for one in alike], [make(one) for one in held]
    if not held:
        whole = series
        series = [one.part(0, int((1 - HELD) * len(one))) for one in whole]
        kept = [replace(one.part(int((1 - HELD) * len(one)), len(one)), title=f"{one.title}, its end") for one in whole]
        said.append(f"the deck holds no record out: the last {100 * HELD:g} % of each was held out from all fits")
    channels = lambda columns: tuple(first.channels[j] for j in columns)
    return Records(tuple(series), tuple(kept), channels(outputs), channels(inputs), tuple(said))


def _apart(fitted: list[Recording], held: list[Recording], said: list[str]) -> tuple[list[Recording], list[Recording]]:
    """What is fitted and what is held out: the last of several decays where nothing is, which is `said`."""
    if held or len(fitted) < 2 or not fitted[0].free:
        return fitted, held
    said.append(f"the deck holds no record out: '{fitted[-1].title}', a decay as a whole, was held out from all fits")
    return fitted[:-1], fitted[-1:]


def _rung(record: Recording, outputs: list[int]) -> Recording:
    """A free decay up to where all outputs, each over its rms, have lost their energy: what follows is noise alone."""
    if not record.free:
        return record
    y = record.samples[:, outputs]
    y = y - y[-max(len(y) // 10, 1) :].mean(axis=0)
    power = (y**2 / np.maximum((y**2).mean(axis=0), 1e-300)).sum(axis=1)
    last = int(np.searchsorted(np.cumsum(power), _RUNG * power.sum())) + 1
    return replace(record, samples=record.samples[: max(last, _SHORTEST)])


def named(found: Records) -> dict[str, object]:
    """What reports say of the records."""
    return {
        "channels": tuple(channel.sensor or channel.name for channel in found.outputs),
        "units": tuple(channel.unit for channel in found.outputs),
        "sd": found.fitted[0].sd,
        "inputs": tuple(channel.sensor or channel.name for channel in found.inputs),
        "fitted": tuple(one.title for one in found.fitted),
    }


def _channels(problem: Problem, record: Recording) -> tuple[list[int], list[int]]:
    """Columns of forces, or motions of the ground, and of motions on degrees of freedom of the model."""
    own = lambda j: bool(record.channels[j].weights)
    forced = lambda channel: channel.quantity in FORCES or channel.ground
    inputs = [int(j) for j in record.inputs if forced(record.channels[j]) and own(j)]
    outputs = [int(j) for j in record.outputs if record.channels[j].quantity in _ORDERS and own(j)]
    _prescribed(problem, record)
    for what, columns in (
        ("force, or motion of the ground,", inputs or record.free),
        ("motion (displacement, rotation, or their derivatives)", outputs),
    ):
        if not columns:
            message = f"recording '{record.title}' has no channel of {what} at a degree of freedom of the model"
            help = "name it under inputs or outputs with its quantity, or state free_decay: true where nothing acts"
            raise DeckError([Diagnostic("MD640", ERROR, message, problem.place("recordings"), help=help)])
    ground.check(problem, record, inputs, outputs, _ORDERS)
    return inputs, outputs


def _prescribed(problem: Problem, record: Recording) -> None:
    """Raise DeckError (MD640) for a motion that is prescribed at a degree of freedom of the model."""
    for j in record.inputs:
        channel = record.channels[j]
        if channel.quantity in _ORDERS and not channel.ground:
            message = f"input '{channel.name}' of recording '{record.title}' is a motion of {channel.sensor}, which is free to move"
            help = "call it ground (groundTX) where it is the motion of what holds the model, or name it under outputs"
            raise DeckError([Diagnostic("MD640", ERROR, message, problem.place("recordings"), help=help)])


def cannot_judge(problem: Problem) -> tuple[Diagnostic, ...]:
    """Why `diagnose` and `run` would refuse the recordings of a deck (MD640), as a warning: `identify` may need no force."""
    try:
        _channels(problem, problem.recordings[0])
    except DeckError as error:
        return tuple(replace(one, severity=WARNING) for one in error.diagnostics)
    return ()


def in_order(one: Recording, first: Recording) -> Recording | None:
    """A recording with its channels in the order of those of `first`, whatever files call them; None where they or rates differ."""
    if abs(one.time_step_s / first.time_step_s - 1) >= 1e-6 or one.free != first.free:
        return None
    own, order = list(map(measures, one.channels)), []
    for each in map(measures, first.channels):
        j = next((j for j, other in enumerate(own) if other == each and j not in order), None)
        if j is None:
            return None
        order.append(j)
    if len(order) < len(own):
        return None
    return replace(one, channels=tuple(one.channels[j] for j in order), samples=one.samples[:, order])


def _series(problem: Problem, record: Recording, inputs: list[int], outputs: list[int], sd: np.ndarray) -> Series:
    n = problem.structure.n
    rows = lambda columns: np.array([_weights(record.channels[j], n) for j in columns]).reshape(-1, n)
    order = np.array([_ORDERS[record.channels[j].quantity] for j in outputs])
    moving = np.array([record.channels[j].ground for j in inputs], dtype=bool)
    return Series(
        record.title,
        record.time_step_s,
        ground.accelerations(record, inputs),
        ground.relative(record, inputs, outputs, order),
        sd,
        np.where(moving, 0.0, rows(inputs).T),
        rows(outputs),
        order,
        np.where(moving, rows(inputs).T, 0.0),
        carried=ground.carried(record, inputs, outputs, order),
        first=record.start,
        free=record.free,
        disturbance=_disturbance(record),
    )


def _left_out(record: Recording, outputs: list[int]) -> str:
    """What hum and drift took off the outputs of a record."""
    own, y = _disturbance(record), record.samples[:, outputs]
    rms = (y - own.cleared_by(y, record.time_step_s, BLOCK)).std(axis=0)
    sizes = [
        f"{size:.2g} {record.channels[j].unit} in {record.channels[j].name}"
        for size, j in zip(rms, outputs, strict=True)
    ]
    what = [f"{own.mains:g} Hz and its multiples"] * bool(own.mains) + [f"motion slower than {own.drift:g} Hz"] * bool(
        own.drift
    )
    return f"left out of every fit: {' and '.join(what)}; of '{record.title}' rms {', '.join(sizes)}"


def _disturbance(record: Recording) -> Disturbance:
    return Disturbance(record.mains_hz, record.drift_hz)


def _weights(channel: Channel, n: int) -> np.ndarray:
    found = np.zeros(n)
    for dof, share in channel.weights.items():
        found[dof] = share
    return found


def steps(series: Series, highest_hz: float, top_hz: float) -> Series:
    """With so many steps in a sample that the highest mode of interest has _RATE in a period; 2 to 16, 4 at least
    where accelerations of what nothing holds show the moments at which it stops. top_hz: the highest mode of the model.
    """
    whole = lambda wanted: int(np.clip(np.ceil(wanted), 4 if series.adrift else 2, 16))
    return replace(series, factor=whole(_RATE * highest_hz * series.dt), coarsest=whole(top_hz * series.dt + 0.5))


def reduced(series: Series, model: Uncertain) -> Series:
    """The series in the coordinates of a model."""
    V = model.basis
    return replace(series, inputs=V.T @ series.inputs, sensing=series.sensing @ V, base=model.along @ series.base)

"""Rules for recordings and frequency response functions: their sensors read something of this model, their titles differ."""

from dataclasses import replace

import numpy as np

from mouse_cli.formats.draft import Draft
from mouse_cli.formats.record_drafts import FrfDraft, RecordingDraft
from mouse_cli.formats.rules.sensors import Reading, rows, weights
from mouse_cli.formats.sensor import SensorDraft
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.geometry import Geometry
from mouse_cli.model.held_reading import HeldReading
from mouse_cli.model.recording import INPUT, MOTIONS, RELATIVE, Channel, Recording


def records(draft: Draft, geometry: Geometry | None) -> tuple[tuple[FrfTest, ...], tuple[Recording, ...]]:
    """All of a deck that break no rule."""
    frf = [_frf(draft, each, geometry) for each in draft.frf]
    recordings = [_recording(draft, each, geometry) for each in draft.recordings]
    _titles(draft)
    return tuple(one for one in frf if one is not None), tuple(one for one in recordings if one is not None)


def _frf(draft: Draft, each: FrfDraft, geometry: Geometry | None) -> FrfTest | None:
    readings = [weights(draft, sensors, geometry, draft.order) for sensors in (each.outputs, each.inputs)]
    if None in readings or not _acting(draft, each.inputs, readings[1]):
        return None
    outputs, inputs = (_matrix(draft, found) for found in readings)
    names = [tuple(sensor.name for sensor in sensors) for sensors in (each.outputs, each.inputs)]
    return FrfTest(
        each.frequency_hz, each.H, each.kind, outputs, inputs, each.variance, *names, each.coherence, each.title, each.path,
        each.form, each.lines, each.decay_rate, each.gain_sd, each.window, 
        tuple(held for reading in readings[0] for held in reading.held),
    )  # fmt: skip


def _matrix(draft: Draft, found: list[Reading]) -> Matrix:
    """What sensors read: degrees of freedom (s,), or weights (s, n) where that is not enough."""
    if all(each.weights.tolist() == [1.0] for each in found):
        return np.array([each.dofs[0] for each in found], dtype=int)
    return rows(found, draft.order)


def _acting(draft: Draft, forces: tuple[SensorDraft, ...], found: list[Reading]) -> bool:
    """Whether each force acts on something that can move: a support takes what acts where it holds the model."""
    taken = [force for force, each in zip(forces, found, strict=True) if each.held]
    for force in taken:
        message = f"the force at {force.words} acts where a support holds the model, which takes it"
        draft.error(
            "MD328", message, force.where, help="correct its position or direction, or free the support by a spring"
        )
    return not taken


def _recording(draft: Draft, each: RecordingDraft, geometry: Geometry | None) -> Recording | None:
    found = weights(draft, each.sensors, geometry, draft.order)
    if found is None or not (_grounded(draft, each) and _estimable(draft, each)):
        return None
    inputs = each.recording.inputs.tolist()
    if not _acting(draft, *(tuple(part[j] for j in inputs) for part in (each.sensors, found))):
        return None
    channels = zip(each.recording.channels, found, strict=True)
    return replace(each.recording, channels=tuple(_reading(channel, *own) for channel, own in channels))


def _reading(channel: Channel, dofs: np.ndarray, shares: np.ndarray, held: tuple[HeldReading, ...]) -> Channel:
    """The channel with what it reads; one that reads only what supports hold reads 0 of the first degree of freedom."""
    own = dict(zip(dofs.tolist(), shares.tolist(), strict=True)) or {0: 0.0}
    return replace(channel, weights=own, held=held)


def _grounded(draft: Draft, each: RecordingDraft) -> bool:
    """Whether the ground is where it can be: an input that is a motion; and outputs relative to it stand beside one."""
    before, known = len(draft.diagnostics), any(channel.ground for channel in each.recording.channels)
    for channel, sensor in zip(each.recording.channels, each.sensors, strict=True):
        where = sensor.where or each.where
        if channel.ground and channel.role != INPUT:
            message = f"channel '{channel.name}' is the motion of the ground, and stands among the outputs"
            draft.error("MD644", message, where, help="name it under inputs: it is what excites the structure")
        elif channel.ground and channel.quantity not in MOTIONS:
            message = (
                f"channel '{channel.name}' of the ground is {channel.quantity}; the ground has a motion, not a force"
            )
            draft.error(
                "MD644", message, where, help="give quantity: acceleration, velocity or displacement, or its unit"
            )
        elif channel.frame == RELATIVE and (channel.role == INPUT or not known):
            what = "is an input" if channel.role == INPUT else "has no motion of the ground beside it"
            message = f"channel '{channel.name}' is to be relative to the ground, but {what}"
            draft.error("MD644", message, where, help="name the motion of the ground under inputs, or delete frame")
    return len(draft.diagnostics) == before


def _estimable(draft: Draft, each: RecordingDraft) -> bool:
    """Whether gains and delays that are to be estimated are of channels that show them."""
    before, moving = len(draft.diagnostics), any(channel.ground for channel in each.recording.channels)
    for channel, sensor in zip(each.recording.channels, each.sensors, strict=True):
        late = channel.role == INPUT and channel.delay_sd
        if late or (moving and (channel.gain_sd or channel.delay_sd)):
            what = (
                "an input has none: state that of each output"
                if late
                else "the ground moves, and is taken off the outputs"
            )
            message = f"delay_sd or gain_sd of channel '{channel.name}' cannot be estimated: {what}"
            draft.error(
                "MD646", message, sensor.where or each.where, help="delete it, or correct the channel beforehand"
            )
    return len(draft.diagnostics) == before


def _titles(draft: Draft) -> None:
    """Each title stands once; functions of one title are one measurement anyway."""
    seen: set[str] = set()
    for each in draft.recordings:
        title = each.recording.title
        if title in seen:
            draft.error(
                "MD226", f"two recordings are called '{title}'", each.where, help="give each a title of its own"
            )
        seen.add(title)

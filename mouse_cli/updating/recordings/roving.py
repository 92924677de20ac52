"""A hammer, or a shaker, that goes from place to place: where a recording has forces of its own, others do not act."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mouse_cli.model.problem import Problem
from mouse_cli.model.recording import FORCES, INPUT, Channel, Recording


def with_all_forces(problem: Problem) -> Problem:
    """The deck, its recordings that have a force of their own with a channel for each force of any other too, 0 throughout."""
    held, count = problem.held_records, len(problem.recordings)
    every = _padded([*problem.recordings, *(held.recordings if held else ())])
    if held is not None:
        held = replace(held, recordings=tuple(every[count:]))
    return replace(problem, recordings=tuple(every[:count]), held_records=held)


def _padded(every: Sequence[Recording]) -> list[Recording]:
    forces: dict[tuple, Channel] = {}
    for one in every:
        forces |= {measures(channel): channel for channel in _forces(one) if measures(channel) not in forces}
    return [_with(one, forces) for one in every]


def _with(one: Recording, forces: dict[tuple, Channel]) -> Recording:
    own = {measures(channel) for channel in _forces(one)}
    more = tuple(channel for key, channel in forces.items() if own and key not in own)
    still = np.zeros((len(one.samples), len(more)))
    return replace(one, channels=(*one.channels, *more), samples=np.hstack([one.samples, still])) if more else one


def _forces(one: Recording) -> list[Channel]:
    return [channel for channel in one.channels if channel.role == INPUT and channel.quantity in FORCES]


def measures(c: Channel) -> tuple:
    """What a channel measures and how well, whatever it is called."""
    return c.role, c.quantity, frozenset(c.weights.items()), c.ground, c.frame, c.gain_sd, c.delay_sd, c.noise_sd

"""Motion of the ground as excitation: its acceleration, and what channels read relative to it.

With u = v + J d, d the displacement of the ground (or of several directions of it) and J (n, b) what it carries along as a rigid
body, the springs and dashpots of the model feel v alone, and

    M v'' + C v' + K v = -M J d''

(R. W. Clough, J. Penzien, Dynamics of Structures, 1993, section 2-6). Loads follow the masses that a fit moves.
"""

import numpy as np

from mouse_cli._errors import ERROR, DeckError, Diagnostic
from mouse_cli.model.problem import Problem
from mouse_cli.model.recording import ABSOLUTE, MOTIONS, Recording

_ACCELERATION = MOTIONS["acceleration"]
_LINES, _ABOVE = 32, 10.0  # neighbouring lines averaged; times the floor of a spectrum that is more than noise
_ROOM = 0.5  # of a record, put before and after it so that its ends make no waves in its derivatives


def grounds(record: Recording, inputs: list[int]) -> list[int]:
    """Columns of the motions of the ground among those of the inputs."""
    return [j for j in inputs if record.channels[j].ground]


def accelerations(record: Recording, inputs: list[int]) -> np.ndarray:
    """Samples (t, i) of the inputs, motions of the ground as accelerations."""
    found = record.samples[:, inputs].copy()
    for k, j in enumerate(inputs):
        if record.channels[j].ground:
            found[:, k] = _moved(record, j, _ACCELERATION)
    return found


def relative(record: Recording, inputs: list[int], outputs: list[int], orders: np.ndarray) -> np.ndarray:
    """Samples (t, s) of the outputs, absolute ones less the motion of the ground; orders (s,): how many times differentiated."""
    found = record.samples[:, outputs].copy()
    for k, (j, order) in enumerate(zip(outputs, orders.tolist(), strict=True)):
        for b, share in _shares(record, inputs, j).items():
            found[:, k] -= share * _moved(record, b, order)
    return found


def carried(record: Recording, inputs: list[int], outputs: list[int], orders: np.ndarray) -> np.ndarray:
    """Shares (s, i) of an acceleration of the ground, as it is measured, that `relative` takes off accelerations."""
    found = np.zeros((len(outputs), len(inputs)))
    for k, (j, order) in enumerate(zip(outputs, orders.tolist(), strict=True)):
        for b, share in _shares(record, inputs, j).items():
            if order == MOTIONS[record.channels[b].quantity] == _ACCELERATION:
                found[k, inputs.index(b)] = share
    return found


def _moved(record: Recording, column: int, order: int) -> np.ndarray:
    """Samples (t,) of a motion of the ground, differentiated to `order`; a channel of a lower one in the band that it shows."""
    own = MOTIONS[record.channels[column].quantity]
    x, dt = record.samples[:, column], record.time_step_s
    return x if own == _ACCELERATION else derivative(x, dt, order - own, shown(x))


def _shares(record: Recording, inputs: list[int], output: int) -> dict[int, float]:
    """How much of each motion of the ground an output reads, by column; none where it is relative or feels nothing of it."""
    channel = record.channels[output]
    if channel.frame != ABSOLUTE:
        return {}
    moved = {b: record.channels[b].weights for b in grounds(record, inputs)}
    found = {b: sum(w * moves.get(dof, 0.0) for dof, w in channel.weights.items()) for b, moves in moved.items()}
    return {b: share for b, share in found.items() if share}


def check(problem: Problem, record: Recording, inputs: list[int], outputs: list[int], orders: dict[str, int]) -> None:
    """Raise DeckError (MD644) for absolute outputs that are less often differentiated than the motion of the ground."""
    for j in outputs:
        channel = record.channels[j]
        for b in _shares(record, inputs, j):
            if orders[channel.quantity] < MOTIONS[record.channels[b].quantity]:
                message = (
                    f"channel '{channel.name}' is an absolute {channel.quantity}, but of the ground recording '{record.title}' has "
                    f"the {record.channels[b].quantity}, whose integral has no known beginning"
                )
                help = "give frame: relative, if it was measured from the moving ground; else measure accelerations"
                raise DeckError([Diagnostic("MD644", ERROR, message, problem.place("recordings"), help=help)])


def shown(x: np.ndarray) -> float:
    """Highest line, as a share of the Nyquist frequency, up to which the spectrum of x (t,) stands above its floor.

    A displacement falls with the square of the frequency: its derivatives above are those of the noise of its channel.
    """
    window = np.hanning(len(x))
    power = np.abs(np.fft.rfft((x - np.linspace(x[0], x[-1], len(x))) * window)) ** 2
    groups = power[1 : 1 + (len(power) - 1) // _LINES * _LINES].reshape(-1, _LINES).mean(axis=1)
    if not len(groups):
        return 1.0
    above = np.flatnonzero(groups > _ABOVE * np.quantile(groups, 0.1))
    return float((above.max(initial=0) + 1) / len(groups))


def derivative(x: np.ndarray, dt: float, times: int, up_to: float = 1.0) -> np.ndarray:
    """x (t,), differentiated so many times, by its spectrum up to a share of its lines; mirrored at the points of its ends, so that
    it goes on smoothly.
    """
    t = len(x)
    room = int(_ROOM * t)
    line = np.linspace(x[0], x[-1], t)
    own = x - line
    whole = np.concatenate([-own[room:0:-1], own, -own[-2 : -room - 2 : -1]])
    w = 2 * np.pi * np.fft.rfftfreq(len(whole), dt)
    lines = np.where(w <= up_to * np.pi / dt, np.fft.rfft(whole), 0.0) * (1j * w) ** times
    found = np.fft.irfft(lines, len(whole))[room : room + t]
    return found + (line, (x[-1] - x[0]) / (dt * (t - 1)), 0.0)[times]

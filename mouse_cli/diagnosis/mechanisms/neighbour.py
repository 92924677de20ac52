"""A structure beside, tied to a place: the building next door, scaffolding, a pipe that hangs on elsewhere, a soft rig."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.extend.points import with_neighbour
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import BODY, highest, lowest, total_mass
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.points import directions, placed

_PLACES = 4  # about so many of those on a line to begin from: there are many sizes for each
_TIES, _LOOSE = (0.05, 50.0), 0.2  # stiffness of the tie over that of what it ties, by itself; from which on that hardly moves
_SOFTEST, _STIFFEST = 0.5, 1.1  # its frequency over the lowest and the highest measured: beyond, an oscillator or a ground spring
_SELDOM = 0.02  # prior probability of one that stands by itself, beside the oscillator and the ground spring at its ends
_BEGUN = 4, 1  # frequencies, besides those measured, and ties to begin from


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """One degree of freedom more, on m (2 pi f)^2 of its own and tied by k: K + k [B, -1]'[B, -1], M + m on it.

    What the place feels is a spring to the ground and an oscillator, k - k^2 / (k + m ((2 pi f)^2 - w^2)).
    """
    measured = model.data.test.frequency_hz[model.data.has_frequency]
    hz = measured if len(measured) else np.sqrt([lowest(model), highest(model)]) / (2 * np.pi)
    m = Unknown("mass", "kg", *(BODY * total_mass(model)))
    f = Unknown("frequency by itself", "Hz", _SOFTEST * hz.min(), _STIFFEST * hz.max())
    tie = Unknown("stiffness of the tie over its own", "1", *_TIES)
    starts = steps(m, 2), np.concatenate([steps(f, _BEGUN[0]), measured]), steps(tie, _BEGUN[1])

    def change(sizes: np.ndarray, B: np.ndarray) -> Change:
        arm, own = np.append(B[0], -1.0), np.zeros((B.shape[1] + 1,) * 2)
        stiffness, M = sizes[0] * (2 * np.pi * sizes[1]) ** 2, own.copy()
        own[-1, -1], M[-1, -1] = stiffness, sizes[0]
        return Change(sizes[2] * stiffness * np.outer(arm, arm) + own, M)

    def extend(problem, point, place, mass, hz, share):
        stiffness = mass * (2 * np.pi * hz) ** 2
        return with_neighbour(problem, point, place, mass, share * stiffness, stiffness)

    def limit(values: np.ndarray) -> str:
        """So stiff a one, by itself or beside its tie, that it stands still is a ground spring."""
        return "ground-spring" if values[1] > hz.max() or values[2] < _LOOSE else ""

    points = [replace(p, starts=p.starts[:: max(1, len(p.starts) // _PLACES)]) for p in directions(model)]
    made = [placed(candidate, point, (m, f, tie), starts, change, extend, own=1) for point in points]
    seldom = float(np.log(_SELDOM))
    return [replace(one, log_prior=one.log_prior + seldom, seldom=seldom, limit=limit) for one in made]


CANDIDATE = Candidate(
    "neighbour",
    "a structure beside that is tied to it",
    "oscillator",
    "a structure that stands by itself and is tied to a place: the building next door, scaffolding, a pipe that is held elsewhere, "
    "a soft rig; its mass on its own spring to the ground is one mode more than the model has",
    recipes,
)

"""A mass on a spring somewhere on the structure, with a resonance of its own: absorber, loose part, sloshing liquid."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.extend.points import with_oscillator
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import BODY, highest, lowest, total_mass
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.points import directions, placed

_PLACES = 6  # about so many of those on a line to begin from: there are many sizes for each


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """One degree of freedom more: K + k [B, -1]'[B, -1], M + m on it, k = m (2 pi f)^2."""
    total, hz = total_mass(model), np.sqrt([lowest(model), highest(model)]) / (2 * np.pi)
    m = Unknown("mass", "kg", *(BODY * total))
    f = Unknown("frequency", "Hz", 0.3 * hz[0], 1.5 * hz[1])
    measured = model.data.test.frequency_hz[model.data.has_frequency]
    found = np.concatenate([steps(f, 14), measured])  # one of those measured may be its own
    least, most = (measured.min(), measured.max()) if len(measured) else (0.0, np.inf)

    def change(sizes: np.ndarray, B: np.ndarray) -> Change:
        arm = np.append(B[0], -1.0)
        M = np.zeros((len(arm), len(arm)))
        M[-1, -1] = sizes[0]
        return Change(sizes[0] * (2 * np.pi * sizes[1]) ** 2 * np.outer(arm, arm), M)

    extend = lambda problem, point, place, mass, hz: with_oscillator(
        problem, point, place, mass, mass * (2 * np.pi * hz) ** 2
    )

    def limit(values: np.ndarray) -> str:
        """So stiff a mount that it follows the structure makes it a mass; so soft a one that it stands still, a ground spring."""
        if values[1] > most:
            return "mass"
        return "ground-spring" if values[1] < least else ""

    points = [replace(p, starts=p.starts[:: max(1, len(p.starts) // _PLACES)]) for p in directions(model)]
    made = [placed(candidate, point, (m, f), (steps(m, 2), found), change, extend, own=1) for point in points]
    return [replace(one, limit=limit) for one in made]


CANDIDATE = Candidate(
    "oscillator",
    "a hidden oscillator",
    "oscillator",
    "a mass on a spring with a resonance of its own (absorber, sloshing liquid, loose part): one mode more than the model has",
    recipes,
)

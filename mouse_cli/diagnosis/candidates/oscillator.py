"""A mass on a spring somewhere on the structure, with a resonance of its own: absorber, loose part, sloshing liquid."""

import numpy as np

from mouse_cli.diagnosis.candidates import Candidate
from mouse_cli.diagnosis.change import Change, Recipe, Unknown, product, steps
from mouse_cli.diagnosis.extend_points import with_oscillator
from mouse_cli.diagnosis.points import Points, directions
from mouse_cli.diagnosis.reduced import Reduced
from mouse_cli.diagnosis.scales import highest, lowest, total_mass


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """One degree of freedom more: K + k [B, -1]'[B, -1], M + m on it, k = m (2 pi f)^2."""
    total, hz = total_mass(model), np.sqrt([lowest(model), highest(model)]) / (2 * np.pi)
    m = Unknown("mass", "kg", 1e-3 * total, 0.4 * total)
    f = Unknown("frequency", "Hz", 0.3 * hz[0], 1.5 * hz[1])
    measured = model.data.test.frequency_hz[model.data.has_frequency]
    found = np.concatenate([steps(f, 14), measured])  # one of those measured may be its own
    return [_at(point, m, f, found, candidate) for point in directions(model)]


def _at(point: Points, m: Unknown, f: Unknown, hz: np.ndarray, candidate: Candidate) -> Recipe:
    def change(values: np.ndarray) -> Change:
        B = point.motion(values[2:])[0]
        arm = np.append(B, -1.0)
        M = np.zeros((len(arm), len(arm)))
        M[-1, -1] = values[0]
        return Change(values[0] * (2 * np.pi * values[1]) ** 2 * np.outer(arm, arm), M)

    return Recipe(
        candidate,
        (m, f, *point.unknown),
        change,
        product(steps(m, 2), hz, *point.starts.T[:, :: max(1, len(point.starts) // 6)]),
        lambda values: point.site(values[2:]),
        own=1,
        log_prior=float(np.log(point.share)),
        extend=lambda problem, values: with_oscillator(
            problem, point, values[2:], values[0], values[0] * (2 * np.pi * values[1]) ** 2
        ),
    )


CANDIDATE = Candidate(
    "oscillator",
    "a hidden oscillator",
    "oscillator",
    "a mass on a spring with a resonance of its own (absorber, sloshing liquid, loose part): one mode more than the model has",
    recipes,
)

"""Band-limited simulations of linear models by lines instead of steps.

A stretch of force is continued to a period. What a model does from its initial state is then its periodic answer and free motion
from where the two differ, both of the same discrete system that is stepped where local forces act.
"""

from dataclasses import replace

import numpy as np

from mouse_cli.dynamics.response import Plant, discrete
from mouse_cli.updating.recordings.series import REACH, limiter

_CONTINUED = 64  # samples in which a force goes back to where it began
_KEPT = 0.75  # lines, by the sample rate: what lies above the band is filtered
_LEAST = 1e-6  # of a motion that is lost within a period
_DEFECTIVE = 1e9  # condition of the modes


def answered(plant: Plant, h: float, force: np.ndarray, start: np.ndarray, factor: int) -> np.ndarray | None:
    """Sensors (P, s, samples, G) behind the band-limiting filter, `factor` steps of h s a sample, REACH samples at either end lost.

    force (t, i, G) at every step; start (P, 2n, G). None where motions do not die away, or modes are no basis: those are stepped.
    """
    by, n2, i = discrete(replace(plant, local=plant.local[:, :0]), h), plant.states, force.shape[1]
    poles, V = np.linalg.eig(by.next[:, :n2, :n2])
    samples = (len(force) - 1) // factor + 1
    period = (samples + _CONTINUED) * factor
    if np.abs(1 - poles**period).min() < _LEAST or np.abs(poles).max() > 1 or np.linalg.cond(V).max() > _DEFECTIVE:
        return None
    parts = np.linalg.solve(V, np.concatenate([by.next[:, :n2, n2:], start], axis=2))
    now, after, begun = np.split(parts[:, :, None], [i, 2 * i], axis=3)
    seen = by.outputs[:, :, :n2] @ V
    spectrum = np.fft.rfft(_periodic(force, period), axis=0)[: int(_KEPT * (samples + _CONTINUED))]
    z = np.exp(2j * np.pi * np.arange(len(spectrum)) / period)
    driven = ((now + z[:, None] * after) / (z - poles[:, :, None])[..., None]).reshape(*poles.shape, -1)
    twice = spectrum * np.where(np.arange(len(z)) > 0, 2.0, 1.0)[:, None, None]
    # lines of negative frequency belong to the conjugate modes, so that the real part is the state
    steady = (V @ (driven @ twice.reshape(driven.shape[2], -1))).real / period
    H = (seen @ driven).reshape(*seen.shape[:2], len(z), i) + by.outputs[:, :, None, n2:]
    Y = np.einsum("psli,lig->pslg", H, spectrum * _gain(z, factor)[:, None, None])
    free = _free(poles, seen, begun[:, :, 0] - np.linalg.solve(V, steady), samples, factor)
    return _at_samples(Y, samples, factor) + free


def _periodic(force: np.ndarray, period: int) -> np.ndarray:
    """The force (t, i, G) continued to a period, smoothly."""
    more = period - len(force)
    share = (0.5 + 0.5 * np.cos(np.pi * (np.arange(more) + 0.5) / more))[:, None, None]
    return np.concatenate([force, share * force[-1] + (1 - share) * force[0]])


def _gain(z: np.ndarray, factor: int) -> np.ndarray:
    """Of the band-limiting filter at lines, its middle at the sample."""
    taps = limiter(factor)
    angle = np.angle(z)
    middle = len(taps) // 2
    return taps[middle] + 2 * np.cos(np.outer(angle, np.arange(1, middle + 1))) @ taps[middle + 1 :]


def _at_samples(Y: np.ndarray, samples: int, factor: int) -> np.ndarray:
    """Lines (P, s, l, G) of a period at the samples (P, s, samples - 2 REACH, G): those above half the sample rate are folded."""
    count = samples + _CONTINUED
    half = count // 2 + 1
    low, above = Y[:, :, :half], Y[:, :, half:]
    low[:, :, count - np.arange(half, half + above.shape[2])] += above.conj()
    return np.fft.irfft(low, count, axis=2)[:, :, REACH : samples - REACH] / factor


def _free(poles: np.ndarray, seen: np.ndarray, away: np.ndarray, samples: int, factor: int) -> np.ndarray:
    """Free motion (P, s, samples - 2 REACH, G) of modes begun at `away` (P, m, G), band-limited; of conjugates one counts twice."""
    passed = np.polynomial.polynomial.polyval(poles, limiter(factor)) * np.where(poles.imag > 0, 2.0, poles.imag == 0)
    own = (passed != 0).any(axis=0)
    sizes = ((seen * passed[:, None]).transpose(0, 2, 1)[..., None] * away[:, :, None])[:, own]
    decays = poles[:, None, own] ** (factor * np.arange(samples - 2 * REACH))[:, None]
    sizes = sizes.reshape(*sizes.shape[:2], -1)
    found = decays.real @ sizes.real - decays.imag @ sizes.imag
    return found.reshape(*found.shape[:2], *seen.shape[1:2], -1).transpose(0, 2, 1, 3)

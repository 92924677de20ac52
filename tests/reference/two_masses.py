"""Two masses whose records scipy integrates: K of springs 2e4 and 3e4 N/m, masses of 1 kg, under a random force on the second."""

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

RATE, SECONDS, NOISE = 512.0, 8.0, 0.01
K = np.array([[5e4, -3e4], [-3e4, 3e4]])
DECK = """mouse: 1
title: two masses
model:
  stiffness: {{order: 2, entries: [[1, 1, 5.0e4], [1, 2, -3.0e4], [2, 2, 3.0e4]]}}
  mass: {{diagonal: [1, 1]}}
  damping: {{order: 2, entries: [[1, 1, 6.0], [1, 2, -3.6], [2, 2, 3.6]]}}
parameters:
  - {{name: k1, nominal: 2.0e4, sd: 5 %, stiffness: [[1, 1, 1]]}}
  - {{name: k2, nominal: 3.0e4, sd: 5 %, stiffness: [[1, 1, 1], [1, 2, -1], [2, 2, 1]]}}
test:
  recordings:
    - file: run.npz
      sample_rate: {rate}
      inputs: [{{sensor: 2, channel: f, quantity: force, unit: N}}]
      outputs: [{outputs}]
"""


def shaking(t: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """A random force (t,) of all lines between 2 and 60 Hz alike, of rms 1."""
    hz = np.fft.rfftfreq(len(t), t[1])
    f = np.fft.irfft(np.where((hz > 2) & (hz < 60), np.exp(2j * np.pi * rng.uniform(size=len(hz))), 0), len(t))
    return f / f.std()


def record(folder: Path, law, sensors=(1, 2), disturbance: float = 0.0, level: float = 40.0) -> str:
    """A deck whose record scipy integrated, the springs 2 % off those of the deck, damping 10 %.

    law(u, v): forces (2,) against the motion. disturbance: rms of a white force on the first mass that nobody measured, N; level:
    rms of the force, N.
    """
    f, a = _read(law, disturbance, level)
    np.savez(folder / "run.npz", f=f, **{f"a{i}": a[:, i - 1] for i in sensors})
    outputs = ", ".join(f"{{sensor: {i}, channel: a{i}, quantity: acceleration, unit: m/s2}}" for i in sensors)
    (folder / "deck.yaml").write_text(DECK.format(rate=RATE, outputs=outputs))
    return str(folder / "deck.yaml")


@cache
def _read(law, disturbance: float, level: float) -> tuple[np.ndarray, np.ndarray]:
    """The force (t,) and the accelerations (t, 2) with their noise."""
    rng, t = np.random.default_rng(7), np.arange(int(SECONDS * RATE)) / RATE
    f = level * shaking(t, rng) * np.minimum(t / 0.2, 1)
    lines = np.fft.rfft(f)
    fine = np.fft.irfft(np.pad(lines, (0, 15 * len(lines))), 16 * len(t)) * 16
    times = np.arange(len(fine)) / RATE / 16
    shaken = disturbance * np.random.default_rng(8).standard_normal(len(t))
    stiff, damp = K * 1.02, 1.2e-4 * K * 1.1
    unmeasured, measured = _between(t, shaken), _between(times, fine)
    force = lambda s: np.array([unmeasured(s), measured(s)])
    rhs = lambda s, y: np.concatenate([y[2:], force(s) - stiff @ y[:2] - damp @ y[2:] - law(y[:2], y[2:])])
    done = solve_ivp(rhs, (0, t[-1]), np.zeros(4), method="RK45", t_eval=t, rtol=1e-7, atol=1e-9, max_step=5e-4)
    a = np.array([rhs(s, y)[2:] for s, y in zip(t, done.y.T, strict=True)])
    a += NOISE * a.std(axis=0) * rng.standard_normal(a.shape)
    return f, a


def _between(times: np.ndarray, values: np.ndarray) -> Callable[[float], float]:
    """What np.interp gives between equal steps of time from 0 on, for one time at once."""
    rate, last, own = 1 / times[1], len(values) - 2, values.tolist()

    def at(time: float) -> float:
        i = min(int(time * rate), last)
        return own[i] + (time * rate - i) * (own[i + 1] - own[i])

    return at


def linear(u, v) -> np.ndarray:
    """No law."""
    return np.zeros(2)

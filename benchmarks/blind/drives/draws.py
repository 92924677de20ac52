"""Drives with or without friction, how they are driven and measured, and how their numbers are drawn."""

import zlib
from dataclasses import dataclass

import numpy as np

from benchmarks.blind.drives.exact import Drive, run

RATE = 4000.0  # knots per second
SECONDS = 16.0
ENCODER = 1e-6  # m
NOISE = 0.005  # of the rms of velocities and accelerations
QUANTITIES = {"position": ("x", 1000.0), "velocity": ("v", 100.0), "acceleration": ("a", 1000.0)}
MASS_SD, DASHPOT_SPREAD = 0.02, 0.2  # of the deck about the truth, largest


@dataclass(frozen=True)
class Case:
    """A drive, its deck's masses and dashpots, and its test. stated: whether the deck has its masses as parameters."""

    name: str
    drive: Drive
    nominal_m: np.ndarray
    nominal_c: np.ndarray
    quantity: str
    course: str
    size: float
    stated: bool

    @property
    def sound(self) -> bool:
        """Whether nothing is missing from the deck."""
        return not self.drive.friction


def generator(*words: object) -> np.random.Generator:
    """Random numbers that depend on all `words`, and on nothing else."""
    return np.random.default_rng([zlib.crc32(str(word).encode()) for word in words])


def cases(seed: int, faults: int, sound: int) -> list[Case]:
    """`faults` drives with friction and `sound` ones without."""
    kinds = [("friction", i) for i in range(faults)] + [("none", i) for i in range(sound)]
    return [_drawn(seed, kind, i) for kind, i in kinds]


def _drawn(seed: int, kind: str, i: int) -> Case:
    """Every third one has a shaft and a second mass, every tenth play in it; every other one is driven in closed loop."""
    rng, n = generator("drives", seed, kind, i), 2 if i % 3 == 2 else 1
    u = rng.uniform
    m = np.exp(u(np.log(2), np.log(120), 1)) * np.array([1.0, u(0.5, 2.0)])[:n]
    c, a = m * u(0.5, 4.0, n), u(1.0, 5.0)  # 1/s; rms of the acceleration that the force gives, m/s2
    rms = float(a * m.sum())
    k = float((2 * np.pi * u(8, 25)) ** 2 * m[-1])
    play = a / (2 * np.pi * 4) ** 2 * u(0.05, 0.2) if n == 2 and i % 10 == 5 and kind == "friction" else 0.0
    shaft = (k, 2 * u(0.01, 0.03) * float(np.sqrt(k * m[-1])), play) if n == 2 else (0.0, 0.0, 0.0)
    loop = 2 * np.pi * u(3, 6)
    gains = (float(m.sum() * loop**2), float(1.4 * m.sum() * loop)) if i % 2 else None
    friction = rms * u(0.1, 0.45) if kind == "friction" else 0.0
    at = int(rng.integers(n)) if kind == "friction" else 0
    drive = Drive(m, c, friction, at, rms * u(-0.1, 0.1), shaft, gains)
    stated, spread = bool(rng.integers(2)), lambda size: 1 + u(-size, size, n)
    nominal = m * spread(MASS_SD) if stated else m
    course = ("multisine", "trapezoid")[i // 2 % 2] if i % 2 else "multisine"
    quantity = list(QUANTITIES)[(i // 2) % 3]
    return Case(f"{seed}-{kind}-{i}", drive, nominal, c * spread(DASHPOT_SPREAD), quantity, course, rms, stated)


def measured(case: Case) -> tuple[float, np.ndarray, np.ndarray]:
    """Sample rate, force (t,) and channels (t, n), as a controller or a data acquisition system logs them."""
    knots = (
        path(case) if case.drive.gains else np.column_stack([_sines(case, case.size), np.zeros(int(SECONDS * RATE))])
    )
    found = run(case.drive, knots, 1 / RATE)
    key, rate = QUANTITIES[case.quantity]
    step, force, motion = int(RATE / rate), found["f"], found[key]
    if key == "x":
        return rate, force[::step], ENCODER * np.round(motion[::step] / ENCODER)
    force, motion = limited(force[:, None], step)[:, 0], limited(motion, step)
    return (
        rate,
        force,
        motion + NOISE * motion.std(axis=0) * generator(case.name, "noise").standard_normal(motion.shape),
    )


def limited(fine: np.ndarray, step: int) -> np.ndarray:
    """Every `step`-th sample (t, n) behind a steep low pass at 0.45 of their rate."""
    from scipy.signal import firwin, oaconvolve

    low = firwin(80 * step + 1, 0.9 / step, window=("kaiser", 8.0))
    padded = np.pad(fine, ((40 * step, 40 * step), (0, 0)), mode="edge")
    return oaconvolve(padded, low[:, None], mode="valid", axes=0)[::step]


def _sines(case: Case, rms: float) -> np.ndarray:
    """Random phases from 0.3 to 8 Hz, with a soft beginning."""
    rng, t = generator(case.name, "sines"), int(SECONDS * RATE)
    lines = np.fft.rfftfreq(t, 1 / RATE)
    own = (lines >= 0.3) & (lines <= 8.0)
    spectrum = np.zeros(len(lines), complex)
    spectrum[own] = np.exp(2j * np.pi * rng.uniform(size=own.sum()))
    found = np.fft.irfft(spectrum, t)
    ramp = np.minimum(1.0, np.arange(t) / RATE / 0.25)
    return rms * found / found.std() * (0.5 - 0.5 * np.cos(np.pi * ramp))


def path(case: Case) -> np.ndarray:
    """Position and velocity (t, 2) that the loop follows: random, or from place to place at trapezoids of velocity."""
    a = case.size / case.drive.m.sum()
    if case.course == "multisine":
        slope = _sines(case, a / (2 * np.pi * 3.0))
    else:
        rng, t = generator(case.name, "path"), np.arange(int(SECONDS * RATE)) / RATE
        slope, at, sign = np.zeros(len(t)), 0.1, 1.0
        while at < SECONDS:
            rise, flat, rest = rng.uniform(0.15, 0.5), rng.uniform(0.0, 0.8), rng.uniform(0.0, 0.4)
            peak, acceleration = rise, 2 * a * rng.uniform(0.3, 1.0)
            corners = np.array([at, at + peak, at + peak + flat, at + 2 * peak + flat])
            slope += sign * acceleration * peak * np.interp(t, corners, [0, 1, 1, 0], left=0, right=0)
            at, sign = corners[-1] + rest, -sign
    position = np.concatenate([[0.0], np.cumsum((slope[1:] + slope[:-1]) / 2 / RATE)])
    return np.column_stack([position, slope])

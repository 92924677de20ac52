"""Beams with a concealed cause, and what a test of their frequency response functions gives."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from benchmarks.blind.case import generator, log_uniform, near
from benchmarks.blind_frf.exact import Beam, Joint, receptance

# Noise: of each reading, and of the rms of all readings of a sensor
SENSORS, LINES, NOISE, FLOOR = 8, 1200, 0.01, 0.002
MODES = 5.5  # the band ends there, in modes of the beam
DENSITY, E = 7850.0, 2.1e11
ELEMENTS = 40
WAVES = {"pinned": np.pi, "clamped": 1.8751}  # of the first mode of a pinned-pinned and of a clamped-free beam
# Truth: group that is right, and the law of its damping where it has one.
TRUTHS = {
    "control": ("", ""),
    "crack, structural": ("local-stiffness", "structural"),
    "crack, viscous": ("local-stiffness", "viscous"),
    "mass": ("mass", ""),
    "absorber": ("oscillator", ""),
    "ground spring, structural": ("ground-spring", "structural"),
    "dashpot to the ground": ("damping", "viscous"),
}


@dataclass(frozen=True)
class Case:
    """One beam: `nominal`, what its deck says, and `true`; force and sensors (s,) in m, x: its position, nan without one."""

    name: str
    truth: str
    group: str
    law: str
    nominal: Beam
    true: Beam
    height: float  # m, of a square section
    force: float
    sensors: np.ndarray
    x: float
    draws: int = 1


@dataclass(frozen=True)
class Measured:
    """frequency_hz (f,); H (f, s), receptance, m/N, with its noise; variance (f, s) of H as the deck states it."""

    frequency_hz: np.ndarray
    H: np.ndarray
    variance: np.ndarray


def cases(split: str, seed: int, count: int) -> Iterator[Case]:
    """`count` beams of each truth."""
    for truth in TRUTHS:
        for k in range(count):
            yield _case(truth, k, generator(split, seed, "frf", truth, k))


def _case(truth: str, k: int, rng: np.random.Generator) -> Case:
    pinned = bool(rng.integers(2)) or truth == "crack, structural"  # the beam of the lecture is simply supported
    length = float(np.round(rng.uniform(0.5, 2.0), 3))
    height = float(np.round(length / rng.uniform(60, 160), 5))
    ends = ("pinned", "pinned") if pinned else ("clamped", "free")
    nominal = Beam(length, E * height**4 / 12, DENSITY * height**2, 0.01, ends)
    grid = np.arange(1, ELEMENTS + (not pinned)) * length / ELEMENTS  # nodes that can be measured
    shares = np.array_split(grid, SENSORS)
    sensors = np.array([rng.choice(share) for share in shares])
    x = float(length * rng.uniform(0.08, 0.92))
    true = Beam(
        length, near(rng, nominal.EI, 0.03), near(rng, nominal.mass, 0.015), log_uniform(rng, 0.006, 0.016), ends
    )
    true = Beam(true.length, true.EI, true.mass, true.eta, ends, _joints(truth, true, x, rng))
    group, law = TRUTHS[truth]
    force = float(rng.choice(grid[np.abs(grid / length - 0.4) < 0.25]))
    draws = 4 if truth == "control" else 1
    return Case(f"{truth}-{k}", truth, group, law, nominal, true, height, force, sensors, x if group else np.nan, draws)


def _joints(truth: str, beam: Beam, x: float, rng: np.random.Generator) -> tuple[Joint, ...]:
    """What is concealed at x."""
    total, first = beam.mass * beam.length, np.sqrt(beam.EI / beam.mass) * (np.pi / beam.length) ** 2
    if truth.startswith("crack"):
        height = np.sqrt(12 * beam.EI * DENSITY / (E * beam.mass))  # of the section, near enough
        stiffness = beam.EI / (height * _crack(rng.uniform(0.2, 0.6)))  # of the hinge, N m/rad
        loss = rng.uniform(0.1, 0.5)  # structural; or viscous, so much at the second mode
        part = (
            (lambda w: loss * np.ones_like(w)) if truth.endswith("structural") else (lambda w: loss * w / (4 * first))
        )
        return (Joint(x, compliance=lambda w: 1 / (stiffness * (1 + 1j * part(w)))),)
    if truth == "mass":
        kg = total * log_uniform(rng, 0.01, 0.1)
        return (Joint(x, stiffness=lambda w: -kg * w**2 + 0j),)
    if truth == "absorber":
        kg, own, loss = total * log_uniform(rng, 0.01, 0.06), first * rng.uniform(1.5, 15), rng.uniform(0.01, 0.1)
        k = kg * own**2 * (1 + 1j * loss)
        return (Joint(x, stiffness=lambda w: -kg * w**2 * k / (k - kg * w**2)),)
    if truth.startswith("ground spring"):
        k = beam.EI / beam.length**3 * log_uniform(rng, 10, 300) * (1 + 1j * rng.uniform(0.1, 0.5))
        return (Joint(x, stiffness=lambda w: k + 0 * w),)
    if truth.startswith("dashpot"):
        c = total * first * log_uniform(rng, 0.02, 0.2)
        return (Joint(x, stiffness=lambda w: 1j * w * c),)
    return ()


def _crack(s: float) -> float:
    """Compliance of an open edge crack of relative depth s, times EI over the height (Chondros, Dimarogonas and Yao 1998)."""
    series = [0.6272, -1.04533, 4.5948, -9.9736, 20.2948, -33.0351, 47.1063, -40.7556, 19.6]
    return 6 * np.pi * (1 - 0.3**2) * float(s**2 * np.polynomial.polynomial.polyval(s, series))


def measured(case: Case, words: tuple) -> Measured:
    """A test of the true beam; `words` seed its noise."""
    rng = generator(case.name, "test", *words)
    wave = WAVES[case.nominal.ends[0]]
    ratio = MODES if case.nominal.ends[0] == "pinned" else (MODES - 0.5) * np.pi / wave
    top = (wave * ratio / case.nominal.length) ** 2 * np.sqrt(case.nominal.EI / case.nominal.mass) / (2 * np.pi)
    frequency = np.geomspace(0.02 * top, top, LINES)  # a stepped sine: about two lines within each resonance
    H = receptance(case.true, frequency, case.force, case.sensors)
    variance = (NOISE * np.abs(H)) ** 2 + (FLOOR**2 * (np.abs(H) ** 2).mean(axis=0))
    noise = (rng.standard_normal(H.shape) + 1j * rng.standard_normal(H.shape)) * np.sqrt(variance / 2)
    return Measured(frequency, H + noise, variance)

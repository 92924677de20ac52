"""Sensors and noise: what a test of a true structure gives, and what its deck says of it."""

from dataclasses import dataclass

import numpy as np

from benchmarks.blind.case import Case, generator

MEASURED = 5  # modes


@dataclass(frozen=True)
class Config:
    """Number of sensors; sd of frequencies, of each, and of shapes, of the largest component of a mode; modes to be fitted."""

    sensors: int
    frequency_sd: float
    shape_sd: float
    modes: int = MEASURED


CONFIGS = {
    "A": Config(14, 0.001, 0.01),
    "B": Config(8, 0.002, 0.01),
    "D": Config(8, 0.005, 0.03),
    "P": Config(14, 0.0002, 0.005),
}
MISSTATED = (
    "understated",
    "gains",
    "position",
    "drift",
)  # noise twice as stated; 2 %; 0.5 % of the span; 1 % mode by mode


@dataclass(frozen=True)
class Measured:
    """sites (s,): indices into those of the case; frequency (m,); shapes (s, m), the largest component of a mode about 1.

    The first `modes` of the configuration are to be fitted, the rest is held out, as is altered (a,), with a mass added.
    """

    sites: list[int]
    frequency: np.ndarray
    shapes: np.ndarray
    altered: np.ndarray


def measured(case: Case, truth: dict[str, np.ndarray], config: Config, words: tuple, misstated: str = "") -> Measured:
    """The test of `truth`; `words` seed the noise. `misstated`: one of MISSTATED, or nothing."""
    rng = generator(case.name, "test", *words)
    sites = _sites(case, config, rng)
    count = min(
        len(truth["frequency"]), len(case.numbers)
    )  # what hangs on a structure has modes that its model has not
    shapes = truth["shapes"][:count].T
    readings = _moved(shapes, sites, rng) if misstated == "position" else shapes[sites]
    readings = _faulty(readings / abs(readings).max(axis=0), case.sensor_fault)
    if misstated == "gains":
        readings = readings * (1 + 0.02 * rng.standard_normal(len(sites)))[:, None]
    scale = 2.0 if misstated == "understated" else 1.0
    readings = readings + scale * config.shape_sd * rng.standard_normal(readings.shape)
    frequency = truth["frequency"][:count] * (1 + scale * config.frequency_sd * rng.standard_normal(count))
    if misstated == "drift":
        frequency = frequency * (1 + rng.uniform(-0.01, 0.01, count))
    altered = truth["altered"][: config.modes]
    altered = altered * (1 + scale * config.frequency_sd * rng.standard_normal(len(altered)))
    order = np.argsort(frequency)  # noise may exchange two close ones
    return Measured(sites, frequency[order], readings[:, order], np.sort(altered))


def _sites(case: Case, config: Config, rng: np.random.Generator) -> list[int]:
    """Sensors spread over the choices, each somewhere in its share of them."""
    choices = list(case.choices or range(len(case.sites)))
    count = min(config.sensors, len(choices))
    return [int(rng.choice(part)) for part in np.array_split(choices, count)]


def _moved(shapes: np.ndarray, sites: list[int], rng: np.random.Generator) -> np.ndarray:
    """What sensors read that are not quite where the deck says; sites are even along a line."""
    from scipy.interpolate import CubicSpline

    line = np.linspace(0, 1, len(shapes))
    return CubicSpline(line, shapes)(np.clip(line[sites] + 0.005 * rng.standard_normal(len(sites)), 0, 1))


def _faulty(readings: np.ndarray, fault: dict) -> np.ndarray:
    """With one sensor wrong in gain, or reversed, or two exchanged."""
    if not fault:
        return readings
    order = np.argsort(abs(readings).max(axis=1))[::-1]  # a fault is put where something is read
    first = int(order[int(fault["pick"][0] * len(order) * 0.7)])
    readings = readings.copy()
    if fault["kind"] == "swap":
        others = [s for s in range(len(readings)) if abs(s - first) > 1]
        other = others[int(fault["pick"][1] * len(others))]
        readings[[first, other]] = readings[[other, first]]
    readings[first] *= fault["gain"]
    return readings

"""What a case of the benchmark is, and how its numbers are drawn."""

import zlib
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

SPLITS = ("development", "fresh")  # structures used while developing, and others
DENSITY_SPREAD, E_SPREAD = 0.015, 0.03  # largest difference of the structure from its deck
ALTERED = 0.04  # mass added for the altered configuration, of the whole


@dataclass(frozen=True)
class Case:
    """One structure and its cause.

    name: unique; kind: structure; truth: cause, a row of the confusion table; groups: right names, empty when nothing is missing;
    inputs: what the truth is made from (JSON), given to `make`; model: deck up to the test; sites: (k,) sensors where shapes are
    known, as items of `dofs` or of `sensors`; numbers: system mode numbers of the modes measured.
    """

    name: str
    kind: str
    truth: str
    groups: tuple[str, ...]
    inputs: dict
    make: Callable[[dict], dict[str, np.ndarray]]
    model: str
    sites: tuple[str | dict, ...]
    numbers: tuple[int, ...]
    altered: str = ""  # masses that make the altered configuration, {node: kg}
    places: tuple[tuple[float, ...], ...] = ()  # one for each local cause, m
    ends: tuple[tuple[int, ...], ...] = ()  # nodes that a cause joins: it is at none but these
    span: float = 1.0  # m
    outside: bool = False  # no cause of the library: the right answer is to abstain
    tolerated: tuple[str, ...] = ()  # groups that may be named besides
    sensor_fault: dict = field(default_factory=dict)
    draws: int = 1  # tests of different noise
    choices: tuple[int, ...] = ()  # sites from which sensors are chosen; empty: all
    files: dict[str, str] = field(default_factory=dict)  # that the deck refers to
    sizes: dict[str, float] = field(default_factory=dict)  # of the mechanism, by the names that the tool gives them
    config: Any = None  # sensors and noise of its own, a Config of `test_data`


def generator(*words: object) -> np.random.Generator:
    """Random numbers that depend on all `words`, and on nothing else."""
    return np.random.default_rng([zlib.crc32(str(word).encode()) for word in words])


def log_uniform(rng: np.random.Generator, low: float, high: float) -> float:
    """A number whose logarithm is uniform."""
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def near(rng: np.random.Generator, value: float, spread: float) -> float:
    """A number within `spread` of `value`."""
    return float(value * (1 + rng.uniform(-spread, spread)))

"""What a test of a truth gives: sensors and noise of the qualities A, B and D, and noise that the deck misstates."""

from dataclasses import dataclass

import numpy as np

from benchmarks.trials.case import Blank

SEEN = 0.05  # of the usual size: what moves less at all sensors that there could be, no test finds
GAIN_SD = 0.02
HELD_OUT = 1 / 3  # of the cases


@dataclass(frozen=True)
class Quality:
    """Number of sensors; sd of each frequency, and of shapes over the largest component of a mode."""

    sensors: int
    frequency_sd: float
    shape_sd: float


QUALITIES = {"A": Quality(14, 0.001, 0.01), "B": Quality(8, 0.002, 0.01), "D": Quality(8, 0.005, 0.03)}


@dataclass(frozen=True)
class Truth:
    """Frequencies (m,) in Hz and what all possible sensors read, (s, m), the largest 1."""

    frequency: np.ndarray
    shapes: np.ndarray


def truth_of(blank: Blank, count: int) -> Truth:
    """The first `count` modes that a test finds."""
    if blank.tuned:
        b, stiffness = blank.tuned[0]
        found = []
        for i in range(count):
            blank.truth.spring(b, float(stiffness[i]))
            f, x = blank.truth.modes(i + 1)
            blank.truth.springs.pop()
            found.append((f[i], x[:, i]))
        frequency, whole = np.array([f for f, _ in found]), np.column_stack([x for _, x in found])
    else:
        frequency, whole = blank.truth.modes(count + 4)
    shapes = whole[[dof for _, dof in blank.sensors]]
    size = np.abs(shapes).max(axis=0)
    seen = np.flatnonzero(size > SEEN * np.median(size))[:count]
    return Truth(frequency[seen], shapes[:, seen] / size[seen])


@dataclass(frozen=True)
class Test:
    """sensors (s,): indices into those of the structure; frequency (m,), shapes (s, m) with noise; held: modes kept from fits."""

    quality: Quality
    sensors: list[int]
    numbers: list[int]
    frequency: np.ndarray
    shapes: np.ndarray
    held: int


def counts(rng: np.random.Generator, blank: Blank) -> tuple[int, int]:
    """(modes measured, of which held out)."""
    held = int(rng.integers(1, 3)) if rng.uniform() < HELD_OUT else 0
    most = len(blank.sensors) - 1
    return min(int(rng.integers(5, 7)) + held, most), held


def measured(rng: np.random.Generator, blank: Blank, truth: Truth, quality: Quality, held: int, error: str) -> Test:
    """A test of the truth; `error`: understated, gains, or nothing."""
    choices = np.arange(len(blank.sensors))
    own = [int(rng.choice(part)) for part in np.array_split(choices, min(quality.sensors, len(choices)))]
    readings = truth.shapes[own] / np.abs(truth.shapes[own]).max(axis=0)
    if error == "gains":
        readings = readings * (1 + GAIN_SD * rng.standard_normal(len(own)))[:, None]
    scale = 2.0 if error == "understated" else 1.0
    readings = readings + scale * quality.shape_sd * rng.standard_normal(readings.shape)
    m = len(truth.frequency)
    frequency = truth.frequency * (1 + scale * quality.frequency_sd * rng.standard_normal(m))
    order = np.argsort(frequency)  # what noise has exchanged, no test tells
    numbers = [blank.rigid + i + 1 for i in range(m)]
    return Test(quality, own, numbers, frequency[order], readings[:, order], held)


def difference(before: Truth, after: Truth, quality: Quality, m: int) -> np.ndarray:
    """Frequencies and shapes of m modes of `after` less those of `before`, over the stated noise; modes go by their order."""
    f = (after.frequency[:m] / before.frequency[:m] - 1) / quality.frequency_sd
    signs = np.sign((before.shapes[:, :m] * after.shapes[:, :m]).sum(axis=0))
    x = (after.shapes[:, :m] - signs * before.shapes[:, :m]) / quality.shape_sd
    share = min(quality.sensors, len(x)) / len(x)  # of the places that have a sensor
    return np.concatenate([f, np.sqrt(share) * x.ravel()])


def section(blank: Blank, test: Test) -> str:
    """The section `test` of the deck."""
    quality = test.quality
    rows = ["      - [" + ", ".join(f"{x:.5f}" for x in row) + "]" for row in test.shapes]
    lines = [
        *("test:", "  modes:"),
        f"    number: {test.numbers}",
        f"    frequency: [{', '.join(f'{f:.8g}' for f in test.frequency)}]",
        f"    frequency_sd: {100 * quality.frequency_sd:g} %",
        f"    dofs: [{', '.join(blank.sensors[s][0] for s in test.sensors)}]",
        *("    shapes:", *rows, f"    shape_sd: {100 * quality.shape_sd:g} %"),
    ]
    if test.held:
        lines += ["  hold_out:", f"    modes: {test.numbers[-test.held :]}"]
    return "\n".join(lines) + "\n"

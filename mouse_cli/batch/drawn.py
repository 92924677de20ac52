"""Tests of which each part counts so often: modes and sensors, measured functions, stretches of recordings.

What counts c times has its variances divided by c, and 0 times is left out; a stretch of a recording stands there c times.
"""

from dataclasses import replace
from itertools import pairwise

import numpy as np

from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.hold_out import HeldRecords, part
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.problem import Problem
from mouse_cli.model.recording import Recording

_SHORTEST, _MOST = 300, 20  # samples of a stretch, which is simulated from a state of its own; stretches in all


def reweighted(test: ModalTest, modes: list[int] | None = None, sensors: list[int] | None = None) -> ModalTest:
    """The test with each mode and sensor counted so often: a datum's variance is divided by both counts, by 0: left out."""
    modes_n = np.ones(test.m) if modes is None else np.array(modes, float)
    sensors_n = np.ones(test.s) if sensors is None else np.array(sensors, float)
    kept, at = np.flatnonzero(modes_n), np.flatnonzero(sensors_n)
    left = part(test, kept, at)
    times = np.outer(sensors_n[at], modes_n[kept])
    return replace(
        left, shape_sd=left.shape_sd / np.sqrt(times), frequency_sd_hz=left.frequency_sd_hz / np.sqrt(modes_n[kept])
    )


def functions(problem: Problem) -> tuple[str, ...]:
    """Names of the measured functions, `function H(3TX,1TX)`."""
    from mouse_cli.observables.frf import names

    found = []
    for number, test in enumerate(problem.frf, 1):
        outputs, inputs = names(test)
        place = f" of {test.title or f'measurement {number}'}" if len(problem.frf) > 1 else ""
        found += [f"function H({outputs[o]},{inputs[i]}){place}" for o, i in np.argwhere(_measured(test))]
    return tuple(found)


def _measured(test: FrfTest) -> np.ndarray:
    return np.isfinite(test.H).any(axis=0)


def functions_drawn(tests: tuple[FrfTest, ...], counts: list[int]) -> tuple[FrfTest, ...]:
    """The functions of all tests counted so often, at the lines that are fitted of the tests as they are."""
    from mouse_cli.observables.frf import observe

    found, left = [], np.array(counts, float)
    for test in tests:
        seen, measured = observe(test, test.form), _measured(test)
        times = np.zeros(measured.shape)
        times[measured], left = left[: measured.sum()], left[measured.sum() :]
        H, variance = (np.full(test.H.shape, np.nan, kind) for kind in (complex, float))
        H[seen.lines] = np.where(seen.have & (times > 0), seen.H, np.nan)
        with np.errstate(divide="ignore"):
            variance[seen.lines] = 2 * seen.sd**2 / times
        found.append(replace(test, H=H, variance=variance))
    return tuple(found)


def stretches(problem: Problem) -> tuple[tuple[Recording, ...], HeldRecords]:
    """The recordings that are fitted, cut into stretches; and what is held out, the end of each where the deck names nothing."""
    from mouse_cli.updating.recordings.records import HELD

    held = problem.held_records or HeldRecords()
    fitted = list(problem.recordings)
    if not held.recordings:
        ends = [int((1 - HELD) * len(one.samples)) for one in fitted]
        rest = tuple(_cut(one, end, len(one.samples)) for one, end in zip(fitted, ends, strict=True))
        held = replace(held, recordings=rest)
        fitted = [_cut(one, 0, end) for one, end in zip(fitted, ends, strict=True)]
    shortest = max(_SHORTEST, sum(len(one.samples) for one in fitted) // _MOST)
    found = []
    for one in fitted:
        edges = np.linspace(0, len(one.samples), max(len(one.samples) // shortest, 1) + 1).astype(int)
        found += [_cut(one, first, last) for first, last in pairwise(edges)]
    return tuple(found), held


def _cut(one: Recording, first: int, last: int) -> Recording:
    return replace(one, samples=one.samples[first:last], start=one.start + first)


def drawn(problem: Problem, counts: dict[str, list[int]]) -> Problem:
    """`problem` with each `modes`, `sensors`, `functions` or `records` (stretches) counted so often."""
    if "functions" in counts:
        return replace(problem, frf=functions_drawn(problem.frf, counts["functions"]))
    if "records" in counts:
        parts, held = stretches(problem)
        times = zip(parts, counts["records"], strict=True)
        return replace(problem, recordings=tuple(one for one, c in times for _ in range(c)), held_records=held)
    return replace(problem, test=reweighted(problem.test, **counts))

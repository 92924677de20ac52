"""Frames that lack nothing, and storey buildings that lack nothing."""

from collections.abc import Iterator

from benchmarks.blind.case import Case, generator
from benchmarks.blind.space import storeys
from benchmarks.blind.space.frames import case, drawn, quality


def cases(split: str, seed: int, count: int) -> Iterator[Case]:
    """`count` frames or buildings in turn."""
    for k in range(count):
        rng = generator(split, seed, "space", "control", k)
        if k % 2:
            yield storeys.case("control", k, storeys.drawn(rng), rng, 0.0, truth="control", groups=())
            continue
        frame = drawn(rng)
        yield case("control", k, frame, frame.inputs(rng), quality(rng), "control", groups=())

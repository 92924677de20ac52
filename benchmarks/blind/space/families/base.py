"""Feet that turn about both horizontal axes: all alike, or one of them."""

from collections.abc import Iterator

import numpy as np

from benchmarks.blind.case import Case, generator, log_uniform
from benchmarks.blind.space.frames import E, case, drawn, quality, visible


def cases(split: str, seed: int, count: int) -> Iterator[Case]:
    """`count` frames; stiffnesses from 0.5 to 10 EI/L of a column, each axis its own."""
    for k in range(count):
        rng = generator(split, seed, "space", "base", k)
        frame, config = drawn(rng), quality(rng)
        sound, alike = frame.inputs(rng), bool(rng.integers(2))
        posts = frame.lengths[: len(frame.feet)]
        while True:
            feet = frame.feet if alike else [int(rng.choice(frame.feet))]
            pair = [E * frame.sections[0, 1] / float(np.mean(posts)) * log_uniform(rng, 0.5, 10) for _ in range(2)]
            inputs = sound | {"springs": [[foot, 4 + d, pair[d]] for foot in feet for d in (0, 1)]}
            if visible(inputs, sound, config):
                break
        places = () if alike else (tuple(frame.points[feet[0]].tolist()),)
        names = [f"stiffness of the support, {axis}" for axis in ("RX", "RY")]
        about = {
            "sizes": dict(zip(names, pair, strict=True)),
            "groups": ("support",),
            "tolerated": ("support",),
            "places": places,
        }
        yield case("base", k, frame, inputs, config, "flexible bases" if alike else "a flexible base", **about)

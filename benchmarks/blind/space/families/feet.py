"""Two or three feet that turn about both horizontal axes, each with stiffnesses of its own, as softly as what is nearly pinned."""

from collections.abc import Iterator

import numpy as np

from benchmarks.blind.case import Case, generator, log_uniform
from benchmarks.blind.space.frames import E, case, drawn, quality, visible

MOST = 8  # feet of a frame


def cases(split: str, seed: int, count: int) -> Iterator[Case]:
    """`count` frames; stiffnesses from 0.1 to 1 EI/L of a column."""
    for k in range(count):
        rng = generator(split, seed, "space", "feet", k)
        while True:
            frame, config = drawn(rng), quality(rng)
            if len(frame.feet) <= MOST:
                break
        sound, soft = frame.inputs(rng), E * frame.sections[0, 1] / float(np.mean(frame.lengths[: len(frame.feet)]))
        while True:
            feet = rng.choice(frame.feet, int(rng.integers(2, 4)), replace=False).tolist()
            springs = [[foot, d, soft * log_uniform(rng, 0.1, 1)] for foot in feet for d in (4, 5)]
            inputs = sound | {"springs": springs}
            if visible(inputs, sound, config):
                break
        about = {
            "groups": ("support",),
            "tolerated": ("support",),
            "places": tuple(tuple(frame.points[foot].tolist()) for foot in feet),
        }
        yield case("feet", k, frame, inputs, config, f"{len(feet)} flexible feet", sizes={}, **about)

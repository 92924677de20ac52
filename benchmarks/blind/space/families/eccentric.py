"""A tank or machine on a bracket: a mass on a rigid arm, which turns the node that it hangs on."""

from collections.abc import Iterator

import numpy as np

from benchmarks.blind.case import Case, generator, log_uniform
from benchmarks.blind.space.frames import case, drawn, quality, visible


def cases(split: str, seed: int, count: int) -> Iterator[Case]:
    """`count` frames; 2 to 15 % of the mass of the floors, on an arm of 0.5 to 2.5 m that is level."""
    for k in range(count):
        rng = generator(split, seed, "space", "eccentric", k)
        frame, config = drawn(rng), quality(rng)
        sound, free = frame.inputs(rng), np.flatnonzero(frame.points[:, 2])
        while True:
            node, angle = int(rng.choice(free)), rng.uniform(0, 2 * np.pi)
            arm = rng.uniform(0.5, 2.5) * np.array([np.cos(angle), np.sin(angle), 0.0])
            kg = float(frame.kg.sum()) * log_uniform(rng, 0.02, 0.15)
            inputs = sound | {"masses": [[node, arm.tolist(), kg]]}
            if visible(inputs, sound, config):
                break
        place = tuple(frame.points[node].tolist())
        about = {"groups": ("mass",), "places": (place,), "sizes": {"mass": kg}}
        yield case("eccentric", k, frame, inputs, config, "eccentric mass", **about)

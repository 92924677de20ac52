"""A brace, cable or strut that the deck does not have: across a panel of a wall or a floor, or over two storeys."""

from collections.abc import Iterator
from itertools import combinations

import numpy as np

from benchmarks.blind.case import Case, generator, log_uniform
from benchmarks.blind.space.frames import E, Frame, case, drawn, quality, visible


def cases(split: str, seed: int, count: int) -> Iterator[Case]:
    """`count` frames; sections of 1 to 20 cm2."""
    for k in range(count):
        rng = generator(split, seed, "space", "brace", k)
        frame, config = drawn(rng), quality(rng)
        sound, diagonals = frame.inputs(rng), _diagonals(frame)
        while True:
            one, other = diagonals[int(rng.integers(len(diagonals)))]
            inputs = sound | {"struts": [[one, other, E * log_uniform(rng, 1e-4, 2e-3)]]}
            if visible(inputs, sound, config):
                break
        middle = tuple(frame.points[[one, other]].mean(axis=0).tolist())
        yield case(
            "brace",
            k,
            frame,
            inputs,
            config,
            "brace",
            groups=("brace",),
            places=(middle,),
            ends=((one + 1, other + 1),),
            sizes={
                "stiffness": inputs["struts"][0][2] / float(np.linalg.norm(np.subtract(*frame.points[[one, other]])))
            },
        )


def _diagonals(frame: Frame) -> list[tuple[int, int]]:
    """Nodes that neighbour in two directions, or by two storeys in one of them, not both on the ground."""
    steps = [np.unique(frame.points[:, d]) for d in range(3)]
    at = np.column_stack([np.searchsorted(own, frame.points[:, d]) for d, own in enumerate(steps)])
    found = []
    for i, j in combinations(range(len(at)), 2):
        step = tuple(np.abs(at[j] - at[i]).tolist())
        if sorted(step) == [0, 1, 1] or (step[2] == 2 and sorted(step[:2]) == [0, 1]):
            found += [(i, j)] if at[i, 2] or at[j, 2] else []
    return found

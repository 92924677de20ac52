"""Strokes of a hammer in a recording of its force."""

import numpy as np

_LEVEL = 0.2  # of the largest stroke, at which one begins
_BOUNCE = 0.1  # of the largest value of a stroke: a second contact above it is a double stroke


def strokes(force: np.ndarray, block: int, pretrigger: int) -> tuple[np.ndarray, np.ndarray]:
    """First samples of the blocks of strokes whose whole block was recorded; and whether each is a double stroke.

    A block begins `pretrigger` samples before the force rises above a fifth of its largest value. The next stroke is looked for
    after the end of the block.
    """
    size = np.abs(force - np.median(force))
    level = _LEVEL * size.max()
    above = np.flatnonzero(size > level)
    begin, double, free = [], [], 0
    for at in above:
        first = at - pretrigger
        if at < free or first < 0:
            continue
        if first + block > len(force):
            break
        begin.append(first)
        double.append(_double(size[at : first + block]))
        free = first + block
    return np.array(begin, dtype=int), np.array(double, dtype=bool)


def _double(size: np.ndarray) -> bool:
    """Whether a second contact follows the first."""
    peak = int(np.argmax(size[: max(2, len(size) // 8)]))
    limit = _BOUNCE * size[peak]
    after = size[peak:] < limit
    end = peak + int(np.argmax(after)) if after.any() else len(size)
    return bool((size[end:] > 2 * limit).any())

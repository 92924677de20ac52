"""How much of what moves over a sweep is due to each varied quantity."""

import numpy as np

_MOST, _EACH = 8, 4  # groups of values that are all different, and points in each at least


def grouped(points: list[tuple], count: int) -> list[np.ndarray]:
    """For each of `count` quantities the group (n,) of every point: equal values together, or neighbours where all differ."""
    return [_groups([point[j] for point in points], alone=count == 1) for j in range(count)]


def _groups(values: list, alone: bool) -> np.ndarray:
    distinct = sorted(set(values), key=lambda value: (isinstance(value, str), value))
    place = np.array([distinct.index(value) for value in values], int)
    if alone or len(distinct) < len(values):
        return place
    return place * max(1, min(_MOST, len(values) // _EACH)) // max(1, len(distinct))


def share(y: np.ndarray, group: np.ndarray, by_chance: bool) -> float:
    """Of the variance of y (n,), what the means of the groups (n,) explain: the correlation ratio R^2 (first-order index of Sobol).

    by_chance: points were drawn, so that means differ by chance too: 1 - (1 - R^2)(n - 1)/(n - groups), zero at least. In a grid
    all groups have the same values of all other quantities.
    """
    kinds, n = np.unique(group), len(y)
    total = float(np.sum((y - y.mean()) ** 2))
    if not total > 0:
        return 0.0
    ratio = float(sum(np.count_nonzero(group == g) * (y[group == g].mean() - y.mean()) ** 2 for g in kinds)) / total
    if not by_chance or len(kinds) == n:
        return ratio
    return max(0.0, 1 - (1 - ratio) * (n - 1) / (n - len(kinds)))

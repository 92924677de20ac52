"""Probabilities that do not rest on how many places a mechanism could be at: the mean of those under two priors.

Groups of mechanisms that are as probable beforehand, each shared among its places, hold one support of a few for more probable than
one member of hundreds; places that are as probable, whatever acts there, hold groups of many places for more probable. Neither is
known. What is named must stand under both.
"""

from collections import defaultdict

import numpy as np

from mouse_cli.diagnosis.gates import BY_GROUP
from mouse_cli.diagnosis.search.fit import Fit


def levelled(probabilities: np.ndarray, fits: list[Fit]) -> np.ndarray:
    """The mean (f,) of `probabilities` of `fits`, whose prior goes by groups, and of those where it goes by places.

    Sets of equally many mechanisms share what they have together; no mechanism, and what has no name, keep theirs.
    """
    sets: dict[int, list[int]] = defaultdict(list)
    for i, one in enumerate(fits):
        if one.recipes and not one.nameless:
            sets[len(one.recipes)].append(i)
    found = probabilities.copy()
    for own in sets.values():
        many = np.array([fits[i].log_places for i in own])
        by_place = probabilities[own] * np.exp(many - many[np.argmax(probabilities[own])])
        if by_place.sum() > 0:
            by_place *= probabilities[own].sum() / by_place.sum()
            found[own] = BY_GROUP * probabilities[own] + (1 - BY_GROUP) * by_place
    return found


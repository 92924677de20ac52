"""Probabilities that do not rest on how many places a mechanism could be at: the mean of those under two priors.

Groups of mechanisms that are as probable beforehand, each shared among its places, hold one support of a few for more probable than
one member of hundreds; places that are as probable, whatever acts there, hold groups of many places for more probable. Neither is
known. What is named must stand under both.
"""

from collections import defaultdict

import numpy as np

from mouse_cli.diagnosis.effects.change import PLACE
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
        many = np.array([log_places(fits[i]) for i in own])
        by_place = probabilities[own] * np.exp(many - many[np.argmax(probabilities[own])])
        if by_place.sum() > 0:
            by_place *= probabilities[own].sum() / by_place.sum()
            found[own] = BY_GROUP * probabilities[own] + (1 - BY_GROUP) * by_place
    return found


def log_places(one: Fit) -> float:
    """ln of how many places its mechanisms could be at for each that the data leave: by their prior, and of a place along a line
    by its range over its sd.
    """
    sd = np.sqrt(np.abs(np.diag(one.covariance)))[one.model.k :]
    found = sum(recipe.seldom - recipe.log_prior for recipe in one.recipes)
    for recipe, own in zip(one.recipes, one.model.own, strict=True):
        for unknown, s, width in zip(recipe.unknowns, sd[own], one.model.width[own], strict=True):
            if unknown.name == PLACE:
                found += max(0.0, float(np.log(width / (np.sqrt(2 * np.pi) * s))))
    return float(found)

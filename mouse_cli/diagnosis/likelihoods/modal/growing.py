"""What causes take of parts of a model: it grows as the deck's parameters make these parts grow.

What is lost of a part is a share of it. Were it a fixed amount, a part that is missing would stand again as soon as a parameter
moved, in a small share, and stiff all the same.
"""

from collections.abc import Iterator

import numpy as np

from mouse_cli.diagnosis.effects.change import Change


def grown(model, i: int, change: Change, x: np.ndarray) -> Change:
    """What cause i does at x (k + t,), `change` being that at the deck's parameters of the base."""
    recipe, base = model.recipes[i], model.base
    return change if recipe.grows is None else recipe.grown(change, base.parameters(x[: model.k]) - base.theta)


def growing(model, x: np.ndarray) -> Iterator[tuple[int, np.ndarray, np.ndarray, Change]]:
    """Number of each cause that grows, how its K and M do by z (k,), and what it does at the deck's parameters of the base."""
    for i, (recipe, own) in enumerate(zip(model.recipes, model.own, strict=True)):
        if recipe.grows is not None:
            by_K, by_M = (each @ model.base.by(x[: model.k]) for each in recipe.grows)
            yield i, by_K, by_M, recipe.at(x[model.k :][own])

"""Where effects add up from: no mechanism, and sets of them that turn the modes so far that others act otherwise beside them.

What a place and size adds to a residual beside causes that are there is what it adds at the centre that has the most of them:
r(centre and c and b) = r(centre and c) + r(centre and b) - r(centre), see `superposed`. A foot that is loose turns a gantry so that
a mass on it, or a softer girder, does what it never did on a foot that is held.
"""

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.search.superposed import Alone, text

Places = frozenset[tuple[str, str]]  # candidates, and where they act


class Centres:
    """What candidates do beside each centre, by name; beside none in a dictionary of its own."""

    def __init__(self) -> None:
        self.alone: dict[str, Alone] = {}
        self._beside: dict[Places, tuple[bytes, dict[str, Alone]]] = {}

    def add(self, before: np.ndarray, causes: tuple[Recipe, ...]) -> None:
        """A further centre: `causes`, at x (k + t,) `before`."""
        self._beside.setdefault(_places(causes), (before.tobytes(), {}))

    def at(self, before: np.ndarray, causes: tuple[Recipe, ...]) -> dict[str, Alone] | None:
        """What is known beside the centre that `causes` are where they are there `before`; None: they are none."""
        x, known = self._beside.get(_places(causes), (b"", {}))
        return known if x == before.tobytes() else None

    def nearest(self, name: str, causes: tuple[Recipe, ...]) -> Alone | None:
        """What candidate `name` does at the centre that has the most of `causes` and no others; None: it was looked at nowhere."""
        own = _places(causes)
        inside = [(len(centre), known[name]) for centre, (_, known) in self._beside.items() if centre <= own and name in known]
        return max(inside, key=lambda each: each[0])[1] if inside else self.alone.get(name)


def _places(causes: tuple[Recipe, ...]) -> Places:
    return frozenset((recipe.candidate.key, text(recipe)) for recipe in causes)

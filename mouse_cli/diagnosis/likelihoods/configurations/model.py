"""Several arrangements of one structure as one model: parameters and causes are shared, and so is what theory errs in each mode.

With the residual r_i of arrangement i, whitened by what its own test states, and an error e_n ~ N(0, tau^2) of ln f in mode n that
is the same in every arrangement, r = U e / tau + noise, U_in = tau / sd_i: data of one mode are correlated. They are whitened by

    (I + u u')^-1/2 = I - (1 - 1 / sqrt(1 + u'u)) u u' / u'u

for each mode, u the column of U (Sherman and Morrison).
"""

from collections.abc import Callable
from dataclasses import dataclass, field, fields, replace
from functools import cached_property

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe
from mouse_cli.diagnosis.likelihoods.modal.lowest import lowest
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.point import Left, Point
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.turning import Turn
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.model.problem import Problem
from mouse_cli.terms.further import with_parameters

_COORDINATES, _TIMES = 36, 6  # coordinates of a configuration at least, and of the number of its highest measured mode
_LOOKED, _BESIDE = 4, 2  # arrangements that a first look is made at: with what is sought, and without


@dataclass(frozen=True)
class SharedRecipe(Recipe):
    """A cause that is the same in every arrangement that has it: as in the first of them; `each` (a,), None without it."""

    each: tuple[Recipe | None, ...] = field(default=(), repr=False)

    def like(self, other: "SharedRecipe") -> "SharedRecipe":
        """The same cause in other arrangements, with the ranges of `other`."""
        each = tuple(one and replace(one, unknowns=other.unknowns) for one in self.each)
        return replace(self, unknowns=other.unknowns, each=each)

    def extended(self, problems: tuple[Problem, ...], coordinates: np.ndarray) -> tuple[Problem, ...]:
        """The deck of every arrangement with the cause in it; without it, its parameters are there and do nothing."""
        values, own = self.values(coordinates), len(problems[0].parameters)
        like = self.extend(problems[0], values).parameters  # each deck would name them by places of its own
        pairs = zip(self.each, problems, strict=True)
        decks = [one.extend(deck, values) if one else with_parameters(deck, like[own:]) for one, deck in pairs]
        return tuple(replace(deck, parameters=like) for deck in decks)


@dataclass(frozen=True)
class SharedData:
    """Data of all tests together. dof: their degrees of freedom; by_shape: modes of all are paired by shape."""

    dof: int
    by_shape: bool
    slack: float = 0.0


@dataclass(frozen=True)
class Arranged:
    """Reduced models (a,) of the arrangements; common_sd: tau, of ln f, in every mode; having (a,): which have what is sought."""

    parts: tuple[Reduced, ...]
    common_sd: float
    having: tuple[bool, ...]

    @property
    def problem(self) -> Problem:
        """The deck of the first, whose parameters and units are those of all."""
        return self.parts[0].problem

    @property
    def theta(self) -> np.ndarray:
        """Values (p,) of the parameters where causes are weighed."""
        return self.parts[0].theta

    @property
    def L(self) -> np.ndarray:
        """Root (p, k) of the prior."""
        return self.parts[0].L

    @property
    def z(self) -> np.ndarray:
        """z (k,) of theta."""
        return self.parts[0].z

    def parameters(self, z: np.ndarray) -> np.ndarray:
        """Values (p,) of the parameters at z (k,)."""
        return self.parts[0].parameters(z)

    @cached_property
    def data(self) -> SharedData:
        """All tests together."""
        return SharedData(sum(part.data.dof for part in self.parts), all(part.data.by_shape for part in self.parts))

    def each(self, do: Callable[[Reduced, bool], Reduced]) -> "Arranged":
        """What `do` makes of every configuration, and of whether it has what is sought."""
        pairs = zip(self.parts, self.having, strict=True)
        return replace(self, parts=tuple(do(part, has) for part, has in pairs))

    @property
    def nameless(self):
        """The field of those that have what is sought; None: there is none."""
        return getattr(self.parts[0], "nameless", None)

    @property
    def first(self) -> Reduced:
        """The first configuration that has what is sought."""
        return self.parts[self.having.index(True)]

    def judged_by(self, data: SharedData) -> "Arranged":
        """Itself: accuracies of arrangements stay as their decks state them."""
        return self

    def recipes(self, candidate: Candidate) -> list[SharedRecipe]:
        """What `candidate` can do to all arrangements alike; nothing where they differ in where it can act."""
        pairs = zip(self.parts, self.having, strict=True)
        found = [candidate.recipes(part, candidate) if has else None for part, has in pairs]
        counts = {len(each) for each in found if each is not None}
        if len(counts) != 1:
            return []
        return [_shared(tuple(each and each[i] for each in found)) for i in range(counts.pop())]

    def like(self, recipe: SharedRecipe) -> SharedRecipe | None:
        """The cause of other arrangements in these; None where it has no place in them."""
        if not any(self.having):
            return replace(recipe, each=(None,) * len(self.parts))
        found = self.recipes(recipe.candidate)
        return found[recipe.number].like(recipe) if recipe.number < len(found) else None

    def looked_at(self, do: Callable[[Reduced], Reduced]) -> "Arranged":
        """What a first look is made with: what `do` makes of a few arrangements, the first that has what is sought among them."""
        having = np.flatnonzero(self.having)
        few = having[np.linspace(0, len(having) - 1, min(len(having), _LOOKED)).astype(int)]
        chosen = sorted({*few.tolist(), *np.flatnonzero(~np.array(self.having))[:_BESIDE].tolist()})
        parts = tuple(do(self.parts[i]) for i in chosen)
        same = len(parts) == len(self.parts) and all(a is b for a, b in zip(parts, self.parts, strict=True))
        return self if same else replace(self, parts=parts, having=tuple(self.having[i] for i in chosen))

    def at(self, theta: np.ndarray) -> "Arranged":
        """The same at other values theta (p,) of the parameters."""
        return replace(self, parts=tuple(lowest_of(part.at(theta)) for part in self.parts))

    @cached_property
    def common(self) -> np.ndarray:
        """U (q, modes): what the errors that arrangements share, in sd tau, do to the whitened data."""
        numbers = [part.data.test.number for part in self.parts]
        modes = np.unique(np.concatenate(numbers))
        return np.vstack([common(part, modes, self.common_sd) for part in self.parts])

    def whitened(self, values: np.ndarray) -> np.ndarray:
        """`values` (q,) or (q, .) of all arrangements, whitened for the errors that they share."""
        size = (self.common**2).sum(axis=0)
        by = (1 - 1 / np.sqrt(1 + size)) / np.maximum(size, 1e-300)
        along = self.common.T @ values
        return values - self.common @ (by * along.T).T


def lowest_of(part: Reduced) -> Reduced:
    """A configuration in its lowest coordinates, and those by which ends of lines turn: every fit solves all configurations.

    What the coordinates left out would add to a change of the highest measured mode n goes with (n / r)^4 of it.
    """
    return lowest(part, max(_COORDINATES, _TIMES * int(part.data.test.number.max())))


def common(part: Reduced, modes: np.ndarray, sd: float) -> np.ndarray:
    """U (q, modes) of one arrangement: shapes are not concerned."""
    data = part.data
    rows = np.flatnonzero(data.has_frequency)
    found = np.zeros((len(rows) + int(data.has_shape.sum()), len(modes)))
    found[np.arange(len(rows)), np.searchsorted(modes, data.test.number[rows])] = sd / data.sd_log[rows]
    return found


def _shared(each: tuple[Recipe | None, ...]) -> SharedRecipe:
    like = next(one for one in each if one)
    first = SharedRecipe(**{one.name: getattr(like, one.name) for one in fields(Recipe) if one.init}, each=each)
    return first.like(first)


def _absent(recipe: SharedRecipe) -> Recipe:
    """The cause in an arrangement that does not have it."""
    return Recipe(recipe.candidate, recipe.unknowns, lambda values: Change(), recipe.grid)


@dataclass(frozen=True)
class Points(Left):
    """All arrangements at x: the point of each, and the residual of all, whitened."""

    x: np.ndarray
    points: tuple[Point, ...]
    residual: np.ndarray

    @property
    def pairing(self) -> np.ndarray:
        """Modes that the measured ones are, of one arrangement after another."""
        return np.concatenate([at.modes for at in self.points])

    @property
    def turns(self) -> tuple[Turn, ...]:
        """Those of each."""
        return tuple(turn for at in self.points for turn in at.turns)


class Together:
    """Arrangements with causes that they share: what `fit` and `Study` need of a model."""

    def __init__(self, base: Arranged, recipes: tuple[SharedRecipe, ...] = ()):
        self.base, self.recipes = base, recipes
        self.models = [
            Model(part, tuple(recipe.each[i] or _absent(recipe) for recipe in recipes))
            for i, part in enumerate(base.parts)
        ]
        first = self.models[0]
        self.k, self.t, self.own = first.k, first.t, first.own
        self.bounds, self.width = first.bounds, first.width

    def point(self, x: np.ndarray) -> Points | None:
        """All arrangements at x (k + t,); None where one is not physical."""
        found = []
        for model in self.models:
            at = model.point(x)
            if at is None:
                return None
            found.append(at)
        residual = self.base.whitened(np.concatenate([at.residual for at in found]))
        return Points(x, tuple(found), residual)

    def jacobian(self, at: Points) -> np.ndarray:
        """d(prediction)/dx (q, k + t), whitened."""
        return self.base.whitened(self.slopes(at))

    def slopes(self, at: Points) -> np.ndarray:
        """The same, each arrangement whitened by itself alone."""
        return np.vstack([model.jacobian(point) for model, point in zip(self.models, at.points, strict=True)])

    def curvature(self, at: Points) -> np.ndarray | float:
        """See `Model`; errors that arrangements share are left out."""
        return sum(model.curvature(point) for model, point in self.parts(at))

    def parts(self, at: Points) -> list[tuple[Model, Point]]:
        """Model and point of each arrangement."""
        return list(zip(self.models, at.points, strict=True))

    def loosened(self, at: Points, share: float) -> None:
        """None: what theory errs is in the errors that arrangements share."""
        return None

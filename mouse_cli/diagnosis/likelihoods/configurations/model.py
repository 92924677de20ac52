"""Several arrangements of one structure as one model: parameters and causes are shared, and so is what theory errs in each mode.

With the residual r_i of arrangement i, whitened by what its own test states, and errors e ~ N(0, I) that are the same in every
arrangement, r_i = U_i e + noise, see `shared`: data of all are correlated. They are whitened by (I + U U')^-1/2.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from typing import Any

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe
from mouse_cli.diagnosis.likelihoods.configurations.shared import Errors, Modes
from mouse_cli.diagnosis.likelihoods.modal.given import Given
from mouse_cli.diagnosis.likelihoods.modal.lowest import lowest
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.point import Left, Point
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.turning import Turn
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.model.problem import Problem
from mouse_cli.terms.further import with_parameters

_COORDINATES, _TIMES = 36, 6  # coordinates of a configuration at least, and of the number of its highest measured mode
_KEPT = 8  # models of arrangements without what is sought that are kept
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
    """Data of all tests together. dof: their degrees of freedom; by_shape: modes of all are paired by shape.

    errors: what theory errs in all of them; slack: by which ln of their density is lower for errors that are larger than given.
    """

    dof: int
    by_shape: bool
    errors: Errors
    slack: float = 0.0


@dataclass(frozen=True)
class Arranged(Given):
    """Reduced models (a,) of the arrangements; common_sd: tau, of ln f, in every mode; having (a,): which have what is sought.

    erring: what theory errs in all alike, of the models before anything that was found came into the decks; None: of these. slack:
    by which ln of their density is lower for errors that are larger than those.
    """

    parts: tuple[Reduced, ...]
    common_sd: float
    having: tuple[bool, ...]
    erring: Errors | None = None
    slack: float = 0.0

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
        by_shape = all(part.data.by_shape for part in self.parts)
        return SharedData(sum(part.data.dof for part in self.parts), by_shape, self.errors, self.slack)

    def each(self, do: Callable[[Reduced, bool], Reduced]) -> "Arranged":
        """What `do` makes of every configuration, and of whether it has what is sought."""
        pairs = zip(self.parts, self.having, strict=True)
        return replace(self, parts=tuple(do(part, has) for part, has in pairs), erring=self.errors)

    @property
    def nameless(self):
        """The field of those that have what is sought; None: there is none."""
        return getattr(self.parts[0], "nameless", None)

    @property
    def first(self) -> Reduced:
        """The first configuration that has what is sought."""
        return self.parts[self.having.index(True)]

    def judged_by(self, data: SharedData) -> "Arranged":
        """The same by errors of other data; accuracies of the tests stay as their decks state them."""
        same = data.errors is self.errors and data.slack == self.slack
        return self if same else replace(self, erring=data.errors, slack=data.slack)

    def recipes(self, candidate: Candidate) -> list[SharedRecipe]:
        """What `candidate` can do to all arrangements alike; nothing where they differ in where it can act."""
        pairs = zip(self.parts, self.having, strict=True)
        found = [_made(part, candidate) if has else None for part, has in pairs]
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
        having, modes = (tuple(each[i] for i in chosen) for each in (self.having, self.errors.modes))
        return self if same else replace(self, parts=parts, having=having, erring=Errors(modes, self.common_sd))

    def at(self, theta: np.ndarray) -> "Arranged":
        """The same at other values theta (p,) of the parameters."""
        pairs = zip(self.parts, self.having, strict=True)
        return replace(self, parts=tuple(lowest_of(part.at(theta), has) for part, has in pairs), erring=self.errors)

    def without(self, i: int, x: np.ndarray, of: Callable[[Model, np.ndarray], Any]) -> Any:
        """`of` arrangement number i, which has nothing of what is sought, at x (k + t,): the last are kept, for first looks at what
        the others have are all made beside the same one.
        """
        z, kept = x[: self.L.shape[1]], self._kept
        key = i, of, z.tobytes()
        if key not in kept:
            if len(kept) >= _KEPT:
                del kept[next(iter(kept))]
            kept[key] = of(Model(self.parts[i]), z)
        return kept[key]

    @cached_property
    def _kept(self) -> dict[tuple, Any]:
        return {}

    @cached_property
    def errors(self) -> Errors:
        """What theory errs in all alike: in the models of the decks as they were given."""
        return Errors(tuple(map(Modes.of, self.parts)), self.common_sd) if self.erring is None else self.erring

    def erring_as(self, modes: tuple[Modes, ...]) -> "Arranged":
        """The same as theory errs in these modes, by as much more or less as ln |I + U U'| says."""
        errors = Errors(modes, self.common_sd)
        return replace(self, erring=errors, slack=self.slack + 0.5 * (errors.log_size - self.errors.log_size))


def lowest_of(part: Reduced, has: bool) -> Reduced:
    """A configuration in its lowest coordinates, and, if it has what is sought, those by which ends of lines turn: every fit solves
    all configurations.

    What the coordinates left out would add to a change of the highest measured mode n goes with (n / r)^4 of it.
    """
    return lowest(part, max(_COORDINATES, _TIMES * int(part.data.test.number.max())), has)


def _made(part: Reduced, candidate: Candidate) -> list[Recipe]:
    """What a candidate can do to one arrangement; each of its recipes knows which of that model it is."""
    return [replace(recipe, number=i, home=part) for i, recipe in enumerate(part.recipes(candidate))]


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


class Together(Given):
    """Arrangements with causes that they share: what `fit` and `Study` need of a model."""

    made_of = "base", "recipes"

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
        found = self._of_each(Model.point, x)
        if found is None:
            return None
        residual = self.base.errors.whitened(np.concatenate([at.residual for at in found]))
        return Points(x, tuple(at if at.x is x else replace(at, x=x) for at in found), residual)

    def glimpsed(self, x: np.ndarray) -> np.ndarray | None:
        """See `Model`, of all arrangements."""
        found = self._of_each(Model.glimpsed, x)
        return None if found is None else self.base.errors.whitened(np.concatenate(found))

    def _of_each(self, of: Callable[[Model, np.ndarray], Any], x: np.ndarray) -> list | None:
        """`of` all arrangements at x (k + t,); None where one is not physical."""
        found = []
        for i, model in enumerate(self.models):
            own = of(model, x) if self.base.having[i] else self.base.without(i, x, of)
            if own is None:
                return None
            found.append(own)
        return found

    def jacobian(self, at: Points) -> np.ndarray:
        """d(prediction)/dx (q, k + t), whitened."""
        return self.base.errors.whitened(self.slopes(at))

    def slopes(self, at: Points) -> np.ndarray:
        """The same, each arrangement whitened by itself alone."""
        return np.vstack([model.jacobian(point) for model, point in zip(self.models, at.points, strict=True)])

    def curvature(self, at: Points) -> np.ndarray | float:
        """See `Model`; errors that arrangements share are left out."""
        return sum(model.curvature(point) for model, point in self.parts(at))

    def parts(self, at: Points) -> list[tuple[Model, Point]]:
        """Model and point of each arrangement."""
        return list(zip(self.models, at.points, strict=True))

    def loosened(self, at: Points, share: float) -> "Together | None":
        """The same as theory errs where the causes are, not without them; None where it errs in no model that several are.

        What it errs in the causes is in the errors that arrangements share.
        """
        modes = self.modes(at) if self.recipes and self.errs_alike else None
        return modes and Together(self.base.erring_as(modes), self.recipes)

    @property
    def errs_alike(self) -> bool:
        """Whether theory errs in several of them by one matrix."""
        return bool(self.base.errors.alike)

    def modes(self, at: Points) -> tuple[Modes, ...] | None:
        """Modes of the models of which theory errs, as the causes have them at a point; None: they are in other models."""
        found = [own.at(*there) for own, there in zip(self.base.errors.modes, self.parts(at), strict=True)]
        return None if None in found else tuple(found)

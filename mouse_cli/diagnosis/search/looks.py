"""A first look at what mechanisms do to a model: all their places and sizes by themselves, those that promise beside others.

What promises beside others is where effects add up, see `superposed` and `centres`.
"""

from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.evidence import capped
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.point import Point
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate, registry
from mouse_cli.diagnosis.search.added_up import Effects
from mouse_cli.diagnosis.search.centres import Centres
from mouse_cli.diagnosis.search.superposed import KEPT, Alone, by_itself, chosen, promised, text
from mouse_cli.dynamics.correlation import mac

_WHOLE = 1024  # places and sizes of one candidate that are looked at beside a centre
_TURNED = 0.95  # MAC of a measured mode with itself, without causes, below which others do not act beside these as by themselves
_NOWHERE = np.zeros(0)


class Looks:
    """A reduced model, and what each candidate can do to it, by itself and beside others.

    known: candidates by key; None: all. kind: of what a model with causes is made, of one structure or of its arrangements. begun:
    the same at the parameters where the search began; None: here. centres: what candidates do by themselves, and beside others.
    finer: the same in all coordinates; None: these are all.
    """

    finer: "Looks | None" = None

    def __init__(
        self,
        model: Reduced,
        known: dict[str, Candidate] | None = None,
        kind: type[Model] = Model,
        begun: "Looks | None" = None,
    ):
        self.model, self.k, self.kind = model, model.L.shape[1], kind
        self.begun = self if begun is None else begun
        self.centres = Centres()
        self.known = {key: one for key, one in registry().items() if not one.between} if known is None else known
        self._made: dict[str, list[Recipe]] = {}
        self._looked: dict[tuple, list[tuple[float, int, np.ndarray]]] = {}
        self._following: dict[tuple, tuple[np.ndarray, np.ndarray]] = {}
        self._cut: dict[tuple, np.ndarray | float] = {}

    @property
    def alone(self) -> dict[str, Alone]:
        """What candidates do by themselves."""
        return self.centres.alone

    def recipes(self, name: str) -> list[Recipe]:
        """What candidate `name` can do, and where; made when first asked for."""
        if name not in self._made:
            candidate = self.known[name]
            made = self.model.recipes(candidate)
            self._made[name] = [replace(recipe, number=i, home=self.model) for i, recipe in enumerate(made)]
        return self._made[name]

    def own(self, recipes: tuple[Recipe, ...]) -> tuple[Recipe, ...]:
        """The same causes at the same places in this model, which may count places otherwise."""
        return tuple(self._same(recipe) for recipe in recipes)

    def _same(self, recipe: Recipe) -> Recipe:
        made, place = self.recipes(recipe.candidate.key), text(recipe)
        order = sorted(made, key=lambda each: each.number != recipe.number)
        return next((each for each in order if text(each) == place), order[0])

    @cached_property
    def effects(self) -> Effects:
        """What all do by themselves, of one place each; asked for when all were looked at."""
        single = {name: {text(each) for each in self.recipes(name) if len(each.parts) < 2} for name in self.alone}
        alone = {name: own for name, one in self.alone.items() if (own := one.of(single[name])).at}
        return Effects(alone, *self._adapted(np.zeros(self.k), ()))

    def looks(self, name: str, before: np.ndarray, beside: tuple[Recipe, ...]) -> list[tuple[float, int, np.ndarray]]:
        """Misfits to be expected, numbers of recipes of candidate `name`, and x to begin from, the most promising first; kept."""
        others = self.own(beside)
        key = _key(name, before, others)
        if key not in self._looked:
            found, seen = [], []
            for recipe, i, at in self._points(name, before, others):
                found.append((self.predicted(at, before, others), recipe.number, at.x))
                seen.append((text(recipe), i, at.residual))
            self._looked[key] = sorted(found, key=lambda item: item[0])
            known = self._centre(before, others)
            none = self.kind(self.model, others).point(before) if seen and known is not None and name not in known else None
            if none is not None:
                known[name] = by_itself(seen, none.residual)
        return self._looked[key]

    def _centre(self, before: np.ndarray, others: tuple[Recipe, ...]) -> dict[str, Alone] | None:
        """What is known where effects add up from, if that is beside `others` that are there `before`."""
        if others:
            return self.begun.centres.at(before, others)
        return None if before.any() else self.alone

    def keep(self, name: str, before: np.ndarray, beside: tuple[Recipe, ...], looks: list, alone: Alone | None) -> None:
        """Looks at a candidate beside others, or none, and what it does there, found by another process."""
        others = self.own(beside)
        self._looked.setdefault(_key(name, before, others), looks)
        known = None if alone is None else self._centre(before, others)
        if known is not None:
            known.setdefault(name, alone)

    def centred(self, before: np.ndarray, beside: tuple[Recipe, ...]) -> bool:
        """Whether effects add up beside these causes, where they are there `before`."""
        return self.begun.centres.at(before, self.own(beside)) is not None

    def beside(self, name: str, before: np.ndarray, beside: tuple[Recipe, ...]) -> Alone | None:
        """What a candidate does beside others, where those are a centre and it was looked at."""
        return (self._centre(before, self.own(beside)) or {}).get(name)

    def _points(self, name: str, before: np.ndarray, others: tuple[Recipe, ...]) -> Iterator[tuple[Recipe, int, Point]]:
        """Recipe, number of the size and point of what candidate `name` does beside `others`, where that is worth a look."""
        worth = self._worth(name, before, others)
        for recipe in self.recipes(name):
            if others and len(recipe.parts) > 1:  # several grow one by one beside others
                continue
            trial, place = self.kind(self.model, (*others, recipe)), text(recipe)
            for i, values in enumerate(recipe.grid):
                if worth is None or (place, i) in worth:
                    at = trial.point(np.concatenate([before, recipe.coordinates(values)]))
                    if at is not None:
                        yield recipe, i, at
            recipe.forget()

    def _worth(self, name: str, before: np.ndarray, others: tuple[Recipe, ...]) -> set[tuple[str, int]] | None:
        """Sites, and numbers of sizes, that are worth a look beside `others`; None: all."""
        count = sum(len(recipe.grid) for recipe in self.recipes(name))
        few = count <= KEPT
        if not others:
            alone = None if before.any() else self._glimpsed(name)
            return None if few or alone is None else chosen(alone, alone.none, before, *self._adapted(before, ()), KEPT)
        centre = self._centre(before, others) is not None
        given = None if few or (centre and count <= _WHOLE) else self._there(name, before, others)
        return None if given is None else chosen(*given, _WHOLE if centre else KEPT)

    def promise(self, name: str, before: np.ndarray, others: tuple[Recipe, ...]) -> float:
        """The misfit that candidate `name` promises beside `others` where effects add up; -inf: that is not known."""
        given = self._there(name, before, self.own(others))
        return -np.inf if given is None else float(promised(*given).min())

    def _there(self, name: str, before: np.ndarray, others: tuple[Recipe, ...]) -> tuple | None:
        """What `promised` asks for, of candidate `name` beside `others`; None without a look at it by itself."""
        self.begun.looks(name, np.zeros(self.k), ())
        trial, alone = self.kind(self.model, others), self.begun.centres.nearest(name, others)
        at = trial.point(before)
        if at is None or alone is None:
            return None
        left = trial.glimpsed(before) if alone.glimpsed else at.residual + self._off(before, others)
        return None if left is None else (alone, left, before[: self.k], *self._adapted(before, others))

    def _glimpsed(self, name: str) -> Alone | None:
        """What a candidate does by itself where modes are close, whose angles cost more to find than the modes; None: none are."""
        bare, none = self.kind(self.model), np.zeros(self.k)
        at = bare.point(none)
        if at is None or not at.turns or not hasattr(bare, "glimpsed"):
            return None
        seen = []
        for recipe in self.recipes(name):
            trial, place = self.kind(self.model, (recipe,)), text(recipe)
            for i, values in enumerate(recipe.grid):
                left = trial.glimpsed(np.concatenate([none, recipe.coordinates(values)]))
                seen += [] if left is None else [(place, i, left)]
            recipe.forget()
        if not seen:
            return None
        self.alone[name] = by_itself(seen, bare.glimpsed(none), glimpsed=True)
        return self.alone[name]

    def turned(self, before: np.ndarray, beside: tuple[Recipe, ...]) -> bool:
        """Whether causes turn a measured mode so far that others do not act beside them as by themselves."""
        shapes = []
        for model, x in ((self.kind(self.model, self.own(beside)), before), (self.kind(self.model), before[: self.k])):
            at = model.point(x)
            if at is None:
                return False
            shapes.append([own.measured(own.X[: each.base.r]) for each, own in model.parts(at)])
        return any((mac(one, other).diagonal() < _TURNED).any() for one, other in zip(*shapes, strict=True))

    def _adapted(self, before: np.ndarray, others: tuple[Recipe, ...]) -> tuple[np.ndarray, np.ndarray]:
        """T (q, k + t), and (T'T + P)^-1 [T', -P] (k + t, q + k): how far the deck's parameters, and t coordinates of the causes
        `others` that are there `before`, follow a residual. P: their prior; coordinates are as wide as their ranges at most.
        """
        key = (before.tobytes(), *((each.candidate.key, each.number) for each in others)) if others else ()
        if key not in self._following:
            model = self.kind(self.model, others)
            at = model.point(before if others else np.zeros(self.k))
            if at is None:
                return self._adapted(np.zeros(self.k), ())
            T = model.jacobian(at)
            H = capped(T.T @ T + np.diag(np.arange(T.shape[1]) < self.k), model.width)
            self._following[key] = T, np.linalg.solve(H, np.hstack([T.T, -np.eye(T.shape[1], self.k)]))
        return self._following[key]

    def predicted(self, at: Point, before: np.ndarray = _NOWHERE, others: tuple[Recipe, ...] = ()) -> float:
        """The misfit that is left of `at` when the deck's parameters, and causes that are there `before`, adapt to first order."""
        T, adapted = self._adapted(before, others)
        residual = at.residual + self._off(before, others)
        step = adapted @ np.concatenate([residual, at.x[: self.k]])
        left, z = residual - T @ step, at.x[: self.k] + step[: self.k]
        return float(left @ left + z @ z)

    def _off(self, before: np.ndarray, others: tuple[Recipe, ...]) -> np.ndarray | float:
        """What all coordinates leave (q,) where causes `others` are there `before`, less what these few leave: beside shear, or a
        flexible support, few coordinates err more than a partner does.
        """
        if self.finer is None:
            return 0.0
        key = (before.tobytes(), *((each.candidate.key, each.number) for each in others))
        if key not in self._cut:
            x = before if others else np.zeros(self.k)
            at, few = self.finer.kind(self.finer.model, self.finer.own(others)).point(x), self.kind(self.model, others).point(x)
            self._cut[key] = _difference(at, few)
        return self._cut[key]


def _difference(at: Point | None, few: Point | None) -> np.ndarray | float:
    """Residual (q,) of a point less that of another, where both are of the same data, pair them alike and turn no modes; else 0."""
    if at is None or few is None or len(at.residual) != len(few.residual) or at.turns or few.turns:
        return 0.0
    return at.residual - few.residual if np.array_equal(at.pairing, few.pairing) else 0.0


def _key(name: str, before: np.ndarray, others: tuple[Recipe, ...]) -> tuple:
    """Of looks at a candidate beside others that are there `before`."""
    return name, before.tobytes(), *((each.candidate.key, each.number) for each in others)

"""What each mechanism can do to a model: a first look at all of its places and sizes, and brief descents from the best."""

from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np

from mouse_cli.diagnosis import gates
from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.evidence import capped
from mouse_cli.diagnosis.likelihoods.modal.lowest import lowest
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.point import Point
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate, registry
from mouse_cli.diagnosis.search.added_up import Effects
from mouse_cli.diagnosis.search.fit import Fit, descended
from mouse_cli.diagnosis.search.optima import BEYOND
from mouse_cli.diagnosis.search.starts import Led, cost, leading, spread, surrounding
from mouse_cli.diagnosis.search.superposed import KEPT, Alone, by_itself, chosen, promised, text
from mouse_cli.dynamics.eigen import IndefiniteError
from mouse_cli.updating.chi_square import upper_tail

_LOOKS, _MOST, BRIEF = 12, 40, 4  # brief descents at least, at most, and their steps
_POOR = 4  # brief descents where no first look is anywhere near what would matter
_ROUNDS, _SURROUNDED, _AROUND = 3, 3, 6  # times that the best ends are surrounded by places, how many of them, and by how many
_WEIGHED = 12  # ends of brief descents that are weighed in all coordinates
MOVED = 5e-3  # share of parameters within which causes weigh alike
_ABOUT = 4  # studies at other parameters that are kept
_NOWHERE = np.zeros(0)
_COARSE = 24  # coordinates at least for a first look


class Study:
    """A reduced model, what each candidate can do to it, and the same at other parameters, where causes weigh otherwise.

    known: candidates by key; None: all. kind: of what a model with causes is made, of one structure or of its arrangements. alone:
    what candidates do by themselves. pool: processes that share the search, of the study that it began with.
    """

    def __init__(
        self,
        model: Reduced,
        known: dict[str, Candidate] | None = None,
        kind: type[Model] = Model,
        begun: "Study | None" = None,
    ):
        self.model, self.k, self.kind = model, model.L.shape[1], kind
        self.begun = self if begun is None else begun  # the same at the parameters where the search began
        self.alone: dict[str, Alone] = {}
        self.pool: Any = None
        self.known = registry() if known is None else known
        self._made: dict[str, list[Recipe]] = {}
        self._about: list[Study] = [self]
        self._looked: dict[tuple, list[tuple[float, int, np.ndarray]]] = {}
        self._following: dict[tuple, tuple[np.ndarray, np.ndarray]] = {}

    def recipes(self, name: str) -> list[Recipe]:
        """What candidate `name` can do, and where; made when first asked for."""
        if name not in self._made:
            candidate = self.known[name]
            made = self.model.recipes(candidate)
            self._made[name] = [replace(recipe, number=i, home=self.model) for i, recipe in enumerate(made)]
        return self._made[name]

    @cached_property
    def coarse(self) -> "Study":
        """The same in few coordinates, in which all places and sizes are looked at before any is fitted.

        Those are the lowest, and how the rest moves when one end of a line, or a spring, softens, which they alone do not.
        """
        model = self.model.looked_at(_lowest)
        if model is self.model:
            return self
        return Study(model, self.known, self.kind, None if self.begun is self else self.begun.coarse)

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
            none = self.kind(self.model).point(before) if seen and not others and not before.any() else None
            if none is not None and name not in self.alone:
                self.alone[name] = by_itself(seen, none.residual)
        return self._looked[key]

    def keep(self, name: str, looks: list[tuple[float, int, np.ndarray]], alone: Alone | None) -> None:
        """Looks at a candidate by itself, and what it does there, found by another process."""
        self._looked.setdefault(_key(name, np.zeros(self.k), ()), looks)
        if alone is not None:
            self.alone.setdefault(name, alone)

    def keep_beside(self, name: str, before: np.ndarray, beside: tuple[Recipe, ...], looks: list) -> None:
        """Looks at a candidate beside others, likewise."""
        self._looked.setdefault(_key(name, before, self.own(beside)), looks)

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
        few = sum(len(recipe.grid) for recipe in self.recipes(name)) <= KEPT
        if not others:
            alone = None if before.any() else self._glimpsed(name)
            return None if few or alone is None else chosen(alone, alone.none, before, *self._adapted(before, ()))
        given = None if few else self._there(name, before, others)
        return None if given is None else chosen(*given)

    def promise(self, name: str, before: np.ndarray, others: tuple[Recipe, ...]) -> float:
        """The misfit that candidate `name` promises beside `others` where effects add up; -inf: that is not known."""
        given = self._there(name, before, self.own(others))
        return -np.inf if given is None else float(promised(*given).min())

    def _there(self, name: str, before: np.ndarray, others: tuple[Recipe, ...]) -> tuple | None:
        """What `promised` asks for, of candidate `name` beside `others`; None without a look at it by itself."""
        self.begun.looks(name, np.zeros(self.k), ())
        trial, alone = self.kind(self.model, others), self.begun.alone.get(name)
        at = trial.point(before)
        if at is None or alone is None:
            return None
        left = trial.glimpsed(before) if alone.glimpsed else at.residual
        return None if left is None else (alone, left, before[: self.k], *self._adapted(before, others))

    def _glimpsed(self, name: str) -> Alone | None:
        """What a candidate does by itself where modes are close, whose angles cost more to find than the modes; None: none are."""
        bare, none = self.kind(self.model), np.zeros(self.k)
        at = bare.point(none)
        if at is None or not at.turns or not isinstance(bare, Model):
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

    def approached(
        self, name: str, before: np.ndarray, beside: tuple[Recipe, ...], reach: float = np.inf
    ) -> list[tuple[float, int, list[np.ndarray]]]:
        """Misfit - 2 ln prior, number of the recipe, x at the end and the start of brief descents, the best first, no two alike.

        reach: misfit from which on none need go on. What a first look finds best may be beside the true place many times over, and
        the true one at a wrong size. Where the first ends show that the cause is idle, the other starts stand for theirs.
        """
        trials = {i: self.with_cause(beside, name, i) for i in range(len(self.recipes(name)))}
        looks = self.looks(name, before, beside)
        most = min(max(_LOOKS, len(trials)), _MOST) // (2 if beside else 1)  # a partner is tried beside many
        most = _POOR if looks and looks[0][0] > BEYOND * reach else most
        chosen = spread([(number, x) for _, number, x in looks], trials, most)
        if len(chosen) < 2:
            return [(0.0, i, [x]) for i, x in chosen]
        led = self._led([], chosen[:_LOOKS], trials, weighed_beside(beside), reach)
        if not beside and led and self.idle(cost(led[0][2]), before):
            promised = {id(x): left - 2 * trials[i].recipes[-1].log_prior for left, i, x in looks}
            ends = [(cost(one), i, [one.point.x, x]) for i, x, one in led]
            return sorted(ends + [(promised[id(x)], i, [x]) for i, x in chosen[_LOOKS:]], key=lambda each: each[0])
        led = self._led(led, chosen[_LOOKS:], trials, weighed_beside(beside), reach)
        begun = {i for i, _ in chosen}
        for _ in range(_ROUNDS if len(begun) < len(trials) else 0):
            near = surrounding(led[:_SURROUNDED], trials, begun, _AROUND, reach)
            if not near:
                break
            led = self._led(led, near, trials, weighed_beside(beside), reach)
            begun |= {i for i, _ in near}
        kept = {id(end) for _, end in spread([(i, one.point.x) for i, _, one in led], trials, most)}
        return [(cost(one), i, [one.point.x, x]) for i, x, one in led if id(one.point.x) in kept]

    def idle(self, least: float, before: np.ndarray) -> bool:
        """Whether the model explains the data as it is, `before`, and a cause that leaves `least` gains less than a name takes."""
        bare = self.kind(self.model)
        at = bare.point(before)
        left = np.inf if at is None else self.predicted(at, before)
        return left - least < 2 * gates.ODDS and upper_tail(left, max(bare.base.data.dof, 1)) > gates.GATE

    def _led(self, led: Led, starts: list[tuple[int, np.ndarray]], trials: dict[int, Model], count: int, reach: float) -> Led:
        """Ends of brief descents, with those from `starts` among them; one that cannot be among the first `count` is given up."""
        for i, x in starts:
            last = cost(led[count - 1][2]) if len(led) >= count else np.inf
            limit = last + 2 * sum(recipe.log_prior for recipe in trials[i].recipes)
            end = descended(trials[i], x[self.k :], x[: self.k], BRIEF, min(reach, limit))
            led = led if end is None else leading(led, (i, x, end))
        return led

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
        step = adapted @ np.concatenate([at.residual, at.x[: self.k]])
        left, z = at.residual - T @ step, at.x[: self.k] + step[: self.k]
        return float(left @ left + z @ z)

    def own(self, recipes: tuple[Recipe, ...]) -> tuple[Recipe, ...]:
        """The same causes at the same places in this model, which may count places otherwise."""
        return tuple(self._same(recipe) for recipe in recipes)

    def _same(self, recipe: Recipe) -> Recipe:
        made, place = self.recipes(recipe.candidate.key), text(recipe)
        order = sorted(made, key=lambda each: each.number != recipe.number)
        return next((each for each in order if text(each) == place), order[0])

    def with_cause(self, others: tuple[Recipe, ...], name: str, number: int) -> Model:
        """The model with the causes `others`, from any study, and recipe `number` of candidate `name`."""
        return self.kind(self.model, (*self.own(others), self.recipes(name)[number]))

    def at(self, one: Fit) -> "Study":
        """The same at the parameters that a fit found, if these are of a structure where its causes can act where they do.

        Far from their prior a member may hold no energy any more; what then has its number is at another place.
        """
        theta = one.model.base.parameters(one.point.x[: self.k])
        try:
            there = Study(self.model.at(theta), self.known, self.kind, self.begun)
            return there if there._knows(one) else self
        except (IndefiniteError, np.linalg.LinAlgError):  # parameters far from their prior: a fit that explains nothing
            return self

    def _knows(self, one: Fit) -> bool:
        """Whether the causes of a fit can act where they do."""
        return all(text(recipe) in map(text, self.recipes(recipe.candidate.key)) for recipe in one.recipes)

    def about(self, one: Fit) -> "Study":
        """The same, or one of the last there were, at parameters from which those of a fit differ by no more than a trifle."""
        theta = one.model.base.parameters(one.point.x[: self.k])
        for study in self._about:
            near = np.all(np.abs(theta - study.model.theta) <= MOVED * np.abs(study.model.theta))
            if near and study._knows(one):
                return study
        self._about = [self, self.at(one), *self._about[1:_ABOUT]]
        return self._about[1]

    def moved(self, theta: np.ndarray) -> "Study":
        """The same at theta (p,), or the one of the last there were that is there."""
        for study in self._about:
            if study.model.theta.tobytes() == theta.tobytes():
                return study
        there = Study(self.model.at(theta), self.known, self.kind, self.begun)
        self._about = [self, there, *self._about[1:_ABOUT]]
        return there


def _key(name: str, before: np.ndarray, others: tuple[Recipe, ...]) -> tuple:
    """Of looks at a candidate beside others that are there `before`."""
    return name, before.tobytes(), *((each.candidate.key, each.number) for each in others)


def _lowest(model: Reduced) -> Reduced:
    """A model in its lowest coordinates, and those by which ends of lines turn and springs soften; or itself."""
    return lowest(model, max(_COARSE, 4 * model.data.m + 8, int(model.data.test.number.max()) + 12))


def weighed_beside(others: tuple) -> int:
    """How many ends of brief descents are weighed in all coordinates, beside causes there already."""
    return _WEIGHED // (2 if others else 1)

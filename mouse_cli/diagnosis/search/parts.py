"""Parts of a search that any process of a pool can do: what is given and found can be handed over."""

from collections.abc import Callable
from dataclasses import dataclass
from math import inf
from typing import Any

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.likelihoods.modal.point import Point
from mouse_cli.diagnosis.search.descents import best, tried
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.diagnosis.search.superposed import Alone

Looks = list[tuple[float, int, np.ndarray]]


@dataclass(frozen=True)
class Beside:
    """Causes that are there: values theta (p,) of the parameters where they are weighed, candidates and recipes, and x."""

    theta: np.ndarray
    causes: tuple[tuple[str, int], ...]
    x: np.ndarray

    @classmethod
    def of(cls, first: Fit, there: Study) -> "Beside":
        """Those of a fit, in the study of its parameters."""
        causes = tuple((recipe.candidate.key, recipe.number) for recipe in there.own(first.recipes))
        return cls(there.model.theta, causes, first.point.x)

    def at(self, study: Study) -> tuple[Study, tuple[Recipe, ...]]:
        """The study there, and the recipes."""
        there = study.moved(self.theta)
        return there, tuple(there.recipes(name)[number] for name, number in self.causes)


@dataclass(frozen=True)
class Found:
    """A fit without its model: the recipe of the last cause, and what `Fit` has of these names."""

    number: int
    point: Point
    misfit: float
    hessian: np.ndarray
    log_evidence: float

    def fit(self, there: Study, others: tuple[Recipe, ...], name: str) -> Fit:
        """The same with its model."""
        model = there.with_cause(others, name, self.number)
        return Fit(model, self.point, self.misfit, self.hessian, self.log_evidence)


def in_turn(
    study: Study,
    task: Callable[..., Any],
    given: list[tuple],
    accept: Callable[[int, Any], None],
    reach: Callable[[int], float] = lambda i: inf,
) -> None:
    """accept(i, task(study, *given[i], reach(i))) for each i in order, by the pool of the study if it has one; see `Pool`."""
    if study.pool is not None:
        study.pool.in_turn(task, given, accept, reach)
        return
    for i, own in enumerate(given):
        accept(i, task(study, *own, reach(i)))


def promising(study: Study) -> list[str]:
    """All candidates, those first that a first look at them alone finds most promising."""
    names, coarse, none = list(study.known), study.coarse, np.zeros(study.k)
    in_turn(study, first_look, [(name,) for name in names], lambda i, seen: learn(study, names[i], *seen))
    looks = {name: coarse.looks(name, none, ()) for name in names}
    for name in names if study.pool is not None else ():
        study.pool.broadcast(learn, name, looks[name], coarse.alone.get(name))
    return sorted(names, key=lambda name: looks[name][0][0] if looks[name] else np.inf)


def first_look(study: Study, name: str, reach: float) -> tuple[Looks, Alone | None]:
    """What a candidate does by itself, at all of its places and sizes."""
    coarse = study.coarse
    return coarse.looks(name, np.zeros(study.k), ()), coarse.alone.get(name)


def learn(study: Study, name: str, looks: Looks, alone: Alone | None) -> None:
    """Keep what a first look found."""
    study.coarse.keep(name, np.zeros(study.k), (), looks, alone)


def single(study: Study, name: str, reach: float) -> Fit | None:
    """The most probable fit of a candidate by itself."""
    return best(study, name, reach)


def centre(study: Study, beside: Beside) -> None:
    """From here on effects add up beside these causes."""
    there, own = beside.at(study)
    there.coarse.begun.centres.add(beside.x, own)


def look_beside(study: Study, beside: Beside, name: str, reach: float) -> tuple[Looks, Alone | None]:
    """What a candidate does beside causes that are there; all of it, if these are a centre."""
    there, own = beside.at(study)
    return there.coarse.looks(name, beside.x, own), there.coarse.beside(name, beside.x, own)


def learn_beside(study: Study, beside: Beside, name: str, looks: Looks, alone: Alone | None) -> None:
    """Keep what a look beside others found."""
    there, own = beside.at(study)
    there.coarse.keep(name, beside.x, own, looks, alone)


def partner(study: Study, beside: Beside, name: str, count: int, most: int, reach: float) -> list[Found]:
    """Fits of a candidate beside causes that are there."""
    there, own = beside.at(study)
    fits, _ = tried(there, name, own, beside.x, count, most, reach)
    return [Found(one.recipes[-1].number, one.point, one.misfit, one.hessian, one.log_evidence) for one in fits]

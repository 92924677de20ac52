"""What each mechanism can do to a model: brief descents from what a first look finds best, at any parameters of the deck."""

from functools import cached_property
from typing import Any

import numpy as np

from mouse_cli.diagnosis import gates
from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.likelihoods.modal.lowest import lowest
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.search.fit import Fit, descended
from mouse_cli.diagnosis.search.looks import Looks
from mouse_cli.diagnosis.search.optima import BEYOND
from mouse_cli.diagnosis.search.starts import Led, cost, leading, spread, surrounding
from mouse_cli.diagnosis.search.superposed import text
from mouse_cli.dynamics.eigen import IndefiniteError
from mouse_cli.updating.chi_square import upper_tail

_LOOKS, _MOST, BRIEF = 12, 40, 4  # brief descents at least, at most, and their steps
_POOR = 4  # brief descents where no first look is anywhere near what would matter
_ROUNDS, _SURROUNDED, _AROUND = 3, 3, 6  # times that the best ends are surrounded by places, how many of them, and by how many
_WEIGHED = 12  # ends of brief descents that are weighed in all coordinates
MOVED = 5e-3  # share of parameters within which causes weigh alike
_ABOUT = 4  # studies at other parameters that are kept
_COARSE = 24  # coordinates at least for a first look


class Study(Looks):
    """A reduced model, what each candidate can do to it, and the same at other parameters, where causes weigh otherwise.

    pool: processes that share the search, of the study that it began with.
    """

    pool: Any = None

    @cached_property
    def _about(self) -> "list[Study]":
        """This one, and the last at other parameters."""
        return [self]

    @cached_property
    def coarse(self) -> "Study":
        """The same in few coordinates, in which all places and sizes are looked at before any is fitted.

        Those are the lowest, and how the rest moves when one end of a line, or a spring, softens, which they alone do not.
        """
        model = self.model.looked_at(_lowest)
        if model is self.model:
            return self
        few = Study(model, self.known, self.kind, None if self.begun is self else self.begun.coarse)
        few.finer = self
        return few

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

    def judged_by(self, data) -> "Study":
        """The same by errors that theory has with what leads in it; what was looked at is of others."""
        there = Study(self.model.judged_by(data), self.known, self.kind)
        there.pool = self.pool and self.pool.judged_by(there, data)
        return there

    def about(self, one: Fit) -> "Study":
        """The same at parameters from which those of a fit differ by no more than a trifle.

        The nearest on a grid, whatever was asked before, so that all processes of a pool weigh causes alike; 0 is near to nothing
        else: a mass or stiffness that is small is none that vanishes.
        """
        theta, here = one.model.base.parameters(one.point.x[: self.k]), self.model.theta
        step = 2 * MOVED * np.abs(here)
        steps = np.rint(np.divide(theta - here, step, out=np.zeros_like(step), where=step > 0))
        near = here + steps * step
        near = np.where((step > 0) & (near * theta > 0), near, theta)
        try:
            there = self.moved(near)
        except (IndefiniteError, np.linalg.LinAlgError):
            return self.at(one)
        return there if there._knows(one) else self.at(one)

    def moved(self, theta: np.ndarray) -> "Study":
        """The same at theta (p,), or the one of the last there were that is there."""
        for study in self._about:
            if study.model.theta.tobytes() == theta.tobytes():
                return study
        there = Study(self.model.at(theta), self.known, self.kind, self.begun)
        self._about = [self, there, *self._about[1:_ABOUT]]
        return there


def _lowest(model: Reduced) -> Reduced:
    """A model in its lowest coordinates, and those by which ends of lines turn and springs soften; or itself."""
    return lowest(model, max(_COARSE, 4 * model.data.m + 8, int(model.data.test.number.max()) + 12))


def weighed_beside(others: tuple) -> int:
    """How many ends of brief descents are weighed in all coordinates, beside causes there already."""
    return _WEIGHED // (2 if others else 1)

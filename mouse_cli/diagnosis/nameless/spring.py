"""A spring that no mechanism of the library is: between two distant places, or against the turning of one."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.matrices import of_matrices, with_tie
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest, total_mass
from mouse_cli.diagnosis.localise.force import matched
from mouse_cli.diagnosis.localise.matching import shapes
from mouse_cli.diagnosis.nameless import Nameless
from mouse_cli.diagnosis.nameless._averaged import averaged
from mouse_cli.diagnosis.nameless._cells import Cells
from mouse_cli.diagnosis.nameless._correlated import extent
from mouse_cli.diagnosis.nameless._ends import Ends, Spring, around, springs
from mouse_cli.diagnosis.nameless._field import Smooth
from mouse_cli.diagnosis.nameless._tied import tied
from mouse_cli.diagnosis.search.fit import Fit, fit
from mouse_cli.diagnosis.search.optima import NEAR, within
from mouse_cli.model.diagnosis import FORCE
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.problem import Problem

_FITTED, _FOLLOWED = 16, 3  # springs that are fitted at nodes, and of which ends beside theirs are tried
_CLOSEST = 6  # of these ends that are fitted
_STEPS = 25  # of a fit
_GAINED = 10.0  # by which the misfit may fall, at most, where ends are beside nodes
_SIZES = 10.0 ** np.arange(-2.0, 2.5, 0.5)  # stiffnesses to begin from, in their unit


@dataclass(frozen=True)
class _Tried:
    """The fit of a spring, and ln of its prior among all."""

    fit: Fit
    prior: float
    spring: Spring

    @property
    def weight(self) -> float:
        """ln of both."""
        return self.fit.log_evidence + self.prior


def best_spring(model: Reduced, reach: float = np.inf) -> Fit | None:
    """The fit of the spring that the data make the most probable, all places and spreads integrated out.

    Springs are put in order by the shapes that they would make, whatever their stiffness; the first are fitted, then those that
    end beside the best of them. None where no shapes tell them apart. reach: misfit above which no fit matters.
    """
    found = _beside(model, _at_nodes(model, _GAINED * reach), reach)
    if not found:
        return None
    first = max(found, key=lambda each: each.weight)
    z = first.fit.point.x[: model.L.shape[1]]
    fits = [one for one in (_at(model, first.spring, s, z) for s in NAMELESS.spreads) if one is not None]
    spreads = np.logaddexp.reduce([one.log_evidence for one in fits]) - np.log(len(NAMELESS.spreads))
    total = np.logaddexp.reduce([each.weight for each in found]) + spreads - first.fit.log_evidence
    here = max(fits, key=lambda one: one.log_evidence)
    fits = [here if each is first else each.fit for each in found]
    return averaged(fits, [each.weight for each in found], float(total + np.log(2)))  # b and -b are the same


def _at_nodes(model: Reduced, reach: float) -> list[_Tried]:
    measured, every = shapes(model), list(springs(model))
    if measured.dof < 1 or not len(measured.modes) or not every:
        return []
    prior = _log_prior(every)
    matches = matched(model, measured, np.stack([_row(each) for each in every]))
    order = np.argsort(matches.cost + matches.volume() - 2 * prior, kind="stable")[:_FITTED]
    return _fitted(model, [(every[i], float(prior[i]), matches.z[i]) for i in order], reach)


def _beside(model: Reduced, found: list[_Tried], reach: float) -> list[_Tried]:
    """The springs of `found`, the best of them with ends at the places beside theirs too, which share their prior.

    Those that match the shapes best are fitted; the evidence of others differs by what their shapes do, as in `local.best_law`.
    """
    found, near = sorted(found, key=lambda each: -each.weight), []
    for each in found[:_FOLLOWED]:
        ends, own = each.spring
        places = [around(model, ends, i) for i in own]
        choices = product(*(range(len(one.sites)) for one in places))
        some = [_joined(zip(places, chosen, strict=True)) for chosen in choices]
        matches = matched(model, shapes(model), np.stack([_row(one) for one in some]))
        score = -0.5 * (matches.cost + matches.volume())
        first = np.argsort(-score, kind="stable")[:_CLOSEST]
        others = np.logaddexp.reduce(score) - np.logaddexp.reduce(score[first])
        prior = each.prior - float(np.log(len(some)) - others)
        z = each.fit.point.x[: model.L.shape[1]]
        near += [(some[i], prior, z) for i in first]
    return _fitted(model, near, reach) + [each for each in found[_FOLLOWED:] if each.fit.misfit < reach]


def _joined(chosen: Iterable[tuple[Ends, int]]) -> Spring:
    """The spring that ends at one of each of several places."""
    ends = [one.some(np.array([i])) for one, i in chosen]
    rows, at, numbers = (np.concatenate([getattr(one, name) for one in ends]) for name in ("rows", "at", "numbers"))
    sites = tuple(site for one in ends for site in one.sites)
    return Ends(sites, rows, at, numbers, ends[0].direction), tuple(range(len(sites)))


def _fitted(model: Reduced, chosen: list[tuple[Spring, float, np.ndarray]], reach: float) -> list[_Tried]:
    """Those springs with their ln prior, from parameters z, at a spread of one, that misfit less than `reach`."""
    found: list[_Tried] = []
    for spring, prior, z in chosen:
        one = _at(model, spring, 1.0, z, min(reach, within([each.fit for each in found], NEAR) if found else reach))
        found += [] if one is None or one.misfit >= reach else [_Tried(one, prior, spring)]
    return found


def _log_prior(every: list[Spring]) -> np.ndarray:
    """ln of what is held likely of each: half of it for those between two places, if there are others too."""
    two = np.array([len(own) == 2 for _, own in every])
    kinds = len(set(two.tolist()))
    return -np.log(kinds * np.where(two, two.sum(), (~two).sum()))


def _row(spring: Spring) -> np.ndarray:
    """Motion (r,) that it resists."""
    ends, own = spring
    return np.array([1.0, -1.0])[: len(own)] @ ends.rows[list(own)]


def _at(model: Reduced, spring: Spring, spread: float, z: np.ndarray, reach: float = np.inf) -> Fit | None:
    """The fit of one spring with that spread, from parameters z (k,) and the stiffness that suits them; reach: as above."""
    ends, own = spring[0].some(np.array(spring[1])), len(spring[1])
    unit = np.sqrt(lowest(model) * total_mass(model))
    unit *= extent(model.problem.mesh.coordinates) if ends.turns and model.problem.mesh is not None else 1.0
    blocks = tuple((row[None], np.array([[unit**2]])) for row in ends.rows)
    cells = Cells(ends.sites, ends.at, "m", blocks, "K", _extend(model, ends, unit))
    rival = NAMELESS if own == 2 else replace(NAMELESS, even="")
    P = spread * np.array([[1.0], [-1.0]])[:own]
    trial = Model(tied(model, Smooth(rival, cells, P, spread, 0.0, 1), cells))
    starts = [trial.point(np.append(z, np.sqrt(k) / spread)) for k in _SIZES]
    starts = [at for at in starts if at is not None]
    if not starts:
        return None
    return fit(trial, np.zeros(0), min(starts, key=lambda at: at.chi2 + at.x @ at.x).x, _STEPS, reach)


def _extend(model: Reduced, ends: Ends, unit: float) -> Callable[..., Problem] | None:
    """The deck with the spring in it, its stiffness a parameter; None where the coordinates leave out some of its flexibility."""
    if model.V.shape[1] < model.V.shape[0]:
        return None

    def extend(problem: Problem, values: np.ndarray, spread: float, sign: int) -> Problem:
        if of_matrices(problem):
            return with_tie(problem, ends.numbers, unit * values, sign)
        edit, direction = Edit(problem), DIRECTIONS[ends.direction]
        nodes = [_node(edit, site) for site in ends.sites]
        spring = edit.add("spring", [nodes], {direction: (unit * values[0]) ** 2})
        edit.bind("spring that has no name", spring, (direction,), unit="N m/rad" if ends.turns else "N/m")
        return edit.done()

    return extend


def _node(edit: Edit, site) -> int:
    """The node at a site; of a place along a bar a new one."""
    if site.kind == "node":
        return edit.index(site.ids[0])
    element = edit.element(site.ids[0])
    a, b = (edit.coordinates[n] for n in edit.sets[element[0]].nodes[element[1]])
    return edit.split(element, float((np.array(site.position) - a) @ (b - a) / ((b - a) @ (b - a))))


NAMELESS = Nameless(
    "spring",
    "a spring between two places, or against a turn",
    FORCE,
    "one spring between any two places that move in one direction and that nothing joins, or one that resists the turning of one "
    "place; its places and its spread are integrated out (a strut to a distant part, an outrigger)",
    (0.3, 1.0, 3.0, 10.0),
    lambda model: None,
    even="brace",
)

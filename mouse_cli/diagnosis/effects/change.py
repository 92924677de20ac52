"""What a cause does to a model: changes of K, M and of what sensors read, in the coordinates of the reduced model."""

from bisect import bisect_right
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import inf, nextafter
from typing import Any

import numpy as np

from mouse_cli.dynamics.sensing import read
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.diagnosis import EVERYWHERE, Site
from mouse_cli.model.held_reading import HeldReading
from mouse_cli.model.problem import Problem
from mouse_cli.model.unknown import Unknown

PLACE = "place"  # name of an unknown that is a distance along a line of bars, m
LOST = "share lost"  # name of one that is a share of what a part gives


@dataclass(frozen=True)
class Softening:
    """Bars (c,), none twice, softened by what is added to their flexibility (c, 3, 3), or to that in bending alone (c, 2, 2).

    Several causes add up in one bar. residual (c, 3, 3): strains of each that forces in it make beyond the coordinates; None: none.
    lost (c, 3, 3): change of their stiffness by this cause alone, where that is known already.
    """

    bars: np.ndarray
    added: np.ndarray
    residual: np.ndarray | None = None
    lost: np.ndarray | None = None

    def __post_init__(self) -> None:
        given = self.added
        if given.shape[1] < 3:
            added = np.zeros((len(given), 3, 3))
            added[:, : given.shape[1], : given.shape[1]] = given
            object.__setattr__(self, "added", added)


def residual(parts: list[Softening], bars: np.ndarray) -> np.ndarray | None:
    """That of `bars` (c,), sorted, of which `parts` are; None where they have none."""
    if all(part.residual is None for part in parts):
        return None
    found = np.zeros((len(bars), 3, 3))
    for part in parts:
        if part.residual is not None:
            found[np.searchsorted(bars, part.bars)] = part.residual
    return found if found.any() else None


def effective_loss(lost: np.ndarray, residual: np.ndarray) -> np.ndarray:
    """What coordinates feel (..., 3, 3) of stiffness that bars lose, see `sites/residual.py`."""
    return lost @ np.linalg.inv(np.eye(3) + residual @ lost)


@dataclass(frozen=True)
class Change:
    """K, M, C, D (r + a, r + a) that are added, a degrees of freedom of the mechanism's own behind the r of the model; None: none.

    C is viscous damping, D structural, K times a loss factor: both are felt by functions alone. spring: stiffness of the part that
    may lose energy by a law of its own; None: what is added.

    sensing (s, r + a): added to what the sensors read. softening: of bars, when stiffness is lost in series.
    """

    K: np.ndarray | None = None
    M: np.ndarray | None = None
    sensing: np.ndarray | None = None
    softening: Softening | None = None
    C: np.ndarray | None = None
    D: np.ndarray | None = None
    spring: np.ndarray | None = None


def summed(changes: list[Change]) -> Change:
    """Changes of M, and of bars that differ, as one."""
    if len(changes) == 1:
        return changes[0]
    parts = [change.softening for change in changes]
    fields = {name: [getattr(part, name) for part in parts] for name in ("bars", "added", "residual", "lost")}
    joined = {name: None if any(each is None for each in own) else np.concatenate(own) for name, own in fields.items()}
    return Change(M=sum(change.M for change in changes), softening=Softening(**joined))


@dataclass(frozen=True)
class Carried:
    """Motion (r, a) of the model with a degrees of freedom of a cause's own; of all n free then (n, a), and K, M times it.

    deck: which of those n the degrees of freedom of the deck are. every: what the deck's parameters, d directions, add to K and M
    of the cause (d, r + a, r + a), or of several, whose rows `own` are of this one; across(motion (n, b)): to K and M between that
    motion and this one (d, b, a). strain (b, 3, a): natural strains of the bars in it. place: of the n by label.
    """

    model: np.ndarray
    whole: np.ndarray
    K: np.ndarray
    M: np.ndarray
    deck: np.ndarray
    every: tuple[np.ndarray, np.ndarray]
    across: Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]
    strain: np.ndarray
    own: np.ndarray | None = None
    place: Mapping[str, int] = field(default_factory=dict)

    def read(self, sensing: Matrix, names: tuple[str, ...], held: tuple[HeldReading, ...]) -> np.ndarray:
        """What sensors of the deck, `sensing`, read of the motion (s, a), those where supports held it too, by their names."""
        found = np.array(read(sensing, self.whole[self.deck]))
        for each in held:
            if each.sensor in names and each.label in self.place:
                found[names.index(each.sensor)] += each.weight * self.whole[self.place[each.label]]
        return found

    @property
    def slopes(self) -> tuple[np.ndarray, np.ndarray]:
        """`every`, of this cause alone."""
        return self.every if self.own is None else tuple(each[:, self.own[:, None], self.own] for each in self.every)

    def part(self, which: list[int], r: int) -> "Carried":
        """What a part of the degrees of freedom carries along, of a model of r coordinates."""
        own = [getattr(self, name)[:, which] for name in ("model", "whole", "K", "M")]
        at = np.concatenate([np.arange(r), r + np.array(which)])
        across = lambda other: tuple(each[..., which] for each in self.across(other))
        rows = at if self.own is None else self.own[at]
        return Carried(*own, self.deck, self.every, across, self.strain[..., which], rows, self.place)


@dataclass(frozen=True)
class Recipe:
    """A candidate at a place, or along a line of them when the place is an unknown.

    change(values), site(values): what it does, and where, for values (t,) of the unknowns. own: degrees of freedom of its own.
    grid (g, t): values to begin from; starts: those (t,) that a screening found. log_prior: ln of the share of the candidate's
    prior that this place has; seldom: of it, ln of how seldom such a thing is, wherever it is. extend(problem, values): the deck
    with the cause in it. number: which of its candidate's recipes it is. carried: how degrees of freedom of its own move the model
    along, which other causes see. law: how its spring loses energy, see `frf/lossy.py`.
    limit(values): group that it cannot be told from at such values, the end of their range; empty: none, its candidate's own.
    jumps: coordinates, in order, at which the matrices jump, by number of the unknown; there the piece after it begins.
    parts: names of several things, each with as many of the unknowns in turn, of which there are recipes with fewer; empty: none.
    dofs: labels of the degrees of freedom that it acts in, one an unknown, of which there are recipes with fewer; empty: none.
    title(values): how it is called at such values; empty: as its candidate is.
    linear: number of an unknown to which all that it adds is proportional; None: there is none.
    home: the model that it was made for. grows: how K and M that it adds grow with each parameter of the deck (p,), over what they
    are at those of its model; None: they do not.
    """

    candidate: Any
    unknowns: tuple[Unknown, ...]
    change: Callable[[np.ndarray], Change]
    grid: np.ndarray
    site: Callable[[np.ndarray], Site] = lambda values: EVERYWHERE
    own: int = 0
    log_prior: float = 0.0
    extend: Callable[[Problem, np.ndarray], Problem] | None = None
    number: int = 0
    carried: Carried | None = None
    law: str = ""
    limit: Callable[[np.ndarray], str] = lambda values: ""
    title: Callable[[np.ndarray], str] = lambda values: ""
    jumps: dict[int, np.ndarray] = field(default_factory=dict, repr=False)
    starts: tuple[np.ndarray, ...] = ()
    parts: tuple[str, ...] = ()
    dofs: tuple[str, ...] = ()
    linear: int | None = None
    home: Any = field(default=None, repr=False, compare=False)
    grows: tuple[np.ndarray, np.ndarray] | None = field(default=None, repr=False, compare=False)
    seldom: float = 0.0
    _last: dict[bytes, Change] = field(default_factory=dict, init=False, repr=False, compare=False)

    def at(self, coordinates: np.ndarray) -> Change:
        """What it does at coordinates (t,); the last one is kept, as other causes beside it are looked at."""
        key = coordinates.tobytes()
        if key not in self._last:
            found = self.change(self.values(coordinates))
            self._last.clear()
            self._last[key] = found
        return self._last[key]

    def forget(self) -> None:
        """Nothing is kept: matrices of thousands of sites that are looked at once would fill the memory."""
        self._last.clear()

    def grown(self, change: Change, moved: np.ndarray) -> Change:
        """A change of it where the deck's parameters have moved by `moved` (p,)."""
        if self.grows is None or not moved.any():
            return change
        K, M = (
            None if m is None else (1 + g @ moved) * m for g, m in zip(self.grows, (change.K, change.M), strict=True)
        )
        return replace(change, K=K, M=M)

    def group(self, coordinates: np.ndarray) -> str:
        """Group of mechanisms that it belongs to at coordinates (t,)."""
        return self.limit(self.values(coordinates)) or self.candidate.group

    def values(self, coordinates: np.ndarray) -> np.ndarray:
        """Values (t,) at coordinates (t,)."""
        return np.array([u.value(c) for u, c in zip(self.unknowns, coordinates, strict=True)])

    def coordinates(self, values: np.ndarray) -> np.ndarray:
        """Coordinates (t,) of values (t,)."""
        return np.array([np.log(v) if u.log else v for u, v in zip(self.unknowns, values, strict=True)])

    @cached_property
    def _pieces(self) -> dict[int, list[float]]:
        """Where the matrices jump, by number of the unknown, between both ends of the world."""
        return {j: [-inf, *at.tolist(), inf] for j, at in self.jumps.items()}

    @cached_property
    def bounds(self) -> np.ndarray:
        """Ranges (t, 2) of the coordinates."""
        return np.array([u.bounds for u in self.unknowns]).reshape(-1, 2)

    def rate(self, j: int, coordinate: float, step: float) -> list[tuple[float, float]]:
        """As `slope`, of the matrices: those that are proportional to unknown j are their own derivative by its logarithm."""
        log = self.unknowns[j].log
        if j == self.linear and (log or coordinate):
            return [(coordinate, 1.0 if log else 1 / coordinate)]
        return self.slope(j, coordinate, step)

    def slope(self, j: int, coordinate: float, step: float) -> list[tuple[float, float]]:
        """Coordinates of unknown j, and weights of what is there, whose sum is the derivative to second order.

        Central; one-sided, (-3 f0 + 4 f1 - f2) / 2 h, where a step would leave the range or cross a jump.
        """
        ends = self._pieces.get(j, (-inf, inf))
        i = bisect_right(ends, coordinate)
        lower, upper = self.unknowns[j].bounds
        low, high = max(lower, ends[i - 1]), min(upper, nextafter(ends[i], -inf))
        if low <= coordinate - step and coordinate + step <= high:
            return [(coordinate + step, 0.5 / step), (coordinate - step, -0.5 / step)]
        h = step if coordinate + 2 * step <= high else -step
        return [(coordinate, -1.5 / h), (coordinate + h, 2 / h), (coordinate + 2 * h, -0.5 / h)]


def outer(rows: np.ndarray, core: np.ndarray) -> np.ndarray:
    """sum over b of rows_b' core_b rows_b (r, r), for rows (b, c, r) and symmetric core (b, c, c)."""
    loads = np.einsum("bij,bjr->bir", core, rows)
    return rows.reshape(-1, rows.shape[-1]).T @ loads.reshape(-1, rows.shape[-1])


def steps(unknown: Unknown, count: int) -> np.ndarray:
    """`count` values inside the range, evenly spaced in the coordinate."""
    lower, upper = unknown.bounds
    at = lower + (np.arange(count) + 0.5) / count * (upper - lower)
    return np.exp(at) if unknown.log else at


def product(*axes: np.ndarray) -> np.ndarray:
    """All combinations (g, t) of values along t axes."""
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(axes))


def proportional(
    candidate: Any,
    unknown: Unknown,
    starts: int,
    site: Site | Callable[[np.ndarray], Site],
    log_prior: float,
    extend: Callable[[Problem, np.ndarray], Problem],
    K: np.ndarray | None = None,
    M: np.ndarray | None = None,
) -> Recipe:
    """A recipe in one unknown that adds K and M (r, r) in proportion to it; begun from `starts` values in its range."""
    change = lambda values: Change(*(None if each is None else values[0] * each for each in (K, M)))
    where = (lambda values: site) if isinstance(site, Site) else site
    grid = steps(unknown, starts)[:, None]
    return Recipe(candidate, (unknown,), change, grid, where, log_prior=log_prior, extend=extend, linear=0)

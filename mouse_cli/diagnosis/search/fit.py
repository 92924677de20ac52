"""Most probable parameters of the deck and of causes that are added to it, and the evidence for those causes.

x = [z, c]: the deck's parameters in prior standard deviations, N(0, 1), and coordinates of the causes, uniform in their ranges.
C = |residual|^2 + |z|^2 is lowered by Levenberg-Marquardt steps within the ranges, one exact eigensolution a step; the evidence is
that of `evidence.laplace` at the end.
"""

from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from mouse_cli.diagnosis.effects.change import PLACE, Recipe
from mouse_cli.diagnosis.evidence import at_ends, laplace, root
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.point import Point
from mouse_cli.model.site import Site

_SMALL = 1e-4  # change of J, relative to 1 + its share of rounding, that ends the search
_TRIFLE = 1e-5  # of that: what a step promises, below which no shorter one is tried: rounding undoes it
_NOTHING = 0.1  # of that: where a full step promises no more, the search is at its end
MOST = 40
_GIVE_UP = 1e8
_SHORTER = 0.25  # squared length of a step over that of one that was refused, at most
_GOOD, _BAD = 0.75, 0.25  # share of the promised gain above which a step may be longer, below which it has to be shorter
_HOPE = 4.0  # times the gain that a full step promises: what a search may gain at most, unless it gains more
# Steps before a search may be given up (of a brief one a third), and that may gain as the last one did
_LEAST, _AHEAD = 3, 8


@dataclass(frozen=True)
class End:
    """Where a search ended. misfit = chi2 + |z|^2."""

    model: Model
    point: Point
    misfit: float

    @property
    def recipes(self) -> tuple[Recipe, ...]:
        """The causes."""
        return self.model.recipes

    @property
    def c(self) -> np.ndarray:
        """Coordinates of the causes."""
        return self.point.x[self.model.k :]

    @property
    def sites(self) -> tuple[Site, ...]:
        """Where they act."""
        pairs = zip(self.recipes, self.model.own, strict=True)
        return tuple(recipe.site(recipe.values(self.c[own])) for recipe, own in pairs)

    @property
    def groups(self) -> list[str]:
        """Groups of the causes, each where the search left it."""
        return [recipe.group(self.c[own]) for recipe, own in zip(self.recipes, self.model.own, strict=True)]


@dataclass(frozen=True)
class Fit(End):
    """The end of a search, weighed. hessian (k + t, k + t) of half the misfit by x; log_evidence.

    elsewhere: the same causes at other places, and their share in the evidence; variants: likewise a rival without a name with
    other spreads, lengths or places. taken: groups of its causes, where a more probable fit has one of them in another form.
    """

    hessian: np.ndarray = field(repr=False)
    log_evidence: float
    elsewhere: tuple[tuple["Fit", float], ...] = ()
    variants: tuple[tuple["Fit", float], ...] = ()
    taken: tuple[str, ...] = ()
    bearable: ClassVar[float] = 1.5  # misfit over degrees of freedom above which no explanation is one
    telling: ClassVar[bool] = False  # so many data that evidence alone says whether something is missing

    @property
    def groups(self) -> list[str]:
        """Groups of the causes."""
        return list(self.taken) or super().groups

    @property
    def strained(self) -> bool:
        """Whether parameters are further from their priors than chance allows, where the misfit cannot tell."""
        return False

    @property
    def errs_alike(self) -> bool:
        """Whether theory errs in several arrangements alike, by what depends on the mechanisms in them."""
        return getattr(self.model, "errs_alike", False)

    @property
    def nameless(self):
        """The field that the model has, a rival without a name; None: there is none."""
        return getattr(self.model.base, "nameless", None)

    @property
    def data(self):
        """The test that it is fitted to."""
        return self.model.base.data

    @property
    def dof(self) -> int:
        """Degrees of freedom that the misfit has when the model is right."""
        return self.model.base.data.dof - self.model.t - round(self.point.free)

    def idle(self, noise: float) -> float:
        """How many unknowns of its causes, in effect, the data leave to their ranges where all variances are `noise` times."""
        k, width = self.model.k, self.model.width
        prior = np.diag((np.arange(len(self.hessian)) < k).astype(float))
        open_by = root((self.hessian - prior) / noise + prior, width)[k:]
        return float(((open_by**2).sum(axis=1) * 2 * np.pi / width**2).sum())

    @property
    def by_itself(self) -> float:
        """Its log evidence without that of other places."""
        return _evidence(self, self.hessian) - self.point.nats

    @property
    def log_places(self) -> float:
        """ln of how many places its causes could be at for each that the data leave: by their prior, and of a place along a line by
        its range over its sd.
        """
        sd = np.sqrt(np.abs(np.diag(self.covariance)))[self.model.k :]
        found = sum(recipe.seldom - recipe.log_prior for recipe in self.recipes)
        for recipe, own in zip(self.recipes, self.model.own, strict=True):
            for unknown, s, width in zip(recipe.unknowns, sd[own], self.model.width[own], strict=True):
                if unknown.name == PLACE:
                    found += max(0.0, float(np.log(width / (np.sqrt(2 * np.pi) * s))))
        return float(found)

    @property
    def root(self) -> np.ndarray:
        """Root B (k + t, k + t) of the covariance B B' of x, unknowns that the data do not feel as wide as their range."""
        return root(self.hessian, self.model.width)

    @property
    def covariance(self) -> np.ndarray:
        """Of x (k + t, k + t)."""
        return self.root @ self.root.T


def fit(
    model: Model, c: np.ndarray, z: np.ndarray | None = None, most: int = MOST, reach: float = np.inf
) -> Fit | None:
    """The most probable x, weighed; None likewise where its evidence is no number. See `descended`."""
    end, H = _lowered(model, c, z, most, reach)
    if end is None:
        return None
    H = normal(model, end.point)[0] if H is None else H
    found = Fit(model, end.point, end.misfit, H, _evidence(end, H) - end.point.nats)
    return found if np.isfinite(found.log_evidence) else None


def descended(
    model: Model, c: np.ndarray, z: np.ndarray | None = None, most: int = MOST, reach: float = np.inf
) -> End | None:
    """The most probable x, from coordinates c (t,) of the causes and z (k,) on; None where the model is not physical there.

    most: steps; reach: a misfit above which no fit matters: the search is given up where it will not come so low, neither by what
    a full step promises nor by going on to gain as it did. Far from an optimum the first alone says little.
    """
    return _lowered(model, c, z, most, reach)[0]


def _lowered(model: Model, c: np.ndarray, z: np.ndarray | None, most: int, reach: float) -> tuple[End | None, np.ndarray | None]:
    """See `descended`; and H, see `normal`, of where it ended if that is known."""
    k, known = model.k, None
    lower, upper = np.hstack([np.full((2, k), [[-np.inf], [np.inf]]), model.bounds.T])
    at = model.point(np.clip(np.concatenate([model.base.z if z is None else z, c]), lower, upper))
    if at is None:
        return None, None
    damping, scale, gained = 1e-3, np.concatenate([np.ones(k), 1 / model.width**2]), np.inf
    for step_number in range(most):
        J, (known, slope) = cost_at(at, k), normal(model, at)
        H = known + model.curvature(at)
        step = lambda damped, H=H, slope=slope, x=at.x: _step(H, slope, damped, scale, x, lower, upper)
        hope = min(_AHEAD, most - step_number) * gained if step_number >= min(_LEAST, most // 3) else np.inf
        full = float(slope @ step(1e-6))
        if full < _NOTHING * _small(J) or (J - hope > reach and J - _HOPE * full > reach):
            break
        there, damping = _lower(model, at, H, slope, step, damping, (lower, upper))
        if there is None:
            break
        gained, at, known = J - cost_at(there, k), there, None
        if gained < _small(J - gained):
            break
    return End(model, at, cost_at(at, k)), known


def _lower(model: Model, at: Point, H, slope, step, damping: float, limits: tuple) -> tuple[Point | None, float]:
    """The point after a damped step that misfits no more, None where there is none, and the damping of the next.

    That follows the share of the promised gain that a step had; one that is refused is followed by a much shorter one
    (Nocedal and Wright, Numerical Optimization, 2006, algorithm 4.1), for less damping than slopes have changes nothing.
    """
    k, J = model.k, cost_at(at, model.k)
    promised, longest = np.inf, np.inf
    while damping < _GIVE_UP and promised > _TRIFLE * _small(J):
        p = step(damping)
        length = float(H.diagonal() @ p**2)
        if length <= longest:
            promised, longest = float(slope @ p), _SHORTER * length
            there = model.point(np.clip(at.x + p, *limits))
            gained = -np.inf if there is None else J - cost_at(there, k)
            if gained >= 0:
                share = gained / max(2 * promised - float(p @ H @ p), 1e-300)
                return there, max(damping * (1 / 8 if share > _GOOD else 1 if share > _BAD else 3), 1e-9)
        damping *= 6
    return None, damping


def _small(J: float) -> float:
    """Change of J that ends the search."""
    return _SMALL * (1 + 1e-3 * J)


def normal(model: Model, at: Point) -> tuple[np.ndarray, np.ndarray]:
    """H (k + t, k + t) of C / 2 at a point, T'T and the prior of z; and its slope (k + t,) downwards."""
    T, own = model.jacobian(at), (np.arange(len(at.x)) < model.k).astype(float)
    return T.T @ T + np.diag(own), T.T @ at.residual - own * at.x


def cost_at(at: Point, k: int) -> float:
    """C at a point."""
    return at.chi2 + float(at.x[:k] @ at.x[:k])


def _step(H, slope, damping, scale, x, lower, upper) -> np.ndarray:
    """Damped step; what stands at a limit and would leave it is held. scale: H of unknowns that are as wide as they may be."""
    A = H + np.diag(damping * H.diagonal() + 1e-12 * scale)
    held = ((x <= lower) & (slope < 0)) | ((x >= upper) & (slope > 0))
    if held.any():
        A[held], A[:, held] = 0.0, 0.0
        A[held, held] = 1.0
    return np.where(held, 0.0, np.linalg.solve(A, np.where(held, 0.0, slope)))


def _evidence(end: End, H: np.ndarray) -> float:
    """ln Z at the end of a search, without what angles between close modes take of it."""
    model, share = end.model, np.array([u.at_end for recipe in end.recipes for u in recipe.unknowns])
    places = sum(recipe.log_prior for recipe in end.recipes)
    gone = at_ends(model.bounds[:, 1] - end.c, H, model.width, share)
    return laplace(end.misfit, H, model.width) + gone + places - model.base.data.slack

"""Other modes of the posterior: values of the parameters that fit as well as those a run ended with.

Frequencies stay as they are when like parts of a structure are exchanged, or the structure is seen in a mirror. So the search
begins where parameters of one unit have exchanged their values, in pairs and in reversed order, at the reflection of the answer in
the prior mean, and at draws of the prior. Weights are the shares of the normal densities at the modes in the evidence
(Laplace's method).
"""

from collections.abc import Iterator
from itertools import combinations

import numpy as np

from mouse_cli.dynamics.eigen import EigenSolution
from mouse_cli.estimators import estimator as find_estimator
from mouse_cli.estimators.linear import Estimator
from mouse_cli.model.arrays import is_sparse
from mouse_cli.model.result import Alternative, Alternatives
from mouse_cli.updating import anchored
from mouse_cli.updating.convergence import ExceedanceTest
from mouse_cli.updating.normality import falls
from mouse_cli.updating.posterior import Laplace, cost, laplace, place
from mouse_cli.updating.state import Setting, State
from mouse_cli.updating.trace import Trace

_SMALL, _DRAWS = 30, 3  # degrees of freedom of a small model, and draws of the prior from which its search begins
_PAIRS, _DESCENTS = 66, 4  # exchanged pairs at most, and descents from the best of them
_REACH = 50.0  # J above that of the answer from which none begins
_MOST = 8  # modes
_SILENT = 0.9  # of a prior standard deviation: an axis of which the data say nothing to first order
_APART = 1.0  # standard deviations within which two modes are one
_TELLING = 0.05  # of the largest component of a shape: a difference that a test sees
_NEGLIGIBLE = 20.0  # J beyond that of the best by this: a share below 1e-4 of the posterior
_EVEN = 0.5  # standard deviations to all sides of a place at which the density must be lower, if it is a mode


def posterior_modes(setting: Setting, state: State, estimator: Estimator) -> list[Laplace]:
    """All modes of the posterior that are found from `state`, the highest first; none where that is no mode of this posterior."""
    run, coordinates = setting.problem.run, setting.coordinates
    posed = run.recursion == "anchored" and estimator.uses_prior and estimator.weighted and setting.frf is None
    if not posed or not len(setting.y) or not coordinates.L.size or is_sparse(setting.problem.structure.K):
        return []
    return [] if coordinates.at_limit(state.u).any() else alternatives(setting, laplace(setting, state))


def stated(found: list[Laplace]) -> Alternatives:
    """What a result says of the modes `found`, of which the first is the answer."""
    share = shares(found)
    others = tuple(
        Alternative(each.state.theta, np.sqrt(np.diag(each.covariance)), each.cost, float(own))
        for each, own in zip(found[1:], share[1:], strict=True)
    )
    telling = deciding(found)
    if telling is None:
        return Alternatives(float(share[0]), others)
    mode, dof, (here, there) = telling
    return Alternatives(float(share[0]), others, (int(found[0].setting.problem.test.number[mode]), dof, here, there))


def alternatives(setting: Setting, first: Laplace, seed: int = 1) -> list[Laplace]:
    """The modes found from `first` and elsewhere, the highest first; without `first` where that is a saddle beside them."""
    found, waiting = [first], [first]
    draws = _DRAWS if setting.problem.structure.n <= _SMALL else 0
    rng = np.random.default_rng(seed)
    starts = [*_downhill(first), *(rng.standard_normal(len(first.z)) for _ in range(draws))]
    while waiting and len(found) <= _MOST:
        starts += _exchanges(setting, waiting.pop(0))
        for z in starts:
            there = descended(setting, z)
            if there is not None and not any(same(there, each) for each in found):
                found.append(there)
                waiting.append(there)
        starts = []
    kept = [each for each in found[1:] if is_mode(each)]
    return highest(kept if kept and not is_mode(first) else [*kept, first])


def highest(found: list[Laplace]) -> list[Laplace]:
    """The modes that are not negligible, the highest first, equal ones always in the same order."""
    order = sorted(found, key=lambda each: (round(each.cost, 4), *each.z))
    return [each for each in order if each.cost < order[0].cost + _NEGLIGIBLE]


def shares(found: list[Laplace]) -> np.ndarray:
    """Share of each mode in the evidence."""
    evidence = np.array([each.log_evidence for each in found])
    weights = np.exp(evidence - evidence.max())
    return weights / weights.sum()


def same(one: Laplace, other: Laplace) -> bool:
    """Whether two modes are one."""
    return min(one.length(other.z), other.length(one.z)) < _APART


def is_mode(normal: Laplace) -> bool:
    """Whether the density falls to all sides: where the parameters can be exchanged, a recursion may end on a saddle."""
    return all(each.ratio > 0 for each in falls(normal, np.arange(len(normal.z)), (-_EVEN, _EVEN)))


def descended(setting: Setting, z: np.ndarray) -> Laplace | None:
    """The normal density where the anchored recursion ends that begins at z (k,); None where it does not end."""
    _, begun = cost(setting, z)
    if begun is None:
        return None
    test = ExceedanceTest(setting.problem.run.confidence, setting.problem.run.convergence)
    trace = Trace(setting, test, lambda cycle: None, begun)
    status = anchored.recur(trace, find_estimator("bayes"))
    return laplace(setting, trace.state) if status.key == "converged" else None


def _downhill(first: Laplace) -> list[np.ndarray]:
    """To both sides of a saddle: along axes of which the data say nothing to first order, to second order they may."""
    silent = np.flatnonzero(np.linalg.norm(first.root, axis=0) > _SILENT)
    silent = silent if first.setting.problem.structure.n <= _SMALL else silent[:1]
    return [
        first.z + each.steps * first.root[:, axis]
        for axis in silent
        for each in falls(first, [axis], (-_EVEN, _EVEN))
        if not each.ratio
    ]


def _exchanges(setting: Setting, one: Laplace) -> list[np.ndarray]:
    """Places z (k,) that promise most where like parameters are exchanged, or the answer is reflected in the prior mean."""
    small = setting.problem.structure.n <= _SMALL
    found = [z for z in (*_exchanged(setting, one), -one.z) if one.length(z) > _APART]
    screen = _Screen(setting, one.state).cost if not small else lambda z: cost(setting, z)[0]
    costs = np.array([screen(z) for z in found])
    order = [i for i in np.argsort(costs, kind="stable") if costs[i] < one.cost + _REACH]
    return [found[i] for i in order[:_DESCENTS]]


def _exchanged(setting: Setting, first: Laplace) -> Iterator[np.ndarray]:
    """z with the values of like parameters exchanged: of one unit and transform, each within the other's prior."""
    u, coordinates, parameters = first.state.u, setting.coordinates, setting.problem.parameters
    sd = np.sqrt(np.sum(coordinates.L**2, axis=1)) if coordinates.L.ndim == 2 else coordinates.L
    like = lambda i, j: (
        parameters[i].unit == parameters[j].unit
        and coordinates.logarithmic[i] == coordinates.logarithmic[j]
        and min(sd[i], sd[j]) > 0
        and abs(coordinates.mean[i] - coordinates.mean[j]) < min(sd[i], sd[j])
    )
    pairs = [(i, j) for i, j in combinations(range(len(u)), 2) if like(i, j)]
    for i, j in pairs[:_PAIRS]:
        yield _at(setting, _swapped(u, [(i, j)]))
    family = [i for i in range(len(u)) if any(i in pair for pair in pairs)]
    if len(family) > 2:
        yield _at(setting, _swapped(u, [(i, j) for i, j in zip(family, reversed(family), strict=True) if i < j]))


def _swapped(u: np.ndarray, pairs: list[tuple[int, int]]) -> np.ndarray:
    swapped = u.copy()
    for i, j in pairs:
        swapped[[i, j]] = u[[j, i]]
    return swapped


def _at(setting: Setting, u: np.ndarray) -> np.ndarray:
    return setting.coordinates.in_prior_units(u - setting.coordinates.mean)


class _Screen:
    """J in the basis of the lowest modes of one state: some hundred degrees of freedom for the price of some ten."""

    def __init__(self, setting: Setting, state: State):
        most = int(setting.problem.test.number.max(initial=1)) if setting.problem.test.m else 1
        self.setting, self.basis = setting, state.solution.shapes[:, : 3 * most + 20]

    def cost(self, z: np.ndarray) -> float:
        """J at z (k,), infinite where the model is not physical; an upper bound of each eigenvalue makes it approximate."""
        setting, u = self.setting, place(self.setting, z)
        if not setting.coordinates.within(u):
            return np.inf
        K, M = (self.basis.T @ A @ self.basis for A in setting.assembly.matrices(setting.coordinates.value(u)))
        try:
            L = np.linalg.cholesky(M)
        except np.linalg.LinAlgError:
            return np.inf
        half = np.linalg.solve(L, np.linalg.solve(L, K).T)
        values, vectors = np.linalg.eigh((half + half.T) / 2)
        if values[0] < 0:
            return np.inf
        shapes = self.basis @ np.linalg.solve(L.T, vectors)
        return State(setting, u, EigenSolution(values, shapes)).chi2 + float(z @ z)


def deciding(found: list[Laplace]) -> tuple[int, int, tuple[float, float]] | None:
    """(measured mode, degree of freedom, values at both) where the shapes of the two highest modes of the posterior differ most.

    Shapes with their largest component 1; degrees of freedom without a sensor alone. None where none differs.
    """
    setting = found[0].setting
    at = [each.state.solution.shapes[:, each.state.modes] for each in found[:2]]
    at = [X / np.take_along_axis(X, np.abs(X).argmax(axis=0)[None], axis=0) for X in at]
    signs = np.sign(np.einsum("ij,ij->j", *at))
    at[1] = at[1] * np.where(signs == 0, 1.0, signs)
    gap = np.abs(at[0] - at[1])
    test = setting.problem.test
    gap[test.dofs if test.sensing is None else np.abs(test.sensing).sum(axis=0).nonzero()[0]] = 0.0
    if not gap.size or gap.max() < _TELLING:
        return None
    dof, mode = np.unravel_index(int(gap.round(6).argmax()), gap.shape)
    return int(mode), int(dof), (float(at[0][dof, mode]), float(at[1][dof, mode]))

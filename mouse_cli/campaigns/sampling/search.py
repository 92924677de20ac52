"""Where the posterior density is highest: the recursion, begun anew from draws of the prior."""

import numpy as np

from mouse_cli.estimators import estimator
from mouse_cli.model.arrays import is_sparse
from mouse_cli.updating import anchored
from mouse_cli.updating.convergence import ExceedanceTest
from mouse_cli.updating.normality import falls
from mouse_cli.updating.posterior import Laplace, cost, laplace
from mouse_cli.updating.state import Setting, State
from mouse_cli.updating.trace import Trace

_STARTS = 12
_APART = 1.0  # standard deviations within which two modes are one
_NEGLIGIBLE = 20.0  # J beyond that of the best by this: a share below 1e-4 of the posterior


def modes(setting: Setting, rng: np.random.Generator, first: Laplace) -> list[Laplace]:
    """The modes found from `first` and from draws of the prior, the highest first; `first` alone for sparse models."""
    found = [first] if _is_mode(first) else []
    for _ in range(0 if is_sparse(setting.problem.structure.K) else _STARTS):
        begun = _drawn(setting, rng)
        there = None if begun is None else _descended(setting, begun)
        if there is None or any(min(each.length(there.z), there.length(each.z)) < _APART for each in found):
            continue
        if _is_mode(there):
            found.append(there)
    found.sort(key=lambda each: (round(each.cost, 4), *each.z))  # equal ones always in the same order
    return [each for each in found if each.cost < found[0].cost + _NEGLIGIBLE] or [first]


def _is_mode(normal: Laplace) -> bool:
    """Whether the density falls to all sides: where the parameters can be exchanged, a recursion may end on a saddle."""
    return all(each.ratio > 0 for each in falls(normal, np.arange(len(normal.z)), (-0.5, 0.5)))


def _drawn(setting: Setting, rng: np.random.Generator) -> State | None:
    """A model drawn from the prior, physical and within the limits; None where ten draws are not."""
    for _ in range(10):
        _, state = cost(setting, rng.standard_normal(setting.coordinates.L.shape[-1]))
        if state is not None:
            return state
    return None


def _descended(setting: Setting, begun: State) -> Laplace | None:
    """The normal density where the anchored recursion ends that begins there; None where it does not end."""
    test = ExceedanceTest(setting.problem.run.confidence, setting.problem.run.convergence)
    trace = Trace(setting, test, lambda cycle: None, begun)
    status = anchored.recur(trace, estimator("bayes"))
    return laplace(setting, trace.state) if status.key == "converged" else None


def start(normals: list[Laplace], walkers: int, rng: np.random.Generator) -> np.ndarray:
    """Places z (w, k) drawn from the normal densities at the modes, by shares of the evidence, where the posterior is not 0."""
    evidence = np.array([each.log_evidence for each in normals])
    share = np.exp(evidence - evidence.max())
    chosen = rng.choice(len(normals), size=walkers, p=share / share.sum())
    return np.array([_near(normals[i], rng) for i in chosen])


def _near(normal: Laplace, rng: np.random.Generator) -> np.ndarray:
    """A draw; ever nearer to the mode while the posterior is zero there."""
    spread = 1.0
    while True:
        z = normal.z + spread * normal.root @ rng.standard_normal(len(normal.z))
        if spread < 1e-6 or cost(normal.setting, z)[1] is not None:
            return z
        spread *= 0.9


def nearest(normals: list[Laplace], z: np.ndarray) -> np.ndarray:
    """Share (modes,) of the samples z (s, k) that each mode is nearest to, in its own standard deviations."""
    lengths = [np.linalg.norm(np.linalg.solve(each.root, (z - each.z).T), axis=0) for each in normals]
    return np.bincount(np.argmin(lengths, axis=0), minlength=len(normals)) / len(z)

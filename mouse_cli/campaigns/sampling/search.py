"""Where the posterior density is highest: the recursion, begun anew from draws of the prior."""

import numpy as np

from mouse_cli.model.arrays import is_sparse
from mouse_cli.updating.alternatives import descended, highest, is_mode, same
from mouse_cli.updating.posterior import Laplace, cost
from mouse_cli.updating.state import Setting

_STARTS = 12


def modes(setting: Setting, rng: np.random.Generator, first: Laplace) -> list[Laplace]:
    """The modes found from `first` and from draws of the prior, the highest first; `first` alone for sparse models."""
    found = [first] if is_mode(first) else []
    for _ in range(0 if is_sparse(setting.problem.structure.K) else _STARTS):
        z = _drawn(setting, rng)
        there = None if z is None else descended(setting, z)
        if there is not None and not any(same(there, each) for each in found) and is_mode(there):
            found.append(there)
    return highest(found) if found else [first]


def _drawn(setting: Setting, rng: np.random.Generator) -> np.ndarray | None:
    """z (k,) of a model drawn from the prior, physical and within the limits; None where ten draws are not."""
    for _ in range(10):
        z = rng.standard_normal(setting.coordinates.L.shape[-1])
        if cost(setting, z)[1] is not None:
            return z
    return None


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

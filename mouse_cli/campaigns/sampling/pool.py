"""Processes that evaluate the posterior density of one deck, for models whose solution takes longer than handing over."""

import multiprocessing
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from mouse_cli.campaigns.sampling.ensemble import Density
from mouse_cli.model.problem import Problem
from mouse_cli.updating.prior_model import begin

_density: Density | None = None  # of this process


@contextmanager
def pool_of(problem: Problem, density: Density, processes: int) -> Iterator[Any]:
    """Something with a `map` for emcee; None, and no process, where one is asked for."""
    if processes < 2:
        yield None
        return
    fresh = multiprocessing.get_context("spawn")
    with fresh.Pool(processes, _make_ready, (problem, density.centre, density.root)) as pool:
        yield _Pool(pool, processes)


class _Pool:
    """Hands over places alone: the density is there already."""

    def __init__(self, pool: Any, processes: int):
        self.pool, self.processes = pool, processes

    def map(self, _: Any, places: Any) -> list[tuple[float, np.ndarray]]:
        """The density at each of `places`, in order."""
        places = list(places)
        return self.pool.map(_evaluated, places, chunksize=-(-len(places) // self.processes))


def _make_ready(problem: Problem, centre: np.ndarray, root: np.ndarray) -> None:
    global _density
    _density = Density(begin(problem)[0], centre, root)


def _evaluated(w: np.ndarray) -> tuple[float, np.ndarray]:
    return _density(w)

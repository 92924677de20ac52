"""Natural strains of bars, and which forces their ends let them bear; see `bars.py`."""

import numpy as np

from mouse_cli.model.problem import Problem
from mouse_cli.terms.constraints import Motion
from mouse_cli.terms.elements import Layout
from mouse_cli.terms.elements import _beam as beam


def natural(ends: np.ndarray, axial: np.ndarray, length: np.ndarray) -> np.ndarray:
    """Natural strains (c, 3, r) of bars by the motion of their ends (c, 4, r), along them (c, 2, r), and their length (c,)."""
    w1, s1, w2, s2 = np.moveaxis(ends, 1, 0)
    return np.stack([s2 - s1, 2 / length[:, None] * (w1 - w2) + s1 + s2, axial[:, 1] - axial[:, 0]], axis=1)


def borne(length: np.ndarray, dofs: np.ndarray, sense: np.ndarray, free: np.ndarray) -> np.ndarray:
    """N N' (e, 3, 3): what natural forces bars bear in a plane whose local directions `free` carry no load."""
    one = np.eye(12)
    strains = natural(one[None, dofs] * sense[:, None], one[None, [0, 6]], np.ones(1))[0][:, free]
    strains = strains[:, strains.any(axis=0)]
    return np.tile(np.round(np.eye(3) - strains @ np.linalg.pinv(strains), 12), (len(length), 1, 1))


def sparse_rows(motion: Motion, places: np.ndarray):
    """The rows `places` of T, sparse."""
    from scipy.sparse import csr_array

    counts = motion.counts[places]
    first = motion.start[places]
    at = np.repeat(first - np.cumsum(counts) + counts, counts) + np.arange(counts.sum())
    start = np.concatenate([[0], np.cumsum(counts)])
    return csr_array((motion.factor[at], motion.dof[at], start), shape=(len(places), motion.n))


def by_ends(problem: Problem, bars) -> np.ndarray:
    """Natural strains (b, 3, 12) for each direction of both nodes."""
    B = np.zeros((len(bars), 3, 12))
    for number in np.unique(bars.set).tolist():
        elements = problem.mesh.elements[number]
        local = beam.span(Layout(problem.mesh.coordinates[elements.nodes], dict(elements.options))).motion
        for plane, (dofs, sense) in enumerate(beam.PLANES):
            own = (bars.set == number) & (bars.plane == plane)
            there = local[bars.member[own]]
            B[own] = natural(there[:, dofs] * sense[:, None], there[:, [0, 6]], bars.length[own])
    return B

"""Loads by which all bars slip in shear, whose responses few coordinates of a model after Euler and Bernoulli do not hold.

Where bars shear, sections no longer turn as the axis does, and no combination of the lowest modes does that. Statically it is what
an antisymmetric strain phi e_a of every bar makes, phi = 12 EI / (kappa G A l^2), e_a that of a mode: the load (3 EI / l) phi e_a.
"""

import numpy as np

from mouse_cli.diagnosis.sites.bars import bars, motion_of
from mouse_cli.diagnosis.sites.residual import NUMBERS
from mouse_cli.diagnosis.sites.strains import by_ends, sparse_rows
from mouse_cli.model.problem import Problem


def shearing(problem: Problem, theta: np.ndarray, V: np.ndarray) -> np.ndarray:
    """Loads (n, c) that shear puts on motions V (n, c) of a model at theta (p,), the largest of each is 1; none where degrees of
    freedom are too many, or where there is no bar that does not shear.
    """
    motion = None if problem.mesh is None or V.size > NUMBERS else motion_of(problem)
    found = None if motion is None else bars(problem, motion, theta, V)
    if found is None:
        return np.zeros((len(V), 0))
    slip = (found.phi == 0) * 36 * found.EI / found.length * found.EI / (found.E * found.A * found.length**2)
    forces = by_ends(problem, found)[:, 1, :, None] * (slip[:, None] * found.strain[:, 1])[:, None]
    rows = sparse_rows(motion, (6 * found.nodes[:, :, None] + np.arange(6)).ravel())
    loads = rows.T @ forces.reshape(-1, V.shape[1])
    size = np.abs(loads).max(axis=0)
    return loads[:, size > 0] / size[size > 0]

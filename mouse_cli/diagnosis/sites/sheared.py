"""Loads by which all bars slip in shear, whose responses few coordinates of a model after Euler and Bernoulli do not hold.

Where bars shear, sections no longer turn as the axis does, and no combination of the lowest modes does that. Statically it is what
an antisymmetric strain phi e_a of every bar makes, phi = 12 EI / (kappa G A l^2), e_a that of a mode: the load (3 EI / l) phi e_a.
"""

import numpy as np

from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.diagnosis.sites.residual import NUMBERS
from mouse_cli.diagnosis.sites.strains import by_ends, sparse_rows
from mouse_cli.model.problem import Problem
from mouse_cli.terms.constraints import Motion


def shearing(problem: Problem, motion: Motion | None, bars: Bars | None, count: int) -> np.ndarray:
    """Loads (n, count) that shear puts on the first `count` coordinates, the largest of each is 1; none where bars are too many, or
    shear as it is.
    """
    if motion is None or bars is None or motion.n * count > NUMBERS:
        return np.zeros((0 if motion is None else motion.n, 0))
    antisymmetric = bars.strain[:, 1, :count]
    slip = (bars.phi == 0) * 36 * (bars.EI / bars.length) * (bars.EI / (bars.E * bars.A * bars.length**2))
    forces = by_ends(problem, bars)[:, 1, :, None] * (slip[:, None] * antisymmetric)[:, None]
    rows = sparse_rows(motion, (6 * bars.nodes[:, :, None] + np.arange(6)).ravel())
    loads = rows.T @ forces.reshape(-1, count)
    size = np.abs(loads).max(axis=0)
    return loads[:, size > 0] / size[size > 0]

"""The stiffness of a continuum whose elements are not known, as parts at its degrees of freedom.

With K X = M X Lambda, X'M X = 1 and Y = M^1/2 X, the root S = Y Lambda^1/2 Y' makes K = M^1/2 S S M^1/2, the sum of b_i b_i', b_i
row i of S M^1/2. Each part is positive, none resists a motion of the whole as a rigid body, for S takes such to nothing, and
b_i'u is local: the root of the biharmonic operator of a plate is the Laplacian, its curvature there.
"""

import numpy as np

from mouse_cli.diagnosis.extend.matrices import with_shares
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.nameless._cells import Cells, of_rows
from mouse_cli.diagnosis.nameless._groups import places
from mouse_cli.diagnosis.sites.points import named_dof
from mouse_cli.model.arrays import dense
from mouse_cli.model.problem import Problem

_ENTRIES = 5e5  # of all parts together, up to which a deck holds them


def local_energy(model: Reduced) -> Cells | None:
    """A part at each degree of freedom of a model in all of its modes; None of one in fewer, or with masses that are none."""
    n = model.problem.structure.n
    if model.r < n:
        return None
    values, vectors = np.linalg.eigh(dense(model.assembly.matrices(model.theta)[1]))
    if values[0] <= 0:
        return None
    root = (vectors * np.sqrt(values)) @ vectors.T
    Y = root @ model.V
    strains = Y * np.sqrt(np.maximum(model.eigenvalues, 0.0))
    sites = [named_dof(model.problem.structure, i) for i in range(n)]
    at, unit = places(model.problem.structure)
    upper = np.triu_indices(n)

    def extend(problem: Problem, kept: np.ndarray, shares: np.ndarray, spread: float) -> Problem | None:
        if n * len(upper[0]) > _ENTRIES:
            return None
        own = strains[kept] @ Y.T @ root
        parts = [
            (sites[k].text, float(v), (*upper, np.outer(b, b)[upper]))
            for k, v, b in zip(kept, shares, own, strict=True)
        ]
        return with_shares(problem, "stiffness", parts, spread)

    return of_rows(model, sites, at, unit, strains, np.ones(n), "K", extend)

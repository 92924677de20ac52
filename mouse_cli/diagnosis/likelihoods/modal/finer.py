"""The inertia that elements of half the length have, in the degrees of freedom of the deck: its mesh corrected, for any mechanism.

Bars that are halved have nodes i in their middles beside those of the deck, c. In static equilibrium these follow by
T = -K_ii^-1 K_ic: K is the same then, and M that of consistent masses (Guyan, AIAA J. 3, 1965). Vibrating at lambda they move by
lambda K_ii^-1 B u beyond that, B = M_ic + M_ii T, so that to first order in lambda over the eigenvalues of halves that are clamped

    lambda' = lambda / (1 + u'(M_T - M) u + lambda u'D u),     M_T = M_cc + M_ci T + T'B,  D = B'K_ii^-1 B,  u'M u = 1

and modes turn into one another as what this adds to M has it between them, lambda taken as the root of both. A mechanism changes
the modes u and with them what the mesh does to them, so that each prediction is corrected by itself. Where a bar is all but
missing, M is less than that of the deck, and u'M u of the deck is what the two forms are over.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.model.arrays import Matrix
from mouse_cli.model.problem import Problem
from mouse_cli.terms.assembly import assembly

_RIGID = 1e-7  # share of the highest eigenvalue, below which a motion may be rigid
_SAME = 1e-6  # relative difference of K up to which halves are as stiff as the whole


@dataclass(frozen=True)
class Finer:
    """M_T - M and D (n, n), sparse, see above; below: the eigenvalue up to which modes are corrected, where halves swing by
    themselves.
    """

    spread: Matrix
    within: Matrix
    below: float = np.inf

    def of(self, V: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Both in coordinates V (n, r)."""
        return V.T @ (self.spread @ V), V.T @ (self.within @ V)

    def corrected(self, known: np.ndarray, most: int) -> int:
        """How many modes are corrected: `most`, or those below the limit in the model as it is, of eigenvalues `known` (r,).

        As many whatever parameters and causes do, so that no mode jumps on its way past it.
        """
        below = int(np.searchsorted(known, self.below))
        return min(max(below, 1), most) if below < len(known) else most


def inertia(problem: Problem, halves: Problem, theta: np.ndarray, below: float = np.inf) -> Finer | None:
    """What `halves`, the deck with every beam in two, has more than `problem` at theta (p,); None where it is not as stiff."""
    from scipy.sparse import csc_array, csc_matrix
    from scipy.sparse.linalg import spsolve

    place = {label: i for i, label in enumerate(halves.structure.labels)}
    old = np.array([place[label] for label in problem.structure.labels])
    new = np.setdiff1d(np.arange(halves.structure.n), old)
    K, M = (csc_array(each) for each in assembly(halves).matrices(theta))
    stiff, mass = (csc_array(each) for each in assembly(problem).matrices(theta))
    own = csc_matrix(K[new][:, new])
    T = -csc_array(spsolve(own, csc_matrix(K[new][:, old])))
    if abs(K[old][:, old] + K[old][:, new] @ T - stiff).max() > _SAME * abs(stiff).max():
        return None
    B = M[new][:, old] + M[new][:, new] @ T
    spread = M[old][:, old] + M[old][:, new] @ T + T.T @ B - mass
    return Finer(spread.tocsr(), (B.T @ csc_array(spsolve(own, csc_matrix(B)))).tocsr(), below)


def refined(
    parts: tuple[np.ndarray, np.ndarray], eigenvalues: np.ndarray, X: np.ndarray, u: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Eigenvalues and modes X (size, size), the first (m,) of which are corrected, close ones turned into one another.

    u (r, m): these in the coordinates of both matrices (r, r) of a `Finer`.
    """
    count = u.shape[1]
    own, root = u / np.maximum(1.0, np.linalg.norm(u, axis=0)), np.sqrt(np.maximum(eigenvalues[:count], 0.0))
    spread, within = (own.T @ each @ own for each in parts)
    more = np.eye(count) + spread + root[:, None] * within * root
    found = _among(eigenvalues[:count], more)
    if found is None:
        return eigenvalues, X
    return np.concatenate([found[0], eigenvalues[count:]]), np.hstack([X[:, :count] @ found[1], X[:, count:]])


def _among(eigenvalues: np.ndarray, mass: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """Eigenvalues (m,) and modes Q (m, m), Q'mass Q = 1, of diag(eigenvalues) and mass (m, m); None where that is no mass.

    Where no motion is rigid, by the reciprocals of the eigenvalues, which ask for no factor of the mass: a third of the time.
    """
    from scipy.linalg.lapack import dsyevd, dsygvd

    if eigenvalues[0] <= _RIGID * eigenvalues[-1]:
        rates, Q, fault = dsygvd(np.diag(eigenvalues), mass)
        return None if fault else (rates, Q)
    by = 1 / np.sqrt(eigenvalues)
    periods, Q, fault = dsyevd(mass * by * by[:, None], lower=1, overwrite_a=1)
    if fault or periods[0] <= 0:
        return None
    return 1 / periods[::-1], by[:, None] * (Q / np.sqrt(periods))[:, ::-1]

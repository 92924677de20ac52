"""Free modes with residual flexibility (MacNeal, Computers & Structures 1 (1971) 581)."""

import numpy as np

from mouse_cli.coupling.reductions import Part, Reduced, Reduction


def reduce(part: Part, keep: int) -> Reduced:
    """u = Phi p + Psi g: what higher modes do is a spring without mass at each place, the residual term of lecture 22."""
    X, left = part.free_modes(keep)[1], part.residual_modes(keep)
    found = part.projected(np.column_stack([X, left]))
    M = found.M.copy()
    M[X.shape[1] :] = M[:, X.shape[1] :] = 0.0
    return Reduced(found.K, M, found.boundary)


REDUCTION = Reduction(
    "macneal", "free modes and residual flexibility", "u = Phi p + (K^+ - Phi Lambda^-1 Phi') f, residual mass left out", reduce
)  # fmt: skip

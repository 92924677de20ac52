"""Free modes with residual flexibility and residual mass (Rubin, AIAA Journal 13 (1975) 995)."""

import numpy as np

from mouse_cli.coupling.reductions import Part, Reduced, Reduction


def reduce(part: Part, keep: int) -> Reduced:
    """u = Phi p + Psi g with the true K and M on both: Ritz's method, so that frequencies come from above."""
    return part.projected(np.column_stack([part.free_modes(keep)[1], part.residual_modes(keep)]))


REDUCTION = Reduction(
    "rubin", "free modes, residual flexibility and mass", "u = Phi p + (K^+ - Phi Lambda^-1 Phi') f, residual mass kept", reduce
)  # fmt: skip

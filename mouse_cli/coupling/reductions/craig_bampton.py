"""Modes with the boundary held, and static constraint modes (Craig and Bampton, AIAA Journal 6 (1968) 1313)."""

import numpy as np

from mouse_cli.coupling.reductions import Part, Reduced, Reduction


def reduce(part: Part, keep: int) -> Reduced:
    """u = Psi_c u_b + Phi_f p: coordinates of the boundary remain, and the coupling is exact there."""
    return part.projected(np.column_stack([part.constraint_modes, part.held_modes(keep)[1]]))


REDUCTION = Reduction(
    "craig-bampton", "constraint modes and modes of the held part", "u = -K_ii^-1 K_ib u_b + Phi_f p, Phi_f with u_b = 0", reduce
)  # fmt: skip

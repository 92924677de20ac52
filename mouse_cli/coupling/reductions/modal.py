"""Modal coupling of lecture 22: the lowest free modes alone."""

from mouse_cli.coupling.reductions import Part, Reduced, Reduction


def reduce(part: Part, keep: int) -> Reduced:
    """u = Phi p, with K = Lambda, M = I: springs K_CC between parts add Phi' K_CC Phi; rigid interfaces hold B Phi p = 0."""
    return part.projected(part.free_modes(keep)[1])


REDUCTION = Reduction(
    "modal", "free modes alone", "u = Phi p; higher modes are left out: the modal truncation problem", reduce
)

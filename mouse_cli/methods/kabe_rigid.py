"""Kabe (1985) with the rigid-body modes among the constraints: K R = 0 exactly, the measured modes as far as that leaves room."""

from mouse_cli.methods import SHAPES, Method
from mouse_cli.methods.found import Found
from mouse_cli.methods.given import Given
from mouse_cli.methods.pattern import Pattern
from mouse_cli.model.updated import KEPT, LOST, PARTLY


def update(given: Given) -> Found:
    """As `kabe`, over the changes of K that leave its rigid-body modes R without force."""
    pattern = Pattern(given, given.rigid)
    K, count, change, settled = given.iterate(lambda X: pattern.stiffness(X, given.eigenvalues))
    return Found(K, given.M, count, change, settled)


METHOD = Method(
    "kabe-rigid",
    "Kabe, pattern of zeros and rigid-body modes kept",
    "min sum (k_ij/k0_ij - 1)^2 with K R = 0 and K X = M X L, k_ij = 0 where k0_ij = 0",
    "lecture 21-1; Kabe, AIAA J. 23 (1985) 1431",
    (
        (
            PARTLY,
            "rigid-body modes come first; what room is left serves the measured modes, by least squares where it is short",
        ),
        (LOST, "nothing in it knows of signs: K may have negative eigenvalues"),
        (KEPT, "K R = 0 is a constraint"),
        (KEPT, "elements that are zero stay zero"),
        (LOST, "each element of K is changed by itself, as no element of a structure can be"),
    ),
    (SHAPES,),
    update,
    dense=True,
)

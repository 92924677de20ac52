"""Kabe (1985): the elements of K that are not zero, changed least in proportion to themselves until K has the measured modes."""

from mouse_cli.methods import SHAPES, Method
from mouse_cli.methods.found import Found
from mouse_cli.methods.given import Given
from mouse_cli.methods.pattern import Pattern
from mouse_cli.model.updated import KEPT, LOST, PARTLY


def update(given: Given) -> Found:
    """min sum (k_ij / k0_ij - 1)^2 with K X = M X L over the elements of K0 that are not zero.

    Where the elements are fewer than the equations ask for, |K X - M X L| is least instead, forces by the root of the stiffness of
    their place, each mode by its own inertia.
    """
    pattern = Pattern(given)
    K, count, change, settled = given.iterate(lambda X: pattern.stiffness(X, given.eigenvalues))
    return Found(K, given.M, count, change, settled)


METHOD = Method(
    "kabe",
    "Kabe, pattern of zeros kept",
    "min sum (k_ij/k0_ij - 1)^2 with K X = M X L, k_ij = 0 where k0_ij = 0",
    "lecture 21-1; Kabe, AIAA J. 23 (1985) 1431",
    (
        (PARTLY, "exactly where the elements are enough for it, else by least squares"),
        (LOST, "nothing in it knows of signs: K may have negative eigenvalues"),
        (LOST, "they are no constraint: the structure is tied to the ground"),
        (KEPT, "elements that are zero stay zero"),
        (LOST, "each element of K is changed by itself, as no element of a structure can be"),
    ),
    (SHAPES,),
    update,
    dense=True,
)

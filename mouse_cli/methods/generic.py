"""Generic element matrices (Gladwell and Ahmadian 1995): the stiffness of like elements revised in their own strain modes."""

import numpy as np

from mouse_cli.methods import ELEMENTS, SHAPES, Method, refusals
from mouse_cli.methods.found import Found
from mouse_cli.methods.generic_beams import GenericBeams, generic_beams
from mouse_cli.methods.given import Given
from mouse_cli.methods.least_error import Undetermined, Unknowns, least_error
from mouse_cli.model.updated import KEPT, PARTLY, Moved

_NEAR = 0.02  # a step may bring the smallest eigenvalue of k down to this share of what it was


def update(given: Given) -> Found:
    """K^e = U0 k U0' with one k for the elements of a group, by equation error; k stays positive definite.

    k is in units of the model's own: 1 on the diagonal and 0 off it before the update. Raises NumericalError for entries of k that
    the measured modes do not determine.
    """
    beams = generic_beams(given)
    lowest = {}

    def admissible(theta: np.ndarray) -> bool:
        """Every k definite, and not much less so than one step before."""
        least = [float(np.linalg.eigvalsh(k)[0]) for k in beams.matrices(theta)]
        sound = all(now > _NEAR * lowest.get(i, 1.0) for i, now in enumerate(least))
        if sound:
            lowest.update(enumerate(least))
        return sound

    k = len(beams.names)
    unknowns = Unknowns(beams.assembly, beams.theta, beams.free, np.ones(k), admissible)
    try:
        found = least_error(given, unknowns)
    except Undetermined as reason:
        loose = [name for name, is_loose in zip(beams.names, reason.loose, strict=True) if is_loose]
        raise refusals.undetermined(given.problem, METHOD.key, loose, str(reason)) from None
    return _told(beams, found)


def _told(beams: GenericBeams, found) -> Found:
    rows = zip(beams.names, beams.theta[beams.free], found.theta[beams.free], strict=True)
    moved = tuple(Moved(name, "", float(before), float(after)) for name, before, after in rows)
    return Found(
        found.K, found.M, found.iterations, found.change, found.settled, moved, found.conditioning, tuple(beams.names)
    )


METHOD = Method(
    "generic",
    "generic element matrices",
    "K^e = U0 [k11 k12 k13; . k22 k23; . . k33] U0', min sum_i r_i'(K0 + s M)^-1 r_i, r_i = (K - lambda_i M) x_i",
    "lecture 21-1; Gladwell and Ahmadian, Mech. Syst. Signal Process. 9 (1995) 601",
    (
        (PARTLY, "as far as the groups have parameters enough"),
        (KEPT, "k of each group is kept positive definite"),
        (KEPT, "U0 holds strain modes alone: elements do not resist rigid motion"),
        (KEPT, "the elements join what they joined"),
        (KEPT, "k11, k22, k33 are bending, shear and torsion of an element, k12, k13, k23 what couples them"),
    ),
    (SHAPES, ELEMENTS),
    update,
)

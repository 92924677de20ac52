"""Physical parameters by equation error: the deck's properties that leave the least force in the measured modes."""

import numpy as np

from mouse_cli.methods import PARAMETERS, SHAPES, Method, refusals
from mouse_cli.methods.found import Found
from mouse_cli.methods.given import Given
from mouse_cli.methods.least_error import Undetermined, Unknowns, least_error
from mouse_cli.model.updated import KEPT, LOST, PARTLY, Moved


def update(given: Given) -> Found:
    """The parameters with an sd, within their limits; those that were positive stay so. No prior takes part.

    Raises NumericalError for parameters that the equations do not determine.
    """
    problem, start = given.problem, given.problem.prior.mean
    parameters = problem.parameters
    free = np.array([i for i, p in enumerate(parameters) if p.sd > 0], int)
    low = np.array([max(p.lower, 0.0) if p.nominal > 0 else p.lower for p in parameters])
    high = np.array([p.upper for p in parameters])
    strict = np.array([p.nominal > 0 and p.lower <= 0 for p in parameters])

    def admissible(theta: np.ndarray) -> bool:
        """Within the limits, and positive where it was."""
        return bool(((theta >= low) & (theta <= high) & ~(strict & (theta <= 0))).all())

    units = np.array([parameters[i].sd for i in free])
    try:
        found = least_error(given, Unknowns(given.assembly, start, free, units, admissible))
    except Undetermined as reason:
        loose = [parameters[i].name for i, is_loose in zip(free, reason.loose, strict=True) if is_loose]
        raise refusals.undetermined(problem, METHOD.key, loose, str(reason)) from None
    moved = [Moved(parameters[i].name, parameters[i].unit, float(start[i]), float(found.theta[i])) for i in free]
    return Found(found.K, found.M, found.iterations, found.change, found.settled, tuple(moved), found.conditioning)


METHOD = Method(
    "equation-error",
    "physical parameters by equation error",
    "min sum_i r_i'(K0 + s M)^-1 r_i over theta, r_i = (K(theta) - lambda_i M(theta)) x_i",
    "lecture 21-1",
    (
        (LOST, "the parameters may not be able to reproduce them"),
        (KEPT, "elements with positive properties have semidefinite matrices"),
        (KEPT, "elements do not resist rigid motion, whatever their properties"),
        (KEPT, "the matrices are those of the same elements"),
        (PARTLY, "every number is a property; what the model left out is put into the wrong one"),
    ),
    (SHAPES, PARAMETERS),
    update,
)

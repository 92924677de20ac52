"""Flexibility along an unknown motion of the whole structure."""

import numpy as np

from mouse_cli.diagnosis.extend.matrices import with_tie
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest, total_mass
from mouse_cli.diagnosis.nameless import Nameless
from mouse_cli.diagnosis.nameless._cells import Cells
from mouse_cli.diagnosis.nameless._motions import Motions, motions
from mouse_cli.model.diagnosis import COMPLIANCE
from mouse_cli.model.problem import Problem


def cells(model: Reduced) -> Cells | None:
    """Rows of momentum m u, whose sum over the motion is it in the coordinates of the model, where M = 1.

    The motion is in units of 1 / sqrt(mass times lowest measured eigenvalue): a spread of one doubles the compliance of a first
    mode of its form.
    """
    own = motions(model)
    if own is None:
        return None
    unit = 1 / np.sqrt(total_mass(model) * lowest(model))

    def extend(problem: Problem, kept: np.ndarray, values: np.ndarray, spread: float, sign: int) -> Problem:
        motion = np.zeros(model.problem.structure.n)
        motion[own.dofs[kept]] = values * unit
        force = model.assembly.matrices(model.theta)[0] @ motion
        acting = np.flatnonzero(force)
        return with_tie(problem, acting, force[acting] / np.sqrt(1 + motion @ force), sign)

    return own.cells(model, unit * _masses(model, own), extend)


def _masses(model: Reduced, own: Motions) -> np.ndarray:
    """Mass (c,) that moves with each row, together all there is."""
    shares = own.shares
    if own.dofs is not None:
        shares = np.asarray(model.assembly.matrices(model.theta)[1].diagonal())[own.dofs]
    return total_mass(model) * shares / shares.sum()


NAMELESS = Nameless(
    "compliance",
    "flexibility along an unknown motion of the structure",
    COMPLIANCE,
    "one motion of the whole structure more than the model lets it make: K^-1 + h h' with a smooth random field h, whose spread "
    "and correlation length are integrated out (soil that rocks, a soft base or joint, overall bending)",
    (0.1, 0.5, 2.5),
    cells,
    (-1,),
    "support",
)

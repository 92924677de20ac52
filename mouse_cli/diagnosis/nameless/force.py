"""A spring along an unknown motion of the whole structure."""

import numpy as np

from mouse_cli.diagnosis.extend.matrices import with_tie
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest, total_mass
from mouse_cli.diagnosis.nameless import Nameless
from mouse_cli.diagnosis.nameless._cells import Cells
from mouse_cli.diagnosis.nameless._motions import motions
from mouse_cli.model.diagnosis import FORCE


def cells(model: Reduced) -> Cells | None:
    """Rows of motion, in units of which k = lowest measured eigenvalue times the mass, by their shares."""
    own = motions(model)
    if own is None:
        return None
    weights = np.sqrt(lowest(model) * total_mass(model)) * own.shares
    extend = lambda problem, kept, values, spread, sign: with_tie(problem, own.dofs[kept], values * weights[kept], sign)
    return own.cells(model, weights, extend)


NAMELESS = Nameless(
    "force",
    "a spring along an unknown motion of the structure",
    FORCE,
    "stiffness that ties all parts together along one motion: K + b b' with a smooth random field b, whose spread and correlation "
    "length are integrated out (outrigger, strut between distant parts)",
    (0.3, 1.0, 3.0),
    cells,
    (1,),
)

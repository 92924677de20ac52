"""A reduced model in fewer coordinates: its lowest ones, and how the rest moves when one end of a line, or a spring, softens."""

import numpy as np

from mouse_cli.diagnosis.effects.hinges import ends
from mouse_cli.diagnosis.effects.losses import loosened
from mouse_cli.diagnosis.likelihoods.modal import scales
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced


def lowest(model: Reduced, count: int) -> Reduced:
    """A model in its `count` lowest coordinates, and those by which ends of lines turn and springs soften; or itself."""
    if count >= model.r:
        return model
    forces = np.concatenate([ends(model), loosened(model)])[: model.r - count, count:]
    moved = forces / (model.eigenvalues[count:] + scales.lowest(model))
    Q = np.eye(model.r)[:, : count + len(moved)]
    Q[count:, count:] = np.linalg.qr(moved.T)[0]
    return model.within(Q)

"""A reduced model in fewer coordinates: its lowest ones, and how the rest moves when ends of lines, springs or members soften."""

import numpy as np

from mouse_cli.diagnosis.effects.hinges import ends
from mouse_cli.diagnosis.effects.losses import loosened
from mouse_cli.diagnosis.effects.members import softening
from mouse_cli.diagnosis.likelihoods.modal import scales
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced


def lowest(model: Reduced, count: int, softening_too: bool = True) -> Reduced:
    """A model in its `count` lowest coordinates, and those by which ends of lines, springs and members soften; or itself.

    softening_too: False where nothing will soften, and the lowest are all.
    """
    if count >= model.r:
        return model
    if not softening_too:
        return model.within(np.eye(model.r)[:, :count])
    forces = np.concatenate([ends(model), loosened(model), softening(model)])[: model.r - count, count:]
    moved = forces / (model.eigenvalues[count:] + scales.lowest(model))
    Q = np.eye(model.r)[:, : count + len(moved)]
    Q[count:, count:] = np.linalg.qr(moved.T)[0]
    return model.within(Q)

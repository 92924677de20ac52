"""A reduced model in fewer coordinates: its lowest ones, and how the rest bends when one end of a line is released."""

import numpy as np

from mouse_cli.diagnosis.effects.hinges import ends
from mouse_cli.diagnosis.likelihoods.modal import scales
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced


def lowest(model: Reduced, count: int) -> Reduced:
    """A model in its `count` lowest coordinates, and those by which ends of lines turn; itself where there are no more."""
    if count >= model.r:
        return model
    bent = ends(model)[:, count:] / (model.eigenvalues[count:] + scales.lowest(model))
    bent = bent[: model.r - count]
    Q = np.eye(model.r)[:, : count + len(bent)]
    Q[count:, count:] = np.linalg.qr(bent.T)[0]
    return model.within(Q)

"""A first look at pairs of places that nothing joins: along which of them a spring could make what was measured.

By two rules, as neither alone finds all. To first order a spring k along b moves the data by k g, g their derivatives; with the
deck's parameters following, T their derivatives, it gains

    (g'r)^2 / (g'g - g'T (T'T + I)^-1 T'g)        where g'r > 0

of the misfit of the residual r: it ranks what is weak, and what acts on frequencies alone. And the matching of `force`, which is
exact for one force of any size, by the shapes.
"""

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.localise.force import matched
from mouse_cli.diagnosis.localise.matching import shapes
from mouse_cli.diagnosis.localise.survey import gained
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.diagnosis.sites.pairs import MOST, pairs

_STEPS = 8  # of the matching


def ties(model: Reduced) -> np.ndarray | None:
    """Keys (c, 3) of the MOST pairs that are worth fitting; None where there are no more."""
    found = pairs(model)
    if len(found) <= MOST:
        return None
    update = fit(Model(model), np.zeros(0))
    if update is None:
        return None
    gain, _ = gained(update, update.model.jacobian(update.point), found.rows @ update.point.X)
    order = [np.argsort(-gain[0], kind="stable")]
    measured = shapes(model)
    if len(measured.modes) and measured.dof > 0:
        order.append(np.argsort(matched(model, measured, found.rows, _STEPS).cost, kind="stable"))
    mixed = np.stack(order, axis=1).ravel()
    kept = mixed[np.sort(np.unique(mixed, return_index=True)[1])][:MOST]
    return found.keys[np.sort(kept)]

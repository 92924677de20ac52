"""What the mesh of bars does to functions, which no cause is to explain."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.extend.halves import halved
from mouse_cli.diagnosis.likelihoods.frf.damping import damping
from mouse_cli.diagnosis.likelihoods.frf.model import FrfModel
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.numerics import refinable
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.search.fit import Fit, fit
from mouse_cli.dynamics.solver import EigenSolver


def of_mesh(one: Fit, base: Reduced) -> float:
    """chi-square that the fit `one` of FRFs without a cause leaves of the functions of its own deck on half as long elements.

    No cause can gain more than that by imitating the mesh. base: the model with its modes; 0 where no mesh of bars can be halved.
    """
    if not refinable(base.problem):
        return 0.0
    theta = base.parameters(one.point.x[: one.model.of_deck])
    finer = reduced(halved(base.problem), theta, EigenSolver())
    data = replace(one.model.base.data, modes=None)
    same = replace(damping(finer, len(data.theory)), sd=one.model.damping.sd)
    blocks = zip(data.blocks, finer.problem.frf, strict=True)
    own = replace(data, blocks=tuple(replace(block, test=test) for block, test in blocks))
    there = FrfModel(replace(finer, data=own), same).point(one.point.x)
    if there is None:
        return 0.0
    blocks = tuple(replace(block, H=part.H) for block, part in zip(data.blocks, there.parts, strict=True))
    model = FrfModel(one.model.base.judged_by(replace(data, blocks=blocks)), one.model.damping)
    again = fit(model, np.zeros(0), one.point.x)
    return 0.0 if again is None else again.point.chi2

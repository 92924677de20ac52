"""What an explanation of functions makes of the calibration of their chains, where that is more than calibrations err."""

import numpy as np

from mouse_cli.diagnosis.gates import beyond
from mouse_cli.diagnosis.likelihoods.frf.compared import of_functions
from mouse_cli.diagnosis.likelihoods.frf.gains import Gains
from mouse_cli.diagnosis.likelihoods.frf.model import FrfModel
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.diagnosis.search.rank import explains
from mouse_cli.model.groups import enumerated

_SCALED = " Mass, stiffness and damping that are all wrong by one factor do the same as a gain of the force."


def miscalibrated(one: Fit) -> tuple[str, ...]:
    """The sentence on gains that are beyond their priors in a fit that explains the functions; none where no gain is so far.

    Thousands of values hardly show in their misfit what a gain has taken up of them, so that it is told by its shift.
    """
    model, x = of_functions(one).model, of_functions(one).point.x
    if not isinstance(model, FrfModel) or not explains(one):
        return ()
    (_, _, u, _, _), gains = model.split(x), model.gains
    found = beyond(u)
    if not found:
        return ()
    sd = np.sqrt(np.diag(of_functions(one).covariance)[model.lossy : model.measured])
    said = enumerated([_said(gains, j, u[j], sd[j]) for j in found])
    scaled = _SCALED if any(gains.of_force(j) for j in found) else ""
    return (f"The test is at fault, whatever the model lacks: the {said}. Calibrate there, or state a larger gain_sd.{scaled}",)


def _said(gains: Gains, j: int, u: float, sd: float) -> str:
    """Gain j, u (sd) prior standard deviations from its mean."""
    prior = gains.sd[j]
    value = np.exp(prior * u)
    return f"{gains.names[j]} is {value:.4g} (sd {value * prior * sd:.2g}) instead of 1: {u:+.1f} prior sd of {100 * prior:.3g} %"

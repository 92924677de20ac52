"""What an explanation of functions makes of the calibration of their chains, where that is more than calibrations err."""

import numpy as np

from mouse_cli.diagnosis.gates import beyond
from mouse_cli.diagnosis.likelihoods.frf.compared import of_functions
from mouse_cli.diagnosis.likelihoods.frf.gains import Gains
from mouse_cli.diagnosis.likelihoods.frf.model import FrfModel
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.diagnosis.search.rank import explains
from mouse_cli.model.groups import enumerated

_BEGIN = "The test is at fault, whatever the model lacks:"
_SCALED = " Mass, stiffness and damping that are all wrong by one factor do the same as a gain of the force."


def miscalibrated(one: Fit) -> tuple[str, ...]:
    """Sentences on gains that are beyond their priors, and on delays, in a fit that explains the functions; none where none is.

    Thousands of values hardly show in their misfit what a gain has taken up of them, so that it is told by its shift.
    """
    model, x = of_functions(one).model, of_functions(one).point.x
    if not isinstance(model, FrfModel) or not explains(one):
        return ()
    (_, _, u, _, _), gains = model.split(x), model.gains
    sd = np.sqrt(np.diag(of_functions(one).covariance)[model.lossy : model.measured])
    return _gains(gains, u, sd) + _delays(gains, u, sd)


def _gains(gains: Gains, u: np.ndarray, sd: np.ndarray) -> tuple[str, ...]:
    """The sentence on the gains; u, sd (t + r,): unknowns of the chains and their standard deviations."""
    found, parts = beyond(u[: len(gains.sd)]), []
    for j in found:
        prior, value = gains.sd[j], np.exp(gains.sd[j] * u[j])
        more = f"{u[j]:+.1f} prior sd of {100 * prior:.3g} %"
        parts.append(f"{gains.names[j]} is {value:.4g} (sd {value * prior * sd[j]:.2g}) instead of 1: {more}")
    if not found:
        return ()
    scaled = _SCALED if any(gains.of_force(j) for j in found) else ""
    return (f"{_BEGIN} the {enumerated(parts)}. Calibrate there, or state a larger gain_sd.{scaled}",)


def _delays(gains: Gains, u: np.ndarray, sd: np.ndarray) -> tuple[str, ...]:
    """The sentence on the delays that data tell from none, which are unknowns only where nothing explains the functions without."""
    own = slice(len(gains.sd), None)
    u, sd, names = u[own], sd[own], gains.names[own]
    found = beyond(u / sd)
    if not found:
        return ()
    mean = float(np.average(u, weights=sd**-2.0))
    if len(u) > 1 and not beyond((u - mean) / sd):  # the force is early, rather
        said = f"all responses are {_ms(gains, mean, float((sd**-2.0).sum() ** -0.5))} late behind the force"
    else:
        said = enumerated([f"{names[j]} is {_ms(gains, u[j], sd[j])} late" for j in found])
    return (f"{_BEGIN} {said} (filters, channels that are sampled in turn). Correct the phase in the file.",)


def _ms(gains: Gains, u: float, sd: float) -> str:
    """A delay of u (sd) prior standard deviations."""
    return f"{1e3 * gains.late * u:.4g} ms (sd {1e3 * gains.late * sd:.2g})"

"""Rules for the parameters and what is believed of them before the test."""

import numpy as np

from mouse_cli.formats.draft import Draft
from mouse_cli.formats.rules.entries import LARGEST
from mouse_cli.model.parameter import Gaussian, Parameter


def prior(draft: Draft) -> Gaussian | None:
    """The prior distribution of the parameters; None when a rule is broken."""
    names: set[str] = set()
    for parameter in draft.parameters:
        _one(draft, parameter)
        if parameter.name in names:
            message = f"two parameters are called '{parameter.name}'"
            draft.error("MD310", message, parameter.span, help="give each its own name")
        names.add(parameter.name)
    mean = np.array([p.nominal for p in draft.parameters])
    cov = draft.covariance
    if cov is None:
        return Gaussian(mean, np.array([p.variance for p in draft.parameters]))
    _semidefinite(draft, cov)
    return Gaussian(mean, cov)


def _one(draft: Draft, parameter: Parameter) -> None:
    """One parameter: its standard deviation, its limits and its transform."""
    name, where = parameter.name, parameter.span
    if not 0 <= parameter.sd < LARGEST:
        draft.error(
            "MD311",
            f"standard deviation of {name} is {parameter.sd:.8g}; it must be positive and below {LARGEST:g}, or 0 to hold it",
            where,
            help="give the standard deviation of the property",
        )
    elif parameter.sd == 0:
        draft.warn("MD312", f"{name} has no standard deviation: it stays at its prior value", where)
    if not abs(parameter.nominal) < LARGEST:
        draft.error("MD302", f"nominal value of {name} is {parameter.nominal}", where, help="give a finite number")
    if not parameter.lower <= parameter.nominal <= parameter.upper or parameter.lower == parameter.upper:
        draft.error(
            "MD313",
            f"{name} has the prior value {parameter.nominal:.8g}, which is not within its limits "
            f"{parameter.lower:.8g} to {parameter.upper:.8g}",
            where,
            help="give lower < upper with the nominal value between them",
        )
    if parameter.transform == "log" and not parameter.nominal > 0:
        message = (
            f"{name} has transform log and the nominal value {parameter.nominal:.8g}; a logarithm needs a positive one"
        )
        draft.error("MD314", message, where, help="give a positive nominal value, or transform: identity")
    if parameter.transform == "log" and draft.run.fix_total_mass:
        message = f"{name} has transform log, but the total mass can be held fixed only for transform identity"
        draft.error("MD315", message, where, help="use limits (lower: 0) instead of the logarithm")


def _semidefinite(draft: Draft, cov: np.ndarray) -> None:
    """A covariance is symmetric and has no negative eigenvalue."""
    if not np.isfinite(cov).all():
        draft.error("MD316", "prior covariance is not finite", draft.where_covariance)
        return
    scale = np.sqrt(np.outer(np.abs(np.diag(cov)), np.abs(np.diag(cov))))
    correlation = np.divide(cov, scale, out=np.zeros_like(cov), where=scale > 0)
    if not np.allclose(correlation, correlation.T, atol=1e-9):
        draft.error("MD316", "prior covariance is not symmetric", draft.where_covariance)
    elif np.linalg.eigvalsh(correlation).min() < -1e-9:
        message = "prior covariance has a negative eigenvalue: no set of properties can be correlated so"
        help = "check the correlations; each lies within -1 to 1, and they must agree with one another"
        draft.error("MD316", message, draft.where_covariance, help=help)

"""What a fit strains: parameters far from their prior, and a law whose own mode the record cannot show."""

import numpy as np

from mouse_cli.diagnosis.gates import FAR, GATE
from mouse_cli.diagnosis.likelihoods.history.polish import Fit
from mouse_cli.updating.chi_square import upper_tail

_END = 0.01  # of the logarithm of a range, from its end


def shifted(one: Fit, scale: float = 1.0) -> np.ndarray:
    """Nuisances z (k,) in prior sd, the deck's own parameters first, where the variances of the data are `scale` times the stated.

    With H = H_d + P the curvature of the cost, of data and of prior, the optimum moves by -(H_d/s + P)^-1 (1 - 1/s) P z.
    """
    k, x = one.hypothesis.nuisances, one.x
    if scale <= 1.0 or not len(one.covariance):
        return x[:k]
    P = np.diag(1 / one.hypothesis.sd**2)
    H = np.linalg.inv(one.covariance)
    step = np.linalg.solve((H - P) / scale + P, (1 - 1 / scale) * P @ (x - one.hypothesis.mean))
    return (x - step)[:k]


def shift_p(one: Fit, scale: float = 1.0) -> float:
    """p-value of the prior part of the cost: of all nuisances together, or of the furthest of so many."""
    z2 = shifted(one, scale) ** 2
    if not len(z2):
        return 1.0
    return min(upper_tail(float(z2.sum()), len(z2)), len(z2) * upper_tail(float(z2.max()), 1), 1.0)


def strained(one: Fit, scale: float | None = None) -> bool:
    """Whether nuisances are further from their prior than chance allows; scale: by what the fit leaves, unless it is known."""
    return shift_p(one, max(1.0, one.misfit / one.dof) if scale is None else scale) < GATE


def innovation(one: Fit) -> float:
    """Misfit and prior part of the cost together."""
    return one.misfit + float((shifted(one) ** 2).sum())


def far(one: Fit, scale: float) -> tuple[str, ...]:
    """The nuisances beyond FAR, in words, the furthest first."""
    z = shifted(one, scale)
    names = (*one.hypothesis.linear.names, *(f"offset of force {i + 1}" for i in range(len(one.hypothesis.offset))))
    order = np.argsort(-np.abs(z))
    return tuple(f"{names[i]} is {z[i]:+.1f} prior sd from its mean" for i in order if abs(z[i]) > FAR)


def hidden(one: Fit, horizon_s: float) -> tuple[str, str] | None:
    """Key and reason of a law whose own mode is no finding: slower than the stretch it is judged on, or at the end of its range.

    Within a stretch such a mode is a free force, that may stand for anything.
    """
    for part, p in one.hypothesis.sizes(one.x[None]):
        if not part.extra:
            continue
        frequency = next((v for u, v in zip(part.unknowns, p[:, 0], strict=True) if u.unit == "Hz"), np.inf)
        if frequency * horizon_s < 1:
            slow = f"its period, {1 / frequency:.3g} s, is longer than the stretch of {horizon_s:.3g} s it is judged on"
            return part.law.key, f"{part.place.site.text}: {slow}"
        for size, value in zip(part.unknowns, p[:, 0], strict=True):
            reach = _END * np.log(size.upper / size.lower)
            low = size.unit != "1" and np.log(value / size.lower) < reach
            if low or np.log(size.upper / value) < reach:
                return (
                    part.law.key,
                    f"{part.place.site.text}: its {size.name} ends at the end of the range held possible",
                )
    return None

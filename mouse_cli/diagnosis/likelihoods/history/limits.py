"""What a fit strains: parameters far from their prior, and a law whose own mode the record cannot show."""

import numpy as np

from mouse_cli.diagnosis.gates import FAR
from mouse_cli.updating.recordings.adequacy import shifted
from mouse_cli.updating.recordings.polish import Fit

_END = 0.01  # of the logarithm of a range, from its end


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

"""Which laws records can show: none slower than a stretch, at the end of its range or but the limit of a plainer one, no dashpot
where damping is assumed.
"""

import numpy as np

from mouse_cli.diagnosis.gates import ODDS
from mouse_cli.updating.recordings.acting import Part
from mouse_cli.updating.recordings.adequacy import adequate
from mouse_cli.updating.recordings.fit import Fit
from mouse_cli.updating.recordings.study import Study

_END = 0.01  # of the logarithm of a range, from its end
_DASHPOT = "dashpot"  # key of the law that is damping alone


def shown(study: Study, found: list[Fit], dropped: dict[str, str]) -> list[Fit]:
    """Fits whose laws the records can show; into `dropped` the others."""
    horizon, kept = study.length * study.look.dt, []
    for one in found:
        unseen = hidden(one, horizon)
        if unseen is None:
            kept.append(one)
        else:
            dropped[unseen[0]] = unseen[1]
    return once(kept, dropped)


def once(found: list[Fit], dropped: dict[str, str]) -> list[Fit]:
    """Fits without those whose law is seen as what a plainer one beside it is, unless they are sure against it: one hypothesis is
    weighed once.

    Friction that never slips is a spring, with a slip force that no record tells: their evidence differs by the ranges of their
    sizes, which is nothing that a record says.
    """
    plain = {tuple(_seen(one)): one.log_evidence for one in found if not _limited(one)}
    kept = []
    for one in found:
        limited = _limited(one)
        if limited and plain.get(tuple(_seen(one)), -np.inf) >= one.log_evidence - ODDS:
            part = limited[0]
            size = part.unknowns[part.law.limit[0]].name
            dropped[part.law.key] = f"{part.site.text}: no record reaches its {size}, and a plainer law is what it is below"
        else:
            kept.append(one)
    return kept


def _seen(one: Fit) -> list[tuple[str, str]]:
    """Groups as which the laws of a fit are seen, with their places."""
    return sorted((part.place.where, group) for part, group in zip(one.recipes, one.groups, strict=True))


def _limited(one: Fit) -> list[Part]:
    """Laws of a fit that are seen as something else."""
    return [part for part, group in zip(one.recipes, one.groups, strict=True) if group != part.law.group]


def undamped(study: Study, found: list[Fit], dropped: dict[str, str]) -> list[Fit]:
    """Fits without dashpots where the damping of the deck is assumed and others explain the records; into `dropped` why.

    The damping of a structure is not that of the modes of its model, least of all when mass or stiffness is other than modelled.
    """
    others = [one for one in found if all(part.law.key != _DASHPOT for part in one.hypothesis.parts)]
    if not study.model.bare or len(others) == len(found) or not any(map(adequate, others)):
        return found
    dropped[_DASHPOT] = "the deck has no damping, and the residual without one may be noise: it says how the structure is damped"
    return others


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
            return part.law.key, f"{part.site.text}: {slow}"
        for size, value in zip(part.unknowns, p[:, 0], strict=True):
            reach = _END * np.log(size.upper / size.lower)
            low = size.unit != "1" and np.log(value / size.lower) < reach
            if low or np.log(size.upper / value) < reach:
                return (
                    part.law.key,
                    f"{part.site.text}: its {size.name} ends at the limit of its range",
                )
    return None

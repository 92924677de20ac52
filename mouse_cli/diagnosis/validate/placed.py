"""Places of one hypothesis by what the deck holds out: fitted data may leave open where it acts, and the rest tell.

p(held out | fitted) of a hypothesis at several places is the mean over these, by their shares in its evidence.
"""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.search.descents import idealised
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.diagnosis.validate.held_out import held_out_density

_ASKED = 1e-3  # share from which on a place is asked


def places(one: Fit) -> list[tuple[Fit, float]]:
    """The fit at the place where it leads and at the others, and their shares."""
    if not one.elsewhere:
        return [(one, 1.0)]
    total = sum(share for _, share in one.elsewhere)
    own = replace(one, elsewhere=(), log_evidence=one.log_evidence + float(np.log(max(1 - total, 1e-300))))
    return [(own, 1 - total), *one.elsewhere]


def predicted(one: Fit) -> tuple[float, np.ndarray] | None:
    """ln of the density of what is held out, noise integrated out of it, over all places, and what each adds to it; None: nothing
    is held out, or it cannot be predicted.
    """
    found = []
    for i, (each, share) in enumerate(places(one)):
        density = held_out_density(each) if share > _ASKED or i == 0 else None
        if density is None and i == 0:
            return None
        found.append(-np.inf if density is None else float(np.log(max(share, 1e-300))) + density.over_noise)
    return float(np.logaddexp.reduce(found)), np.array(found)


def led(one: Fit) -> Fit:
    """The same, led by the place that is most probable by what was fitted and what is held out; shares are those of the fit.

    What has no name stays where it is: where it acts is its field's to say.
    """
    found = predicted(one) if one.elsewhere and not one.nameless else None
    if found is None or not np.argmax(found[1]):
        return one
    every = places(one)
    first, _ = every.pop(int(np.argmax(found[1])))
    return replace(idealised(first), log_evidence=one.log_evidence, elsewhere=tuple(every))


def shared(one: Fit) -> Fit:
    """The same with shares of its places by all data."""
    found = predicted(one) if one.elsewhere else None
    if found is None:
        return one
    shares = np.exp(found[1] - found[0])[1:].tolist()
    return replace(one, elsewhere=tuple((each, share) for (each, _), share in zip(one.elsewhere, shares, strict=True)))

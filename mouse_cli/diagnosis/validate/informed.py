"""What the deck holds out as data too: explanations that the fitted data leave open, by how well they predict the rest.

p(i | fitted, held out) is in proportion to p(i | fitted) p(held out | i, fitted).
"""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.gates import LIKELY
from mouse_cli.diagnosis.search.rank import Ranking
from mouse_cli.diagnosis.validate.placed import led, predicted, shared

_ASKED = 1e-3  # probability from which on, but for the leading one without a name, an explanation must predict as well as the best


def informed(ranking: Ranking) -> Ranking:
    """The ranking with the probabilities of its mechanisms, all together as before, by all data.

    Noise larger than stated is integrated out of each prediction: where all of them err, how much each does says less.
    """
    rivals = np.array([one is not ranking.baseline for one in ranking.fits])
    wanted = rivals & (ranking.probabilities > _ASKED)
    wanted[[i for i, one in enumerate(ranking.fits) if one.nameless][:1]] = True
    asked = np.flatnonzero(wanted).tolist()
    if len(asked) < 2 or dict(ranking.groups).get("none", 0.0) > LIKELY:
        return ranking
    told = [predicted(ranking.fits[i]) for i in asked]
    if None in told:
        return ranking
    densities = np.array([density for density, _ in told])
    # In logarithms: what predicts badly enough may have led by all of the probability.
    p, weight = ranking.probabilities.copy(), np.log(np.maximum(ranking.probabilities, np.finfo(float).tiny))
    weight[asked] += densities - densities.max()
    weight = np.exp(weight - weight[rivals].max())
    p[rivals] = ranking.probabilities[rivals].sum() * weight[rivals] / weight[rivals].sum()
    order = np.argsort(-p, kind="stable")
    return replace(
        ranking,
        fits=tuple(shared(led(ranking.fits[i])) if i in asked else ranking.fits[i] for i in order.tolist()),
        probabilities=p[order],
        stated=ranking.stated[order],
        log_odds=ranking.log_odds[order],
        by_fitted=ranking.probabilities[order],
    )

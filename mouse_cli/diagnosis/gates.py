"""What every kind of test is judged by: how probable hypotheses are beforehand, and what a name takes. Each stands here alone."""

from collections.abc import Sequence
from math import comb, erfc, log, sqrt

from mouse_cli.model.diagnosis import UNPROVED
from mouse_cli.model.prediction import REFUTED

NONE = 0.3
"""Prior probability that nothing is missing."""

ONE, MORE = 0.6, 1 / 7
"""Prior probability of one mechanism, and by what each further one is less probable: together 0.7."""

ALIKE = 0.5
"""Share of the sets of several mechanisms that are of one group because it is one; others may be of one group too."""

BY_GROUP = 0.5
"""Share of the prior of mechanisms that is spread evenly over groups and then over places; the rest is over places at once."""

NAMELESS = 0.1
"""Prior weight of a change without a name, about that of a pair."""

SURE = 0.95
"""Posterior probability of a group, and of its site, from which on it is named: no rival is left that would have to be listed."""

OPEN = 0.97
"""The same of what many sets share, none of which is sure: sets that were not tried may have it at another place, or not at all."""

STAYS = 0.1
"""Posterior probability of a group above which it stays a rival of a leading field without a name."""

SAME_SITE = 0.05
"""Distance, over the span of the structure, up to which mechanisms of one group in two explanations are one mechanism."""

ODDS = 3.0
"""Log of the odds over no mechanism, noise larger than stated integrated out, that a name takes."""

MATERIAL = 3.0
"""Log evidence that each further mechanism of a set, or part of a mechanism, must gain."""

WHOLLY = 0.5
"""Prior probability that a part which has lost something is gone."""

GATE = REFUTED
"""p-value of a misfit, of a shift of the parameters or of both below which it is not chance."""

SEVERAL = 1e-2
"""p-value that an explanation of several mechanisms needs: with two of them almost anything can be fitted."""

LIKELY, DEMANDED = 0.1, UNPROVED
"""Probability of no mechanism below which something is likely missing though not proved, and below which it is missing."""

FAR = 5.0
"""Distance of a parameter from its prior mean, in prior sd, beyond which a fit is rejected: it gives no name."""

BEYOND = 0.01
"""Probability that any of several unknowns is so far from its prior mean, below which those that are so far are reported."""


def beyond(z: Sequence[float]) -> list[int]:
    """Which of the shifts z (n,), in prior sd, are beyond what chance makes of n.

    >>> beyond([0.3, -4.0, 2.9]), beyond([2.9])
    ([1], [0])
    """
    return [j for j, far in enumerate(z) if len(z) * erfc(abs(far) / sqrt(2)) < BEYOND]


def prior(count: int) -> float:
    """Prior probability that `count` mechanisms are missing, whichever.

    >>> [round(prior(count), 4) for count in range(4)]
    [0.3, 0.6, 0.0857, 0.0122]
    """
    return NONE if count == 0 else ONE * MORE ** (count - 1)


def log_prior(count: int, groups: int, alike: bool) -> float:
    """ln of the prior probability of one set of groups of `count` mechanisms, of a library of so many; alike: all of one group.

    Half of all sets (ALIKE) are drawn from those of one group: structures degrade in one way at several places, and like items are
    removed. The other half is drawn from all multisets, those of one group among them.

    >>> [round(log_prior(2, 12, alike) - log_prior(2, 12, False), 2) for alike in (False, True)]
    [0.0, 2.01]
    """
    groups, repeated = max(groups, 1), ALIKE if count > 1 else 0.0
    share = (1 - repeated) / comb(groups + count - 1, count) + repeated * alike / groups
    return log(prior(count) * share)

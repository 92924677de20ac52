"""What every kind of test is judged by: how probable hypotheses are beforehand, and what a name takes.

P(none) = 0.3; P(n mechanisms) = 0.6 / 7^(n - 1), which is 0.7 for one and more together; a change without a name counts as much as
a pair. Within a number of mechanisms every set of groups is alike, and within a group its members.
"""

from math import comb, log

NONE, ONE, MORE, NAMELESS = (
    0.3,
    0.6,
    1 / 7,
    0.1,
)  # nothing, one mechanism, each further one by that; without a name
SURE = 0.9  # probability of a group from which on it is named
ODDS = 3.0  # ln of the odds over the model as it is that a name needs
GATE = 1e-3  # p-value of the misfit, below which something is missing, and an explanation none
SEVERAL = (
    1e-2  # p-value that an explanation of several mechanisms needs: with two of them almost anything can be fitted
)
LIKELY, DEMANDED = (
    0.1,
    0.02,
)  # probability of the model as it is below which something is likely missing, and below which it is
FAR = 5.0  # prior standard deviations of a parameter of the deck, beyond which a fit with it is no explanation


def log_prior(count: int, groups: int) -> float:
    """ln of the prior probability of one set of `count` mechanisms, of a library of so many groups.

    >>> round(float(2.718281828 ** log_prior(1, 10)), 3)
    0.06
    """
    if count == 0:
        return log(NONE)
    return log(ONE * MORE ** (count - 1) / comb(max(groups, 1) + count - 1, count))

"""The priors and gates of every verdict, whatever the kind of test; each stands here and nowhere else."""

PRIOR = 0.3, 0.6, 0.1
"""Prior probability that nothing is missing, that one mechanism is, that two are; each is shared evenly by groups, and within a
group by its members."""

SURE = 0.9
"""Posterior probability of a group from which on it is named."""

ODDS = 3.0
"""Log evidence over that of no mechanism, in nats and by the noise scale, that a name takes."""

GATE = 1e-3
"""p-value of a misfit, of a shift of the parameters or of both below which it is not chance."""

FAR_PRIOR = 5.0
"""Distance of a parameter from its prior mean, in prior sd, beyond which no fit is believed: such a fit is no name."""

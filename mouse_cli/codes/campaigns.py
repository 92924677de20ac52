"""MD550 and MD930 to MD959: what a posterior is worth, sweeps, bootstraps and samples."""

from mouse_cli.codes import Code

CODES = {
    "MD550": Code(
        "posterior that is not normal",
        "A run reports the mode of the posterior and the standard deviations of the normal density that first-order partial "
        "derivatives put there. Two standard deviations from the mode, along the axis that changes a property by the largest share "
        "of its value, the posterior is narrower or wider than that density by a factor of 1.5 or more: so are its intervals. "
        "It is looked at where that costs little: converged runs of the anchored recursion with a prior, whose model is not "
        "rejected, with dense matrices of up to 40 degrees of freedom.",
        "`mouse sample` gives the posterior as it is. Where the data hardly determine a property, measure what it moves.",
    ),
    "MD940": Code(
        "no package for samples",
        "`mouse sample` walks with the package emcee, which a plain installation does not bring.",
        "`pip install 'mouse-cli[sampling]'`.",
    ),
    "MD941": Code(
        "no posterior to sample",
        "The deck lets no property vary, holds no data, or its run has no answer to begin from.",
        "See what `mouse run` says of the deck.",
    ),
    "MD942": Code(
        "normal density that cannot stand for the posterior",
        "Draws from the normal density of the run were weighed by the true posterior. The tail of the weights is so heavy (Pareto "
        "k-hat above 0.7) that no practicable number of draws would give its mean (Vehtari et al. 2024; Yao et al. 2018).",
        "Use the samples, and not the standard deviations of `mouse run`.",
    ),
    "MD943": Code(
        "posterior with several modes",
        "Begun from other values of the prior, the search ends elsewhere, and nearly as high: the data and the prior allow "
        "several answers, such as two springs exchanged. `mouse run` tells of one of them.",
        "Measure what tells them apart (mode shapes, a mass added on one side), or say in the prior what is known.",
    ),
    "MD944": Code(
        "chain too short",
        "The walkers took fewer than 50 autocorrelation times, or do not agree (R-hat of 1.05 or more): quantiles of the samples "
        "are not those of the posterior yet.",
        "Allow more `--steps`. Where that does not help, the posterior has places between which walkers seldom go.",
    ),
}
